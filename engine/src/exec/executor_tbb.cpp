// SPDX-License-Identifier: Apache-2.0
// TBB in an arena of our own: the host's limits and its other arenas are left alone.
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "evigrid/executor.hpp"

namespace evigrid {
namespace {

class Tbb final : public Executor {
 public:
  explicit Tbb(int threads) : arena_(allowed(threads)) { arena_.initialize(); }
  [[nodiscard]] int concurrency() const noexcept override { return arena_.max_concurrency(); }
  [[nodiscard]] std::string_view name() const noexcept override { return "tbb"; }
  void run(std::int64_t count, Task task, void* context) override {
    arena_.execute([&] {
      tbb::parallel_for(
          tbb::blocked_range<std::int64_t>(0, count, 1),
          [&](const tbb::blocked_range<std::int64_t>& r) {
            const int worker = tbb::this_task_arena::current_thread_index();
            for (std::int64_t i = r.begin(); i < r.end(); ++i) task(context, i, worker);
          },
          tbb::simple_partitioner());
    });
  }

 private:
  /// TBB would cut a larger arena down by itself, and complain on the console of the host.
  static int allowed(int threads) {
    const auto most = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    return threads <= 0 ? tbb::task_arena::automatic : std::min(threads, static_cast<int>(most));
  }
  tbb::task_arena arena_;
};

}  // namespace

std::unique_ptr<Executor> make_tbb_executor(int threads) { return std::make_unique<Tbb>(threads); }

}  // namespace evigrid
