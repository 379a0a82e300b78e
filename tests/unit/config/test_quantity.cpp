// Values with a unit, alone and in a case.
#include <gtest/gtest.h>

#include "config/case_file.hpp"
#include "config/effective_case.hpp"
#include "config/parameter_table.hpp"
#include "config/quantity.hpp"

namespace sphdrop {
namespace {

TEST(Quantities, HaveTheBitsOfTheSameNumberInSI) {
  const struct {
    const char *text, *unit;
    double value;
  } cases[] = {{"1.0 mm", "m", 1e-3},
               {"0.1mm", "m", 1e-4},
               {"+2.5e1 um", "m", 25e-6},
               {"25 µm", "m", 25e-6},
               {"-80 cm/s", "m/s", -0.8},
               {"300 MPa", "Pa", 300e6},
               {"0.3 GPa", "Pa", 0.3e9},
               {"300 N/mm^2", "Pa", 300e6},
               {"5 ns", "s", 5e-9},
               {"72 mN/m", "N/m", 0.072},
               {"72 mJ/m2", "N/m", 0.072},
               {"1 mPa s", "Pa s", 0.001},
               {"1 mPa*s", "Pa s", 0.001},
               {"1 mPa·s", "Pa s", 0.001},
               {"1 g/cm3", "kg/m3", 1000},
               {"1 g cm^-3", "kg/m3", 1000},
               {"998.2 kg/m^3", "kg/m3", 998.2},
               {"9.81 m/s^2", "m/s2", 9.81},
               {"9.81 m s-2", "m/s2", 9.81},
               {"20 Hz", "1/s", 20},
               {"3 krad/s", "rad/s", 3000},
               {"90 deg", "deg", 90},
               {"0.3 m", "m", 0.3},
               {"1 m/s/s", "m/s2", 1}};
  for (const auto& c : cases) {
    const Quantity quantity = parse_quantity(c.text, c.unit);
    ASSERT_TRUE(quantity.value) << c.text << ": " << quantity.mistake;
    EXPECT_EQ(*quantity.value, c.value) << c.text;
  }
}

TEST(Quantities, WhatIsWrongIsSaid) {
  const struct {
    const char *text, *unit, *mistake;
  } cases[] = {{"1 ms", "m", "is of another kind: a value in m is wanted"},
               {"1 m/s", "m", "another kind"},
               {"1 mmm", "m", "unknown unit \"mmm\""},
               {"1 inch", "m", "unknown unit \"inch\""},
               {"1 kg/", "kg/m3", "unknown unit"},
               {"1 m//s", "m/s", "unknown unit"},
               {"1 m^", "m", "unknown unit \"m^\""},
               {"1 m^0", "m", "unknown unit"},
               {"1 rad", "deg", "another kind"},
               {"1e400 mm", "m", "too large or too small"},
               {"1e99999999999 mm", "m", "too large or too small"},
               {"1 mm", "d_ini", "takes a number without a unit"},
               {"1 mm", "-", "takes a number without a unit"}};
  for (const auto& c : cases) {
    const Quantity quantity = parse_quantity(c.text, c.unit);
    EXPECT_FALSE(quantity.value) << c.text;
    EXPECT_NE(quantity.mistake.find(c.mistake), std::string::npos) << quantity.mistake;
  }
}

TEST(Quantities, AreToldFromWordsAndNumbers) {
  for (const char* text : {"1 mm", "-.5mm", "1e3 Pa", "1,5 mm"}) EXPECT_TRUE(looks_like_quantity(text)) << text;
  for (const char* text : {"auto", "1", "1e3", "", "mm", "inf m", "nan", "-"})
    EXPECT_FALSE(looks_like_quantity(text)) << text;
}

// Every unit of the table is either understood or no unit: none may be a slip.
TEST(Quantities, KnowTheTablesUnits) {
  for (const Parameter& parameter : parameter_table()) {
    const bool is_counted =
        parameter.unit == "-" || parameter.unit == "d_ini" || parameter.unit == "d0" || parameter.unit == "steps";
    EXPECT_NE(takes_units(parameter.unit), is_counted) << parameter.key << " in " << parameter.unit;
  }
}

TEST(Quantities, StandInCasesAndOverrides) {
  const std::string plain =
      "[resolution]\nspacing = 2.5e-5\n[time]\nend = 5e-3\n[drop]\nvelocity = [0.01, -0.8]\n[solid]\n"
      "kind = \"cantilever\"\nlength = 8e-3\nyoungs_modulus = 3e8\n";
  const std::string with_units =
      "[resolution]\nspacing = \"25 um\"\n[time]\nend = \"5 ms\"\n[drop]\nvelocity = [\"1 cm/s\", -0.8]\n[solid]\n"
      "kind = \"cantilever\"\nlength = 1\nyoungs_modulus = \"300 MPa\"\n";
  const Case expected = parse_case_text(plain, "a.cfg", {}).values;
  const Case found = parse_case_text(with_units, "a.cfg", {"solid.length=8 mm"}).values;
  EXPECT_EQ(effective_case_text(found), effective_case_text(expected));
}

}  // namespace
}  // namespace sphdrop
