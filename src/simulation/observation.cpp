#include "simulation/observation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "decomposition/exact_sum.hpp"
#include "diagnostics/energy.hpp"
#include "diagnostics/state_hash.hpp"

namespace sphdrop {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

// Sums over all particles of all ranks, exact and therefore independent of who holds them.
enum Sum : std::size_t {
  fluid_mass,
  fluid_x,
  fluid_y,
  fluid_xx,
  fluid_yy,
  fluid_pressure,
  fluid_momentum_x,
  fluid_momentum_y,
  fluid_spin,
  fluid_kinetic,
  fluid_compressive,
  fluid_heat,
  fluid_correction,
  fluid_shift,
  fluid_gauge,
  tension_sharing,
  surface_shift,
  solid_mass_x,
  solid_mass_y,
  solid_momentum_x,
  solid_momentum_y,
  solid_spin,
  solid_kinetic,
  solid_elastic,
  solid_heat,
  solid_artificial,
  probe_deflection,
  probe_displacement_x,
  middle_probe_deflection,
  sum_count
};
using Sums = std::array<ExactSum, sum_count>;

void add_fluid(const Simulation& simulation, Sums& sums) {
  const FluidParticles& f = simulation.fluid();
  const Case& c = simulation.input();
  const double rest_density = c.drop.is_rigid() ? c.drop.density : c.fluid.density;
  f.for_each_owned([&](std::size_t row) {
    const double m = f.mass[row];
    const Vector x = f.position.at(row), v = f.velocity.at(row);
    sums[fluid_mass].add(m);
    sums[fluid_x].add(m * x.x);
    sums[fluid_y].add(m * x.y);
    sums[fluid_xx].add(m * x.x * x.x);
    sums[fluid_yy].add(m * x.y * x.y);
    sums[fluid_pressure].add(f.pressure[row]);
    sums[fluid_momentum_x].add(m * v.x);
    sums[fluid_momentum_y].add(m * v.y);
    sums[fluid_spin].add(m * cross(x, v));
    sums[fluid_kinetic].add(kinetic_energy(m, v));
    sums[fluid_compressive].add(m * compressive_energy_per_mass(f.density[row], rest_density, c.fluid.sound_speed));
    sums[fluid_heat].add(f.dissipated_energy[row]);
    sums[fluid_correction].add(f.correction_energy[row]);
    if (!f.shift_energy.is_left_out()) sums[fluid_shift].add(f.shift_energy[row]);
    if (!f.gauge_energy.is_left_out()) sums[fluid_gauge].add(f.gauge_energy[row]);
  });
}

void add_solid(const Simulation& simulation, Sums& sums) {
  const SolidParticles& s = simulation.solid();
  const auto is_among = [](const std::vector<std::int64_t>& probe, std::int64_t id) {
    return std::binary_search(probe.begin(), probe.end(), id);
  };
  s.for_each_owned([&](std::size_t row) {
    const double m = s.mass[row];
    const Vector x = s.position.at(row), v = s.velocity.at(row);
    if (s.is_fixed[row] == 0) {
      sums[solid_mass_x].add(m * x.x);
      sums[solid_mass_y].add(m * x.y);
    }
    sums[solid_momentum_x].add(m * v.x);
    sums[solid_momentum_y].add(m * v.y);
    sums[solid_spin].add(m * cross(x, v));
    sums[solid_kinetic].add(kinetic_energy(m, v));
    sums[solid_heat].add(s.dissipated_energy[row]);
    sums[solid_artificial].add(s.artificial_stress_work[row]);
    const Vector displacement = x - s.reference_position.at(row);
    if (is_among(simulation.deflection_probe(), s.id[row])) {
      sums[probe_deflection].add(displacement.y);
      sums[probe_displacement_x].add(displacement.x);
    }
    if (is_among(simulation.middle_probe(), s.id[row])) sums[middle_probe_deflection].add(displacement.y);
  });
  simulation.solid_step().add_elastic_energy(s, sums[solid_elastic]);
}

struct Extent {
  double left = infinity, right = -infinity, bottom = infinity, top = -infinity;
};

// Width and height from the extreme particles, half a spacing beyond each.
Extent drop_extent(const Simulation& simulation, double& density_error) {
  const FluidParticles& f = simulation.fluid();
  const Case& c = simulation.input();
  const double rest_density = c.drop.is_rigid() ? c.drop.density : c.fluid.density;
  std::array<double, 5> largest{-infinity, -infinity, -infinity, -infinity, 0.0};
  f.for_each_owned([&](std::size_t row) {
    const Vector x = f.position.at(row);
    largest[0] = std::max(largest[0], -x.x);
    largest[1] = std::max(largest[1], x.x);
    largest[2] = std::max(largest[2], -x.y);
    largest[3] = std::max(largest[3], x.y);
    largest[4] = std::max(largest[4], std::abs(f.density[row] / rest_density - 1.0));
  });
  simulation.communicator().max_in_place(largest);
  density_error = largest[4];
  return {-largest[0], largest[1], -largest[2], largest[3]};
}

// The mass centre of the drop's upper right quarter, relative to the whole drop's.
Vector quarter_centre(const Simulation& simulation, Vector centre) {
  const FluidParticles& f = simulation.fluid();
  std::array<ExactSum, 3> sums;
  f.for_each_owned([&](std::size_t row) {
    const Vector r = f.position.at(row) - centre;
    if (!(r.x > 0 && r.y > 0)) return;
    sums[0].add(f.mass[row]);
    sums[1].add(f.mass[row] * r.x);
    sums[2].add(f.mass[row] * r.y);
  });
  ExactSum::reduce(sums, simulation.communicator());
  return Vector{sums[1].value(), sums[2].value()} / sums[0].value();
}

void observe_drop(const Simulation& simulation, const std::array<double, sum_count>& sum, Observation& o) {
  const double mass = sum[fluid_mass];
  const Vector centre{sum[fluid_x] / mass, sum[fluid_y] / mass};
  const Extent extent = drop_extent(simulation, o.largest_density_error);
  o.drop_width = extent.right - extent.left + simulation.input().resolution.spacing;
  o.drop_height = extent.top - extent.bottom + simulation.input().resolution.spacing;
  o.drop_centre_x = centre.x;
  o.drop_centre_y = centre.y;
  o.drop_velocity_x = sum[fluid_momentum_x] / mass;
  o.drop_velocity_y = sum[fluid_momentum_y] / mass;
  o.drop_elongation = (sum[fluid_xx] - sum[fluid_yy]) / mass - (centre.x * centre.x - centre.y * centre.y);
  const Vector quarter = quarter_centre(simulation, centre);
  o.quarter_centre_x = quarter.x;
  o.quarter_centre_y = quarter.y;
  if (simulation.rigid_body().is_enabled()) {
    o.drop_angle = simulation.rigid_body().body().angle;
    o.drop_spin = simulation.rigid_body().body().spin;
    return;
  }
  o.mean_pressure = sum[fluid_pressure] / static_cast<double>(simulation.fluid_total());

  if (simulation.surface_tension().is_enabled()) {
    const SurfaceTensionStep& tension = simulation.surface_tension();
    const SurfaceReport report = tension.report();
    o.curve_length = report.length;
    o.curve_area = report.area;
    o.mean_curvature = report.mean_curvature;
    o.curvature_scatter = report.curvature_scatter;
    o.curve_count = report.curve_count;
    o.tension_net_force = report.net_force;
    o.surface = simulation.input().surface_tension.coefficient * o.curve_length;
    o.reconnection = simulation.input().surface_tension.coefficient * tension.reconnected_length() +
                     tension.reconnected_gauge_energy();
    o.sharing_work = sum[tension_sharing];
    if (tension.work_of_adhesion() > 0) {
      o.base_width = report.base_width;
      o.adhesion = -tension.work_of_adhesion() * o.base_width;
      o.reconnection -= tension.work_of_adhesion() * tension.reconnected_base();
    }
    const GaugePressureStep& gauge = simulation.gauge();
    if (gauge.is_enabled()) {
      o.gauge_pressure = gauge.pressure();
      o.gauge = gauge.energy(report.area);
      o.gauge_adjustment = gauge.adjustment() + sum[fluid_gauge];
    }
  }
}

void observe_beam(const Simulation& simulation, const std::array<double, sum_count>& sum, Observation& o) {
  if (simulation.deflection_probe().empty()) return;
  const auto probe_size = static_cast<double>(simulation.deflection_probe().size());
  o.deflection = sum[probe_deflection] / probe_size;
  o.middle_deflection = sum[middle_probe_deflection] / static_cast<double>(simulation.middle_probe().size());
  if (simulation.input().solid.kind == SolidKind::cantilever || simulation.input().solid.kind == SolidKind::polygon)
    o.tip_displacement_x = sum[probe_displacement_x] / probe_size;
}

void observe_solids(const Simulation& simulation, Observation& o) {
  const auto& probes = simulation.probes_of_solids();
  std::vector<ExactSum> sums(2 * probes.size());
  const SolidParticles& s = simulation.solid();
  for (std::size_t k = 0; k < probes.size(); ++k)
    for (const std::int64_t id : probes[k])
      for_each_owned_of(s, {k, id, id + 1}, [&](std::size_t row) {
        const Vector displacement = s.position.at(row) - s.reference_position.at(row);
        sums[2 * k].add(displacement.x);
        sums[2 * k + 1].add(displacement.y);
      });
  if (probes.empty()) return;
  ExactSum::reduce(sums, simulation.communicator());
  const ContactStep& contact = simulation.contact();
  std::vector<double> forces;
  if (simulation.communicator().rank() == contact.owner())
    for (const SolidIds& ids : simulation.solids()) {
      const Vector force = contact.force_on(ids);
      forces.push_back(force.x);
      forces.push_back(force.y);
    }
  simulation.communicator().broadcast(forces, contact.owner());
  for (std::size_t k = 0; k < probes.size(); ++k) {
    const auto count = static_cast<double>(probes[k].size());
    const bool yields = !probes[k].empty();
    o.solids.push_back({yields ? sums[2 * k + 1].value() / count : nan, yields ? sums[2 * k].value() / count : nan,
                        forces[2 * k], forces[2 * k + 1]});
  }
}

void observe_contact(const Simulation& simulation, Observation& o) {
  const ContactStep& contact = simulation.contact();
  std::vector<double> numbers;
  if (simulation.communicator().rank() == contact.owner()) {
    const ContactSummary& s = contact.summary();
    const Vector impulse = contact.impulse();
    numbers = {
        static_cast<double>(s.count), s.force_on_solid.x,         s.force_on_solid.y, impulse.x, impulse.y, s.energy,
        contact.angular_impulse(),    contact.dissipated_energy()};
  }
  simulation.communicator().broadcast(numbers, contact.owner());
  o.contact_count = numbers[0];
  o.contact_force_x = numbers[1];
  o.contact_force_y = numbers[2];
  o.contact_impulse_x = numbers[3];
  o.contact_impulse_y = numbers[4];
  o.contact = numbers[5];
  o.contact_angular_impulse = numbers[6];
  o.dissipated_contact = numbers[7];
}

}  // namespace

Observation observe(const Simulation& simulation, double initial_total) {
  Sums sums;
  add_fluid(simulation, sums);
  sums[tension_sharing].add(simulation.surface_tension().sharing_work().part());
  sums[surface_shift].add(simulation.shifting().work().part());
  add_solid(simulation, sums);
  ExactSum::reduce(sums, simulation.communicator());
  std::array<double, sum_count> sum{};
  for (std::size_t k = 0; k < sum_count; ++k) sum[k] = sums[k].value();

  Observation o{};
  for (const ObservedQuantity& quantity : observed_quantities()) o.*quantity.value = nan;
  o.surface = o.adhesion = o.contact = o.reconnection = o.gauge = o.gauge_adjustment = o.sharing_work =
      o.largest_density_error = 0.0;
  o.time = simulation.time();
  o.step = static_cast<double>(simulation.step());
  o.time_step = simulation.time_step();
  if (simulation.fluid_total() > 0) observe_drop(simulation, sum, o);
  observe_beam(simulation, sum, o);
  observe_solids(simulation, o);
  observe_contact(simulation, o);

  const Case& c = simulation.input();
  o.kinetic_fluid = sum[fluid_kinetic];
  o.kinetic_solid = sum[solid_kinetic];
  o.elastic = sum[solid_elastic];
  o.compressive = sum[fluid_compressive];
  o.gravity = -(c.gravity.x * (sum[fluid_x] + sum[solid_mass_x]) + c.gravity.y * (sum[fluid_y] + sum[solid_mass_y]));
  o.dissipated_fluid = sum[fluid_heat];
  o.dissipated_solid = sum[solid_heat];
  o.density_correction = sum[fluid_correction];
  o.artificial_stress_work = sum[solid_artificial];
  o.shifting_work = sum[surface_shift] + sum[fluid_shift];
  o.total = o.kinetic_fluid + o.kinetic_solid + o.elastic + o.compressive + o.surface + o.adhesion + o.contact +
            o.gravity + o.gauge;
  o.unaccounted = o.total + o.dissipated_fluid + o.dissipated_solid + o.dissipated_contact - o.density_correction -
                  o.artificial_stress_work - o.reconnection - o.gauge_adjustment - o.shifting_work - o.sharing_work -
                  initial_total;
  o.momentum_fluid_x = sum[fluid_momentum_x];
  o.momentum_fluid_y = sum[fluid_momentum_y];
  o.momentum_solid_x = sum[solid_momentum_x];
  o.momentum_solid_y = sum[solid_momentum_y];
  o.angular_momentum_fluid = sum[fluid_spin];
  o.angular_momentum_solid = sum[solid_spin];
  return o;
}

std::uint64_t state_hash(Simulation& simulation) {
  simulation.complete_solid();
  std::uint64_t hash = 0;
  const FluidParticles& f = simulation.fluid();
  f.for_each_owned([&](std::size_t row) {
    const double p = f.pressure[row];
    hash += particle_hash({f.id[row], f.position.x[row], f.position.y[row], f.velocity.x[row], f.velocity.y[row],
                           f.density[row], -p, -p, 0.0});
  });
  const SolidParticles& s = simulation.solid();
  s.for_each_owned([&](std::size_t row) {
    hash += particle_hash({s.id[row], s.position.x[row], s.position.y[row], s.velocity.x[row], s.velocity.y[row],
                           s.density[row], s.stress.xx[row], s.stress.yy[row], s.stress.xy[row]});
  });
  return simulation.communicator().sum(hash);
}

}  // namespace sphdrop
