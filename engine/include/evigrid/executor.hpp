// SPDX-License-Identifier: Apache-2.0
// Who runs the tiles. One signature for serial, TBB, OpenMP and the host's own threads; results never depend on it.
#pragma once
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

namespace evigrid {

class Executor {
 public:
  using Task = void (*)(void* context, std::int64_t index, int worker);
  virtual ~Executor() = default;
  /// Largest number of workers that may call a task at the same time; `worker` is below it.
  [[nodiscard]] virtual int concurrency() const noexcept = 0;
  [[nodiscard]] virtual std::string_view name() const noexcept = 0;
  /// Calls task(context, i, worker) once for every i in [0, count) and returns when all are done.
  virtual void run(std::int64_t count, Task task, void* context) = 0;
};

/// threads = 0 means as many as the machine has. None of them changes a process-wide setting.
std::unique_ptr<Executor> make_serial_executor();
std::unique_ptr<Executor> make_tbb_executor(int threads = 0);
std::unique_ptr<Executor> make_openmp_executor(int threads = 0);
/// By name: "serial", "tbb", "openmp"; nullptr for another name.
std::unique_ptr<Executor> make_executor(std::string_view name, int threads = 0);

}  // namespace evigrid
