// What a good case becomes: defaults, derived defaults, overrides, warnings, and the effective case.
#include <gtest/gtest.h>

#include <bit>
#include <clocale>
#include <cmath>
#include <cstdint>
#include <locale>

#include "config/case_file.hpp"
#include "config/derived_defaults.hpp"
#include "config/effective_case.hpp"
#include "config/parameter_store.hpp"
#include "config/parameter_table.hpp"

namespace sphdrop {
namespace {

const std::string cantilever =
    "[resolution]\nspacing = 2.5e-5\n[time]\nend = 5e-3\n[drop]\nvelocity = [0, -0.8]\n[solid]\nkind = \"cantilever\"\n"
    "length = 8e-3\n";

Case read(const std::vector<std::string>& overrides = {}, const std::string& text = cantilever) {
  return parse_case_text(text, "cases/tip/impact.cfg", overrides).values;
}

// One warning that holds the fragment; with none expected, none.
void expect_warning(const std::vector<std::string>& overrides, const std::string& fragment) {
  const std::vector<std::string> warnings = parse_case_text(cantilever, "impact.cfg", overrides).warnings;
  if (fragment.empty()) {
    EXPECT_TRUE(warnings.empty()) << warnings.front();
    return;
  }
  ASSERT_EQ(warnings.size(), 1u) << fragment;
  EXPECT_NE(warnings[0].find(fragment), std::string::npos) << warnings[0];
}

TEST(Defaults, AreThePapersScheme) {
  const Case c = read();
  EXPECT_EQ(c.mode, Mode::paper);
  EXPECT_EQ(c.resolution.smoothing_ratio, 1.2);
  EXPECT_EQ(c.time.step, 0);
  EXPECT_EQ(c.time.sound_cfl, 0.1);
  EXPECT_EQ(c.time.capillary_cfl, 0.1);
  EXPECT_EQ(c.time.viscous_cfl, 0.1);
  EXPECT_EQ(c.fluid.density, 1000);
  EXPECT_EQ(c.fluid.viscosity, 0.001);
  EXPECT_EQ(c.fluid.sound_speed, 50);
  EXPECT_EQ(c.fluid.artificial_viscosity_alpha, 0.1);
  EXPECT_EQ(c.fluid.artificial_viscosity_beta, 0);
  EXPECT_EQ(c.fluid.density_correction_interval, 20);
  EXPECT_EQ(c.resolution.kernel, KernelShape::cubic_spline);
  EXPECT_EQ(c.fluid.viscosity_form, ViscosityForm::artificial);
  EXPECT_EQ(c.fluid.density_treatment, DensityTreatment::moving_least_squares);
  EXPECT_EQ(c.fluid.density_diffusion, 0.1);
  EXPECT_EQ(c.fluid.gauge_pressure, Switch::off);
  EXPECT_EQ(c.fluid.gauge_relaxation_time, 20e-6);
  EXPECT_EQ(c.fluid.ambient_pressure, 0);
  EXPECT_EQ(c.fluid.shifting, Switch::off);
  EXPECT_EQ(c.fluid.shifting_interval, 4);
  EXPECT_EQ(c.drop.relaxation_time, 0);
  EXPECT_EQ(c.drop.shape, DropShape::round);
  EXPECT_EQ(c.drop.arrangement, DropArrangement::rings);
  EXPECT_EQ(c.drop.material, DropMaterial::liquid);
  EXPECT_EQ(c.drop.diameter, 1e-3);
  EXPECT_EQ(c.drop.initial_spin, 0);
  EXPECT_EQ(c.solid.formulation, SolidFormulation::hypoelastic);
  EXPECT_EQ(c.solid.clamp, Clamp::strips);
  EXPECT_EQ(c.solid.damping_ratio, 0);
  EXPECT_EQ(c.solid.viscous_time, 0);
  EXPECT_EQ(c.solid.thickness, 0.25e-3);
  EXPECT_EQ(c.solid.youngs_modulus, 300e6);
  EXPECT_EQ(c.solid.poisson_ratio, 0.3);
  EXPECT_EQ(c.solid.deviatoric_trace, DeviatoricTrace::plane_strain);
  EXPECT_EQ(c.solid.artificial_viscosity_alpha, 2);
  EXPECT_EQ(c.solid.artificial_stress_coefficient, 0.2);
  EXPECT_EQ(c.solid.clamp_length, 0.5e-3);
  EXPECT_EQ(c.solid.clamp_layers, 3);
  EXPECT_EQ(c.solid.damping_rate, 0);
  EXPECT_EQ(c.contact.stiffness_form, ContactStiffness::time_step);
  EXPECT_EQ(c.contact.stiffness, 0.1);
  EXPECT_EQ(c.contact.damping_ratio, 0);
  EXPECT_EQ(c.contact.wall_drag, 0);
  EXPECT_EQ(c.contact.distance_ratio, 1);
  EXPECT_EQ(c.contact.overlap_limit, 0.2);
  EXPECT_EQ(c.surface_tension.form, SurfaceTensionForm::conservative);
  EXPECT_EQ(c.surface_tension.coefficient, 0.072);
  EXPECT_EQ(c.surface_tension.polynomial_points, 3);
  EXPECT_EQ(c.surface_tension.detection_displacement, 0.03);
  EXPECT_EQ(c.gravity.x, 0);
  EXPECT_EQ(c.gravity.y, 0);
}

TEST(Defaults, OfModeModernAreWhatWorksBetter) {
  const Case c = read({"mode=modern"});
  EXPECT_EQ(c.solid.formulation, SolidFormulation::cells);
  EXPECT_EQ(c.time.sound_cfl, 0.4);
  EXPECT_EQ(c.solid.clamp, Clamp::ideal);
  EXPECT_EQ(c.contact.stiffness_form, ContactStiffness::fixed);
  EXPECT_EQ(c.contact.stiffness, 0.3);
  EXPECT_EQ(c.fluid.viscosity_form, ViscosityForm::artificial);
  const Case wall = read({"mode=modern", "solid.kind=rigid_wall"});
  EXPECT_EQ(wall.fluid.viscosity_form, ViscosityForm::physical);
  EXPECT_EQ(wall.fluid.artificial_viscosity_alpha, 0);
  EXPECT_EQ(wall.fluid.gauge_pressure, Switch::on);
  EXPECT_EQ(wall.fluid.shifting, Switch::on);
  // Each only where there is what it is for.
  const Case no_tension = read({"mode=modern", "solid.kind=rigid_wall", "surface_tension.form=none"});
  EXPECT_EQ(no_tension.fluid.gauge_pressure, Switch::off);
  EXPECT_EQ(no_tension.fluid.viscosity_form, ViscosityForm::physical);
  EXPECT_EQ(read({"mode=modern", "solid.kind=rigid_wall", "drop.material=rigid"}).fluid.viscosity_form,
            ViscosityForm::artificial);
  EXPECT_EQ(read({"mode=modern", "solid.formulation=total_lagrangian"}).solid.clamp, Clamp::strips);
  // Single keys still decide.
  const Case mixed = read({"mode=modern", "solid.formulation=hypoelastic", "time.sound_cfl=0.1"});
  EXPECT_EQ(mixed.solid.formulation, SolidFormulation::hypoelastic);
  EXPECT_EQ(mixed.time.sound_cfl, 0.1);
  // The liquid's sound sets the step where the beam is soft, or there is none.
  EXPECT_EQ(read({"mode=modern", "solid.youngs_modulus=2e6"}).time.sound_cfl, 0.2);
  EXPECT_EQ(read({"mode=modern", "solid.kind=rigid_wall"}).time.sound_cfl, 0.2);
  EXPECT_NEAR(read({"mode=modern", "solid.youngs_modulus=6e6"}).time.sound_cfl, 0.2 * std::sqrt(6e6 / 1.2 / 1000) / 50,
              1e-12);
}

TEST(Defaults, OfModeFastAreModernOnesWithLongerSteps) {
  const Case c = read({"mode=fast"});
  EXPECT_EQ(c.solid.formulation, SolidFormulation::cells);
  EXPECT_EQ(c.contact.stiffness_form, ContactStiffness::fixed);
  EXPECT_EQ(c.time.sound_cfl, 0.5);
  EXPECT_EQ(c.time.solid_substeps, 3);
  EXPECT_EQ(c.surface_tension.detection_motion, DetectionMotion::relative);
  EXPECT_EQ(c.fluid.density_correction_interval, 10);
  // A soft beam has no need of them, a hypoelastic one cannot take them; without a beam it is mode modern.
  EXPECT_EQ(read({"mode=fast", "solid.youngs_modulus=6e6"}).time.solid_substeps, 1);
  EXPECT_EQ(read({"mode=fast", "solid.formulation=hypoelastic"}).time.solid_substeps, 1);
  EXPECT_EQ(read({"mode=fast", "solid.kind=rigid_wall"}).time.sound_cfl, 0.2);
  EXPECT_EQ(read({"mode=fast", "solid.kind=rigid_wall"}).time.solid_substeps, 1);
  EXPECT_EQ(read({"mode=fast", "time.solid_substeps=2"}).time.solid_substeps, 2);
  // The liquid's sound asks for fewer.
  EXPECT_EQ(read({"mode=fast", "time.liquid_sound_cfl=0.1"}).time.solid_substeps, 2);
  EXPECT_EQ(read({"mode=modern"}).time.solid_substeps, 1);
  EXPECT_EQ(read({"mode=modern"}).surface_tension.detection_motion, DetectionMotion::absolute);
}

TEST(Defaults, SubstepsThatRingAreDoubted) {
  expect_warning({"mode=fast"}, "");
  expect_warning({"mode=fast", "time.solid_substeps=4"}, "ring");
  expect_warning({"mode=fast", "time.solid_substeps=4", "time.sound_cfl=0.4"}, "");
  expect_warning({"mode=fast", "time.step=120e-9"}, "ring");
}

TEST(DerivedDefaults, FollowFromTheOthers) {
  const Case c = read();
  EXPECT_EQ(c.name, "impact");
  EXPECT_EQ(c.output.directory, "results/impact");
  EXPECT_EQ(c.drop.gap, 0.1 * 2.5e-5);
  EXPECT_EQ(c.drop.centre_x, 8e-3 - 0.5e-3);
  EXPECT_EQ(c.safety.speed_limit, 50);
  EXPECT_DOUBLE_EQ(c.safety.domain_margin, 2 * 0.8 * 5e-3 + 8e-3);

  EXPECT_EQ(read({"solid.kind=fixed_fixed_beam"}).drop.centre_x, 4e-3);
  EXPECT_EQ(read({"solid.kind=rigid_wall"}).drop.centre_x, 0);
  EXPECT_DOUBLE_EQ(read({"solid.kind=rigid_wall", "solid.length=auto"}).solid.length, 8e-3);
  EXPECT_DOUBLE_EQ(read({"contact.distance_ratio=1.5"}).drop.gap, 0.6 * 2.5e-5);
  EXPECT_EQ(read({"drop.gap=0"}).drop.gap, 0);
  EXPECT_EQ(read({"fluid.sound_speed=40"}).safety.speed_limit, 40);
  EXPECT_EQ(read({"fluid.density=900"}).drop.density, 900);
  EXPECT_EQ(read({"drop.material=rigid", "drop.density=2500"}).drop.density, 2500);
  EXPECT_EQ(read({"solid.thickness=0.5e-3"}).solid.clamp_length, 1e-3);
  EXPECT_EQ(read({"solid.thickness=0.5e-3", "solid.clamp_length=0.4e-3"}).solid.clamp_length, 0.4e-3);
}

TEST(DerivedDefaults, TheContactsFollowItsForm) {
  const Case fixed = read({"contact.stiffness_form=fixed"});
  EXPECT_EQ(fixed.contact.stiffness, 0.3);
  EXPECT_EQ(fixed.contact.overlap_limit, 0.5);
  EXPECT_EQ(read({"contact.stiffness_form=fixed", "contact.stiffness=0.1"}).contact.stiffness, 0.1);
  EXPECT_DOUBLE_EQ(fixed.contact_modulus(), 1000.0 * 50 * 50);
  EXPECT_DOUBLE_EQ(read({"drop.material=rigid"}).contact_modulus(), 300e6 / (3 * (1 - 0.6)));
  EXPECT_DOUBLE_EQ(read({"drop.material=rigid", "solid.kind=rigid_wall"}).contact_modulus(), 1000.0 * 50 * 50);
}

const std::vector<std::string> beam_alone = {"drop.shape=none", "drop.velocity=[0, 0]", "time.end=10"};

std::vector<std::string> beam_alone_and(const std::string& override) {
  std::vector<std::string> overrides = beam_alone;
  overrides.push_back(override);
  return overrides;
}

// It is held: neither gravity nor time takes it far.
TEST(DerivedDefaults, ABeamByItselfStaysWhereItIs) {
  const Case falling = read(beam_alone_and("gravity.acceleration=[0, -10]"));
  EXPECT_DOUBLE_EQ(expected_speed(falling), std::sqrt(2 * 10 * 8e-3));
  EXPECT_DOUBLE_EQ(falling.safety.domain_margin, 3 * 8e-3);
  const Case swinging = read(beam_alone_and("solid.initial_tip_velocity=1e-4"));
  EXPECT_DOUBLE_EQ(expected_speed(swinging), 1e-4);
  EXPECT_DOUBLE_EQ(swinging.safety.domain_margin, 2 * 1e-4 * 10 + 8e-3);
}

TEST(DerivedDefaults, ExpectedSpeedCountsEverythingThatMoves) {
  EXPECT_DOUBLE_EQ(expected_speed(read()), 0.8);
  EXPECT_DOUBLE_EQ(expected_speed(read({"drop.velocity=[3, -4]"})), 5);
  EXPECT_DOUBLE_EQ(expected_speed(read({"gravity.acceleration=[0, -10]"})), 0.8 + 10 * 5e-3);
  EXPECT_DOUBLE_EQ(expected_speed(read({"drop.velocity=[0, 0]"})), std::sqrt(2 * 0.072 / (1000 * 1e-3)));
  EXPECT_DOUBLE_EQ(expected_speed(read({"solid.initial_tip_velocity=-2"})), 2);
  EXPECT_DOUBLE_EQ(expected_speed(read({"drop.material=rigid", "drop.initial_spin=-400"})), 0.8 + 400 * 0.5e-3);
  EXPECT_DOUBLE_EQ(expected_speed(read({"drop.material=rigid", "drop.velocity=[0, 0]"})), 0);
}

TEST(DerivedDefaults, LargestStepIsTheSmallestOfEqs40To42) {
  const double h = 1.2 * 2.5e-5;
  const double bulk_modulus = 300e6 / (3 * (1 - 0.6));
  EXPECT_DOUBLE_EQ(largest_sound_speed(read()), std::sqrt(bulk_modulus / 1000));
  EXPECT_DOUBLE_EQ(largest_step(read()).step, h / (500 + 0.8));
  EXPECT_DOUBLE_EQ(largest_step(read({"fluid.viscosity=100"})).step, 1000 * h * h / 100);
  const Case slow = read({"solid.kind=rigid_wall", "fluid.sound_speed=0.5"});
  EXPECT_NEAR(largest_step(slow).step, std::sqrt(1000 * h * h * h / (2 * 3.14159265358979 * 0.072)), 1e-18);
}

// No sound, tension or viscosity of the liquid's bounds it, but on a rigid wall its sound speed still sets the step.
TEST(DerivedDefaults, ARigidDropsStepIsThatOfTheSolidsSound) {
  const double h = 1.2 * 2.5e-5;
  const std::vector<std::string> on_beam{"drop.material=rigid", "fluid.sound_speed=2000", "fluid.viscosity=100",
                                         "surface_tension.coefficient=100"};
  EXPECT_DOUBLE_EQ(largest_step(read(on_beam)).step, h / (500 + 0.8));
  const Case on_wall = read({"drop.material=rigid", "solid.kind=rigid_wall", "fluid.sound_speed=40"});
  EXPECT_DOUBLE_EQ(largest_step(on_wall).step, h / (40 + 0.8));
}

TEST(Values, AreTakenAsWritten) {
  const Case c = read({},
                      "resolution.spacing = 2.5e-5\ntime.end = 5e-3 # seconds\n[drop]\nvelocity = [ 1_0,\n  -8e-1, ]\n"
                      "diameter = 0.001_5\nseed = 0xFF\n[gravity]\nacceleration = [+0.0, -9.81]\n");
  EXPECT_EQ(c.resolution.spacing, 2.5e-5);
  EXPECT_EQ(c.time.end, 5e-3);
  EXPECT_EQ(c.drop.velocity_x, 10);
  EXPECT_EQ(c.drop.velocity_y, -0.8);
  EXPECT_EQ(c.drop.diameter, 0.0015);
  EXPECT_EQ(c.drop.seed, 255);
  EXPECT_EQ(c.gravity.y, -9.81);
}

TEST(Values, CarriageReturnsAndByteOrderMarkDoNoHarm) {
  std::string text = "\xef\xbb\xbf" + cantilever;
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.replace(at, 1, "\r\n");
  EXPECT_EQ(read({}, text), read());
}

TEST(Overrides, ReplaceTheFilesValuesAndTheLastWins) {
  EXPECT_EQ(read({"drop.diameter=2e-3", "drop.diameter=1.5e-3"}).drop.diameter, 1.5e-3);
  EXPECT_EQ(read({"drop.velocity=[0.1, -1]"}).drop.velocity_x, 0.1);
  EXPECT_EQ(read({" time.end = 1e-3 "}).time.end, 1e-3);
  EXPECT_EQ(read({"solid.initial_tip_velocity=-0.25"}).solid.initial_tip_velocity, -0.25);
  EXPECT_EQ(read({"drop.shape=square"}).drop.shape, DropShape::square);
  EXPECT_EQ(read({"drop.shape=\"square\""}).drop.shape, DropShape::square);
  EXPECT_EQ(read({"output.directory=/scratch/my runs/a=b"}).output.directory, "/scratch/my runs/a=b");
  EXPECT_EQ(read({"name=12"}).name, "12");
  EXPECT_EQ(read({"time.step=auto"}).time.step, 0);
}

TEST(Overrides, MayCompleteAnEmptyFile) {
  const Case c = parse_case_text("", "empty.cfg", {"resolution.spacing=2.5e-5", "time.end=1e-3"}).values;
  EXPECT_EQ(c.solid.kind, SolidKind::none);
  EXPECT_EQ(c.time.end, 1e-3);
}

TEST(Overrides, HideAMistakeOfTheFile) {
  const std::string text = "resolution.spacing = -1\ntime.end = 1e-3\n";
  EXPECT_THROW(read({}, text), CaseError);
  EXPECT_EQ(read({"resolution.spacing=1e-5"}, text).resolution.spacing, 1e-5);
}

TEST(Warnings, SpeakOfWhatRunsButMisleads) {
  expect_warning({}, "");
  expect_warning({"resolution.spacing=5e-5", "solid.length=8e-3"}, "odd number: it will be 2 to 3 times too stiff");
  expect_warning({"solid.thickness=5e-5"}, "the beam has 2 rows");
  expect_warning({"solid.artificial_stress_coefficient=0.25"}, "unstable at h = 1.2 d");
  expect_warning({"solid.artificial_stress_coefficient=0.24"}, "");
  expect_warning({"solid.artificial_stress_coefficient=0.5", "resolution.smoothing_ratio=1.05"}, "");
  expect_warning({"resolution.smoothing_ratio=1.3"}, "unstable at h = 1.3 d");
  expect_warning({"drop.velocity=[0,-5.1]"}, "less than 10 times the largest speed expected, 5.1 m/s");
  expect_warning({"drop.velocity=[0,-5]"}, "");
  expect_warning({"fluid.artificial_viscosity_alpha=0"}, "will clump");
  expect_warning({"fluid.density_correction_interval=0"}, "without the correction");
  expect_warning({"solid.length=9e-4"}, "beam theory");
  expect_warning({"drop.diameter=0.1"}, "check the units");
  expect_warning({"fluid.density_treatment=none"}, "density_treatment = \"none\": without the correction");
  expect_warning({"fluid.density_treatment=density_diffusion", "fluid.density_diffusion=0"}, "without the correction");
  expect_warning({"fluid.density_treatment=density_diffusion", "fluid.density_correction_interval=0"}, "");
  expect_warning({"fluid.viscosity_form=physical", "fluid.artificial_viscosity_alpha=0"}, "");
  expect_warning({"fluid.viscosity_form=physical", "fluid.viscosity=0"}, "nothing damps the liquid");
  expect_warning({"fluid.viscosity_form=physical", "time.sound_cfl=0.25"}, "");  // of the beam's sound
  expect_warning({"fluid.viscosity_form=physical", "time.sound_cfl=0.25", "solid.kind=rigid_wall"}, "may grow");
  expect_warning({"fluid.viscosity_form=physical", "time.sound_cfl=0.25", "solid.kind=rigid_wall",
                  "fluid.density_treatment=density_diffusion"},
                 "");
  expect_warning({"fluid.viscosity_form=physical", "time.sound_cfl=0.2", "solid.kind=rigid_wall"}, "");
  expect_warning({"time.sound_cfl=0.3", "solid.kind=rigid_wall"}, "");
  expect_warning({"resolution.kernel=wendland_c2"}, "take 1.5");
  expect_warning({"resolution.kernel=wendland_c2", "resolution.smoothing_ratio=1.3",
                  "solid.artificial_stress_coefficient=0", "solid.clamp_layers=3"},
                 "");
}

TEST(Warnings, NameTheirPlace) {
  const auto warnings = parse_case_text(cantilever + "artificial_stress_coefficient = 0.5\n", "eps.cfg").warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(warnings[0].starts_with("eps.cfg:10: solid.artificial_stress_coefficient = 0.5")) << warnings[0];
}

TEST(Warnings, LeaveAloneWhatTheCaseLacks) {
  EXPECT_TRUE(
      parse_case_text(cantilever, "wall.cfg",
                      {"solid.kind=rigid_wall", "solid.artificial_stress_coefficient=0.5", "solid.thickness=3e-5"})
          .warnings.empty());
  EXPECT_TRUE(parse_case_text(cantilever, "ball.cfg",
                              {"drop.material=rigid", "fluid.sound_speed=1", "fluid.artificial_viscosity_alpha=0",
                               "fluid.density_correction_interval=0", "time.step=5e-9"})
                  .warnings.empty());
}

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

void expect_identical(const Case& a, const Case& b) {
  EXPECT_EQ(a, b);
  Case one = a;
  Case two = b;
  for (const Parameter& parameter : parameter_table()) {
    if (const auto* real = std::get_if<RealParameter>(&parameter.value)) {
      EXPECT_TRUE(same_bits(real->member(one), real->member(two))) << parameter.key;
    }
    if (const auto* vector = std::get_if<VectorParameter>(&parameter.value)) {
      EXPECT_TRUE(same_bits(vector->x(one), vector->x(two)) && same_bits(vector->y(one), vector->y(two)))
          << parameter.key;
    }
  }
}

TEST(EffectiveCase, ReadsBackBitForBit) {
  const std::vector<std::vector<std::string>> variants = {
      {},
      {"solid.kind=rigid_wall", "solid.length=auto"},
      {"drop.shape=none", "drop.velocity=[0,0]", "solid.initial_tip_velocity=-0.1"},
      {"drop.velocity=[-0.0, -0.30000000000000004]", "gravity.acceleration=[1e-300, -9.80665]",
       "time.end=0.0033333333333333335", "fluid.viscosity=1.0020000000000001e-3", "drop.seed=9223372036854775807",
       "time.step=5e-9", "drop.shape=square", "surface_tension.form=curvature", "surface_tension.polynomial_points=5",
       "solid.deviatoric_trace=two_dimensional", "drop.arrangement=lattice", "name=quote \" back \\ slash",
       "output.directory=/tmp/\xc3\xb6 #1", "solid.youngs_modulus=6e6"},
  };
  for (const auto& overrides : variants) {
    const Case original = read(overrides);
    const std::string text = effective_case_text(original);
    const Case again = parse_case_text(text, "elsewhere/other.cfg").values;
    expect_identical(original, again);
    EXPECT_EQ(effective_case_text(again), text);
    EXPECT_EQ(text.find("auto\""), std::string::npos) << text;
  }
}

TEST(EffectiveCase, NamesEveryParameterWithItsUnit) {
  const std::string text = effective_case_text(read());
  for (const Parameter& parameter : parameter_table()) {
    EXPECT_NE(text.find(std::string(parameter.name()) + " = "), std::string::npos) << parameter.key;
    EXPECT_NE(text.find(std::string(parameter.description)), std::string::npos) << parameter.key;
  }
  EXPECT_NE(text.find("# m; D0; diameter"), std::string::npos) << text;
}

// Numbers as German and others write them: a comma for the point, a point between thousands.
class CommaLocale : public std::numpunct<char> {
 protected:
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\1"; }
};

TEST(Locale, ChangesNothing) {
  const std::string text(cantilever + "thickness = 0.00025\nyoungs_modulus = 123456789.5\nclamp_layers = 10\n");
  const std::string broken = std::string(1200, '\n') + "time = = 3\n";
  const Case plain = read({"drop.gap=1.25e-5"}, text);
  const std::string effective = effective_case_text(plain);
  const std::locale previous = std::locale::global(std::locale(std::locale::classic(), new CommaLocale));
  const char* c_locale = std::setlocale(LC_ALL, "de_DE.UTF-8");  // where it is installed
  EXPECT_EQ(read({"drop.gap=1.25e-5"}, text), plain);
  EXPECT_EQ(effective_case_text(plain), effective);
  std::string message;
  try {
    read({}, broken);
  } catch (const CaseError& error) {
    message = error.what();
  }
  std::locale::global(previous);
  if (c_locale != nullptr) std::setlocale(LC_ALL, "C");
  EXPECT_TRUE(message.starts_with("cases/tip/impact.cfg:1201: ")) << message;
}

}  // namespace
}  // namespace sphdrop
