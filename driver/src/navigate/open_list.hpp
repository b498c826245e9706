// SPDX-License-Identifier: Apache-2.0
// A* 's open list. Exact order — least f, then largest g, then lowest index — at the cost of small heaps: items lie in
// buckets of f, unsorted, and only the bucket that is being emptied is a heap. It fits into the cache where one heap
// over a frontier of thousands of cells does not.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace evigrid::driver {

class OpenList {
 public:
  struct Item {
    double f, g;
    std::uint32_t index;
  };

  void clear() {
    heap_.clear();
    for (std::int64_t b = now_ + 1; waiting_ > 0; ++b) {  // no farther than what still waits
      auto& slot = slots_[static_cast<std::size_t>(b % kSlots)];
      waiting_ -= slot.size();
      slot.clear();
    }
    began_ = false;
  }
  [[nodiscard]] bool empty() const { return heap_.empty() && waiting_ == 0; }

  /// f is finite and at least that of the last item taken, but for rounding.
  void push(const Item& item) {
    const std::int64_t b = bucket(item.f);
    if (!began_) now_ = b, began_ = true;
    if (b <= now_) {
      heap_.push_back(item);
      std::push_heap(heap_.begin(), heap_.end(), Later{});
    } else {
      wait(item, b);
    }
  }

  /// Of a list that is not empty.
  Item pop() {
    while (heap_.empty()) next_bucket();
    std::pop_heap(heap_.begin(), heap_.end(), Later{});
    const Item top = heap_.back();
    heap_.pop_back();
    return top;
  }

  /// What pop() would most likely take next, if it is at hand: to be fetched from memory ahead of time.
  [[nodiscard]] const Item* peek() const { return heap_.empty() ? nullptr : heap_.data(); }

 private:
  static constexpr double kPerUnit = 128;       // buckets for a step of cost 1
  static constexpr std::int64_t kSlots = 4096;  // a ring; what lies beyond waits in its last slot and is put off again

  struct Later {  // a type, so that the heaps inline it
    bool operator()(const Item& a, const Item& b) const {
      return a.f != b.f ? a.f > b.f : a.g != b.g ? a.g < b.g : a.index > b.index;
    }
  };
  static std::int64_t bucket(double f) { return static_cast<std::int64_t>(std::min(f * kPerUnit, 1e15)); }
  void wait(const Item& item, std::int64_t b) {
    slots_[static_cast<std::size_t>(std::min(b, now_ + kSlots - 1) % kSlots)].push_back(item);
    ++waiting_;
  }
  void next_bucket() {
    ++now_;
    auto& slot = slots_[static_cast<std::size_t>(now_ % kSlots)];
    if (slot.empty()) return;
    heap_.swap(slot);  // slot is empty now, and keeps the heap's memory
    waiting_ -= heap_.size();
    const auto far = std::partition(heap_.begin(), heap_.end(), [&](const Item& i) { return bucket(i.f) <= now_; });
    if (far != heap_.end()) {
      const auto nearest = std::min_element(far, heap_.end(), [](const Item& i, const Item& k) { return i.f < k.f; });
      if (far == heap_.begin() && waiting_ == 0) now_ = bucket(nearest->f) - 1;  // nothing before it
      for (auto i = far; i != heap_.end(); ++i) wait(*i, bucket(i->f));
    }
    heap_.erase(far, heap_.end());
    std::make_heap(heap_.begin(), heap_.end(), Later{});
  }

  std::vector<Item> heap_;  // of the bucket `now_`, and of what came too late for an earlier one
  std::vector<std::vector<Item>> slots_ = std::vector<std::vector<Item>>(kSlots);
  std::int64_t now_ = 0;
  std::size_t waiting_ = 0;
  bool began_ = false;
};

}  // namespace evigrid::driver
