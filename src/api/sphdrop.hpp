#pragma once
// sphdrop as a library. What stands in the namespace sphdrop::v1 keeps its meaning; what would break it comes as v2
// beside it. All values are in SI units, per metre of depth.
//
// MPI must be initialised, and everything here be destroyed before it is finalised. Where a function is collective, all
// ranks of the communicator call it together. The state has the same bits on any number of ranks, whatever is watched.

#include <mpi.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sphdrop::v1 {

/// Thrown on all ranks together, so that a program can leave in good order. The text is that of the program `sphdrop`.
class Error : public std::runtime_error {
 public:
  enum class Kind {
    mistake = 2,       ///< in the case, in a name or in what is asked for
    unsafe_state = 3,  ///< a particle too fast, lost or too deep in the solid, or a value that is not a number
    output = 4         ///< results could not be written
  };
  Error(Kind kind, const std::string& text) : std::runtime_error(text), kind_(kind) {}
  /// Its number is the exit code of `sphdrop`.
  Kind kind() const { return kind_; }

 private:
  Kind kind_;
};

/// A checked case. Overrides are those of --set: "solid.length=12 mm". Mistakes are thrown as Error, all in one text.
class Case {
 public:
  /// Collective: rank 0 reads the file, and the particles that it names.
  static Case from_file(MPI_Comm communicator, const std::string& path, const std::vector<std::string>& overrides = {});
  /// `source_name` stands before mistakes, and without its ending is the case's name unless the text gives one. A file
  /// of particles that the text names is read by every rank.
  static Case from_text(const std::string& text, const std::vector<std::string>& overrides = {},
                        const std::string& source_name = "case.cfg");

  /// The same text with further overrides, the last of which wins.
  Case with(const std::vector<std::string>& overrides) const;

  /// What will run, but perhaps not as intended: what `sphdrop` says as "warning: ...".
  const std::vector<std::string>& warnings() const;
  /// Of a parameter that is one number, "drop.diameter", in its SI unit. Throws Error for anything else.
  double number(const std::string& parameter) const;
  /// Of any parameter, as in a case file: "[0, -0.8]", "\"cantilever\"".
  std::string value(const std::string& parameter) const;
  /// A case file with every parameter.
  std::string text() const;

 private:
  friend class Simulation;
  struct Content;
  explicit Case(std::shared_ptr<const Content> content) : content_(std::move(content)) {}
  std::shared_ptr<const Content> content_;
};

/// A quantity by its name.
struct Quantity {
  std::string name, unit, description;
};

enum class Material { drop, solid };

/// What a simulation leaves behind if it is given this: all that `sphdrop` does (io/FORMAT.md).
struct Results {
  std::string folder = {};     ///< empty: the case's output.directory
  std::string restart = {};    ///< "latest", "auto" (latest if there is any) or a checkpoint's path; empty: begin anew
  bool fresh = false;          ///< begin anew though there are checkpoints of an unfinished run
  double max_walltime = 0;     ///< s from the construction on, to stop with a checkpoint in good time before; 0: none
  bool show_progress = false;  ///< lines on standard error
};

/// A case under way. It always stands at an instant, whose state can be looked at; the first is the start. Its own
/// communicator is a duplicate of the given one. Everything but looking at this rank's own particles is collective.
class Simulation {
 public:
  /// In memory alone.
  Simulation(MPI_Comm communicator, const Case& input);
  /// With results in a folder.
  Simulation(MPI_Comm communicator, const Case& input, const Results& results);
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  /// One time step, then the observers that are due. False, and nothing is done, at time.end or once it is finished
  /// or stopped.
  bool step();
  /// Steps to the first instant at or after that time, s. False if it does not get there.
  bool run_until(double time);
  /// Steps to time.end. False if it was stopped before.
  bool run();
  /// Ends the run at this instant, which step() does by itself at time.end: with results, their last row and snapshot,
  /// and run.json. May be called again.
  void finish();

  double time() const;         ///< s; negative while a drop comes to rest before it is given its velocity
  double time_step() const;    ///< the step to come, s
  std::int64_t steps() const;  ///< so far
  int rank() const;
  int ranks() const;
  /// Why the run stopped before its end (wall time); empty if it did not. The state can no longer be looked at; it
  /// goes on from its checkpoint.
  const std::string& stopped() const;

  using Observer = std::function<void(Simulation&)>;
  /// Calls it now and after every step, on all ranks. Observers are called in the order in which they were added; they
  /// may look and communicate but not step. What they throw leaves step().
  void every_step(const Observer& observer);
  /// Calls it now and at the first instant at or after every multiple of `interval`, s; not before t = 0.
  void every(double interval, const Observer& observer);

  /// A column of history.csv at this instant; NaN for what the case does not have. `unaccounted` counts from the first
  /// call of this.
  double observed(const std::string& name);
  static std::vector<Quantity> observed_quantities();

  /// The names that column() takes: what snapshots hold, vectors as velocity_x and velocity_y, tensors as stress_xx,
  /// stress_yy and stress_xy.
  static std::vector<Quantity> columns(Material material);
  /// Of all particles of the material, on every rank, in the order of their global ids, which the start fixes: the
  /// same on any number of ranks. The memory of all particles on each rank.
  std::vector<double> column(Material material, const std::string& name);
  /// Of the particles that this rank owns, which may change from step to step; in the order of own_ids(). Not
  /// collective.
  std::vector<double> own_column(Material material, const std::string& name);
  std::vector<std::int64_t> own_ids(Material material) const;
  std::int64_t particles(Material material) const;  ///< on all ranks

  /// Over every particle's id, position, velocity, density and stress: what `sphdrop` prints at the end.
  std::uint64_t state_hash();
  /// The text that `sphdrop` ends with; empty before a run with results is finished.
  const std::string& summary() const;

 private:
  struct Content;
  std::unique_ptr<Content> content_;
};

/// "0.1.0"
std::string version();

}  // namespace sphdrop::v1
