#include "server/commands/init/interview.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <istream>

#include "api/json/problem_document.h"
#include "server/commands/exit_status.h"

namespace plenum::server {
namespace {

using api::Json;

constexpr char kDocumentNote[] =
    "Requirements of plenum design. Pressures that end in _gauge count from the ambient pressure. "
    "A number may also be a text with its unit: \"15 psi\", \"200 ms\". Notes are remarks, nothing "
    "more. All fields: docs/reference/input.md and requests.md.";
constexpr char kGroupNote[] =
    "Actuators that are alike and switch together. expansion_ratio is the volume at the operating "
    "pressure over rest_volume_ml (1: rigid). The rise time ends at 95 % of the operating "
    "pressure, the fall time at 5 %. For another kind of actuator add a second group to the list.";
constexpr char kDutyNote[] =
    "All actuators inflate and deflate once a cycle. The supply must last for so many cycles "
    "without refill or recharge. simultaneous false: the groups take turns.";
constexpr char kSupplyNote[] =
    "Sources that may be chosen: cylinder (compressed air), co2, compressor (pump, reservoir and "
    "battery), mains (wall supply), tank (filled beforehand), direct_pump (no reservoir). May also "
    "hold source_pressure_kpa_gauge_max, mass_kg_max, volume_l_max, cost_eur_max.";
constexpr char kEvacuatedNote[] =
    "Actuators below ambient are evacuated: to rise is to evacuate, to fall is to let air in. "
    "Their supply is one of vacuum. May also hold mass_kg_max, volume_l_max, cost_eur_max.";
constexpr char kVacuumNote[] =
    "Sources that may be chosen: pump (with reservoir and battery, or straight to the lines), "
    "ejector (needs mains beside vacuum in supply). May also hold vacuum_kpa_gauge_min, the "
    "deepest vacuum of a reservoir.";
constexpr char kMainsNote[] = "Pressure and flow of the wall supply.";
constexpr double kDefaultExpansion = 2.0, kDefaultVacuumKpa = -50.0;
constexpr char kObjectiveNote[] = "mass_kg, volume_l, cost_eur or energy_wh.";
constexpr char kRankingNote[] = "Designs in the list, and seconds for the search.";

Json NewGroup(const std::string& name) {
  return {{"note", kGroupNote},
          {"name", name},
          {"count", 4},
          {"rest_volume_ml", 50.0},
          {"expansion_ratio", kDefaultExpansion},
          {"operating_pressure_kpa_gauge", 100.0},
          {"tube_length_m", 0.5},
          {"fittings_per_line", 2},
          {"rise_time_s_max", 0.5},
          {"fall_time_s_max", 0.6}};
}

Json NewDocument() {
  return {
      {"schema", "requirements/1"},
      {"note", kDocumentNote},
      {"name", "my robot"},
      {"actuators", Json::array({NewGroup("actuator")})},
      {"duty",
       {{"note", kDutyNote}, {"frequency_hz", 0.1}, {"actuations", 1000}, {"simultaneous", true}}},
      {"supply", {{"note", kSupplyNote}, {"configurations", {"cylinder", "co2", "compressor"}}}},
      {"objective", {{"note", kObjectiveNote}, {"minimize", "mass_kg"}}},
      {"ranking", {{"note", kRankingNote}, {"count", 10}, {"time_limit_s", 30.0}}}};
}

std::vector<std::string> Divided(const std::string& line) {
  std::vector<std::string> words;
  std::string word;
  for (const char c : line + " ") {
    if (c != ' ' && c != ',' && c != '\t')
      word += c;
    else if (!word.empty())
      words.push_back(std::exchange(word, ""));
  }
  return words;
}

std::string Stripped(const std::string& line) {
  constexpr char kBlanks[] = " \t\r";
  const auto first = line.find_first_not_of(kBlanks);
  return first == std::string::npos
             ? ""
             : line.substr(first, line.find_last_not_of(kBlanks) - first + 1);
}

// A number as it is; a text without a unit gets that of the question ("0,5" s), so that a decimal
// comma is understood.
Json ReadNumber(const std::string& line, const std::string& unit) {
  double value = 0.0;
  const char* end = line.data() + line.size();
  const auto read = std::from_chars(line.data(), end, value);
  if (read.ec == std::errc() && read.ptr == end) {
    if (value == static_cast<double>(static_cast<long long>(value)) && unit.empty())
      return static_cast<long long>(value);
    return value;
  }
  const bool bare = line.find_first_not_of("0123456789.,+- ") == std::string::npos;
  return bare && !unit.empty() ? line + " " + unit : line;
}

// What the answer is for a field that holds `before`.
Json ReadAnswer(const std::string& line, const std::string& unit, const Json& before) {
  if (before.is_array()) return Divided(line);
  if (before.is_string()) return line;
  if (!before.is_boolean()) return ReadNumber(line, unit);
  for (const char* yes : {"y", "yes", "true"})
    if (line == yes) return true;
  for (const char* no : {"n", "no", "false"})
    if (line == no) return false;
  return line;
}

std::string ShownBefore(const Json& value) {
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_array()) return value.dump();
  std::string words;
  for (const Json& word : value) words += (words.empty() ? "" : ", ") + word.get<std::string>();
  return words;
}

// Below ambient, as a number or a text.
bool IsEvacuated(const Json& group) {
  const Json& pressure = group.at("operating_pressure_kpa_gauge");
  if (pressure.is_string()) return pressure.get_ref<const std::string&>().starts_with('-');
  return pressure.is_number() && pressure.get<double>() < 0.0;
}

bool Evacuates(const Json& document) { return IsEvacuated(document.at("actuators").at(0)); }

// A wall supply is described where a source that may be chosen needs it, and only there.
void CompleteMains(Json& supply, const Json& sources, const char* needs) {
  if (std::find(sources.begin(), sources.end(), needs) == sources.end())
    supply.erase("mains");
  else if (!supply.contains("mains"))
    supply["mains"] = {
        {"note", kMainsNote}, {"pressure_kpa_gauge", 600.0}, {"flow_l_per_min_anr_max", 200.0}};
}

// Of evacuated actuators the first says that the supply is one of vacuum; a volume that was to grow
// is rigid until it is asked for.
void CompleteVacuum(Json& document) {
  for (Json& group : document["actuators"])
    if (IsEvacuated(group) && group["expansion_ratio"] == kDefaultExpansion)
      group["expansion_ratio"] = 1.0;
  Json& supply = document["supply"];
  if (!supply.contains("vacuum"))
    supply = {{"note", kEvacuatedNote},
              {"vacuum", {{"note", kVacuumNote}, {"configurations", {"pump"}}}}};
  CompleteMains(supply, supply["vacuum"]["configurations"], "ejector");
}

void CompleteSupply(Json& document) {
  if (Evacuates(document)) return CompleteVacuum(document);
  CompleteMains(document["supply"], document["supply"]["configurations"], "mains");
}

// A name that no group has yet.
std::string FreeName(const Json& groups) {
  for (std::size_t number = groups.size() + 1;; ++number) {
    std::string name = "actuator_" + std::to_string(number);
    if (std::none_of(groups.begin(), groups.end(),
                     [&](const Json& group) { return group.at("name") == name; }))
      return name;
  }
}

class Asking {
 public:
  explicit Asking(Interview& interview) : interview_(interview) {}

  // Puts the answer into the document, which is sound before and after.
  void Ask(const std::string& pointer, const std::string& text, const std::string& unit = "") {
    const Json::json_pointer place(pointer);
    const Json before = document_.at(place);
    const std::string shown = unit.empty() ? text : text + " in " + unit;
    for (;;) {
      interview_.say(shown + " [" + ShownBefore(before) + "]: ");
      const std::string line = NextLine();
      if (line.empty()) return;
      Json changed = document_;
      changed[place] = ReadAnswer(line, unit, before);
      CompleteSupply(changed);
      const Opinion opinion = interview_.judge(changed);
      if (opinion.errors.empty()) {
        if (opinion.warnings != warned_) interview_.say(opinion.warnings);
        warned_ = opinion.warnings;
        document_ = std::move(changed);
        return;
      }
      if (!interview_.person)
        throw BadInput(fmt::format("answer {} to \"{}\":\n{}", line, shown, Lines(opinion.errors)));
      for (const api::Error& error : opinion.errors) interview_.say("  " + error.detail + "\n");
    }
  }

  bool Agrees(const std::string& text) {
    for (;;) {
      interview_.say(text + " [no]: ");
      const std::string line = NextLine();
      if (line == "y" || line == "yes") return true;
      if (line.empty() || line == "n" || line == "no") return false;
      const std::string wanted = fmt::format("{}: yes or no is asked here", line);
      if (!interview_.person) throw BadInput(fmt::format("answer to \"{}\": {}", text, wanted));
      interview_.say("  " + wanted + "\n");
    }
  }

  void AddGroup() {
    Json& groups = document_["actuators"];
    groups.push_back(NewGroup(FreeName(groups)));
    if (!Evacuates(document_)) return;
    groups.back()["operating_pressure_kpa_gauge"] = kDefaultVacuumKpa;
    groups.back()["expansion_ratio"] = 1.0;
  }

  const Json& document() const { return document_; }

 private:
  // Empty where no answer is left.
  std::string NextLine() {
    std::string line;
    if (!std::getline(interview_.answers, line)) interview_.say("\n");
    return Stripped(line);
  }

  Interview& interview_;
  Json document_ = NewDocument();
  std::string warned_;  // the last warnings, which are not repeated
};

void AskGroup(Asking& asking, std::size_t index) {
  const std::string group = "/actuators/" + std::to_string(index) + "/";
  asking.Ask(group + "name", "Name of the actuators");
  asking.Ask(group + "count", "How many of them");
  asking.Ask(group + "rest_volume_ml", "Volume of one without pressure", "mL");
  asking.Ask(group + "expansion_ratio", "Volume at the operating pressure over that volume");
  const bool grows =
      asking.document().at("actuators").at(index).at("expansion_ratio") == kDefaultExpansion;
  asking.Ask(group + "operating_pressure_kpa_gauge",
             "Operating pressure, gauge (below 0: evacuated)", "kPa");
  if (grows && IsEvacuated(asking.document().at("actuators").at(index)))
    asking.Ask(group + "expansion_ratio", "Volume when evacuated over that volume, at most 1");
  asking.Ask(group + "tube_length_m", "Length of the tube to each", "m");
  asking.Ask(group + "rise_time_s_max", "Longest time to fill to 95 %", "s");
  asking.Ask(group + "fall_time_s_max", "Longest time to vent to 5 %", "s");
}

}  // namespace

Json AskRequirements(Interview& interview) {
  constexpr std::size_t kGroupsMost = 8;
  Asking asking(interview);
  asking.Ask("/name", "Name of the robot");
  AskGroup(asking, 0);
  std::size_t groups = 1;
  while (groups < kGroupsMost && asking.Agrees("Other actuators, too")) {
    asking.AddGroup();
    AskGroup(asking, groups++);
  }
  if (groups > 1) asking.Ask("/duty/simultaneous", "All groups at once");
  asking.Ask("/duty/frequency_hz", "Cycles a second", "Hz");
  asking.Ask("/duty/actuations", "Cycles without refill or recharge");
  if (Evacuates(asking.document()))
    asking.Ask("/supply/vacuum/configurations", "Sources of vacuum, of pump, ejector");
  else
    asking.Ask("/supply/configurations",
               "Sources, of cylinder, co2, compressor, mains, tank, direct_pump");
  if (asking.document().at("supply").contains("mains")) {
    asking.Ask("/supply/mains/pressure_kpa_gauge", "Pressure of the wall supply, gauge", "kPa");
    asking.Ask("/supply/mains/flow_l_per_min_anr_max", "Most flow of the wall supply", "L/min");
  }
  asking.Ask("/objective/minimize", "What is to be small: mass_kg, volume_l, cost_eur, energy_wh");
  return asking.document();
}

}  // namespace plenum::server
