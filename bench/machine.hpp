// SPDX-License-Identifier: Apache-2.0
// What the machine can do at most, measured in the binary and the run that it is a yardstick for: `--machine` adds
// these rows to any benchmark of ours. Names: machine/WHAT/threads:N.
//   stream_*        McCalpin's STREAM on floats (copy, scale, add, triad: 8, 8, 12, 12 bytes an element, as STREAM
//   counts:
//                   without the line that a store fetches first), and the patterns of our kernels: in-place scale
//                   (8 bytes read and written), four reads and two writes (24), arrays of 128 MiB in huge pages.
//   l2_triad        triad on three arrays of 200 KiB a thread.
//   random_micro_*  blocks of 192 bytes (one micro-tile: 16 cells of three planes) read and written in random order
//   over
//                   512 MiB, in pages of 4 KiB and of 2 MiB: what a cold sonar cone can ask of the memory.
//   peak_fma        independent fused multiply-adds in registers, at the widest vectors of the processor (2 flop each);
//   peak_mul_add    the same as a product and a sum, not fused.
#pragma once

namespace evigrid::bench {

void register_stream();  // stream.cpp
void register_peak();    // peak.cpp

}  // namespace evigrid::bench
