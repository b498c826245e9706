// SPDX-License-Identifier: Apache-2.0
// rosbag believes what a bag says of itself: an index that points beside a record is followed beyond its buffer, a
// length is allocated before it is compared with the file. So every record is looked at before rosbag sees the file.
#pragma once
#include <cstdint>
#include <string>

namespace evigrid::ros_bag {

/// Throws Error, with the place, unless all records, those in chunks too, lie within what holds them, and every index
/// points at messages. A bag without an index (`rosbag reindex` makes one) and an encrypted one are refused by name.
void check_structure(const std::string& file);

/// Whether the counts in a message's bytes can be true, by its type: roscpp makes room for them before it reads on.
bool counts_fit(const std::string& type, const std::uint8_t* bytes, std::size_t size);

}  // namespace evigrid::ros_bag
