// SPDX-License-Identifier: Apache-2.0
// A bounded first-in first-out queue between those who make scans and the one who fuses them. Nothing is ever dropped:
// a full queue holds the producer back, and says how often. Any number of threads on either side.
#pragma once
#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <iterator>
#include <mutex>
#include <stdexcept>
#include <utility>
#include <vector>

namespace evigrid {

template <class T>
class BoundedQueue {
 public:
  struct Counts {
    std::uint64_t pushed = 0, popped = 0;
    std::uint64_t held_back = 0;   ///< pushes that found no room: refused by try_push, made to wait by push
    std::size_t most_waiting = 0;  ///< largest length so far
  };

  explicit BoundedQueue(std::size_t capacity) : capacity_(capacity) {
    if (capacity == 0) throw std::invalid_argument("a queue of capacity 0 passes nothing on");
  }

  /// False, with `item` untouched, when the queue is full or closed.
  bool try_push(T&& item) {
    const std::lock_guard lock(mutex_);
    if (closed_) return false;
    if (items_.size() == capacity_) {
      ++counts_.held_back;
      return false;
    }
    add(std::move(item));
    return true;
  }

  /// Waits for room. False, with `item` untouched, when the queue is or gets closed.
  bool push(T&& item) {
    std::unique_lock lock(mutex_);
    if (items_.size() == capacity_ && !closed_) ++counts_.held_back;
    room_.wait(lock, [&] { return closed_ || items_.size() < capacity_; });
    if (closed_) return false;
    add(std::move(item));
    return true;
  }

  /// Appends the oldest items, `most` of them or all there are, to `out`; says how many.
  std::size_t pop(std::size_t most, std::vector<T>& out) {
    const std::lock_guard lock(mutex_);
    return take(most, out);
  }

  /// The same, but waits for the first. 0: closed and empty.
  std::size_t wait_pop(std::size_t most, std::vector<T>& out) {
    std::unique_lock lock(mutex_);
    some_.wait(lock, [&] { return closed_ || !items_.empty(); });
    return take(most, out);
  }

  /// No more pushes; what is in the queue can still be popped.
  void close() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    room_.notify_all();
    some_.notify_all();
  }

  [[nodiscard]] std::size_t capacity() const noexcept { return capacity_; }
  [[nodiscard]] std::size_t size() const {
    const std::lock_guard lock(mutex_);
    return items_.size();
  }
  [[nodiscard]] std::size_t room() const { return capacity_ - size(); }
  [[nodiscard]] Counts counts() const {
    const std::lock_guard lock(mutex_);
    return counts_;
  }

 private:
  void add(T&& item) {
    items_.push_back(std::move(item));
    ++counts_.pushed;
    counts_.most_waiting = std::max(counts_.most_waiting, items_.size());
    some_.notify_one();
  }
  std::size_t take(std::size_t most, std::vector<T>& out) {
    const std::size_t n = std::min(most, items_.size());
    const auto end = items_.begin() + static_cast<std::ptrdiff_t>(n);
    out.insert(out.end(), std::make_move_iterator(items_.begin()), std::make_move_iterator(end));
    items_.erase(items_.begin(), end);
    counts_.popped += n;
    if (n > 0) room_.notify_all();
    return n;
  }

  mutable std::mutex mutex_;
  std::condition_variable room_, some_;
  std::deque<T> items_;
  std::size_t capacity_;
  Counts counts_;
  bool closed_ = false;
};

}  // namespace evigrid
