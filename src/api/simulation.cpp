#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "api/case_content.hpp"
#include "api/particle_columns.hpp"
#include "api/translate.hpp"
#include "run/recorded_run.hpp"
#include "setup/initial_state.hpp"
#include "simulation/observation.hpp"
#include "time_integration/due_time.hpp"

namespace sphdrop::v1 {

namespace {

struct Watching {
  double interval;  // s; 0: every step
  double due;       // s
  Simulation::Observer observer;
};

}  // namespace

struct Simulation::Content {
  Communicator communicator;
  double end;                                     // s
  std::optional<sphdrop::RecordedRun> recorded;   // either this
  std::optional<sphdrop::Simulation> unrecorded;  // or that
  std::vector<Watching> watching;
  std::optional<Observation> first, last;
  bool is_finished = false, is_watched = false;
  std::string summary, not_stopped;

  Content(MPI_Comm given, const sphdrop::Case& input, const Results* results, const RecordedRunOptions& options)
      : communicator(given), end(input.time.end) {
    InitialState initial = build_initial_state(input, {communicator.rank(), communicator.size()});
    if (results != nullptr)
      recorded.emplace(communicator, input, std::move(initial), options);
    else
      unrecorded.emplace(communicator, input, initial.fluid, initial.solid);
    arrive();
  }

  sphdrop::Simulation& core() { return recorded ? recorded->simulation() : *unrecorded; }
  const std::string& stopped() const { return recorded ? recorded->stopped() : not_stopped; }
  bool is_over() const { return is_finished || !stopped().empty(); }

  void arrive() {
    if (recorded)
      recorded->arrive();
    else
      unrecorded->evaluate();
  }

  void go_on() {
    if (recorded)
      recorded->go_on();
    else
      unrecorded->move();
    arrive();
  }

  void finish() {
    if (is_over()) return;
    if (recorded) summary = summary_text(recorded->finish());
    is_finished = true;
  }

  void call(const Observer& observer, v1::Simulation& simulation) {
    struct Mark {
      bool& is_set;
      explicit Mark(bool& mark) : is_set(mark) { is_set = true; }
      ~Mark() { is_set = false; }
    } mark(is_watched);
    observer(simulation);
  }

  // What may be looked at.
  sphdrop::Simulation& present() {
    if (!stopped().empty())
      throw Error(Error::Kind::mistake,
                  fmt::format("the run has stopped ({}): its state is in its checkpoint", stopped()));
    return core();
  }
};

namespace {

RecordedRunOptions options_of(const Results& results, const std::string& source_name, const std::string& text) {
  RecordedRunOptions options;
  options.case_file = source_name;
  options.case_text = text;
  if (!results.restart.empty()) options.restart = results.restart;
  options.fresh = results.fresh;
  if (results.max_walltime > 0) options.walltime_limit = results.max_walltime;
  if (results.show_progress) options.progress = Progress::Mode::log;
  return options;
}

}  // namespace

Simulation::Simulation(MPI_Comm communicator, const Case& input)
    : content_(translated([&] {
        return std::make_unique<Content>(communicator, input.content_->parsed.values, nullptr, RecordedRunOptions{});
      })) {}

Simulation::Simulation(MPI_Comm communicator, const Case& input, const Results& results) {
  sphdrop::Case values = input.content_->parsed.values;
  if (!results.folder.empty()) values.output.directory = results.folder;
  content_ = translated([&] {
    return std::make_unique<Content>(communicator, values, &results,
                                     options_of(results, input.content_->source_name, input.content_->text));
  });
  if (content_->stopped().empty() && time() >= content_->end) finish();
}

Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

bool Simulation::step() {
  if (content_->is_watched) throw Error(Error::Kind::mistake, "an observer may look at the simulation but not step it");
  if (content_->is_over() || time() >= content_->end) return false;
  translated([&] { content_->go_on(); });
  if (!stopped().empty()) return false;
  // By position: an observer may add another.
  for (std::size_t k = 0; k < content_->watching.size(); ++k) {
    Watching& watching = content_->watching[k];
    if (time() < watching.due) continue;
    if (watching.interval > 0) watching.due = next_multiple(time(), watching.interval);
    const Observer observer = watching.observer;
    content_->call(observer, *this);
  }
  if (time() >= content_->end) finish();
  return true;
}

bool Simulation::run_until(double time_to_reach) {
  while (time() < time_to_reach)
    if (!step()) return false;
  return true;
}

bool Simulation::run() {
  return run_until(content_->end);
}

void Simulation::finish() {
  translated([&] { content_->finish(); });
}

double Simulation::time() const {
  return content_->core().time();
}

double Simulation::time_step() const {
  return content_->core().time_step();
}

std::int64_t Simulation::steps() const {
  return content_->core().step();
}

int Simulation::rank() const {
  return content_->communicator.rank();
}

int Simulation::ranks() const {
  return content_->communicator.size();
}

const std::string& Simulation::stopped() const {
  return content_->stopped();
}

void Simulation::every_step(const Observer& observer) {
  content_->watching.push_back({0, -std::numeric_limits<double>::infinity(), observer});
  if (!content_->is_over()) content_->call(observer, *this);
}

void Simulation::every(double interval, const Observer& observer) {
  if (!(interval > 0))
    throw Error(Error::Kind::mistake, fmt::format("an observer's interval is {} s; it must be > 0", interval));
  content_->watching.push_back({interval, time() < 0 ? 0.0 : next_multiple(time(), interval), observer});
  if (time() >= 0 && !content_->is_over()) content_->call(observer, *this);
}

std::vector<Quantity> Simulation::observed_quantities() {
  std::vector<Quantity> all;
  for (const ObservedQuantity& q : sphdrop::observed_quantities())
    all.push_back({std::string(q.name), std::string(q.unit), std::string(q.description)});
  return all;
}

double Simulation::observed(const std::string& name) {
  sphdrop::Simulation& core = content_->present();
  const auto table = sphdrop::observed_quantities();
  const auto found =
      std::find_if(table.begin(), table.end(), [&](const ObservedQuantity& q) { return q.name == name; });
  if (found == table.end())
    throw Error(Error::Kind::mistake,
                fmt::format("nothing that is watched is called {}: see observed_quantities()", name));
  if (!content_->last || content_->last->step != static_cast<double>(core.step())) {
    content_->last = observe(core, content_->first ? content_->first->total : 0.0);
    if (!content_->first) {
      content_->first = content_->last;
      content_->last->unaccounted = 0;
    }
  }
  return (*content_->last).*found->value;
}

std::vector<Quantity> Simulation::columns(Material material) {
  return material == Material::drop ? written_columns(FluidParticles()) : written_columns(SolidParticles());
}

std::vector<double> Simulation::own_column(Material material, const std::string& name) {
  sphdrop::Simulation& core = content_->present();
  core.complete_solid();
  return material == Material::drop ? owned_values(core.fluid(), name) : owned_values(core.solid(), name);
}

std::vector<std::int64_t> Simulation::own_ids(Material material) const {
  return material == Material::drop ? owned_ids(content_->present().fluid()) : owned_ids(content_->present().solid());
}

std::vector<double> Simulation::column(Material material, const std::string& name) {
  struct Row {
    std::int64_t id;
    double value;
  };
  const std::vector<std::int64_t> ids = own_ids(material);
  const std::vector<double> values = own_column(material, name);
  std::vector<Row> mine;
  mine.reserve(ids.size());
  for (std::size_t k = 0; k < ids.size(); ++k) mine.push_back({ids[k], values[k]});
  std::vector<Row> all = content_->communicator.all_gather(std::span<const Row>(mine));
  std::sort(all.begin(), all.end(), [](const Row& a, const Row& b) { return a.id < b.id; });
  std::vector<double> column;
  column.reserve(all.size());
  for (const Row& row : all) column.push_back(row.value);
  return column;
}

std::int64_t Simulation::particles(Material material) const {
  return material == Material::drop ? content_->core().fluid_total() : content_->core().solid_total();
}

std::uint64_t Simulation::state_hash() {
  return sphdrop::state_hash(content_->present());
}

const std::string& Simulation::summary() const {
  return content_->summary;
}

}  // namespace sphdrop::v1
