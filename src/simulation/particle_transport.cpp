#include "simulation/particle_transport.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <map>
#include <numeric>

namespace sphdrop {

namespace {

// More columns than any set declares as ghosted: pointers to them live on the stack in every step.
constexpr std::size_t most_columns = 16;

void permute(Column<double>& column, std::span<const std::int32_t> order, std::vector<double>& scratch) {
  scratch.resize(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) scratch[k] = column[static_cast<std::size_t>(order[k])];
  std::copy(scratch.begin(), scratch.end(), column.begin());
}

}  // namespace

void migrate(const Communicator& communicator, ParticleSet& particles, std::span<const int> destination, int tag) {
  std::map<int, RankRows> by_rank;
  std::vector<std::int32_t> staying;  // ascending
  staying.reserve(destination.size());
  std::size_t k = 0;
  particles.for_each_owned([&](std::size_t row) {
    const int rank = destination[k++];
    if (rank == communicator.rank()) {
      staying.push_back(static_cast<std::int32_t>(row));
      return;
    }
    RankRows& rows = by_rank[rank];
    rows.rank = rank;
    rows.rows.push_back(static_cast<std::int32_t>(row));
  });
  assert(k == destination.size());
  std::vector<RankRows> sends;
  sends.reserve(by_rank.size());
  for (auto& [rank, rows] : by_rank) sends.push_back(std::move(rows));
  ExchangePlan plan = ExchangePlan::from_sends(communicator, std::move(sends), 0, tag);

  const std::size_t received = plan.received_row_count();
  const std::vector<Column<double>*> columns = particles.columns_with(Role::state);
  std::vector<std::int64_t> new_id(received);
  std::vector<std::vector<double>> arrived(columns.size(), std::vector<double>(received));
  std::vector<const void*> sources{particles.id.data()};
  std::vector<void*> targets{new_id.data()};
  for (std::size_t c = 0; c < columns.size(); ++c) {
    sources.push_back(columns[c]->data());
    targets.push_back(arrived[c].data());
  }
  plan.start(sources);
  plan.finish(targets);

  // Those that stay close up, the others follow.
  const auto close_up = [&](auto& column) {
    for (std::size_t place = 0; place < staying.size(); ++place)
      column[place] = column[static_cast<std::size_t>(staying[place])];
  };
  close_up(particles.id);
  for (Column<double>* column : columns) close_up(*column);
  const std::size_t size = staying.size() + received;
  particles.resize(size);
  const auto end_of_staying = static_cast<std::ptrdiff_t>(staying.size());
  std::copy(new_id.begin(), new_id.end(), particles.id.begin() + end_of_staying);
  for (std::size_t c = 0; c < columns.size(); ++c)
    std::copy(arrived[c].begin(), arrived[c].end(), columns[c]->begin() + end_of_staying);
  particles.owned.assign(size > 0 ? 1 : 0, {0, static_cast<std::int32_t>(size)});
  particles.ghosts.clear();
}

void reorder(ParticleSet& particles, std::span<const std::int32_t> order) {
  assert(order.size() == particles.size());
  std::vector<std::int64_t> ids(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) ids[k] = particles.id[static_cast<std::size_t>(order[k])];
  std::copy(ids.begin(), ids.end(), particles.id.begin());
  std::vector<double> scratch;
  for (Field* field : particles.fields())
    if ((has(field->roles, Role::state) || has(field->roles, Role::constant)) && !field->is_left_out())
      for (int c = 0; c < field->components; ++c) permute(field->columns[static_cast<std::size_t>(c)], order, scratch);
}

ExchangePlan halo_plan(const Communicator& communicator, const ParticleSet& particles, const VectorField& position,
                       const DomainPartition& partition, double reach, int tag) {
  std::map<int, RankRows> by_rank;
  std::vector<int> ranks;
  const std::size_t owned = particles.owned_count();
  for (std::size_t row = 0; row < owned; ++row) {
    ranks.clear();
    partition.other_ranks_within(position.x[row], position.y[row], reach, ranks);
    for (const int rank : ranks) {
      by_rank[rank].rank = rank;
      by_rank[rank].rows.push_back(static_cast<std::int32_t>(row));
    }
  }
  std::vector<RankRows> sends;
  sends.reserve(by_rank.size());
  for (auto& [rank, rows] : by_rank) sends.push_back(std::move(rows));
  return ExchangePlan::from_sends(communicator, std::move(sends), static_cast<std::int32_t>(owned), tag);
}

ExchangePlan make_halo(const Communicator& communicator, ParticleSet& particles, VectorField& position,
                       const DomainPartition& partition, double reach, int tag) {
  ExchangePlan plan = halo_plan(communicator, particles, position, partition, reach, tag);
  const std::size_t owned = particles.owned_count();
  const std::size_t all = owned + plan.received_row_count();
  particles.resize(all);
  if (all > owned) particles.ghosts = {{static_cast<std::int32_t>(owned), static_cast<std::int32_t>(all)}};

  std::vector<const void*> sources{particles.id.data(), position.x.data(), position.y.data()};
  std::vector<void*> targets{particles.id.data(), position.x.data(), position.y.data()};
  for (Column<double>* column : particles.columns_with(Role::constant)) {
    sources.push_back(column->data());
    targets.push_back(column->data());
  }
  plan.start(sources);
  plan.finish(targets);
  return plan;
}

void sort_by_id(ParticleSet& particles, ExchangePlan& halo) {
  const std::size_t size = particles.size();
  std::vector<char> is_owned(size, 0);
  particles.for_each_owned([&](std::size_t row) { is_owned[row] = 1; });
  std::vector<std::int32_t> order(size);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
    return particles.id[static_cast<std::size_t>(a)] < particles.id[static_cast<std::size_t>(b)];
  });
  reorder(particles, order);
  std::vector<std::int32_t> new_row(size);
  for (std::size_t k = 0; k < size; ++k) new_row[static_cast<std::size_t>(order[k])] = static_cast<std::int32_t>(k);
  halo.renumber_sent_rows(new_row);
  halo.renumber_received_rows(new_row);

  particles.owned.clear();
  particles.ghosts.clear();
  for (std::size_t first = 0; first < size;) {
    const char kind = is_owned[static_cast<std::size_t>(order[first])];
    std::size_t last = first + 1;
    while (last < size && is_owned[static_cast<std::size_t>(order[last])] == kind) ++last;
    (kind ? particles.owned : particles.ghosts)
        .push_back({static_cast<std::int32_t>(first), static_cast<std::int32_t>(last)});
    first = last;
  }
}

void start_exchange(ExchangePlan& plan, std::span<Column<double>* const> columns) {
  assert(columns.size() <= most_columns);
  std::array<const void*, most_columns> sources;
  for (std::size_t c = 0; c < columns.size(); ++c) sources[c] = columns[c]->data();
  plan.start(std::span(sources).first(columns.size()));
}

void finish_exchange(ExchangePlan& plan, std::span<Column<double>* const> columns) {
  std::array<void*, most_columns> targets;
  for (std::size_t c = 0; c < columns.size(); ++c) targets[c] = columns[c]->data();
  plan.finish(std::span(targets).first(columns.size()));
}

}  // namespace sphdrop
