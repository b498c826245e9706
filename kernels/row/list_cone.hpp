// SPDX-License-Identifier: Apache-2.0
// Lists the micro-tiles of one tile that a cone may touch, zone by zone. No branch depends on where a run of them ends:
// they are numbered in bytes, sixteen of which are written for every run however short it is, and what follows
// overwrites the rest. So it is with the lists: sixteen entries are written at once, without a rest to be counted.
#pragma once
#include <cstring>

#include "kernels/row/whole_numbers.hpp"

EVIGRID_CELL_BEGIN

/// Columns from … end − 1 of the row of micro-tiles whose numbers in the tile are these.
EVIGRID_FN void put_run(std::uint8_t*& to, const Byte16& numbers, int from, int end) {
  const Byte16 run = numbers + static_cast<std::uint8_t>(from);
  std::memcpy(to, &run, sizeof run);
  to += end - from;
}

inline std::uint64_t list_cone(const ConeCuts* bands, const ConeTile& t, ListedMicros* zones) {
  static_assert(kMicrosPerSide == 16 && kListAtOnce == 16 && kFree == 0 && kWithin == 1 && kRim == 2);
  std::uint8_t of_zone[kConeZones][kMicrosPerTile + kListAtOnce];  // micro-tiles by their number in the tile
  std::uint8_t *free = of_zone[kFree], *within = of_zone[kWithin], *rim = of_zone[kRim];
  std::uint64_t squares = 0;
  Byte16 numbers = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
  numbers += static_cast<std::uint8_t>(kMicrosPerSide * t.first_row);
  for (int row = t.first_row; row < t.end_row; ++row, numbers += static_cast<std::uint8_t>(kMicrosPerSide)) {
    Int8 c;
    std::memcpy(&c, bands[t.first_band + row].column, sizeof c);
    c -= t.first_column;
    c = c < 0 ? Int8{} : c;
    c = c > kMicrosPerSide ? Int8{} + kMicrosPerSide : c;
    const std::uint64_t run = (std::uint64_t{1} << ((c[5] + 1) >> 1)) - (std::uint64_t{1} << (c[0] >> 1));
    squares |= (c[0] < c[5] ? run : 0) << ((row >> 1) * (kMicrosPerSide / 2));
    put_run(rim, numbers, c[0], c[1]);
    put_run(within, numbers, c[1], c[2]);
    put_run(free, numbers, c[2], c[3]);
    put_run(within, numbers, c[3], c[4]);
    put_run(rim, numbers, c[4], c[5]);
  }
  const std::uint8_t* const ends[kConeZones] = {free, within, rim};
  const auto step = static_cast<std::int32_t>(t.step * static_cast<int>(sizeof(float)));
  const auto first = reinterpret_cast<std::uintptr_t>(t.cells);
  const float x0 = t.x0, y0 = t.y0;
  for (int z = 0; z < kConeZones; ++z) {
    const ListedMicros out = zones[z];
    const auto count = static_cast<int>(ends[z] - of_zone[z]);
    for (int i = 0; i < count; i += kListAtOnce) {
      Byte16 bytes;
      std::memcpy(&bytes, of_zone[z] + i, sizeof bytes);
      const Int16 micro = __builtin_convertvector(__builtin_convertvector(bytes, Short16), Int16);  // gcc: by steps
      const Float16 x = __builtin_convertvector(4 * (micro & (kMicrosPerSide - 1)), Float16) + x0,
                    y = __builtin_convertvector(4 * (micro >> 4), Float16) + y0;
      const Address16 cells = __builtin_convertvector(micro * step, Address16) + first;
      std::memcpy(out.x + i, &x, sizeof x);
      std::memcpy(out.y + i, &y, sizeof y);
      std::memcpy(out.cells + i, &cells, sizeof cells);
    }
    zones[z].count = count;
  }
  return squares;
}

EVIGRID_CELL_END
