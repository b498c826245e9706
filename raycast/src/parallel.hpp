// SPDX-License-Identifier: Apache-2.0
// Many independent queries on a TBB arena of their own: the host's arenas and limits stay as they are. Each block
// writes only its own answers, so they do not depend on the number of threads.
#pragma once
#include <tbb/blocked_range.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <stdexcept>

namespace evigrid::raycast {

/// Calls work(begin, end) for blocks of about `block` of the `count` items. `threads`: 0 for as many as there are.
template <typename Work>
void for_each_block(std::size_t count, std::size_t block, int threads, const Work& work) {
  if (threads < 0) throw std::invalid_argument("threads is negative");
  // No more than the machine has: TBB would print a warning.
  const int most = tbb::info::default_concurrency(), wanted = threads == 0 ? most : std::min(threads, most);
  if (wanted == 1 || count <= block) {
    if (count > 0) work(std::size_t{0}, count);
    return;
  }
  tbb::task_arena arena(wanted);
  arena.execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, block),
                      [&](const tbb::blocked_range<std::size_t>& r) { work(r.begin(), r.end()); });
  });
}

}  // namespace evigrid::raycast
