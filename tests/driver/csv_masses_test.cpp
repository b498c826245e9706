// SPDX-License-Identifier: Apache-2.0
// Rows of masses: what is accepted and, by line and column, what is not.
#include <gtest/gtest.h>

#include <sstream>

#include "csv_masses.hpp"
#include "error.hpp"
#include "text.hpp"

namespace evigrid::driver {
namespace {

MassPairs read(const std::string& text) {
  std::istringstream in(text);
  return read_mass_pairs(in, "f.csv");
}

std::string error_of(const std::string& text) {
  try {
    (void)read(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "(no error)";
}

TEST(CsvMasses, ColumnsAreFoundByName) {
  const MassPairs p = read("id, o2,e1,o1,e2\r\n7,0.4,0.1,0.2,0.3\r\n8,1e-3,.5,0,0\n");
  ASSERT_EQ(p.rows(), 2u);
  EXPECT_DOUBLE_EQ(p.columns[0][0], 0.1);
  EXPECT_DOUBLE_EQ(p.columns[1][0], 0.2);
  EXPECT_DOUBLE_EQ(p.columns[2][0], 0.3);
  EXPECT_DOUBLE_EQ(p.columns[3][0], 0.4);
  EXPECT_DOUBLE_EQ(p.columns[3][1], 1e-3);
}

TEST(CsvMasses, RoundedSumsPass) { EXPECT_EQ(read("e1,o1,e2,o2\n0.3333334,0.6666667,0,1.0000001\n").rows(), 1u); }

TEST(CsvMasses, ErrorsNameFileLineAndColumn) {
  const std::string head = "e1,o1,e2,o2\n0,0,0,0\n";
  for (const auto& [text, message] : {
           std::pair<std::string, std::string>{"", "f.csv: is empty"},
           {"e1,o1,e2,o2\n", "f.csv: no row"},
           {"e1,o1,e2\n0,0,0\n", "f.csv:1:o2: the column is missing"},
           {"e1,o1,e2,o2,e1\n0,0,0,0,0\n", "f.csv:1:e1: the column is there twice"},
           {"e1,o1,e2,o2,c1\n0,0,0,0,0\n", "f.csv:1:c1: more than two sources"},
           {head + "0,0,x,0\n", "f.csv:3:e2: 'x' is no number"},
           {head + "0,0,0,\n", "f.csv:3:o2: '' is no number"},
           {head + "0,nan,0,0\n", "f.csv:3:o1: nan is not within"},
           {head + "0,0,0,inf\n", "f.csv:3:o2: inf is not within"},
           {head + "-0.1,0,0,0\n", "f.csv:3:e1: -0.1 is not within"},
           {head + "0,1.1,0,0\n", "f.csv:3:o1: 1.1 is not within"},
           {head + "0,0,0.6,0.5\n", "f.csv:3:o2: e2 + o2 is 1.1, more than 1"},
           {head + "0,0,0\n", "f.csv:3:-: 3 fields"},
           {head + "\n0,0,0,0\n", "f.csv:3:e1: an empty row"},
       }) {
    EXPECT_TRUE(starts_with(error_of(text), message)) << text;
  }
}

}  // namespace
}  // namespace evigrid::driver
