#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <list>
#include <set>
#include <tuple>
#include <utility>

#include "io/checkpoint.hpp"
#include "io/checkpoint_directory.hpp"
#include "io/checkpoint_head.hpp"
#include "io/checkpoint_outline.hpp"
#include "io/checkpoint_seal.hpp"
#include "io/collective_error.hpp"
#include "io/durable_hdf5.hpp"
#include "io/rows_by_id.hpp"

namespace sphdrop {
namespace {

bool holds_null(std::string_view text) {
  return text.find('\0') != std::string_view::npos;
}

/// Names are taken note of in `names`; throws if one is no name or taken already.
void check_name(const std::string& name, const std::string& kind, std::set<std::string>& names) {
  if (!is_dataset_name(name)) {
    throw CheckpointError(fmt::format("'{}' is no name for a {}: letters, digits and _ only", name, kind));
  }
  if (!names.insert(name).second) throw CheckpointError(fmt::format("the name '{}' of a {} is taken", name, kind));
}

void check_table(const CheckpointTable& table) {
  std::set<std::string> names;
  for (const CheckpointColumn& column : table.columns) {
    check_name(column.name, "column", names);
    if (column.values.size() != table.ids.size()) {
      throw CheckpointError(fmt::format("column '{}/{}': {} values for {} rows", table.name, column.name,
                                        column.values.size(), table.ids.size()));
    }
    if (holds_null(column.unit + column.description)) {
      throw CheckpointError(fmt::format("column '{}/{}': a text holds a null byte", table.name, column.name));
    }
  }
}

void check_arguments(const CheckpointHeader& header, std::span<const CheckpointTable> tables,
                     std::span<const CheckpointNumbers> numbers, int keep) {
  if (keep < 1) throw CheckpointError(fmt::format("{} checkpoints cannot be kept; at least 1 can", keep));
  if (header.step < 0) throw CheckpointError(fmt::format("the step {} is negative", header.step));
  if (holds_null(header.name + header.version + header.git_commit + header.case_text)) {
    throw CheckpointError("a text of the header holds a null byte");
  }
  std::set<std::string> table_names = {"case", "run"};
  for (const CheckpointTable& table : tables) {
    check_name(table.name, "table", table_names);
    check_table(table);
  }
  std::set<std::string> names;
  for (const CheckpointNumbers& entry : numbers) {
    check_name(entry.name, "set of numbers", names);
    if (holds_null(entry.unit + entry.description)) {
      throw CheckpointError(fmt::format("numbers '{}': a text holds a null byte", entry.name));
    }
  }
}

TableOutline outline_of(const Communicator& communicator, const CheckpointTable& table) {
  const std::int64_t none = std::numeric_limits<std::int64_t>::max();
  std::int64_t smallest = none;
  table.ids.for_each([&](std::size_t, std::int64_t id) { smallest = std::min(smallest, id); });
  const std::int64_t first_id = communicator.min(smallest);
  return {table.name, table.total_rows, first_id == none ? 0 : first_id};
}

/// The datasets refer to `by_id` and to the table.
void append_columns(const CheckpointTable& table, RowsById& by_id, std::vector<DatasetRows>& datasets) {
  for (const CheckpointColumn& column : table.columns)
    datasets.push_back({"/" + table.name + "/" + column.name, column.unit, column.description, Hdf5Type::float64,
                        table.total_rows, 1, by_id.part_count(),
                        [&by_id, &column](int part, std::vector<std::byte>& bytes) {
                          const RowBlock rows = by_id.part(part);
                          bytes.resize(static_cast<std::size_t>(rows.size()) * sizeof(double));
                          by_id.gather(part, column.values, bytes.data());
                          return rows.first;
                        }});
}

bool same_bytes(std::span<const double> a, std::span<const double> b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
}

/// The columns' values are compared by others.
void compare_with_outline(const Checkpoint& found, const CheckpointHeader& header, std::span<const TableOutline> tables,
                          std::span<const CheckpointNumbers> numbers) {
  const CheckpointHeader& h = found.header;
  bool same =
      std::tie(h.name, h.version, h.git_commit, h.step, h.state_hash, h.case_text) ==
          std::tie(header.name, header.version, header.git_commit, header.step, header.state_hash, header.case_text) &&
      same_bytes({&h.time, 1}, {&header.time, 1}) && found.tables.size() == tables.size() &&
      found.numbers.size() == numbers.size();
  for (const TableOutline& table : tables) {
    const Checkpoint::Table& filed = found.table(table.name);
    same = same && filed.total_rows == table.total_rows && filed.first_id == table.first_id;
  }
  for (const CheckpointNumbers& entry : numbers) same = same && same_bytes(found.numbers_of(entry.name), entry.values);
  if (!same) throw CheckpointError("the file does not hold what was written (full or faulty disk?)");
}

}  // namespace

std::filesystem::path write_checkpoint(const Communicator& communicator, const std::filesystem::path& directory,
                                       const CheckpointHeader& header, std::span<const CheckpointTable> tables,
                                       std::span<const CheckpointNumbers> numbers, int keep) {
  std::filesystem::path path = directory / checkpoint_file_name(header.step);
  const bool is_root = communicator.rank() == 0;
  try {
    collectively<CollectiveError>(communicator, [&] { check_arguments(header, tables, numbers, keep); });
    std::vector<TableOutline> outlines;
    std::vector<DatasetRows> datasets;
    std::list<RowsById> rows_of_tables;
    for (const CheckpointTable& table : tables) {
      const TableOutline& outline = outlines.emplace_back(outline_of(communicator, table));
      append_columns(table, rows_of_tables.emplace_back(communicator, outline.first_id, outline.total_rows, table.ids),
                     datasets);
    }
    DurableHdf5 plan;
    plan.user_block = checkpoint_head_bytes;
    plan.datasets = datasets;
    plan.structure_bytes = outline_bytes(header, numbers);
    plan.write_structure = [&](Hdf5File& file) { write_outline(file, header, outlines, numbers); };
    plan.seal = [&](const std::string& part) { seal_checkpoint(communicator, part); };
    plan.verify = [&](const std::string& part) {
      try {
        verify_checkpoint(communicator, part);
      } catch (const CheckpointError& error) {
        throw CheckpointError(fmt::format("when read back, {} (full or faulty disk?)", error.what()));
      }
      collectively<CheckpointError>(communicator, [&] {
        if (!is_root) return;
        compare_with_outline(read_outline(Hdf5File::open_to_read(part), part), header, outlines, numbers);
      });
    };
    write_hdf5_durably(communicator, path, plan);
  } catch (const CollectiveError& error) {
    throw CheckpointError(fmt::format("the checkpoint {} could not be written: {}", path.string(), error.what()));
  }
  if (is_root) remove_superseded_checkpoints(directory, header.step, keep);
  // Whoever goes on sees the directory as it will stay.
  communicator.barrier();
  return path;
}

}  // namespace sphdrop
