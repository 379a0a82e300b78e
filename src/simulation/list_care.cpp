// When the lists of neighbours are made anew, and what must be when they need not be.

#include "simulation/simulation.hpp"

namespace sphdrop {

void Simulation::redistribute_if_due(double largest_squared_displacement, double solid_squared_displacement,
                                     const DisplacementBox& displacements_now) {
  const double allowed = parameters_.range.largest_displacement();
  const std::int64_t interval = case_.parallel.repartition_interval;
  const bool forced = interval > 0 && step_ % interval == 0;
  // What a drop moves as a whole brings no neighbours together. It may bring it to another part of the solid, and the
  // box shows how far only as long as it is small.
  const bool moves_as_a_whole =
      solid_step_->is_total_lagrangian() && displacements_now.squared_diagonal() <= 0.25 * allowed * allowed;
  const bool lists_hold = largest_squared_displacement <= allowed * allowed || moves_as_a_whole;
  // Looked for in time; where a step is too long for that, the lists are made anew.
  wants_displacements_ = solid_step_->is_total_lagrangian() &&
                         (largest_squared_displacement > 0.5 * allowed * allowed || contact_displacements_.has_value());
  // What the surface takes is known once it has been found: then the work is dealt out anew.
  const bool deals_out_surface =
      communicator_.size() > 1 && surface_tension_.has_curves() && is_distributed_ && !surface_is_dealt_out_;
  if (is_distributed_ && !forced && !deals_out_surface && lists_hold) {
    // Such a solid stays with its ranks, but the drop may come upon another part of it.
    const bool solid_has_moved = solid_squared_displacement > allowed * allowed;
    const double squared_motion = contact_displacements_
                                      ? displacements_now.squared_motion_since(*contact_displacements_)
                                      : largest_squared_displacement;
    const bool drop_has_moved = squared_motion > allowed * allowed;
    if ((solid_has_moved || drop_has_moved) && fluid_total_ > 0) {
      check_nothing_is_lost();
      regather_contact();
      solid_.list_position.take(solid_.position);
      if (drop_has_moved) contact_displacements_ = displacements_now;
      timer_.lap(Phase::redistribution);
    }
    return;
  }
  std::vector<std::int32_t> surface_rows;
  if (is_distributed_)
    for (const SurfaceTensionStep::OwnNode& own : surface_tension_.own_nodes())
      surface_rows.push_back(static_cast<std::int32_t>(own.row));
  surface_is_dealt_out_ = surface_is_dealt_out_ || deals_out_surface;
  const bool solid_has_changed = distribution_.redistribute(fluid_, solid_, surface_rows, forced || deals_out_surface);
  solid_is_predicted_ = liquid_is_predicted_ = false;
  check_nothing_is_lost();
  corrected_density_.resize(fluid_.size() + column_padding);
  fluid_sweep_.resize(fluid_);
  if (solid_has_changed) {
    solid_step_->relist(solid_, distribution_);
    supports_.relist(solid_);
  }
  contact_displacements_.reset();
  contact_.regather(fluid_, solid_, parameters_.range);
  if (surface_tension_.is_enabled() && is_distributed_) surface_tension_.regather(fluid_, contact_, distribution_);
  if (surface_tension_.is_enabled() && !is_distributed_) surface_tension_.recover(fluid_, distribution_, contact_);
  is_distributed_ = true;
  ++redistributions_;
  timer_.lap(Phase::redistribution);
}

BoxesWanted Simulation::boxes_wanted() const {
  return {wants_displacements_, surface_tension_.displacement_is_relative()};
}

void Simulation::regather_contact() {
  contact_.regather(fluid_, solid_, parameters_.range);
  // Who attracts the drop is numbered anew, and perhaps has another owner.
  if (surface_tension_.is_enabled() && case_.is_wetting()) surface_tension_.regather(fluid_, contact_, distribution_);
}

}  // namespace sphdrop
