#include "server/render/text/text_diagnosis.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include "server/render/text/text_remarks.h"
#include "server/render/text/text_table.h"

namespace plenum::server {
namespace {

using api::Json;
using Align = Table::Align;

std::string WholePercent(const Json& share) {
  return share.is_number() ? fmt::format("{:.0f} %", 100.0 * share.get<double>()) : "–";
}

std::string ErrorsTable(const Json& answer) {
  Table table({{"error", Align::kLeft}, {"RMS kPa"}, {"RMS %"}, {"peak kPa"}, {"held out kPa"}}, 2);
  static constexpr std::pair<const char*, const char*> kRows[] = {
      {"declared", "as declared"},
      {"before", "base model, refitted"},
      {"after", "with effects"},
      {"learned", "with a learned term"}};
  for (const auto& [field, title] : kRows) {
    const Json error = answer.value(field, Json());
    if (error.is_null()) continue;
    table.Add({title, Short(error.at("rms_kpa")), Short(error.at("rms_percent")),
               Short(error.at("peak_kpa")), Short(error.at("holdout_rms_kpa"))});
  }
  return table.Text() +
         fmt::format("  noise of the readings {} kPa; percentages of the operating pressure\n\n",
                     Short(answer.at("noise_kpa")));
}

void AddEstimate(Table& table, std::string of, const std::string& parameter, const Json& estimate) {
  const auto [name, unit] = Spoken(parameter);
  const Json& interval = estimate.at("ci95");
  table.Add({std::move(of), name, Short(estimate.at("value")),
             Short(interval[0]) + " to " + Short(interval[1]), unit,
             estimate.at("identified") == true ? "" : "not fixed by the data"});
}

std::string EstimatesTable(const Json& answer) {
  Table table({{"effect", Align::kLeft},
               {"parameter", Align::kLeft},
               {"value"},
               {"95 % interval"},
               {"unit", Align::kLeft},
               {"", Align::kLeft}},
              2);
  bool any = false;
  for (const Json& effect : answer.at("effects")) {
    std::string of = effect.at("id");
    if (const Json chamber = effect.value("chamber", Json()); chamber.is_string())
      of += "[" + chamber.get<std::string>() + "]";
    for (const auto& [name, value] : effect.at("parameters").items()) {
      if (!value.is_object()) continue;
      AddEstimate(table, std::exchange(of, ""), name, value);
      any = true;
    }
  }
  std::string of = "declared";
  for (const auto& [name, value] : answer.at("fitted").items()) {
    if (value.contains("specimen")) continue;  // in the table of the specimens
    const std::string unit = value.at("unit");
    AddEstimate(table, std::exchange(of, ""), WithUnit(name, unit), value);
    any = true;
  }
  return any ? table.Text() + "\n" : "";
}

// What each piece of the actuator has of its own.
std::string SpecimensTable(const Json& answer) {
  const std::vector<std::vector<std::string>> rows = SpecimenRows(answer);
  if (rows.empty()) return "";
  Table table({{"specimen", Align::kLeft},
               {"runs", Align::kLeft},
               {"number", Align::kLeft},
               {"value"},
               {"95 % interval"},
               {"unit", Align::kLeft}},
              2);
  for (const std::vector<std::string>& row : rows) table.Add(row);
  const std::string spread = SpreadInWords(answer);
  return table.Text() + (spread.empty() ? "" : "  " + spread + "\n") + "\n";
}

// What was found, as sentences.
std::string FoundText(const Json& answer) {
  std::string text;
  for (const char* field : {"numbers", "effects"})
    for (const Json& found : answer.value(field, Json::array()))
      if (const std::string words = found.value("words", ""); !words.empty())
        text += "  - " + words + "\n";
  return text.empty() ? text : text + "\n";
}

std::string NumbersTable(const Json& answer) {
  const Json numbers = answer.value("numbers", Json::array());
  if (numbers.empty()) return "";
  Table table({{"wrong number", Align::kLeft},
               {"declared"},
               {"fitted"},
               {"unit", Align::kLeft},
               {"deviation in σ"},
               {"instead of", Align::kLeft}},
              2);
  for (const Json& number : numbers) {
    const auto [name, spoken] = WrongNumberSpoken(number);
    table.Add({name, Short(number.at("declared")), Short(number.at("fitted")), spoken,
               Short(number.at("deviation_sigma")),
               EffectsText(number.at("instead_of"), Json::object())});
  }
  return table.Text() + "\n";
}

std::string StabilityTable(const Json& answer) {
  const Json stability = answer.value("stability", Json::array());
  if (stability.empty()) return "";
  Table table({{"names under a change", Align::kLeft}, {"best other set, ΔBIC"}, {"hold"}}, 2);
  for (const Json& change : stability)
    table.Add({change.at("change").get<std::string>(), Short(change.at("delta_bic")),
               change.at("holds") == true ? "yes" : "no"});
  return table.Text() + "\n";
}

// Why a set is not named though it fits better than what is.
std::string NotNamed(const Json& candidate) {
  const Json reason = candidate.value("reason", Json());
  return reason.is_string() ? reason.get<std::string>() : "";
}

std::string CandidatesTable(const Json& answer) {
  const Json& candidates = answer.at("candidates");
  if (candidates.empty()) return "";
  constexpr std::size_t kShown = 12;
  Table table({{"candidate", Align::kLeft},
               {"ΔBIC"},
               {"RMS kPa"},
               {"held out kPa"},
               {"numbers"},
               {"found again"},
               {"", Align::kLeft}},
              2);
  for (std::size_t i = 0; i < std::min(kShown, candidates.size()); ++i) {
    const Json& candidate = candidates[i];
    table.Add({EffectsText(candidate.at("effects"), candidate.at("laws")),
               Short(candidate.at("delta_bic")), Short(candidate.at("rms_kpa")),
               Short(candidate.at("holdout_rms_kpa")), candidate.at("parameters").dump(),
               candidate.at("found_again").dump() + " of " + candidate.at("starts").dump(),
               candidate.at("converged") == true ? NotNamed(candidate) : "did not converge"});
  }
  std::string text = table.Text();
  if (candidates.size() > kShown)
    text += fmt::format("  and {} more\n", candidates.size() - kShown);
  return text + "\n";
}

// What to say to settle a record that looks as if it held a slip of the pen.
std::string SlipsText(const Json& answer) {
  std::string text;
  for (const Json& slip : answer.value("slips", Json::array()))
    text +=
        fmt::format("If so, run it again with --assume {}\n", slip.at("assume").get<std::string>());
  return text.empty() ? text : text + "and if all is as written with --assume as_written\n\n";
}

// What was fitted to runs that are held out.
std::string HeldOutText(const Json& answer) {
  std::string text;
  for (const Json& run : answer.value("held_out_fitted", Json::array())) {
    std::string numbers;
    for (const Json& number : run.at("numbers"))
      numbers += (numbers.empty() ? "" : ", ") + number.get<std::string>();
    text += fmt::format("  fitted to {}, though it is held out: {}\n",
                        run.at("run").get<std::string>(), numbers);
  }
  return text.empty() ? text : text + "\n";
}

// The sets of a tie, each with what it says.
std::string TiedText(const Json& answer) {
  const Json& tied = answer.at("tied");
  const Json sets = answer.value("tied_sets", Json::array());
  if (tied.empty()) return "";
  std::string text = "As good as each other:\n";
  for (std::size_t i = 0; i < tied.size(); ++i) {
    text += "  " + EffectsText(tied[i], answer.at("tied_laws")[i]);
    std::string words;
    for (const char* causes : {"effects", "numbers"})
      for (const Json& cause : i < sets.size() ? sets[i].at(causes) : Json::array())
        words += (words.empty() ? ": " : "; ") + cause.at("words").get<std::string>();
    text += words + "\n";
  }
  return text + "\n";
}

std::string TieText(const Json& answer) {
  std::string text = TiedText(answer);
  const Json& next = answer.at("next_experiment");
  if (const Json reason = answer.value("reason", Json()); next.is_null() && reason.is_string())
    return text + fmt::format("No next run: {}.\n\n", reason.get<std::string>());
  if (next.is_null()) return text;
  text += fmt::format("Next run: {}\n", next.at("why").get<std::string>());
  std::string valve;
  for (const Json& command : next.at("valve"))
    valve += fmt::format("{}{} at {} s", valve.empty() ? "" : ", ",
                         command.at("state").get<std::string>(), Short(command.at("t_s")));
  text += "  valve: " + valve + "\n";
  if (next.contains("source_pressure_kpa_gauge"))
    text += fmt::format("  source {} kPa gauge, actuator {}\n",
                        Short(next.at("source_pressure_kpa_gauge")),
                        next.at("blocked") == true ? "blocked" : "free");
  std::string channels;
  for (const Json& channel : next.at("measure")) {
    const auto [name, unit] = Spoken(channel);
    channels += (channels.empty() ? "" : ", ") + name;
  }
  return text + "  measure: " + channels + "\n\n";
}

std::string DiscrepancyText(const Json& answer) {
  const Json& discrepancy = answer.at("discrepancy");
  if (discrepancy.is_null()) return "";
  std::string text = fmt::format("What is left ({} of the residual's variance above the noise)",
                                 WholePercent(answer.at("unexplained_fraction")));
  text += fmt::format(" lies in the equation of the {}\n",
                      discrepancy.at("equation").get<std::string>());
  for (const Json& place : discrepancy.at("places"))
    text += fmt::format("  {}: {}, {} of it\n", place.at("axis").get<std::string>(),
                        place.at("where").get<std::string>(), WholePercent(place.at("share")));
  text += fmt::format(
      "  a learned term takes the error from {} to {} kPa, held out from {} to {}\n\n",
      Short(discrepancy.at("rms_before_kpa")), Short(discrepancy.at("rms_after_kpa")),
      Short(discrepancy.at("holdout_before_kpa")), Short(discrepancy.at("holdout_after_kpa")));
  return text;
}

std::string ResidualText(const Json& answer) {
  const Json& residual = answer.at("residual");
  std::string text = fmt::format(
      "Residual: white {} ({} of {}), independent of the inputs {} ({} of {}), variance over noise "
      "{} "
      "of {}\n",
      PassedText(residual.at("white")), Short(residual.at("portmanteau")),
      Short(residual.at("portmanteau_limit")), PassedText(residual.at("independent_of_inputs")),
      Short(residual.at("cross")), Short(residual.at("cross_limit")),
      Short(residual.at("lack_of_fit")), Short(residual.at("lack_of_fit_limit")));
  const Json& phases = residual.at("phases");
  if (phases.empty()) return text + "\n";
  constexpr std::size_t kShown = 24;
  Table table({{"run", Align::kLeft},
               {"phase", Align::kLeft},
               {"cycle"},
               {"from s"},
               {"mean kPa"},
               {"RMS kPa"},
               {"trend kPa/s"}},
              2);
  for (std::size_t i = 0; i < std::min(kShown, phases.size()); ++i) {
    const Json& phase = phases[i];
    table.Add({phase.at("run").get<std::string>(), phase.at("phase").get<std::string>(),
               phase.at("cycle").dump(), Short(phase.at("start_s")), Short(phase.at("mean_kpa")),
               Short(phase.at("rms_kpa")), Short(phase.at("trend_kpa_per_s"))});
  }
  text += table.Text();
  if (phases.size() > kShown) text += fmt::format("  and {} more\n", phases.size() - kShown);
  return text + "\n";
}

}  // namespace

std::string PassedText(const Json& passed) {
  return passed.is_null() ? "not tested" : passed == true ? "yes" : "no";
}

std::string WithUnit(std::string name, const std::string& unit) {
  if (unit != "1") (name += '_') += unit;
  return name;
}

std::vector<std::vector<std::string>> SpecimenRows(const Json& answer) {
  std::vector<std::vector<std::string>> rows;
  for (const Json& specimen : answer.value("specimens", Json::array())) {
    const Json& name = specimen.at("name");
    std::string shown = name.is_string() ? name.get<std::string>() : "without a name", runs;
    for (const Json& run : specimen.at("runs"))
      runs += (runs.empty() ? "" : ", ") + run.get<std::string>();
    if (specimen.at("fitted").empty()) rows.push_back({shown, runs, "none fitted", "", "", ""});
    for (const auto& [number, value] : specimen.at("fitted").items()) {
      const auto [spoken, unit] = Spoken(WithUnit(number, value.at("unit").get<std::string>()));
      const Json& interval = value.at("ci95");
      rows.push_back({std::exchange(shown, ""), std::exchange(runs, ""), spoken,
                      Short(value.at("value")), Short(interval[0]) + " to " + Short(interval[1]),
                      unit});
    }
  }
  return rows;
}

NameAndUnit WrongNumberSpoken(const Json& number) {
  NameAndUnit spoken =
      Spoken(WithUnit(number.at("name").get<std::string>(), number.at("unit").get<std::string>()));
  for (const char* piece : {"specimen", "chamber"})
    if (const Json name = number.value(piece, Json()); name.is_string())
      spoken.name += " of " + name.get<std::string>();
  return spoken;
}

std::string SpreadInWords(const Json& answer) {
  std::string text;
  const Json spread = answer.value("specimen_spread", Json::object());
  for (const auto& [number, share] : spread.items())
    text += fmt::format("{}{} {:.2g} %", text.empty() ? "" : ", ", Spoken(number).name,
                        100.0 * share.get<double>());
  return text.empty() ? text : "standard deviation between the specimens: " + text;
}

NameAndUnit Spoken(const std::string& parameter) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 15> kUnits = {{
      {"_dm3_per_s_bar", "dm³/(s·bar)"},
      {"_l_per_min_bar", "l/(min·bar)"},
      {"_l_per_min_anr", "l/min ANR"},
      {"_l_per_min", "l/min"},
      {"_rad_per_s", "rad/s"},
      {"_pa2_s2_per_kg2", "Pa²·s²/kg²"},
      {"_pa2_s_per_kg", "Pa²·s/kg"},
      {"_kpa_gauge", "kPa gauge"},
      {"_kpa", "kPa"},
      {"_ml", "ml"},
      {"_mm", "mm"},
      {"_hz", "Hz"},
      {"_m", "m"},
      {"_k", "K"},
      {"_s", "s"},
  }};
  NameAndUnit spoken{parameter, ""};
  for (const auto& [ending, unit] : kUnits) {
    if (!parameter.ends_with(ending)) continue;
    spoken = {parameter.substr(0, parameter.size() - ending.size()), std::string(unit)};
    break;
  }
  std::replace(spoken.name.begin(), spoken.name.end(), '_', ' ');
  return spoken;
}

std::string EffectsText(const Json& effects, const Json& laws) {
  std::string text;
  for (const Json& effect : effects) {
    std::string name = effect.get<std::string>();
    const std::string law = laws.is_object() ? laws.value(name, "") : "";
    std::replace(name.begin(), name.end(), '_', ' ');
    if (constexpr std::string_view kNumber = "number:"; name.starts_with(kNumber))
      name = "another " + name.substr(kNumber.size());
    text += (text.empty() ? "" : " + ") + name + (law.empty() ? "" : " (" + law + ")");
  }
  return text.empty() ? "none" : text;
}

std::string VerdictText(const Json& answer) {
  std::string sentence = answer.at("sentence");
  if (!sentence.empty()) return sentence;
  return "Verdict: " + answer.at("verdict").get<std::string>() + ".";
}

std::string DiagnosisText(const Json& answer) {
  std::string text = VerdictText(answer) + "\n\n" + SlipsText(answer) + FoundText(answer) +
                     ErrorsTable(answer) + HeldOutText(answer) + NumbersTable(answer) +
                     EstimatesTable(answer) + SpecimensTable(answer) + TieText(answer) +
                     CandidatesTable(answer) + StabilityTable(answer) + DiscrepancyText(answer) +
                     ResidualText(answer);
  for (const Json& warning : answer.at("warnings"))
    text += "note: " + warning.get<std::string>() + "\n";
  return text + RemarksText(answer);
}

}  // namespace plenum::server
