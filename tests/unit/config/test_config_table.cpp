// The table itself: complete, consistent, and what follows from it.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <set>
#include <sstream>
#include <string>

#include "config/case_file.hpp"
#include "config/effective_case.hpp"
#include "config/parameter_listing.hpp"
#include "config/parameter_store.hpp"
#include "config/parameter_table.hpp"
#include "config/parameter_text.hpp"

namespace sphdrop {
namespace {

TEST(ParameterTable, KeysAreUniqueAndDescribed) {
  std::set<std::string_view> keys;
  for (const Parameter& parameter : parameter_table()) {
    EXPECT_TRUE(keys.insert(parameter.key).second) << parameter.key;
    EXPECT_FALSE(parameter.unit.empty()) << parameter.key;
    EXPECT_FALSE(parameter.description.empty()) << parameter.key;
    EXPECT_EQ(parameter.description.find_first_of("\n|"), std::string_view::npos) << parameter.key;
    EXPECT_EQ(find_parameter(parameter.key), &parameter);
  }
  EXPECT_EQ(find_parameter("drop"), nullptr);
}

TEST(ParameterTable, SectionsAreContiguous) {
  std::set<std::string_view> sections;
  for (const std::string_view section : section_names()) EXPECT_TRUE(sections.insert(section).second) << section;
}

TEST(ParameterTable, DefaultsAreWithinTheirOwnRange) {
  for (const Parameter& parameter : parameter_table()) {
    SCOPED_TRACE(parameter.key);
    if (const auto* real = std::get_if<RealParameter>(&parameter.value)) {
      const double* number = std::get_if<double>(&real->fallback);
      EXPECT_TRUE(number == nullptr || real->range.contains(*number));
      EXPECT_LT(real->range.lower, real->range.upper);
    } else if (const auto* integer = std::get_if<IntegerParameter>(&parameter.value)) {
      EXPECT_GE(integer->fallback, integer->lower);
      EXPECT_LE(integer->fallback, integer->upper);
    } else if (const auto* vector = std::get_if<VectorParameter>(&parameter.value)) {
      EXPECT_TRUE(vector->range.contains(vector->fallback[0]) && vector->range.contains(vector->fallback[1]));
    } else if (const auto* word = std::get_if<WordParameter>(&parameter.value)) {
      EXPECT_LT(word->fallback, word->words.size());
    }
  }
}

// Derived defaults must be writable into a case too.
TEST(ParameterTable, EveryValueOfAParsedCaseIsWithinItsRange) {
  const Case values = parse_case_text("resolution.spacing = 2.5e-5\ntime.end = 5e-3\n", "a.cfg").values;
  Case copy = values;
  for (const Parameter& parameter : parameter_table()) {
    if (const auto* real = std::get_if<RealParameter>(&parameter.value)) {
      EXPECT_TRUE(real->range.contains(real->member(copy))) << parameter.key << " = " << real->member(copy);
    }
  }
}

// Every enumerator of every enumeration is reached by its own word.
TEST(ParameterTable, WordsMeanTheirEnumerators) {
  const auto stored = [](std::string_view key, const char* text) {
    TomlNode node;
    node.kind = TomlNode::Kind::string;
    node.text = text;
    Case values;
    EXPECT_EQ(store(*find_parameter(key), node, values), std::nullopt) << text;
    EXPECT_EQ(value_text(*find_parameter(key), values), '"' + node.text + '"');
    return values;
  };
  EXPECT_EQ(stored("drop.shape", "none").drop.shape, DropShape::none);
  EXPECT_EQ(stored("drop.shape", "round").drop.shape, DropShape::round);
  EXPECT_EQ(stored("drop.shape", "square").drop.shape, DropShape::square);
  EXPECT_EQ(stored("drop.arrangement", "rings").drop.arrangement, DropArrangement::rings);
  EXPECT_EQ(stored("drop.arrangement", "lattice").drop.arrangement, DropArrangement::lattice);
  EXPECT_EQ(stored("drop.material", "liquid").drop.material, DropMaterial::liquid);
  EXPECT_EQ(stored("drop.material", "rigid").drop.material, DropMaterial::rigid);
  EXPECT_EQ(stored("solid.kind", "none").solid.kind, SolidKind::none);
  EXPECT_EQ(stored("solid.kind", "cantilever").solid.kind, SolidKind::cantilever);
  EXPECT_EQ(stored("solid.kind", "fixed_fixed_beam").solid.kind, SolidKind::fixed_fixed_beam);
  EXPECT_EQ(stored("solid.kind", "rigid_wall").solid.kind, SolidKind::rigid_wall);
  EXPECT_EQ(stored("solid.kind", "polygon").solid.kind, SolidKind::polygon);
  EXPECT_EQ(stored("solid.kind", "obstacle").solid.kind, SolidKind::obstacle);
  EXPECT_EQ(stored("solid.deviatoric_trace", "plane_strain").solid.deviatoric_trace, DeviatoricTrace::plane_strain);
  EXPECT_EQ(stored("solid.deviatoric_trace", "two_dimensional").solid.deviatoric_trace,
            DeviatoricTrace::two_dimensional);
  EXPECT_EQ(stored("surface_tension.form", "none").surface_tension.form, SurfaceTensionForm::none);
  EXPECT_EQ(stored("surface_tension.form", "conservative").surface_tension.form, SurfaceTensionForm::conservative);
  EXPECT_EQ(stored("surface_tension.form", "curvature").surface_tension.form, SurfaceTensionForm::curvature);
  EXPECT_EQ(stored("solid.formulation", "auto").solid.formulation, SolidFormulation::automatic);
  EXPECT_EQ(stored("solid.formulation", "hypoelastic").solid.formulation, SolidFormulation::hypoelastic);
  EXPECT_EQ(stored("solid.formulation", "cells").solid.formulation, SolidFormulation::cells);
  EXPECT_EQ(stored("solid.formulation", "total_lagrangian").solid.formulation, SolidFormulation::total_lagrangian);
  EXPECT_EQ(stored("solid.material_law", "st_venant_kirchhoff").solid.material_law, MaterialLaw::st_venant_kirchhoff);
  EXPECT_EQ(stored("solid.material_law", "neo_hookean").solid.material_law, MaterialLaw::neo_hookean);
  EXPECT_EQ(stored("solid.clamp", "strips").solid.clamp, Clamp::strips);
  EXPECT_EQ(stored("solid.clamp", "ideal").solid.clamp, Clamp::ideal);
  EXPECT_EQ(stored("resolution.kernel", "cubic_spline").resolution.kernel, KernelShape::cubic_spline);
  EXPECT_EQ(stored("resolution.kernel", "wendland_c2").resolution.kernel, KernelShape::wendland_c2);
  EXPECT_EQ(stored("fluid.viscosity_form", "artificial").fluid.viscosity_form, ViscosityForm::artificial);
  EXPECT_EQ(stored("fluid.viscosity_form", "physical").fluid.viscosity_form, ViscosityForm::physical);
  EXPECT_EQ(stored("fluid.density_treatment", "none").fluid.density_treatment, DensityTreatment::none);
  EXPECT_EQ(stored("fluid.density_treatment", "moving_least_squares").fluid.density_treatment,
            DensityTreatment::moving_least_squares);
  EXPECT_EQ(stored("fluid.density_treatment", "density_diffusion").fluid.density_treatment,
            DensityTreatment::density_diffusion);
  EXPECT_EQ(stored("fluid.gauge_pressure", "off").fluid.gauge_pressure, Switch::off);
  EXPECT_EQ(stored("fluid.gauge_pressure", "on").fluid.gauge_pressure, Switch::on);
  EXPECT_EQ(stored("fluid.shifting", "off").fluid.shifting, Switch::off);
  EXPECT_EQ(stored("fluid.shifting", "on").fluid.shifting, Switch::on);
  EXPECT_EQ(stored("mode", "paper").mode, Mode::paper);
  EXPECT_EQ(stored("mode", "modern").mode, Mode::modern);
}

// A value of the parameter's type, different for different n.
TomlNode value_number(const Parameter& parameter, int n) {
  TomlNode node;
  const auto number = [](const std::string& text) {
    TomlNode result;
    result.kind = TomlNode::Kind::real;
    result.text = text;
    return result;
  };
  if (const auto* real = std::get_if<RealParameter>(&parameter.value)) {
    return number(number_text(real->range.lower + (real->range.upper - real->range.lower) / (n + 2)));
  }
  if (const auto* integer = std::get_if<IntegerParameter>(&parameter.value)) {
    node.kind = TomlNode::Kind::integer;
    node.text = std::to_string(n == 0 ? integer->lower : integer->upper);
  } else if (const auto* word = std::get_if<WordParameter>(&parameter.value)) {
    node.kind = TomlNode::Kind::string;
    node.text = word->words[n == 0 ? 0 : word->words.size() - 1];
  } else if (std::holds_alternative<VectorParameter>(parameter.value)) {
    node.kind = TomlNode::Kind::array;
    node.elements = {number(n == 0 ? "1.5" : "2.5"), number(n == 0 ? "3.5" : "4.5")};
  } else if (std::holds_alternative<PointsParameter>(parameter.value) ||
             std::holds_alternative<RegionsParameter>(parameter.value)) {
    TomlNode points, point;
    points.kind = point.kind = node.kind = TomlNode::Kind::array;
    point.elements = {number(n == 0 ? "1.5" : "2.5"), number(n == 0 ? "3.5" : "4.5")};
    points.elements = {point, point};
    node.elements =
        std::holds_alternative<PointsParameter>(parameter.value) ? points.elements : std::vector<TomlNode>{points};
  } else {
    node.kind = TomlNode::Kind::string;
    node.text = n == 0 ? "first" : "second";
  }
  return node;
}

// No two parameters share a member of Case, and each changes one: else a copied line of the table would go unnoticed.
TEST(ParameterTable, EachParameterHasItsOwnMember) {
  const auto only = [](const Parameter& changed, int n) {
    Case values;
    for (const Parameter& parameter : parameter_table()) {
      EXPECT_EQ(store(parameter, value_number(parameter, 0), values), std::nullopt) << parameter.key;
    }
    EXPECT_EQ(store(changed, value_number(changed, n), values), std::nullopt) << changed.key;
    return values;
  };
  for (const Parameter& changed : parameter_table()) {
    const Case before = only(changed, 0);
    const Case after = only(changed, 1);
    for (const Parameter& parameter : parameter_table()) {
      EXPECT_EQ(value_text(parameter, before) != value_text(parameter, after), parameter.key == changed.key)
          << changed.key << " changes " << parameter.key;
    }
  }
}

// Every member of Case stands in the table: the sections are plain numbers of 8 bytes, vectors and enumerations.
TEST(ParameterTable, CoversEveryMemberOfCase) {
  const auto bytes = [](std::string_view section) {
    std::size_t sum = 0;
    std::size_t words = 0;
    for (const Parameter& parameter : parameter_table()) {
      if (parameter.section() != section) continue;
      if (std::holds_alternative<WordParameter>(parameter.value)) {
        ++words;
      } else if (std::holds_alternative<TextParameter>(parameter.value)) {
        sum += sizeof(std::string);
      } else if (std::holds_alternative<PointsParameter>(parameter.value) ||
                 std::holds_alternative<RegionsParameter>(parameter.value)) {
        sum += sizeof(Points);
      } else {
        sum += std::holds_alternative<VectorParameter>(parameter.value) ? 16 : 8;
      }
    }
    return std::pair{sum + 4 * words, sum + 8 * words};  // with enumerations packed, and each with padding
  };
  const auto expect_covered = [&](std::string_view section, std::size_t size) {
    const auto [least, most] = bytes(section);
    EXPECT_TRUE(size >= least && size <= most) << section << ": " << size << " bytes, the table knows " << least;
  };
  expect_covered("resolution", sizeof(Case::Resolution));
  expect_covered("time", sizeof(Case::Time));
  expect_covered("fluid", sizeof(Case::Fluid));
  expect_covered("drop", sizeof(Case::Drop) - sizeof(GivenParticlesOfCase));  // the file's content is no parameter
  expect_covered("solid", sizeof(Case::Solid));
  expect_covered("contact", sizeof(Case::Contact));
  expect_covered("surface_tension", sizeof(Case::SurfaceTension));
  expect_covered("gravity", sizeof(Case::Gravity));
  expect_covered("output", sizeof(Case::Output));
  expect_covered("checkpoint", sizeof(Case::Checkpoint));
  expect_covered("parallel", sizeof(Case::Parallel));
  expect_covered("safety", sizeof(Case::Safety));
  std::size_t sections = sizeof(Case::Resolution) + sizeof(Case::Time) + sizeof(Case::Fluid) + sizeof(Case::Drop) +
                         sizeof(Case::Solid) + sizeof(Case::Contact) + sizeof(Case::SurfaceTension) +
                         sizeof(Case::Gravity) + sizeof(Case::Output) + sizeof(Case::Checkpoint) +
                         sizeof(Case::Parallel) + sizeof(Case::Safety);
  // Beside them the name, the mode with its padding, and further drops and solids.
  EXPECT_EQ(sizeof(Case),
            sections + sizeof(std::string) + 8 + sizeof(std::vector<Case::Drop>) + sizeof(std::vector<Case::Solid>));
}

TEST(Range, HeedsItsEndsAndRefusesWhatIsNoNumber) {
  constexpr Range half_open{0, false, 1, true};
  EXPECT_FALSE(half_open.contains(0));
  EXPECT_TRUE(half_open.contains(1));
  EXPECT_FALSE(half_open.contains(std::nextafter(1.0, 2.0)));
  EXPECT_FALSE(half_open.contains(std::nan("")));
  EXPECT_FALSE(half_open.contains(HUGE_VAL));
  constexpr Range other{0, true, 1, false};
  EXPECT_TRUE(other.contains(0));
  EXPECT_FALSE(other.contains(1));
}

TEST(Listing, MentionsEveryParameterWithAllThatIsKnownOfIt) {
  const std::string text = list_parameters_text();
  const std::string markdown = parameter_reference_markdown();
  for (const Parameter& parameter : parameter_table()) {
    const std::size_t begin = text.find("\n" + std::string(parameter.key) + " ");
    ASSERT_NE(begin, std::string::npos) << parameter.key;
    // Down to the next line that is not indented, its lines taken together again.
    std::string entry;
    for (std::size_t at = begin + 1; at < text.size() && !(text[at - 1] == '\n' && text[at] != ' ' && at > begin + 1);
         ++at)
      if (!(text[at] == ' ' && entry.ends_with(' '))) entry += text[at] == '\n' ? ' ' : text[at];
    const std::string unit = parameter.unit == "-" ? "" : std::string(parameter.unit);
    for (const std::string& part : {unit, std::string(parameter.symbol), std::string(parameter.description),
                                    default_text(parameter), allowed_text(parameter), type_text(parameter)}) {
      EXPECT_NE(entry.find(part), std::string::npos) << entry << "\nlacks " << part;
    }
    EXPECT_NE(markdown.find("| `" + std::string(parameter.key) + "` |"), std::string::npos) << parameter.key;
  }
}

TEST(Listing, FitsATerminal) {
  std::istringstream lines(list_parameters_text());
  for (std::string line; std::getline(lines, line);)
    EXPECT_TRUE(line.size() <= 100 || line.find(' ', 8) == std::string::npos) << line;
}

TEST(Listing, ShowsDefaultsInTheirOwnTerms) {
  EXPECT_EQ(default_text(*find_parameter("resolution.spacing")), "required");
  EXPECT_EQ(default_text(*find_parameter("fluid.sound_speed")), "50");
  EXPECT_EQ(default_text(*find_parameter("drop.velocity")), "[0, 0]");
  EXPECT_EQ(default_text(*find_parameter("drop.shape")), "\"round\"");
  EXPECT_TRUE(default_text(*find_parameter("drop.gap")).starts_with("\"auto\" ("));
  EXPECT_EQ(allowed_text(*find_parameter("solid.poisson_ratio")), "> -1 and < 0.5");
  EXPECT_EQ(allowed_text(*find_parameter("surface_tension.polynomial_points")), "3 or 5");
  EXPECT_EQ(allowed_text(*find_parameter("drop.shape")), "none, round, square, ellipse or particles");
}

}  // namespace
}  // namespace sphdrop
