// SPDX-License-Identifier: Apache-2.0
// The calling thread alone; also the choice by name.
#include "evigrid/executor.hpp"

namespace evigrid {
namespace {

class Serial final : public Executor {
 public:
  [[nodiscard]] int concurrency() const noexcept override { return 1; }
  [[nodiscard]] std::string_view name() const noexcept override { return "serial"; }
  void run(std::int64_t count, Task task, void* context) override {
    for (std::int64_t i = 0; i < count; ++i) task(context, i, 0);
  }
};

}  // namespace

std::unique_ptr<Executor> make_serial_executor() { return std::make_unique<Serial>(); }

std::unique_ptr<Executor> make_executor(std::string_view name, int threads) {
  if (name == "serial") return make_serial_executor();
  if (name == "tbb") return make_tbb_executor(threads);
  if (name == "openmp") return make_openmp_executor(threads);
  if (name == "spin") return make_spinning_executor(threads);
  return nullptr;
}

}  // namespace evigrid
