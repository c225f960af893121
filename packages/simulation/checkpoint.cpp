#include "simulation/checkpoint.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "core/deck.hpp"
#include "core/deck_changes.hpp"
#include "core/entry.hpp"
#include "core/log.hpp"
#include "core/run_error.hpp"
#include "core/text.hpp"
#include "discretisation/agree.hpp"
#include "framework/dof_ids.hpp"
#include "integrator/overlap.hpp"
#include "simulation/output/atomic_file.hpp"
#include "simulation/output/collective.hpp"

namespace mudline {

namespace {

/// Sections of the deck that may change between a run and its continuation, and between a run and another one that
/// starts from it.
const char* const free_sections[] = {"variables", "stages", "start", "solver", "output"};
const char* const free_at_start[] = {"functions", "boundary conditions"};

/// Name in the checkpoint of the names and fingerprints of the files of the fields, a line each.
const char* const field_marks = "field files";
/// Name in the checkpoint of the file of the deck, to whose folder the deck's files are relative.
const char* const deck_file = "deck file";
/// Name in the checkpoint of the results so far, as lines of their table.
const char* const results = "results";

/// Name in the checkpoint of the mesh of the last remeshing: the number of bytes, and the bytes packed into integers.
const char* const remeshed_mesh = "remeshed mesh";

/// Beginning of the names in the checkpoint of what the ends of the present stage remember.
const std::string stage_end = "stage end/";

std::vector<long long> packed(const std::vector<char>& bytes) {
  std::vector<long long> result(1 + (bytes.size() + sizeof(long long) - 1) / sizeof(long long), 0);
  result[0] = static_cast<long long>(bytes.size());
  std::copy(bytes.begin(), bytes.end(), reinterpret_cast<char*>(result.data() + 1));
  return result;
}

std::vector<char> unpacked(const std::vector<long long>& numbers) {
  const char* first = reinterpret_cast<const char*>(numbers.data() + 1);
  return {first, first + numbers[0]};
}

/// The rows of an array of the state, with ids that do not depend on the number of ranks.
struct Rows {
  std::string name;            // name of the ids in the checkpoint, such as "ids/dof"
  std::vector<long long> ids;  // by row; empty: the rows are the same on every rank
  bool shares = false;         // the ranks' rows of one id add up
  int receivers = 0;           // for shares: the number of first rows on this rank that receive the sums
  long long rest = -1;         // see ArrayInfo
};

/// An array of the state with its place in memory, row by row.
struct StateArray {
  std::string name;
  double* values;
  std::size_t size;
  Rows rows;
};

StateArray nodal(const std::string& name, const NodalView& view, const Rows& rows) {
  return {name, view.data(), view.extent(0), rows};
}

Rows rows_of(const Mesh& mesh, const ArrayInfo& info) {
  Rows rows{"ids/array/" + info.name, info.ids, info.on == ArrayInfo::On::sum, mesh.comm()->getRank() == 0 ? 1 : 0,
            info.rest};
  if (info.on == ArrayInfo::On::points)
    for (long long element : mesh.blocks()[info.block].global_ids)
      for (int q = 0; q < info.points_per_element; ++q) rows.ids.push_back(element * info.points_per_element + q);
  return rows;
}

/// Every array of the committed state, in a fixed order.
std::vector<StateArray> arrays_of(Model& model, const NodalView& initial_pressure) {
  const State& state = model.store().committed();
  const Mesh& mesh = model.mesh();
  const DofMap& dofs = *model.space().dofs();
  const Rows dof{"ids/dof", dof_ids(dofs)}, node{"ids/node", mesh.node_ids()};
  Rows forces = dof;
  forces.shares = true;
  forces.receivers = dofs.num_owned_dofs();
  std::vector<StateArray> arrays{
      nodal("nodal/value", state.value, dof),
      nodal("nodal/rate", state.rate, dof),
      nodal("nodal/acceleration", state.acceleration, dof),
      nodal("nodal/predictor", state.predictor, dof),
      nodal("nodal/initial pressure", initial_pressure, dof),
      StateArray{"nodal/coordinates", state.coordinates.data(), state.coordinates.size(), node}};
  std::size_t slot = 0;
  for (const auto& [term, name] : model.named_terms())
    if (face<const History>(*term))
      arrays.push_back(nodal("history force/" + name, state.history_forces[slot++], forces));
  for (int i = 0; i < model.store().num_arrays(); ++i) {
    const ArrayInfo& info = model.store().info(i);
    arrays.push_back({"array/" + info.name, state.arrays[i].data(), state.arrays[i].size(), rows_of(mesh, info)});
  }
  return arrays;
}

[[noreturn]] void does_not_fit(const std::string& name) {
  throw InputError("the checkpoint does not fit this deck: its array '" + name + "' is missing, or has other rows");
}

template <class T>
const std::vector<T>& find(const std::map<std::string, std::vector<T>>& arrays, const std::string& name,
                           const std::string& of) {
  const auto found = arrays.find(name);
  if (found == arrays.end()) does_not_fit(of);
  return found->second;
}

/// Fills this rank's rows from the parts of all ranks.
void redistribute(const std::vector<double>& from, const std::vector<long long>& ids, const StateArray& to) {
  const std::size_t rows = to.rows.ids.size(), columns = ids.empty() ? 0 : from.size() / ids.size();
  if (from.size() != columns * ids.size() || (rows > 0 && to.size != columns * rows)) does_not_fit(to.name);
  std::unordered_map<long long, std::size_t> first;  // first row of each id
  std::vector<double> sums(to.rows.shares ? from.size() : 0, 0.0);
  for (std::size_t row = 0; row < ids.size(); ++row) {
    const std::size_t place = first.emplace(ids[row], row).first->second;
    if (to.rows.shares)
      for (std::size_t c = 0; c < columns; ++c) sums[place * columns + c] += from[row * columns + c];
  }
  const std::vector<double>& values = to.rows.shares ? sums : from;
  for (std::size_t row = 0; row < rows; ++row) {
    const auto found = first.find(to.rows.ids[row]);
    if (found == first.end()) does_not_fit(to.name);
    const bool mine = !to.rows.shares || static_cast<int>(row) < to.rows.receivers;
    for (std::size_t c = 0; c < columns; ++c)
      to.values[row * columns + c] = mine ? values[found->second * columns + c] : 0.0;
  }
}

/// Fills rows that may be others than those of the checkpoint, which are the same on every rank.
void take_rest(const std::vector<double>& from, const std::vector<long long>& ids, const StateArray& to) {
  const std::size_t columns = to.size / to.rows.ids.size();
  if (from.size() != columns * ids.size()) does_not_fit(to.name);
  std::unordered_map<long long, std::size_t> row_of;
  for (std::size_t row = 0; row < to.rows.ids.size(); ++row) row_of.emplace(to.rows.ids[row], row);
  std::fill(to.values, to.values + to.size, 0.0);
  std::unordered_set<long long> seen;  // on the ranks before
  for (std::size_t row = 0; row < ids.size(); ++row) {
    if (!seen.insert(ids[row]).second) continue;
    const auto found = row_of.find(ids[row]);
    const std::size_t place = found != row_of.end() ? found->second : row_of.at(to.rows.rest);
    for (std::size_t c = 0; c < columns; ++c) to.values[place * columns + c] += from[row * columns + c];
  }
}

/// Fills rows without ids from the parts of all ranks: they are the same on every rank, or shares that add up.
void take_common(const std::vector<double>& from, int ranks, const StateArray& to) {
  if (from.size() != to.size * ranks) does_not_fit(to.name);
  for (std::size_t i = 0; i < to.size; ++i) {
    double sum = 0;
    for (int rank = 0; rank < ranks; ++rank) sum += from[rank * to.size + i];
    to.values[i] = !to.rows.shares ? from[i] : to.rows.receivers > 0 ? sum : 0.0;
  }
}

void restore(const CheckpointData& from, const StateArray& to) {
  const std::vector<double>& values = find(from.arrays, to.name, to.name);
  if (to.rows.ids.empty() && from.integers.count(to.rows.name) == 0) {
    if (from.ranks > 0) return take_common(values, from.ranks, to);
    if (values.size() != to.size) does_not_fit(to.name);
  } else {
    const std::vector<long long>& ids = find(from.integers, to.rows.name, to.name);
    const bool same = from.ranks == 0 && ids == to.rows.ids;
    if (to.rows.rest >= 0 && !same) return take_rest(values, ids, to);
    if (from.ranks > 0) return redistribute(values, ids, to);
    if (values.size() != to.size || ids != to.rows.ids) does_not_fit(to.name);
  }
  std::copy(values.begin(), values.end(), to.values);
}

double scalar(const CheckpointData& from, const std::string& name) {
  const auto found = from.scalars.find(name);
  if (found == from.scalars.end()) throw InputError("the checkpoint lacks the value '" + name + "'");
  if (!std::isfinite(found->second)) throw InputError("the value '" + name + "' is not finite");
  return found->second;
}

int counter(const CheckpointData& from, const std::string& name, double most) {
  const double value = scalar(from, name);
  if (value != std::floor(value) || value < 0 || value > most)
    throw InputError("the value '" + name + "' = " + number_text(value) + " is impossible");
  return static_cast<int>(value);
}

std::string text_of(const FieldMarks& marks) {
  std::string text;
  for (const auto& [name, fingerprint] : marks) text += name + ' ' + std::to_string(fingerprint) + '\n';
  return text;
}

/// The fingerprints of the files of the fields; empty where the checkpoint is of a version that kept none.
FieldMarks field_marks_of(const CheckpointData& from) {
  FieldMarks marks;
  const auto found = from.texts.find(field_marks);
  std::istringstream lines(found == from.texts.end() ? "" : found->second);
  std::string name;
  for (std::uint64_t fingerprint = 0; lines >> name >> fingerprint;) marks[name] = fingerprint;
  return marks;
}

Deck deck_of(const std::string& text, const std::string& name) {
  Deck deck;
  deck.overlay(text, name);
  return deck;
}

}  // namespace

void Checkpoint::write(Model& model, const ExcessPressure& pressure, const Progress& progress,
                       const HistoryOutput& history, const FieldOutput& fields) const {
  const Comm& comm = *model.mesh().comm();
  CheckpointData data;
  // this comes first, because a solver may free memory here that the arrays then use
  data.arrays["linear solver"] = model.system().solver_memory();
  for (const StateArray& array : arrays_of(model, pressure.initial())) {
    data.arrays[array.name].assign(array.values, array.values + array.size);
    // an array without rows on this rank may have some on others
    if (max_over_ranks(comm, array.rows.ids.empty() ? 0.0 : 1.0) > 0) data.integers[array.rows.name] = array.rows.ids;
  }
  data.scalars["time"] = model.store().committed().time;
  data.scalars["stage"] = progress.stage;
  data.scalars["step in stage"] = progress.step_in_stage;
  data.scalars["step"] = progress.step;
  data.scalars["stage start"] = progress.stage_start;
  data.scalars["next dt"] = progress.next_dt;
  data.scalars["last dt"] = progress.last_dt;
  data.scalars["stage open"] = progress.stage_open;
  data.scalars["stage over"] = progress.stage_over;
  for (const auto& [name, largest] : progress.ends) data.scalars[stage_end + name] = largest;
  const HistoryMark& mark = history.mark();
  data.integers["history"] = {mark.rows, mark.bytes, static_cast<long long>(mark.fingerprint)};
  data.scalars["field steps"] = fields.num_steps();
  data.texts[results] = progress.results.lines();
  data.texts["deck"] = origin_.deck;
  data.texts[deck_file] = origin_.deck_file;
  data.texts[field_marks] = text_of(fields.marks());
  if (model.ale() && model.ale()->remeshing()) data.scalars["remesh tried"] = progress.remesh_tried;
  if (model.remeshed())
    data.integers[remeshed_mesh] = comm.getRank() == 0 ? packed(model.remeshed()->bytes()) : std::vector<long long>();
  write_checkpoint(comm, path_, signature_of(model.mesh()), data);
}

void Checkpoint::keep_as(const std::string& path, const Comm& comm) const {
  const std::string error =
      agreed_message(raw_communicator(comm), comm.getRank() == 0 ? link_file(path_, path) : std::string());
  if (!error.empty()) throw RunError("checkpoint '" + path + "': " + error);
}

Origin Checkpoint::origin_of(const std::string& path, const RCP<const Comm>& comm) {
  const auto texts = read_checkpoint_texts(*comm, path);
  if (texts.count("deck") == 0 || texts.count(deck_file) == 0)
    throw InputError(path + ": it is of an earlier version, which did not keep where its deck was");
  return {texts.at("deck"), texts.at(deck_file), ""};
}

std::shared_ptr<const RemeshedMesh> Checkpoint::open(const Mesh& mesh) {
  const Comm& comm = *mesh.comm();
  agree(comm, [&] {
    if (!std::filesystem::exists(path_))
      throw InputError(path_ + ": there is no such checkpoint" +
                       (use_ == For::restart ? "; --restart continues a run of the same deck that left one" : ""));
  });
  const auto texts = read_checkpoint_texts(comm, path_);
  const auto deck = texts.find("deck");
  if (deck == texts.end()) throw InputError(path_ + ": the checkpoint lacks its deck");
  old_deck_ = deck->second;
  check_model();
  const std::vector<long long> written = read_checkpoint_integers(comm, path_, remeshed_mesh);
  if (max_over_ranks(comm, static_cast<double>(written.size())) == 0) return nullptr;
  RemeshedMesh remeshed;
  if (!written.empty()) remeshed = RemeshedMesh::from_bytes(unpacked(written));
  return std::make_shared<const RemeshedMesh>(broadcast(comm, std::move(remeshed)));
}

void Checkpoint::read(Model& model, const ExcessPressure& pressure, Progress& progress) {
  const RCP<const Comm> comm = model.mesh().comm();
  data_ = read_checkpoint(*comm, path_, signature_of(model.mesh()));
  if (data_.moved_nodes)
    refuse_or_warn("the source of the mesh gives its nodes other coordinates than those of the first run");
  if (data_.ranks > 0)
    log::info("the checkpoint was written on " + std::to_string(data_.ranks) + (data_.ranks == 1 ? " rank" : " ranks") +
              ", or on another partition: its state is redistributed");
  agree(*comm, [&] {
    try {
      read_progress(model, progress);
      check_stages(model, progress);
      // a checkpoint of an earlier version has no predictor
      if (const auto rate = data_.arrays.find("nodal/rate"); rate != data_.arrays.end())
        data_.arrays.emplace("nodal/predictor", rate->second);
      // what a start lacks belongs to conditions that are new in it, for nothing else may be
      for (const StateArray& array : arrays_of(model, pressure.initial()))
        if (use_ != For::start || data_.arrays.count(array.name) > 0) restore(data_, array);
    } catch (const InputError& error) {
      throw InputError(path_ + ": " + error.what());
    }
  });
  const std::string time = std::to_string(model.store().committed().time) + " s",
                    place = ", step " + std::to_string(progress.step) + ", stage '" +
                            model.stages()[progress.stage]->name + "'";
  if (use_ == For::restart) log::info("restart at t = " + time + place);
  if (use_ == For::start) log::info(path_ + ": start at t = " + time + place);
  if (use_ == For::state) log::info(path_ + ": state at t = " + time);
}

void Checkpoint::refuse_or_warn(const std::string& difference) const {
  if (!accept_changes_)
    throw InputError(path_ + ": the checkpoint is that of another model: " + difference +
                     (use_ == For::restart ? " (--accept-changes goes on all the same)" : ""));
  log::warn("going on from the checkpoint of another model: " + difference);
}

bool Checkpoint::may_change(For use, const std::string& path) {
  const auto lies_here = [&](const char* section) { return lies_in(path, section); };
  return std::any_of(std::begin(free_sections), std::end(free_sections), lies_here) ||
         (use == For::start && std::any_of(std::begin(free_at_start), std::end(free_at_start), lies_here));
}

void Checkpoint::check_model() const {
  const Deck was = deck_of(old_deck_, path_), now = deck_of(origin_.deck, "deck");
  std::vector<DeckChange> changes = deck_changes(was.list(), now.list());
  changes.erase(std::remove_if(changes.begin(), changes.end(),
                               [&](const DeckChange& change) { return may_change(use_, change.path); }),
                changes.end());
  if (!changes.empty()) refuse_or_warn(one_line(changes));
}

void Checkpoint::check_stages(const Model& model, Progress& progress) const {
  const Deck was = deck_of(old_deck_, path_), now = deck_of(origin_.deck, "deck");
  const std::vector<std::string> names = section_names(was.list().sublist("stages"));
  const auto& stages = model.stages();
  const int present = progress.stage, begun = present + (progress.stage_open ? 1 : 0);
  std::vector<std::string> over(names.begin(), names.begin() + std::min<int>(begun, static_cast<int>(names.size())));
  for (int i = 0; i < begun; ++i) {
    if (i < static_cast<int>(over.size()) && i < static_cast<int>(stages.size()) && stages[i]->name == over[i])
      continue;
    const std::string here = i < static_cast<int>(stages.size()) ? "has '" + stages[i]->name + "' there" : "has none";
    throw InputError("the run began with the stages " + join(over) + ", but stage " + std::to_string(i + 1) +
                     " cannot be '" + (i < static_cast<int>(over.size()) ? over[i] : "") + "' any more: the deck " +
                     here + "; stages before the present one can neither be inserted, renamed nor removed");
  }
  std::vector<DeckChange> without_effect;
  for (const DeckChange& change : deck_changes(was.list(), now.list()))
    for (int i = 0; i < begun; ++i) {
      const std::string stage = "stages/" + over[i];
      if (!lies_in(change.path, stage)) continue;
      const bool running = i == present;
      if (running && lies_in(change.path, stage + "/ends when")) progress.stage_over = false;
      const std::string reduction = stage + "/strength reduction";
      if (running && (lies_in(change.path, reduction) ||
                      (change.path == stage + "/duration" && stages[i]->strength_reduction.acts())))
        throw InputError(change.text() + ", but the strengths of that stage are being reduced already");
      if ((change.path == stage + "/duration" && !running) || (change.path == stage + "/type"))
        throw InputError(change.text() + ", but that stage " + (running ? "has begun" : "is over"));
      if (!running) without_effect.push_back(change);
    }
  if (!without_effect.empty()) log::warn("changes in stages that are over have no effect: " + one_line(without_effect));
  if (!progress.stage_open) return;
  const Stage& stage = *stages[present];
  const double done = model.store().committed().time - progress.stage_start;
  if (stage.duration < done * (1 - 1e-9))
    throw InputError("stages/" + stage.name + "/duration: " + number_text(stage.duration) +
                     " s, but the checkpoint stands " + number_text(done) + " s into that stage");
}

void Checkpoint::read_progress(Model& model, Progress& progress) const {
  model.store().committed().time = scalar(data_, "time");
  progress.stage = counter(data_, "stage", 1e6);
  progress.step_in_stage = counter(data_, "step in stage", 2e9);
  progress.step = counter(data_, "step", 2e9);
  progress.stage_start = scalar(data_, "stage start");
  progress.next_dt = scalar(data_, "next dt");
  progress.last_dt = scalar(data_, "last dt");
  progress.stage_open = counter(data_, "stage open", 1) == 1;
  progress.stage_over = data_.scalars.count("stage over") > 0 && counter(data_, "stage over", 1) == 1;
  for (const auto& [name, value] : data_.scalars)
    if (name.compare(0, stage_end.size(), stage_end) == 0)
      progress.ends[name.substr(stage_end.size())] = scalar(data_, name);
  if (const auto found = data_.texts.find(results); found != data_.texts.end())
    progress.results = ResultTable::from_lines(found->second);
  else
    log::warn(path_ + ": a checkpoint of an earlier version, which kept no results: those up to here will be missing");
  if (data_.scalars.count("remesh tried")) progress.remesh_tried = counter(data_, "remesh tried", 2e9);
  if (model.store().committed().time < progress.stage_start && progress.stage_open)
    throw InputError("its time lies before the start of its stage");
  if (progress.stage_open && !(progress.next_dt > 0) &&
      model.stages()[std::min<std::size_t>(progress.stage, model.stages().size() - 1)]->type != Stage::Type::geostatic)
    throw InputError("the value 'next dt' = " + number_text(progress.next_dt) + " is impossible");
  if (use_ == For::start && progress.stage_open) {  // the end of a last stage, which a restart may prolong
    progress.stage_open = false;
    ++progress.stage;
  }
  if (use_ == For::start && progress.stage == static_cast<int>(model.stages().size()))
    throw InputError("the deck has no stage after that one");
  if (progress.stage >= static_cast<int>(model.stages().size()))
    throw InputError("the checkpoint stands in stage " + std::to_string(progress.stage + 1) + ", but the deck has " +
                     std::to_string(model.stages().size()) + " stages");
}

void Checkpoint::resume(double time, HistoryOutput& history, FieldOutput& fields) const {
  const std::vector<long long>& mark = find(data_.integers, "history", "history");
  if (mark.size() < 3) does_not_fit("history");
  history.go_on({{mark[0], mark[1], static_cast<std::uint64_t>(mark[2])}, time, accept_changes_});
  fields.go_on({static_cast<long long>(scalar(data_, "field steps")), time, accept_changes_, field_marks_of(data_)});
}

void Checkpoint::restore_solver(StepSystem& system) const {
  const auto found = data_.arrays.find("linear solver");
  // the numbers belong to the ranks' parts of the matrix, so they need the same partition
  if (data_.ranks == 0 && found != data_.arrays.end()) system.restore_solver(found->second);
}

}  // namespace mudline
