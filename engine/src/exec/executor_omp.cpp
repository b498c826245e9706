// SPDX-License-Identifier: Apache-2.0
// OpenMP with the number of threads stated at the loop: no process-wide setting is touched.
#include <omp.h>

#include <exception>

#include "evigrid/executor.hpp"

namespace evigrid {
namespace {

class OpenMp final : public Executor {
 public:
  explicit OpenMp(int threads) : threads_(threads > 0 ? threads : omp_get_num_procs()) {}
  [[nodiscard]] int concurrency() const noexcept override { return threads_; }
  [[nodiscard]] std::string_view name() const noexcept override { return "openmp"; }
  /// An exception must not leave the parallel region: the first one is thrown behind it.
  void run(std::int64_t count, Task task, void* context) override {
    std::exception_ptr thrown;
#pragma omp parallel for num_threads(threads_) schedule(dynamic, 1)
    for (std::int64_t i = 0; i < count; ++i) {
      try {
        task(context, i, omp_get_thread_num());
      } catch (...) {
#pragma omp critical(evigrid_executor_omp)
        if (!thrown) thrown = std::current_exception();
      }
    }
    if (thrown) std::rethrow_exception(thrown);
  }

 private:
  int threads_;
};

}  // namespace

std::unique_ptr<Executor> make_openmp_executor(int threads) { return std::make_unique<OpenMp>(threads); }

}  // namespace evigrid
