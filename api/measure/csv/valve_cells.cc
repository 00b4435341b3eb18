#include "api/measure/csv/valve_cells.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>

#include "api/json/words.h"
#include "api/measure/csv/off_state.h"
#include "catalog/tables/heading_phrases.h"
#include "catalog/tables/heading_words.h"
#include "catalog/units/text.h"

namespace plenum::api {
namespace {

using catalog::ColumnRead;

constexpr std::size_t kValveErrorsMax = 20;
constexpr double kOfLevel = 0.2;  // of the span between two levels

struct PositionWord {
  std::string_view word;
  Position means;
};
constexpr PositionWord kPositionWords[] = {{"inflate", Position::kInflate},
                                           {"inflating", Position::kInflate},
                                           {"fill", Position::kInflate},
                                           {"filling", Position::kInflate},
                                           {"pressurize", Position::kInflate},
                                           {"pressurise", Position::kInflate},
                                           {"fuellen", Position::kInflate},
                                           {"befuellen", Position::kInflate},
                                           {"belueften", Position::kInflate},
                                           {"aufblasen", Position::kInflate},
                                           {"deflate", Position::kDeflate},
                                           {"deflating", Position::kDeflate},
                                           {"vent", Position::kDeflate},
                                           {"venting", Position::kDeflate},
                                           {"exhaust", Position::kDeflate},
                                           {"release", Position::kDeflate},
                                           {"entlueften", Position::kDeflate},
                                           {"ablassen", Position::kDeflate},
                                           {"hold", Position::kHold},
                                           {"holding", Position::kHold},
                                           {"halten", Position::kHold},
                                           {"open", Position::kOn},
                                           {"opened", Position::kOn},
                                           {"on", Position::kOn},
                                           {"true", Position::kOn},
                                           {"high", Position::kOn},
                                           {"offen", Position::kOn},
                                           {"auf", Position::kOn},
                                           {"ein", Position::kOn},
                                           {"an", Position::kOn},
                                           {"closed", Position::kOff},
                                           {"close", Position::kOff},
                                           {"off", Position::kOff},
                                           {"false", Position::kOff},
                                           {"low", Position::kOff},
                                           {"zu", Position::kOff},
                                           {"geschlossen", Position::kOff},
                                           {"aus", Position::kOff}};

// "Open" and "open", "1" and "1.0" are one cell.
std::string PlainWord(std::string_view cell) {
  if (const auto number = catalog::ParseNumber(cell)) return catalog::FormatNumber(*number);
  return std::string(catalog::Trimmed(catalog::PlainWords(cell)));
}

std::optional<Position> PositionOf(std::string_view cell) {
  const std::string plain = PlainWord(cell);
  const auto* known = std::find_if(std::begin(kPositionWords), std::end(kPositionWords),
                                   [&](const PositionWord& one) { return one.word == plain; });
  return known == std::end(kPositionWords) ? std::nullopt : std::optional(known->means);
}

std::vector<std::string> AllWords() {
  std::vector<std::string> words;
  for (const PositionWord& one : kPositionWords) words.emplace_back(one.word);
  return words;
}

// One column of a valve: how its cells are read.
class ValveColumn {
 public:
  ValveColumn(Recording& recording, std::size_t field)
      : recording_(recording),
        field_(field),
        index_(static_cast<std::size_t>(recording.ColumnOf(kValveFields[field]))) {
    ReadGiven();
    LookAtNumbers();
  }

  std::size_t index() const { return index_; }
  std::size_t field() const { return field_; }
  const ColumnRead& column() const { return recording_.table.columns[index_]; }
  bool has_off() const { return has_off_; }

  // None: an error, which is told.
  std::optional<Position> Read(const RecordedRun& run, std::size_t row) {
    const ValveCell& cell = run.valves[field_][row];
    const auto position = cell.word >= 0
                              ? OfWord(recording_.valve_words[static_cast<std::size_t>(cell.word)])
                              : OfNumber(cell.number);
    if (!position) Fail(run, row, cell);
    has_off_ = has_off_ || position == Position::kOff;
    return position;
  }

 private:
  // "[1 = inflate; 0 = hold]"
  void ReadGiven() {
    const std::string_view text = column().targets.front().unit;
    if (text.empty()) return;
    for (const std::string_view piece : catalog::Split(text, ';')) {
      const std::size_t equals = piece.find('=');
      const auto means =
          equals == std::string_view::npos ? std::nullopt : PositionOf(piece.substr(equals + 1));
      if (!means)
        recording_.table.errors.push_back(
            {0, "column",
             Quoted(column().key) + ": " + Quoted(catalog::Trimmed(piece)) +
                 " must be a cell and inflate, hold or deflate, as 1 = inflate"});
      else
        given_[PlainWord(piece.substr(0, equals))] = *means;
    }
  }

  void LookAtNumbers() {
    std::set<double> levels;
    for (const RecordedRun& run : recording_.runs)
      for (const ValveCell& cell : run.valves[field_]) {
        if (cell.word >= 0) continue;
        low_ = std::min(low_, cell.number), high_ = std::max(high_, cell.number);
        if (levels.size() < 4) levels.insert(cell.number);
      }
    const bool whole = std::all_of(levels.begin(), levels.end(), [](double level) {
      return level == 0.0 || level == 1.0 || level == -1.0;
    });
    three_levels_ = whole && levels.contains(-1.0);
    // One level that is no 0 and no 1 says nothing.
    if (whole) low_ = 0.0, high_ = 1.0;
  }

  std::optional<Position> OfWord(const std::string& word) const {
    const auto given = given_.find(PlainWord(word));
    return given != given_.end() ? std::optional(given->second) : PositionOf(word);
  }

  std::optional<Position> OfNumber(double number) const {
    if (!std::isfinite(number)) return std::nullopt;
    const auto given = given_.find(PlainWord(catalog::FormatNumber(number)));
    if (given != given_.end()) return given->second;
    if (three_levels_)
      return number == 0.0  ? Position::kHold
             : number > 0.0 ? Position::kInflate
                            : Position::kDeflate;
    if (!(high_ > low_)) return std::nullopt;
    const double share = (number - low_) / (high_ - low_);
    if (share <= kOfLevel) return Position::kOff;
    if (share >= 1.0 - kOfLevel) return Position::kOn;
    return std::nullopt;
  }

  void Fail(const RecordedRun& run, std::size_t row, const ValveCell& cell) {
    if (recording_.table.errors.size() >= kValveErrorsMax) return;
    const std::string shown = cell.word >= 0
                                  ? recording_.valve_words[static_cast<std::size_t>(cell.word)]
                                  : catalog::FormatNumber(cell.number);
    std::string detail =
        "must be hold, inflate or deflate, open or closed, on or off, 1 or 0, not " + Quoted(shown);
    if (cell.word >= 0)
      detail += "; nearest: " + Nearest(shown, AllWords());
    else
      detail += "; say what the numbers mean, as " + Quoted(column().key) +
                "=valve [0 = hold; 1 = inflate; 2 = deflate]";
    recording_.table.errors.push_back({run.lines[row], column().key, std::move(detail)});
  }

  Recording& recording_;
  std::size_t field_, index_;
  std::map<std::string, Position> given_;
  double low_ = std::numeric_limits<double>::infinity(), high_ = -low_;
  bool three_levels_ = false, has_off_ = false;
};

// How the recording writes that a valve is off.
std::string OffWord(const Recording& recording) {
  for (const std::string& word : recording.valve_words)
    if (PositionOf(word) == Position::kOff) return word;
  return "0";
}

const char* StateOf(Position position) {
  return position == Position::kInflate   ? "inflate"
         : position == Position::kDeflate ? "deflate"
                                          : "hold";
}

// What on means in a column of its own.
Position OnOf(std::string_view field) {
  return field == kDeflateValveField ? Position::kDeflate : Position::kInflate;
}

void AskForOff(const ColumnRead& column, bool only_vents, const OffState& decided,
               Recording& recording) {
  const std::string& field = column.targets.front().column;
  const std::string off = OffWord(recording);
  const char* other = only_vents ? "inflate" : "deflate";
  recording.table.questions.push_back(
      {"column",
       column.key,
       Quoted(column.key) + ": does the valve hold or " + other + " while it is off? " +
           (only_vents ? "The recording has no valve that fills" : decided.why),
       {field + " [" + off + " = " + other + "]", field + " [" + off + " = hold]"}});
}

void FindStatesOfOne(ValveColumn& valve, Recording& recording) {
  std::vector<std::vector<Position>> positions;  // of each run
  std::set<Position> found;
  for (const RecordedRun& run : recording.runs) {
    positions.emplace_back();
    for (std::size_t row = 0; row < run.t_s.size(); ++row) {
      Position position = valve.Read(run, row).value_or(Position::kHold);
      if (position == Position::kOn) position = OnOf(kValveFields[valve.field()]);
      positions.back().push_back(position);
      found.insert(position);
    }
  }
  if (!recording.table.errors.empty()) return;
  Position off = Position::kHold;
  std::string& meaning = recording.meanings[valve.index()];
  if (found.contains(Position::kOff)) {
    const OffState decided = OffStateOf(recording, positions);
    const bool only_vents = kValveFields[valve.field()] == kDeflateValveField;
    const bool vents = found.contains(Position::kDeflate) && !only_vents;
    if (only_vents || (!vents && !decided.state))
      return AskForOff(valve.column(), only_vents, decided, recording);
    off = vents ? Position::kHold : *decided.state;
    meaning = "on is " + std::string(StateOf(OnOf(kValveFields[valve.field()]))) + ", off is " +
              StateOf(off) + (vents ? "" : ": " + decided.why);
  }
  for (std::size_t r = 0; r < positions.size(); ++r)
    for (const Position position : positions[r])
      recording.runs[r].states.emplace_back(StateOf(position == Position::kOff ? off : position));
}

void FindStatesOfTwo(ValveColumn& fill, ValveColumn& vent, Recording& recording) {
  const auto is_on = [&](ValveColumn& valve, const RecordedRun& run, std::size_t row) {
    const Position position = valve.Read(run, row).value_or(Position::kOff);
    return position == Position::kOn || position == OnOf(kValveFields[valve.field()]);
  };
  for (RecordedRun& run : recording.runs)
    for (std::size_t row = 0; row < run.t_s.size(); ++row) {
      const bool fills = is_on(fill, run, row), vents = is_on(vent, run, row);
      if (fills && vents && recording.table.errors.size() < kValveErrorsMax)
        recording.table.errors.push_back(
            {run.lines[row], vent.column().key,
             "both valves are on: a run inflates, holds or deflates, and the model has no leak "
             "through both"});
      run.states.emplace_back(fills ? "inflate" : vents ? "deflate" : "hold");
    }
  recording.meanings[fill.index()] = "on is inflate; both off is hold";
  recording.meanings[vent.index()] = "on is deflate; both off is hold";
}

}  // namespace

void FindValveStates(Recording& recording) {
  std::vector<ValveColumn> valves;
  valves.reserve(kValveFields.size());
  for (std::size_t k = 0; k < kValveFields.size(); ++k)
    if (recording.ColumnOf(kValveFields[k]) >= 0) valves.emplace_back(recording, k);
  if (valves.empty() || !recording.table.errors.empty()) return;
  if (valves.size() == 1) return FindStatesOfOne(valves.front(), recording);
  if (recording.ColumnOf(kValveField) < 0) return FindStatesOfTwo(valves[0], valves[1], recording);
  // A column that says all beside one that says less: "valve" with "fill".
  const ColumnRead& other = valves[1].column();
  recording.table.questions.push_back(
      {"column",
       other.key,
       Quoted(valves[0].column().key) + " and " + Quoted(other.key) +
           " both say what the valve does: which one counts? An empty answer leaves a column out",
       {""}});
}

}  // namespace plenum::api
