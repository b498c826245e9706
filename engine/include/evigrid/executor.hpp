// SPDX-License-Identifier: Apache-2.0
// Who runs the tiles. One signature for serial, TBB, OpenMP, spinning threads and the host's own; results never depend
// on it.
#pragma once
#include <chrono>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "evigrid/export.hpp"

namespace EVIGRID_API evigrid {

class Executor {
 public:
  using Task = void (*)(void* context, std::int64_t index, int worker);
  virtual ~Executor() = default;
  /// Largest number of workers that may call a task at the same time; `worker` is below it.
  [[nodiscard]] virtual int concurrency() const noexcept = 0;
  [[nodiscard]] virtual std::string_view name() const noexcept = 0;
  /// Calls task(context, i, worker) once for every i in [0, count), in any order and on any threads, no two at a time
  /// with one `worker`, and returns when all are done; what they wrote is then visible to the caller. A task may throw
  /// (std::bad_alloc): run() then throws the first exception when no task runs any more; whether those that had not
  /// begun were called is not said, and the next run() is not disturbed. Executors of your own must keep that: what
  /// leaves a thread, or an OpenMP region, ends the process. Maps that share an executor may call it at the same time,
  /// each from its own thread.
  virtual void run(std::int64_t count, Task task, void* context) = 0;
};

/// threads = 0 (or less) means as many as the machine has. None of them changes a process-wide setting.
std::unique_ptr<Executor> make_serial_executor();
std::unique_ptr<Executor> make_tbb_executor(int threads = 0);
std::unique_ptr<Executor> make_openmp_executor(int threads = 0);
/// Threads of its own that, after work, look for more for `spin` before they sleep: a scan that comes within that time
/// starts on all of them at once (about a microsecond), where threads that sleep take 50 µs and more to wake. The price
/// is stated by `spin`: each thread but the caller keeps a core busy for at most that long after the last work; 0
/// sleeps at once. The caller works too, as worker 0, and never waits for a sleeper. Run from inside a task, beside
/// another run, or in a forked child, it runs on the calling thread alone. Throws std::system_error when a thread
/// cannot be started.
inline constexpr std::chrono::microseconds kSpinDefault{20'000};
std::unique_ptr<Executor> make_spinning_executor(int threads = 0, std::chrono::microseconds spin = kSpinDefault);
/// By name: "serial", "tbb", "openmp", "spin"; nullptr for another name.
std::unique_ptr<Executor> make_executor(std::string_view name, int threads = 0);

}  // namespace evigrid
