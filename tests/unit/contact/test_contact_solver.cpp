#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "contact/contact_force.hpp"
#include "contact/contact_solver.hpp"
#include "contact/foot_point.hpp"

namespace sphdrop {
namespace {

/// A bent cantilever's boundary with liquid scattered about it, lengths in units of d.
struct Scene {
  std::vector<double> x, y, mass, acceleration_x, acceleration_y;
  std::vector<double> vertex_x, vertex_y, force_x, force_y;
  std::vector<Segment> segments;

  Scene(int columns, int particles, unsigned seed) {
    std::vector<std::int32_t> line;
    const auto add_vertex = [&](double vx, double vy) {
      line.push_back(static_cast<std::int32_t>(vertex_x.size()));
      vertex_x.push_back(vx);
      vertex_y.push_back(vy - 1e-4 * vx * vx);
    };
    for (int k = 0; k < columns; ++k) add_vertex(k + 0.5, 9.5);
    for (int k = 8; k > 0; --k) add_vertex(columns - 0.5, k + 0.5);
    for (int k = columns - 1; k >= 0; --k) add_vertex(k + 0.5, 0.5);
    segments = segments_of_polylines(std::vector<std::vector<std::int32_t>>{line});
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> along(-3, columns + 3), across(-3, 13);
    for (int i = 0; i < particles; ++i) {
      x.push_back(along(random));
      y.push_back(across(random) - 1e-4 * x.back() * x.back());
      mass.push_back(1.0 + 0.1 * std::cos(i));
    }
    clear();
  }
  void clear() {
    acceleration_x.assign(x.size(), 0.0);
    acceleration_y.assign(x.size(), 0.0);
    force_x.assign(vertex_x.size(), 0.0);
    force_y.assign(vertex_x.size(), 0.0);
  }
  ContactParticles particles() { return {x, y, mass, acceleration_x, acceleration_y}; }
  ContactVertices vertices() { return {vertex_x, vertex_y, force_x, force_y}; }
};

constexpr ContactParameters parameters{.spring_rate = 40.0, .contact_distance = 1.0, .overlap_limit = 0.2};

TEST(ContactSolver, FindsTheSegmentsWithinReachAndNoOthers) {
  const Scene scene(60, 400, 1);
  ContactSolver solver;
  for (const double reach : {0.4, 1.3, 3.7}) {
    solver.rebuild(scene.x, scene.y, scene.vertex_x, scene.vertex_y, scene.segments, reach);
    const ContactSurface surface{scene.segments, scene.vertex_x, scene.vertex_y};
    std::size_t active = 0;
    for (std::size_t i = 0; i < scene.x.size(); ++i) {
      std::vector<std::int32_t> expected;
      for (std::size_t s = 0; s < scene.segments.size(); ++s) {
        const Segment& segment = scene.segments[s];
        const auto projection =
            project_on_segment({scene.x[i], scene.y[i]}, surface.vertex(segment.first), surface.vertex(segment.second));
        if (projection.squared_distance <= reach * reach) expected.push_back(static_cast<std::int32_t>(s));
      }
      if (expected.empty()) continue;
      ASSERT_LT(active, solver.active_particles().size());
      EXPECT_EQ(solver.active_particles()[active], static_cast<std::int32_t>(i));
      const auto found = solver.candidates(active);
      EXPECT_EQ(std::vector<std::int32_t>(found.begin(), found.end()), expected);
      ++active;
    }
    EXPECT_EQ(active, solver.active_particles().size());
    EXPECT_GT(active, 20u);
  }
}

TEST(ContactSolver, AgreesBitForBitWithAllSegmentsAsCandidates) {
  Scene scene(60, 400, 2);
  ContactSolver solver;
  solver.rebuild(scene.x, scene.y, scene.vertex_x, scene.vertex_y, scene.segments, 6.0);
  const ContactSummary summary = solver.apply(scene.particles(), scene.vertices(), parameters);

  std::vector<std::int32_t> all(scene.segments.size());
  std::iota(all.begin(), all.end(), 0);
  const ContactSurface surface{scene.segments, scene.vertex_x, scene.vertex_y};
  std::vector<Vector> force(scene.vertex_x.size());
  ContactSummary expected;
  for (std::size_t i = 0; i < scene.x.size(); ++i) {
    const FootPoint foot = nearest_foot_point({scene.x[i], scene.y[i]}, all, surface);
    const Vector f = contact_acceleration(foot, 40.0, 1.0);
    EXPECT_EQ(scene.acceleration_x[i], f.x) << i;
    EXPECT_EQ(scene.acceleration_y[i], f.y) << i;
    if (foot.distance >= 1.0) continue;
    ++expected.count;
    expected.energy += scene.mass[i] * contact_energy(foot, 40.0, 1.0);
    const Vector reaction = -scene.mass[i] * f;
    expected.force_on_solid += reaction;
    const SharedForce share = shared_force(reaction, foot.fraction);
    force[scene.segments[foot.segment].first] += share.first;
    force[scene.segments[foot.segment].second] += share.second;
    if (1.0 - foot.distance > expected.largest_overlap) {
      expected.largest_overlap = 1.0 - foot.distance;
      expected.deepest = static_cast<std::int32_t>(i);
    }
  }
  EXPECT_GT(expected.count, 50);
  EXPECT_EQ(summary.count, expected.count);
  EXPECT_EQ(summary.energy, expected.energy);
  EXPECT_EQ(summary.force_on_solid, expected.force_on_solid);
  EXPECT_EQ(summary.largest_overlap, expected.largest_overlap);
  EXPECT_EQ(summary.deepest, expected.deepest);
  for (std::size_t v = 0; v < force.size(); ++v) EXPECT_EQ((Vector{scene.force_x[v], scene.force_y[v]}), force[v]) << v;
}

TEST(ContactSolver, ConservesLinearAndAngularMomentum) {
  Scene scene(60, 600, 3);
  ContactSolver solver;
  solver.rebuild(scene.x, scene.y, scene.vertex_x, scene.vertex_y, scene.segments, 6.0);
  const ContactSummary summary = solver.apply(scene.particles(), scene.vertices(), parameters);
  Vector total, on_solid;
  double moment = 0, moment_on_solid = 0, magnitude = 0;
  for (std::size_t i = 0; i < scene.x.size(); ++i) {
    const Vector force = scene.mass[i] * Vector{scene.acceleration_x[i], scene.acceleration_y[i]};
    total += force;
    moment += cross({scene.x[i], scene.y[i]}, force);
    magnitude += length(force);
  }
  for (std::size_t v = 0; v < scene.vertex_x.size(); ++v) {
    const Vector force{scene.force_x[v], scene.force_y[v]};
    on_solid += force;
    moment += cross({scene.vertex_x[v], scene.vertex_y[v]}, force);
    moment_on_solid += cross({scene.vertex_x[v], scene.vertex_y[v]}, force);
  }
  EXPECT_GT(magnitude, 100.0);
  EXPECT_NEAR(length(total + on_solid), 0.0, 1e-14 * magnitude);
  EXPECT_NEAR(moment, 0.0, 1e-14 * magnitude * 60);
  EXPECT_NEAR(length(summary.force_on_solid - on_solid), 0.0, 1e-14 * magnitude);
  EXPECT_NEAR(summary.moment_on_solid, moment_on_solid, 1e-14 * magnitude * 60);
}

// Dampers and drag too: what the particles lose, the solid gets, moment included, and no power is lost but as heat.
TEST(ContactSolver, ConservesMomentumAndEnergyWithDampersAndDrag) {
  Scene scene(60, 600, 3);
  std::mt19937 random(12);
  std::uniform_real_distribution<double> speeds(-1, 1);
  std::vector<double> velocity_x, velocity_y, vertex_velocity_x, vertex_velocity_y;
  for (std::size_t i = 0; i < scene.x.size(); ++i) {
    velocity_x.push_back(speeds(random));
    velocity_y.push_back(speeds(random));
  }
  for (std::size_t v = 0; v < scene.vertex_x.size(); ++v) {
    vertex_velocity_x.push_back(speeds(random));
    vertex_velocity_y.push_back(speeds(random));
  }
  ContactSolver solver;
  solver.rebuild(scene.x, scene.y, scene.vertex_x, scene.vertex_y, scene.segments, 6.0);
  const auto work = [&](const ContactParameters& law) {
    scene.clear();
    return solver.apply(
        {scene.x, scene.y, scene.mass, scene.acceleration_x, scene.acceleration_y, velocity_x, velocity_y},
        {scene.vertex_x, scene.vertex_y, scene.force_x, scene.force_y, vertex_velocity_x, vertex_velocity_y}, law);
  };
  const auto power = [&] {
    double sum = 0;
    for (std::size_t i = 0; i < scene.x.size(); ++i)
      sum += scene.mass[i] * (scene.acceleration_x[i] * velocity_x[i] + scene.acceleration_y[i] * velocity_y[i]);
    for (std::size_t v = 0; v < scene.vertex_x.size(); ++v)
      sum += scene.force_x[v] * vertex_velocity_x[v] + scene.force_y[v] * vertex_velocity_y[v];
    return sum;
  };
  const ContactParameters springs{.contact_distance = 1.0, .overlap_limit = 0.2, .spring_stiffness = 40.0};
  ContactParameters dampers = springs;
  dampers.damping_ratio = 0.3;
  EXPECT_EQ(work(springs).dissipation, 0.0);
  const double by_springs = power();
  const ContactSummary damped = work(dampers);
  EXPECT_GT(damped.dissipation, 1.0);
  EXPECT_NEAR(power(), by_springs - damped.dissipation, 1e-11 * std::abs(by_springs));

  ContactParameters both = dampers;
  both.drag_rate = 2.5;
  const ContactSummary summary = work(both);
  EXPECT_GT(summary.dissipation, damped.dissipation + 1.0);
  Vector total, on_solid;
  double moment = 0, moment_on_solid = 0, magnitude = 0;
  for (std::size_t i = 0; i < scene.x.size(); ++i) {
    const Vector force = scene.mass[i] * Vector{scene.acceleration_x[i], scene.acceleration_y[i]};
    total += force;
    moment += cross({scene.x[i], scene.y[i]}, force);
    magnitude += length(force);
  }
  for (std::size_t v = 0; v < scene.vertex_x.size(); ++v) {
    const Vector force{scene.force_x[v], scene.force_y[v]};
    on_solid += force;
    moment_on_solid += cross({scene.vertex_x[v], scene.vertex_y[v]}, force);
  }
  EXPECT_NEAR(length(total + on_solid), 0.0, 1e-14 * magnitude);
  EXPECT_NEAR(moment + moment_on_solid, 0.0, 1e-14 * magnitude * 60);
  EXPECT_NEAR(summary.moment_on_solid, moment_on_solid, 1e-14 * magnitude * 60);
}

TEST(ContactSolver, FixedSpringsPushLightAndHeavyParticlesWithTheSameForce) {
  Scene scene(10, 0, 4);
  scene.x = {3.2, 3.2};
  scene.y = {10.2 - 1e-4 * 3.2 * 3.2, 10.2 - 1e-4 * 3.2 * 3.2};
  scene.mass = {2.0, 0.5};
  scene.clear();
  ContactSolver solver;
  solver.rebuild(scene.x, scene.y, scene.vertex_x, scene.vertex_y, scene.segments, 1.5);
  const ContactSummary summary = solver.apply(
      scene.particles(), scene.vertices(), {.contact_distance = 1.0, .overlap_limit = 0.2, .spring_stiffness = 40.0});
  EXPECT_NEAR(2.0 * scene.acceleration_y[0], 40.0 * 0.3, 1e-3);
  EXPECT_DOUBLE_EQ(0.5 * scene.acceleration_y[1], 2.0 * scene.acceleration_y[0]);
  EXPECT_NEAR(summary.energy, 2 * 0.5 * 40.0 * 0.3 * 0.3, 1e-3);
}

TEST(ContactSolver, AddsToWhatIsThere) {
  Scene scene(10, 0, 4);
  scene.x = {3.2};
  scene.y = {10.2 - 1e-4 * 3.2 * 3.2};
  scene.mass = {2.0};
  scene.clear();
  ContactSolver solver;
  solver.rebuild(scene.x, scene.y, scene.vertex_x, scene.vertex_y, scene.segments, 1.5);
  solver.apply(scene.particles(), scene.vertices(), parameters);
  const auto acceleration = scene.acceleration_y;
  const auto force = scene.force_y;
  ASSERT_GT(acceleration[0], 0.0);
  solver.apply(scene.particles(), scene.vertices(), parameters);
  EXPECT_EQ(scene.acceleration_y[0], 2 * acceleration[0]);
  for (std::size_t v = 0; v < force.size(); ++v) EXPECT_EQ(scene.force_y[v], 2 * force[v]);
}

TEST(ContactSolver, GivesTheSameBitsOnAPartOfTheSurface) {
  // Liquid over the free end only; the part holds what is near it and one segment more on either side.
  Scene whole(200, 0, 5);
  std::mt19937 random(6);
  std::uniform_real_distribution<double> along(194, 203), across(-2, 13);
  for (int i = 0; i < 150; ++i) {
    whole.x.push_back(along(random));
    whole.y.push_back(across(random) - 4);
    whole.mass.push_back(1.0);
  }
  whole.clear();
  ContactSolver solver;
  solver.rebuild(whole.x, whole.y, whole.vertex_x, whole.vertex_y, whole.segments, 6.0);
  std::vector<char> wanted(whole.segments.size(), 0);
  for (std::size_t a = 0; a < solver.active_particles().size(); ++a)
    for (const std::int32_t segment : solver.candidates(a)) wanted[segment] = 1;
  const ContactSummary expected = solver.apply(whole.particles(), whole.vertices(), parameters);

  const SurfacePart part = part_of_surface(whole.segments, wanted);
  ASSERT_LT(part.segments.size(), 60u);
  Scene local = whole;
  local.segments = part.segments;
  local.vertex_x.clear();
  local.vertex_y.clear();
  for (const std::int32_t v : part.original_vertices) {
    local.vertex_x.push_back(whole.vertex_x[v]);
    local.vertex_y.push_back(whole.vertex_y[v]);
  }
  local.clear();
  ContactSolver local_solver;
  local_solver.rebuild(local.x, local.y, local.vertex_x, local.vertex_y, local.segments, 6.0);
  const ContactSummary summary = local_solver.apply(local.particles(), local.vertices(), parameters);
  EXPECT_GT(expected.count, 20);
  EXPECT_EQ(summary.count, expected.count);
  EXPECT_EQ(summary.force_on_solid, expected.force_on_solid);
  EXPECT_EQ(local.acceleration_x, whole.acceleration_x);
  EXPECT_EQ(local.acceleration_y, whole.acceleration_y);
  for (std::size_t v = 0; v < part.original_vertices.size(); ++v) {
    EXPECT_EQ(local.force_x[v], whole.force_x[part.original_vertices[v]]);
    EXPECT_EQ(local.force_y[v], whole.force_y[part.original_vertices[v]]);
  }
}

TEST(ContactSolver, ReportsAnOverlapThatIsTooDeep) {
  Scene scene(10, 0, 7);
  scene.x = {3.5, 4.5, 5.5, 6.5};
  scene.y = {9.5 + 0.95, 9.5 + 0.70, 9.5 + 0.90, 9.5 + 0.70};
  scene.mass = {1, 1, 1, 1};
  for (double& y : scene.vertex_y) y = std::round(y * 2) / 2;  // straight
  scene.clear();
  ContactSolver solver;
  solver.rebuild(scene.x, scene.y, scene.vertex_x, scene.vertex_y, scene.segments, 1.5);
  const ContactSummary summary = solver.apply(scene.particles(), scene.vertices(), parameters);
  EXPECT_EQ(summary.count, 4);
  EXPECT_EQ(summary.deepest, 1);  // of two equally deep, the lower
  EXPECT_NEAR(summary.largest_overlap, 0.30, 1e-12);
  EXPECT_TRUE(summary.overlap_is_too_deep(parameters));
  EXPECT_FALSE(summary.overlap_is_too_deep({.spring_rate = 1, .contact_distance = 1, .overlap_limit = 0.31}));
  EXPECT_FALSE(ContactSummary{}.overlap_is_too_deep(parameters));
}

TEST(ContactSolver, ParticleBouncesOffAndKeepsItsSpeed) {
  // One particle falls on a fixed row; the spring is conservative, so it leaves as fast as it came, after about
  // pi/sqrt(k).
  Scene scene(10, 0, 8);
  for (double& y : scene.vertex_y) y = std::round(y * 2) / 2;
  scene.x = {4.3};
  scene.y = {9.5 + 1.001};
  scene.mass = {1.0};
  ContactSolver solver;
  solver.rebuild(scene.x, scene.y, scene.vertex_x, scene.vertex_y, scene.segments, 1.5);
  const double dt = 1e-4;
  double speed = -0.5, contact_time = 0;
  for (int step = 0; step < 20000 && scene.y[0] < 10.52; ++step) {
    scene.clear();
    const ContactSummary summary = solver.apply(scene.particles(), scene.vertices(), parameters);
    if (summary.count > 0) contact_time += dt;
    speed += dt * scene.acceleration_y[0];
    scene.y[0] += dt * speed;
  }
  EXPECT_NEAR(speed, 0.5, 1e-3);
  EXPECT_NEAR(contact_time, M_PI / std::sqrt(40.0), 5e-4);
}

TEST(ContactSolver, IgnoresParticlesWithoutAPlace) {
  Scene scene(10, 0, 9);
  scene.x = {std::numeric_limits<double>::quiet_NaN(), 1e300, std::numeric_limits<double>::infinity(), 3.2};
  scene.y = {1.0, -1e300, 1.0, 10.0};
  scene.mass = {1, 1, 1, 1};
  scene.clear();
  ContactSolver solver;
  solver.rebuild(scene.x, scene.y, scene.vertex_x, scene.vertex_y, scene.segments, 1.5);
  ASSERT_EQ(solver.active_particles().size(), 1u);
  EXPECT_EQ(solver.active_particles()[0], 3);
  EXPECT_EQ(solver.apply(scene.particles(), scene.vertices(), parameters).count, 1);
}

TEST(ContactSolver, WithoutSolidOrLiquidDoesNothing) {
  ContactSolver solver;
  EXPECT_EQ(solver.apply({}, {}, parameters).count, 0);
  Scene scene(10, 5, 10);
  solver.rebuild(scene.x, scene.y, {}, {}, {}, 1.0);
  EXPECT_TRUE(solver.active_particles().empty());
  solver.rebuild({}, {}, scene.vertex_x, scene.vertex_y, scene.segments, 1.0);
  EXPECT_TRUE(solver.active_particles().empty());
}

TEST(ContactSolver, SearchScalesWithTheNumberOfParticles) {
  // 200 000 particles by 400 000 segments: every pair would take minutes.
  Scene scene(200000, 200000, 11);
  for (std::size_t v = 0; v < scene.vertex_y.size(); ++v)
    scene.vertex_y[v] += 1e-4 * scene.vertex_x[v] * scene.vertex_x[v];
  for (std::size_t i = 0; i < scene.y.size(); ++i) scene.y[i] += 1e-4 * scene.x[i] * scene.x[i];
  ContactSolver solver;
  const auto start = std::chrono::steady_clock::now();
  solver.rebuild(scene.x, scene.y, scene.vertex_x, scene.vertex_y, scene.segments, 1.3);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  EXPECT_GT(solver.active_particles().size(), 10000u);
  EXPECT_LT(elapsed.count(), 20.0);
}

}  // namespace
}  // namespace sphdrop
