// Columns of numbers from users' files: what is taken, and what is said of what is not.
#include <gtest/gtest.h>
#include <hdf5.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "io/column_table.hpp"
#include "io/hdf5_file.hpp"

namespace sphdrop {
namespace {

constexpr std::array<std::string_view, 3> known = {"x", "y", "mass"};

ColumnTable parse(std::string_view text) {
  return parse_text_table(text, "drop.csv", known);
}

std::string mistake_of(std::string_view text) {
  try {
    parse(text);
  } catch (const TableError& error) {
    return error.what();
  }
  return "none";
}

TEST(TextTable, TakesColumnsInAnyOrderWithUnitsAndComments) {
  const ColumnTable table =
      parse("\xef\xbb\xbf# made by hand\r\n\r\n y [mm] , x\r\n1.5,+2e-3 # the first\n\n-0.25,\t1\n");
  ASSERT_EQ(table.rows(), 2u);
  EXPECT_EQ(table.find("x")->values, (std::vector<double>{2e-3, 1}));
  EXPECT_EQ(table.find("y")->values, (std::vector<double>{1.5, -0.25}));
  EXPECT_EQ(table.find("y")->unit, "mm");
  EXPECT_EQ(table.find("x")->unit, "");
  EXPECT_EQ(table.find("mass"), nullptr);
  EXPECT_EQ(table.header_line, 3);
  EXPECT_EQ(table.lines, (std::vector<std::int64_t>{4, 6}));
}

TEST(TextTable, NeedsNoLineEndAtTheEnd) {
  EXPECT_EQ(parse("x,y\n1,2").rows(), 1u);
  EXPECT_EQ(parse("x,y").rows(), 0u);
}

TEST(TextTable, ReadsNumbersToTheLastBit) {
  EXPECT_EQ(parse("x\n0.1\n1.7976931348623157e308\n5e-324\n").columns[0].values,
            (std::vector<double>{0.1, std::numeric_limits<double>::max(), 5e-324}));
}

TEST(TextTable, MistakesAreToldWithTheirLine) {
  struct Wrong {
    const char *text, *said;
  };
  for (const Wrong& wrong : {
           Wrong{"", "drop.csv: is empty; its first line must name the columns: x,y"},
           Wrong{"# nothing\n\n", "drop.csv: is empty"},
           Wrong{"1,2\n", "drop.csv:1: the first line must name the columns, for example x,y, and holds numbers"},
           Wrong{"\nx,z\n", "drop.csv:2: there is no column \"z\"; there are x, y, mass, with a comma between two"},
           Wrong{"x;y\n", "drop.csv:1: there is no column \"x;y\""},
           Wrong{"x,x\n", "drop.csv:1: the column x stands twice"},
           Wrong{"x [mm,y\n", "drop.csv:1: \"x [mm\" is no name of a column; write name or name [unit], with a comma"},
           Wrong{"x [mm];y [mm]\n", "drop.csv:1: \"x [mm];y [mm]\" is no name of a column"},
           Wrong{"x,\n", "drop.csv:1: there is no column \"\""},
           Wrong{"x,y\n1,2\n3\n", "drop.csv:3: holds 1 value, and the first line names 2 columns"},
           Wrong{"x,y\n1,2,\n", "drop.csv:2: holds 3 values, and the first line names 2 columns"},
           Wrong{"x,y\n,2\n", "drop.csv:2: x has no value"},
           Wrong{"x,y\n1,nan\n", "drop.csv:2: y = \"nan\" is not a finite number"},
           Wrong{"x,y\n1,-inf\n", "drop.csv:2: y = \"-inf\" is not a finite number"},
           Wrong{"x,y\n1,1e999\n", "drop.csv:2: y = \"1e999\" is not a finite number"},
           Wrong{"x,y\n1,2 mm\n", "drop.csv:2: y = \"2 mm\" is not a finite number; write numbers as 0.5, -1, 1e-3"},
           Wrong{"x,y\n1,0x10\n", "drop.csv:2: y = \"0x10\" is not a finite number"},
           Wrong{"x,y\n1,\x1b[31m\n", "drop.csv:2: y = \"?[31m\" is not a finite number"},
       })
    EXPECT_EQ(mistake_of(wrong.text).find(wrong.said), 0u) << mistake_of(wrong.text) << "\nfor\n" << wrong.text;
}

class Hdf5Table : public testing::Test {
 protected:
  std::string path = (std::filesystem::temp_directory_path() / ("sphdrop-table-" + std::to_string(::getpid()) + ".h5"));
  std::vector<Hdf5Columns> wanted = {{"/position", {"x", "y"}, true}, {"/mass", {"mass"}}};

  ~Hdf5Table() override { std::filesystem::remove(path); }

  void write(const std::vector<double>& positions, int components, const std::vector<double>& masses = {}) {
    Hdf5File file = Hdf5File::create(path);
    const auto rows = static_cast<std::int64_t>(positions.size()) / components;
    file.create_dataset("/position", Hdf5Type::float64, rows, components).write_rows(0, rows, positions.data());
    const auto count = static_cast<std::int64_t>(masses.size());
    if (count > 0) file.create_dataset("/mass", Hdf5Type::float64, count, 1).write_rows(0, count, masses.data());
    file.create_group("/empty");
  }
  std::string mistake() const {
    try {
      read_hdf5_table(path, "drop.h5", wanted);
    } catch (const TableError& error) {
      return error.what();
    }
    return "none";
  }
};

TEST_F(Hdf5Table, TakesTheFirstComponents) {
  write({1, 2, 0, 3, 4, 0}, 3, {5, 6});
  const ColumnTable table = read_hdf5_table(path, "drop.h5", wanted);
  EXPECT_EQ(table.find("x")->values, (std::vector<double>{1, 3}));
  EXPECT_EQ(table.find("y")->values, (std::vector<double>{2, 4}));
  EXPECT_EQ(table.find("mass")->values, (std::vector<double>{5, 6}));
  EXPECT_TRUE(table.lines.empty());
  EXPECT_TRUE(has_hdf5_group(path, "drop.h5", "/empty"));
  EXPECT_FALSE(has_hdf5_group(path, "drop.h5", "/VTKHDF"));
  EXPECT_FALSE(has_hdf5_group(path, "drop.h5", "/position"));
}

TEST_F(Hdf5Table, WhatIsNotRequiredMayBeMissing) {
  write({1, 2, 3, 4}, 2);
  EXPECT_EQ(read_hdf5_table(path, "drop.h5", wanted).columns.size(), 2u);
  wanted[1].is_required = true;
  EXPECT_EQ(mistake(), "drop.h5: has no dataset /mass");
  wanted = {{"/drop/position", {"x", "y"}, true}};
  EXPECT_EQ(mistake(), "drop.h5: has no dataset /drop/position");
}

TEST_F(Hdf5Table, MistakesAreToldWithTheDataset) {
  write({1, 2}, 1);
  EXPECT_EQ(mistake(), "drop.h5: /position has 1 column, and 2 are wanted: x, y");
  write({1, 2, 3, 4}, 2, {5});
  EXPECT_EQ(mistake(), "drop.h5: /mass has 1 rows, and there are 2 of the others");
  write({1, 2, 3, std::numeric_limits<double>::quiet_NaN()}, 2);
  EXPECT_EQ(mistake(), "drop.h5: y of row 1 of /position is not a finite number");
}

TEST_F(Hdf5Table, TextForNumbersAndDamageAreTold) {
  {
    Hdf5File file = Hdf5File::create(path);
    file.write_text("/position", "here and there");
  }
  EXPECT_EQ(mistake().find("drop.h5:/position: "), 0u) << mistake();
  std::filesystem::resize_file(path, 200);
  EXPECT_EQ(mistake().find("drop.h5: H5Fopen failed"), 0u) << mistake();
}

TEST(IsHdf5, ByItsFirstBytes) {
  EXPECT_TRUE(is_hdf5("\x89HDF\r\n\x1a\nand so on"));
  EXPECT_FALSE(is_hdf5("x,y\n"));
  EXPECT_FALSE(is_hdf5(""));
}

}  // namespace
}  // namespace sphdrop
