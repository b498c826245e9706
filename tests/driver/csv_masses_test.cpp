// SPDX-License-Identifier: Apache-2.0
// Rows of masses: what is accepted and, by line and column, what is not.
#include <gtest/gtest.h>

#include <sstream>

#include "csv_masses.hpp"
#include "error.hpp"
#include "text.hpp"

namespace evigrid::driver {
namespace {

MassRows read(const std::string& text, int sources = 2) {
  std::istringstream in(text);
  return read_masses(in, "f.csv", sources);
}

std::string error_of(const std::string& text, int sources = 2) {
  try {
    (void)read(text, sources);
  } catch (const InputError& error) {
    return error.what();
  }
  return "(no error)";
}

TEST(CsvMasses, ColumnsAreFoundByName) {
  const MassRows p = read("id, o2,e1,o1,e2\r\n7,0.4,0.1,0.2,0.3\r\n8,1e-3,.5,0,0\n");
  ASSERT_EQ(p.rows(), 2u);
  EXPECT_DOUBLE_EQ(p.sources[0].e[0], 0.1);
  EXPECT_DOUBLE_EQ(p.sources[0].o[0], 0.2);
  EXPECT_DOUBLE_EQ(p.sources[1].e[0], 0.3);
  EXPECT_DOUBLE_EQ(p.sources[1].o[0], 0.4);
  EXPECT_DOUBLE_EQ(p.sources[1].o[1], 1e-3);
}

TEST(CsvMasses, RoundedSumsPass) { EXPECT_EQ(read("e1,o1,e2,o2\n0.3333334,0.6666667,0,1.0000001\n").rows(), 1u); }

TEST(CsvMasses, ErrorsNameFileLineAndColumn) {
  const std::string head = "e1,o1,e2,o2\n0,0,0,0\n";
  for (const auto& [text, message] : {
           std::pair<std::string, std::string>{"", "f.csv: is empty"},
           {"e1,o1,e2,o2\n", "f.csv: no row"},
           {"e1,o1,e2\n0,0,0\n", "f.csv:1:o2: the column is missing"},
           {"e1,o1,e2,o2,e1\n0,0,0,0,0\n", "f.csv:1:e1: the column is there twice"},
           {"e1,o1,e2,o2,c1,c1\n0,0,0,0,0,0\n", "f.csv:1:c1: the column is there twice"},
           {"e1,o1,e2,o2,e3,o3\n0,0,0,0,0,0\n", "f.csv:1:e3: more than 2 sources: say --sources 3"},
           {"e1,o1,e2,o2,c12\n0,0,0,0,0\n", "f.csv:1:c12: more than 2 sources: say --sources 12"},
           {"e1,o1,e2,o2,c2\n0,0,0.5,0.3,0.3\n", "f.csv:2:c2: e2 + o2 + c2 is 1.1, more than 1"},
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

TEST(CsvMasses, SeveralSourcesAndTheirParadoxicalMasses) {
  const MassRows p = read("c2,e3,o3,e1,o1,e2,o2\n.1,.2,.3,.4,.5,.6,.15\n", 3);
  ASSERT_EQ(p.sources.size(), 3u);
  EXPECT_TRUE(p.sources[0].c.empty());
  EXPECT_EQ(p.sources[1].c, std::vector<double>{.1});
  EXPECT_EQ(p.sources[1].o, std::vector<double>{.15});
  EXPECT_EQ(p.sources[2].e, std::vector<double>{.2});
  EXPECT_TRUE(starts_with(error_of("e1,o1,e2,o2\n0,0,0,0\n", 3), "f.csv:1:e3: the column is missing"));
  EXPECT_TRUE(starts_with(error_of("", 1), "--sources: 1 is not within [2, 64]"));
  EXPECT_EQ(read("e1,o1,e2,o2,e,o2x,c0,e02\n0,0,0,0,x,x,x,x\n").rows(), 1u);  // no masses of a source
}

}  // namespace
}  // namespace evigrid::driver
