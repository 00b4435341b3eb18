#include "server/render/text/text_design.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "server/render/text/text_explain.h"
#include "server/render/text/text_guarantee.h"
#include "server/render/text/text_ranked.h"
#include "server/render/text/text_remarks.h"
#include "server/render/text/text_table.h"

namespace plenum::server {
namespace {

using api::Json;
using Align = Table::Align;

std::string PartsTable(const Json& design) {
  Table table({{"family", Align::kLeft},
               {"part", Align::kLeft},
               {"for", Align::kLeft},
               {"quantity"},
               {"mass kg"}},
              2);
  for (const auto& part : design.at("parts")) {
    const auto name = part.at("manufacturer").get<std::string>() + " " +
                      part.at("part_number").get<std::string>();
    table.Add({part.at("family").get<std::string>(), Cut(name, 48),
               part.at("group").is_string() ? part.at("group").get<std::string>() : "all",
               Times(part), fmt::format("{:.4f}", part.at("mass_kg").get<double>())});
  }
  return table.Text();
}

std::string SettingsText(const Json& design) {
  const auto& settings = design.at("settings");
  std::string text = fmt::format("  Settings: source {} kPa gauge",
                                 Short(settings.at("source_pressure_kpa_gauge")));
  if (const Json groups = settings.value("group_pressure_kpa_gauge", Json()); groups.is_array()) {
    text = "  Settings: regulators";
    for (std::size_t g = 0; g < groups.size(); ++g)
      text += fmt::format("{} {} {}", g == 0 ? "" : ",",
                          design.at("performance").at("groups").at(g).at("name").get<std::string>(),
                          Short(groups[g]));
    text += " kPa gauge";
  }
  // Beside a pressure; of evacuated actuators it is the source.
  if (const Json vacuum = settings.value("vacuum_kpa_gauge", Json());
      vacuum.is_number() && vacuum != settings.at("source_pressure_kpa_gauge"))
    text += fmt::format(", vacuum {} kPa gauge", Short(vacuum));
  if (const Json stop = settings.value("vacuum_stop_kpa_gauge", Json()); stop.is_number())
    text += fmt::format(" at the weakest (pumps stop at {}, duty {})", Short(stop),
                        Percent(settings.at("vacuum_duty")));
  text += ", valve duty " + Percent(settings.at("valve_duty"));
  if (settings.at("compressor_duty").is_number()) {
    text += ", compressor duty " + Percent(settings.at("compressor_duty"));
  }
  if (settings.at("reservoir_volume_ml").is_number()) {
    text += fmt::format(", reservoir {} mL", Short(settings.at("reservoir_volume_ml")));
  }
  if (const Json fill = settings.value("tank_fill_kpa_gauge", Json()); fill.is_number()) {
    text += fmt::format(" filled to {} kPa gauge", Short(fill));
  }
  if (const Json stop = settings.value("pump_stop_kpa_gauge", Json()); stop.is_number()) {
    text += fmt::format(", the pump runs below {}", Short(stop));
  }
  if (const Json power = settings.value("power", Json()); power.is_object()) {
    text += fmt::format("\n  Power: from the {}", power.at("kind").get<std::string>());
    if (power.at("voltage_v").is_number())
      text += fmt::format(", {} V", Short(power.at("voltage_v")));
  }
  return text + "\n";
}

std::string PacksText(const Json& design) {
  std::string text;
  for (const Json& row : design.value("packs", Json::array())) {
    const double packs = row.at("packs").get<double>();
    const char* unit = row.at("unit") == "m" ? " m" : "";
    text += fmt::format("  Bought: {} {} of {}{} {}, {} €, {}{} left over\n",
                        Short(row.at("packs")), packs == 1.0 ? "pack" : "packs",
                        Short(row.at("pack")), unit, row.at("id").get<std::string>(),
                        Short(row.at("cost_eur")), Short(row.at("left_over")), unit);
  }
  return text;
}

std::string TotalsText(const Json& design) {
  const auto& totals = design.at("totals");
  const auto& performance = design.at("performance");
  const Json air = performance.value("compressed_air_l_per_min_anr", Json());
  std::string text = fmt::format(
      "  Totals: mass {:.3f} kg, volume {} L, cost {} €, energy {} Wh\n"
      "  Air: {} L (ANR) per stroke of one actuator, {} L in all; runs {} s, sustains {} Hz\n",
      totals.at("mass_kg").get<double>(), Short(totals.at("volume_l")), CostText(totals),
      Short(totals.at("energy_wh")), Short(performance.at("air_per_actuation_l_anr")),
      Short(performance.at("air_total_l_anr")), Short(performance.at("run_time_s")),
      Short(performance.at("frequency_hz_sustained")));
  if (air.is_number())
    text += fmt::format("  Compressed air: {} L/min (ANR) all the while\n", Short(air));
  return text;
}

std::string MarginsTable(const Json& design) {
  const Json* tightest = Tightest(design);
  Table table(
      {{"requirement", Align::kLeft}, {"required"}, {"achieved"}, {"margin"}, {"", Align::kLeft}},
      2);
  for (const auto& margin : design.at("margins")) {
    table.Add({margin.at("requirement").get<std::string>(), Short(margin.at("required")),
               Short(margin.at("achieved")), Percent(margin.at("relative_margin")),
               &margin != tightest    ? ""
               : margin.at("binding") ? "← binding"
                                      : "← tightest"});
  }
  return table.Text();
}

// Parts that stand for a class and are no product that one can order.
std::string OrderText(const Json& design) {
  std::string text;
  const Json not_orderable = design.at("data_quality").value("not_orderable", Json::array());
  for (const Json& part : design.at("parts"))
    if (std::find(not_orderable.begin(), not_orderable.end(), part.at("id")) != not_orderable.end())
      text += "    " + part.at("family").get<std::string>() + ": " +
              part.at("part_number").get<std::string>() + "\n";
  return text.empty() ? text : "  Classes of parts, not products that one can order:\n" + text;
}

std::string QualityText(const Json& design) {
  const auto& estimated = design.at("data_quality").at("estimated");
  if (estimated.empty()) return "  Data: no number of these parts is an estimate.\n";
  std::string text = fmt::format("  Data: estimates carry {} of the mass; they are\n",
                                 Percent(design.at("data_quality").at("mass_share_estimated")));
  std::string family;
  for (const auto& entry : estimated) {
    const std::string name = entry;
    const auto dot = name.find('.');
    const bool same = name.substr(0, dot) == family;
    family = name.substr(0, dot);
    text += (same ? ", " : (text.back() == '\n' ? "    " : "\n    ") + family + ": ") +
            name.substr(dot + 1);
  }
  return text + "\n";
}

std::string Details(const Json& design) {
  return fmt::format("Design {} in full\n", Grouped(design.at("rank"))) + PartsTable(design) +
         "\n" + SettingsText(design) + TotalsText(design) + PacksText(design) + "\n" +
         MarginsTable(design) + "\n" + VariantsText(design) + QualityText(design) +
         OrderText(design);
}

std::string RequirementText(const Json& entry) {
  const std::string requirement = entry.at("requirement");
  return requirement == "prices" ? "prices: that all parts have one" : requirement;
}

// One entry of a conflict: what is required, and what was found to be enough.
std::string EntryText(const Json& entry) {
  std::string text = "  " + RequirementText(entry);
  if (entry.at("required").is_number()) text += ": required " + Short(entry.at("required"));
  if (entry.at("best").is_number())
    return text + fmt::format(", the catalogue reaches {} while the others hold ({} off)\n",
                              Short(entry.at("best")), Percent(entry.at("relaxation")));
  if (!entry.at("proved").get<bool>()) return text + ", not known to matter: time ran out\n";
  return text +
         (entry.at("required").is_number() ? ", nothing reached while the others hold\n" : "\n");
}

std::string RelaxationText(const Json& relaxation) {
  if (relaxation.empty()) return "";
  std::string text = "The least that makes it feasible:\n";
  for (const auto& relaxed : relaxation)
    text += fmt::format("  {}: {}\n", RequirementText(relaxed),
                        relaxed.at("value").is_number()
                            ? fmt::format("{} in place of {}", Short(relaxed.at("value")),
                                          Short(relaxed.at("required")))
                            : std::string("to be dropped"));
  return text;
}

std::string ConflictText(const Json& answer) {
  std::string text = "No combination of catalogue parts meets the requirements.\n";
  for (const auto& conflict : answer.at("conflicts")) {
    text += conflict.size() == 1 ? "This one cannot be met:\n" : "These cannot be met together:\n";
    for (const auto& entry : conflict) text += EntryText(entry);
  }
  return text + RelaxationText(answer.at("relaxation"));
}

std::string StatusText(const Json& answer) {
  const std::string status = answer.at("status");
  const auto& proof = answer.at("proof");
  if (answer.contains("front")) {
    if (status == "optimal") return "Proved: no other combination belongs to the front.";
    if (status != "infeasible") return "Not proved: the front may lack points.";
  }
  const std::string guaranteed = answer.contains("guarantee") ? "guaranteed " : "";
  if (status == "optimal" && answer.value("list", "") == "kinds")
    return "Proved: no kind of " + guaranteed +
           "design that is not shown beats the last one, but for further kinds with a source that "
           "is shown.";
  if (status == "optimal") {
    return "Proved: no other combination of catalogue parts beats the last design shown.";
  }
  if (status == "infeasible") return "Proved: every combination was ruled out.";
  const std::string reason = status == "cancelled" ? "Stopped on request" : "Not proved";
  if (answer.at("designs").empty()) return reason + ": no design found so far.";
  const Json proved = proof.value("proved_designs", Json(0));
  const std::string first = proved == 0   ? ""
                            : proved == 1 ? " The first is proved."
                                          : " The first " + Grouped(proved) + " are proved.";
  return reason +
         fmt::format(": a design not listed may reach {}, {} below the last one shown.",
                     Short(proof.at("lower_bound")), Percent(proof.at("gap"))) +
         first;
}

std::string_view WhyLeftOut(std::string_view reason) {
  static constexpr std::pair<std::string_view, std::string_view> kWords[] = {
      {"exclude", "excluded"},
      {"require", "beside those required"},
      {"orderable", "that cannot be ordered"},
      {"vacuum", "not rated for vacuum"},
      {"holding", "that cannot close both ways"},
      {"prices", "without a price"}};
  for (const auto& [name, words] : kWords)
    if (name == reason) return words;
  return reason;
}

// "Parts left out of the catalogue: 3 excluded, 40 without a price.": the proof speaks of the
// others.
std::string LeftOutText(const Json& answer) {
  std::string text;
  const Json left_out = answer.value("left_out", Json::object());
  for (const auto& [why, what] : left_out.items()) {
    std::size_t parts = what.is_array() ? what.size() : 0;
    if (what.is_object())
      for (const auto& [family, count] : what.items()) parts += count.get<std::size_t>();
    text += fmt::format("{}{} {}", text.empty() ? "Parts left out of the catalogue: " : ", ",
                        Grouped(parts), WhyLeftOut(why));
  }
  return text.empty() ? text : text + ".\n";
}

std::string ProofText(const Json& answer) {
  const auto& proof = answer.at("proof");
  std::string pruned;
  for (const auto& [reason, count] : proof.at("pruned").items()) {
    if (count == "0") continue;
    pruned += fmt::format("{}{} {}", pruned.empty() ? "" : ", ", reason, Grouped(count));
  }
  std::string text = fmt::format("{}\n{} combinations: {} evaluated ({} simulated); pruned: {}.\n",
                                 StatusText(answer), Grouped(proof.at("combinations")),
                                 Grouped(proof.at("evaluated")), Grouped(proof.at("simulated")),
                                 pruned.empty() ? "none" : pruned);
  if (proof.at("undecided") != 0) {
    text += Grouped(proof.at("undecided")) + " could be neither sized nor ruled out.\n";
  }
  return text + LeftOutText(answer) + fmt::format("{:.2f} s\n", answer.at("seconds").get<double>());
}

std::string HintsText(const Json& answer) {
  std::string text;
  for (const auto& hint : answer.value("hints", Json::array()))
    text += "Hint: " + hint.at("words").get<std::string>() + ".\n";
  return text;
}

}  // namespace

std::string DesignText(const Json& answer, bool wide) {
  const auto& designs = answer.at("designs");
  std::string text;
  if (answer.contains("name")) text += answer.at("name").get<std::string>() + "\n\n";
  if (answer.at("status") == "infeasible") {
    text += ConflictText(answer) + "\n";
  } else if (!designs.empty()) {
    text += QualityLine(answer) + (wide ? WideTable(designs) : RankedTable(answer));
    text += "est.: share of the mass that is estimated; “~” marks estimated flow data";
    const auto& best = answer.at("best_on_measured_flow");
    text += best.is_number()
                ? fmt::format("; best without estimated flow data: design {}.\n\n", Grouped(best))
                : std::string(".\n\n");
    text += BestsText(answer) + Details(designs.front()) + "\n";
  }
  text += GuaranteeText(answer) + FrontText(answer) + RobustText(answer) + PricesText(answer) +
          FlipsText(answer);
  return text + ProofText(answer) + HintsText(answer) + RemarksText(answer);
}

std::string WhyNotFirstText(const Json& answer) {
  if (!answer.contains("why_not_first")) return "";
  if (answer.at("why_not_first").is_null())
    return "\nWhy it is not first is not known: time ran out.\n";
  std::string text = "\nBeside the first of the list:\n";
  for (const auto& sentence : answer.at("why_not_first").at("words"))
    text += "  " + sentence.get<std::string>() + "\n";
  return text;
}

std::string EvaluationText(const Json& answer) {
  const auto& range = answer.at("source_pressure_range_kpa_gauge");
  if (range.is_null()) {
    return "It does not work: at no source pressure that the parts stand does every stroke end "
           "within half of the period.\n" +
           WhyNotFirstText(answer) + RemarksText(answer);
  }
  std::string text = fmt::format("The parts stand source pressures from {} to {} kPa gauge.\n",
                                 Short(range[0]), Short(range[1]));
  if (answer.at("works").is_null())
    text += "It is not known whether it works: " + answer.at("detail").get<std::string>() + ".\n";
  else if (answer.at("works").get<bool>())
    text += SettingsText(answer) + TotalsText(answer) + "\n" + MarginsTable(answer);
  else
    text +=
        "It does not work: the source pressure is none of these, or a stroke does not "
        "end within half of the period.\n";
  return text + WhyNotFirstText(answer) + RemarksText(answer);
}

std::string ProgressText(const optimizer::Progress& progress) {
  if (progress.infeasible)
    return fmt::format("{:.0f} s  infeasible, proved; looking for the reasons", progress.seconds);
  return fmt::format("{:.0f} s  {} evaluated  {} boxes open  best {}  bound {}", progress.seconds,
                     progress.evaluated, progress.open, progress.best ? Short(*progress.best) : "–",
                     Short(progress.lower_bound));
}

}  // namespace plenum::server
