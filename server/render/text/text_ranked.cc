#include "server/render/text/text_ranked.h"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <string_view>
#include <vector>

#include "server/render/text/text_table.h"

namespace plenum::server {
namespace {

using api::Json;
using Align = Table::Align;

// "2× JSG BD-03AB" of the parts of these families; of equal ones of several groups one.
std::string NamesOf(const Json& design, std::initializer_list<std::string_view> families) {
  std::vector<std::string> names;
  for (const auto& part : design.at("parts")) {
    const std::string family = part.at("family");
    if (std::find(families.begin(), families.end(), family) == families.end()) continue;
    const bool counted = part.at("unit") != "m" && part.at("quantity") != 1;
    const std::string maker = part.at("manufacturer");
    const std::string name = (counted ? Times(part) + "× " : "") +
                             (maker == "generic" ? "" : maker + " ") +
                             part.at("part_number").get<std::string>();
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : " + ") + name;
  return text.empty() ? "–" : text;
}

// Pump, bottle, or reservoir that is filled beforehand.
std::string StoreOf(const Json& design) {
  return design.at("configuration") == "tank"
             ? NamesOf(design, {"reservoir"})
             : NamesOf(design, {"compressor", "vacuum_pump", "ejector", "cylinder", "co2"});
}

std::string SourceOf(const Json& design) {
  const std::string store = StoreOf(design);
  return store == "–" ? "mains, " + NamesOf(design, {"regulator"}) : store;
}

std::string TankOf(const Json& design) {
  const Json& volume = design.at("settings").at("reservoir_volume_ml");
  return volume.is_number() ? Short(volume) + " mL" : "–";
}

// "rise 4.8 %": the last word of the requirement's pointer that says what it is.
std::string TightestText(const Json& design) {
  const Json* tightest = Tightest(design);
  if (!tightest) return "–";
  std::string name = tightest->at("requirement").get<std::string>();
  name = name.substr(name.rfind('/') + 1);
  return name.substr(0, name.find('_')) + " " + Percent(tightest->at("relative_margin"));
}

std::string Estimated(const Json& design) {
  const Json& quality = design.at("data_quality");
  return fmt::format("{:.0f} %{}", 100.0 * quality.at("mass_share_estimated").get<double>(),
                     quality.at("flow_estimated").get<bool>() ? " ~" : "");
}

std::string Mass(const Json& design) {
  return fmt::format("{:.3f}", design.at("totals").at("mass_kg").get<double>());
}

bool HasChances(const Json& designs) {
  return !designs.empty() && designs.front().contains("robustness");
}

double Worst(const Json& design, const char* what) {
  double worst = 0.0;
  for (const auto& group : design.at("performance").at("groups"))
    worst = std::max(worst, group.at(what).get<double>());
  return worst;
}

bool Minimizes(const Json& answer, const char* amount) {
  const Json objective = answer.at("requirements").value("objective", Json::object());
  const Json minimize = objective.value("minimize", Json());
  return minimize == amount || (minimize.is_object() && minimize.contains(amount));
}

bool CountsCost(const Json& answer) {
  const Json limits = answer.at("requirements").value("supply", Json::object());
  return Minimizes(answer, "cost_eur") || limits.contains("cost_eur_max");
}

// What is minimised besides mass: names of columns, and the total in each.
struct Minimized {
  const char* unit;
  std::string (*text)(const Json& totals);
};
std::vector<Minimized> MinimizedOf(const Json& answer) {
  std::vector<Minimized> list;
  if (CountsCost(answer)) list.push_back({"€", CostText});
  if (Minimizes(answer, "volume_l"))
    list.push_back({"L", [](const Json& totals) { return Short(totals.at("volume_l")); }});
  if (Minimizes(answer, "energy_wh"))
    list.push_back({"Wh", [](const Json& totals) { return Short(totals.at("energy_wh")); }});
  return list;
}

std::string MarkOf(const Json& design) {
  const auto& quality = design.at("data_quality");
  std::string mark = quality.at("flow_estimated").get<bool>() ? "flow ~" : "flow ok";
  const double share = quality.at("mass_share_estimated").get<double>();
  if (share >= 0.005) mark += fmt::format(", mass ~{:.0f} %", 100.0 * share);
  return mark;
}

constexpr char kToOrder[] = "to order";

// One line: what the best of some designs is, or why there is none.
std::string BestText(const std::string& name, std::size_t width, const Json& best) {
  std::string text = fmt::format("  {:<{}}  ", name, width);
  const Json& design = best.at("design");
  if (design.is_null()) {
    text += best.at("status") == "infeasible" ? "none, proved" : "none found yet";
    for (const Json& entry : best.at("conflict"))
      text += (&entry == &best.at("conflict").front() ? ": " : ", ") +
              entry.at("requirement").get<std::string>();
    return text + "\n";
  }
  text += Mass(design) + " kg";
  if (best.at("relative_distance").is_number())
    text += fmt::format(", {:+.1f} %", 100.0 * best.at("relative_distance").get<double>());
  text += ", " + SourceAndValves(design);
  return text + (best.at("status") == "optimal" ? "\n" : " (not proved)\n");
}

}  // namespace

std::string SourceAndValves(const Json& design) {
  return Cut(SourceOf(design), 30) + ", " + Cut(NamesOf(design, {"valve"}), 30);
}

std::string Percent(const Json& share) {
  return share.is_number() ? fmt::format("{:.1f} %", 100.0 * share.get<double>()) : "–";
}

std::string Times(const Json& part) {
  const double quantity = part.at("quantity").get<double>();
  if (part.at("unit") == "m") return fmt::format("{:.2f} m", quantity);
  return fmt::format("{:.0f}", quantity);
}

// Its battery, or whose supply it is.
std::string PowerOf(const Json& design) {
  const Json power = design.at("settings").value("power", Json());
  return power.is_object() ? power.at("kind").get<std::string>() : NamesOf(design, {"battery"});
}

const Json* Tightest(const Json& design) {
  const auto& margins = design.at("margins");
  const auto least = std::min_element(margins.begin(), margins.end(), [](auto& a, auto& b) {
    return a.at("relative_margin") < b.at("relative_margin");
  });
  return least == margins.end() ? nullptr : &*least;
}

std::string RankedTable(const Json& answer) {
  const Json& designs = answer.at("designs");
  const bool chances = HasChances(designs);
  const std::vector<Minimized> minimized = MinimizedOf(answer);
  // Of 100 characters, what the columns with figures leave.
  const std::size_t narrower = (chances ? 5 : 0) + 4 * minimized.size();
  std::vector<Table::Column> columns{{"#"},
                                     {"source", Align::kLeft},
                                     {"valves", Align::kLeft},
                                     {"battery", Align::kLeft},
                                     {"tank"},
                                     {"kg"}};
  for (const Minimized& one : minimized) columns.push_back({one.unit});
  columns.push_back({"tightest", Align::kLeft});
  if (chances) columns.push_back({"chance"});
  columns.push_back({"est."});
  Table table(columns);
  for (const auto& design : designs) {
    std::vector<std::string> row{Grouped(design.at("rank")),
                                 Cut(SourceOf(design), 20 - narrower),
                                 Cut(NamesOf(design, {"valve"}), 20 - narrower),
                                 Cut(PowerOf(design), 10),
                                 TankOf(design),
                                 Mass(design)};
    for (const Minimized& one : minimized) row.push_back(one.text(design.at("totals")));
    row.push_back(Cut(TightestText(design), 15));
    if (chances) row.push_back(Percent(design.at("robustness").at("probability")));
    row.push_back(Estimated(design));
    table.Add(std::move(row));
  }
  return table.Text();
}

std::string WideTable(const Json& designs) {
  Table table({{"#"},
               {"configuration", Align::kLeft},
               {"source", Align::kLeft},
               {"valves", Align::kLeft},
               {"battery", Align::kLeft},
               {"reservoir", Align::kLeft},
               {"regulator", Align::kLeft},
               {"tubing", Align::kLeft},
               {"mass kg"},
               {"volume L"},
               {"cost €"},
               {"kPa gauge"},
               {"rise s"},
               {"fall s"},
               {"tightest", Align::kLeft},
               {"variants"},
               {"data", Align::kLeft}});
  for (const auto& design : designs) {
    const auto& totals = design.at("totals");
    const Json variants = design.value("variants", Json::object());
    table.Add({Grouped(design.at("rank")), design.at("configuration").get<std::string>(),
               StoreOf(design), NamesOf(design, {"valve"}), PowerOf(design),
               NamesOf(design, {"reservoir"}), NamesOf(design, {"regulator"}),
               NamesOf(design, {"tubing"}), Mass(design), Short(totals.at("volume_l")),
               CostText(totals), Short(design.at("settings").at("source_pressure_kpa_gauge")),
               fmt::format("{:.3f}", Worst(design, "rise_time_s")),
               fmt::format("{:.3f}", Worst(design, "fall_time_s")), TightestText(design),
               variants.contains("found") ? Grouped(variants.at("found")) : "–", MarkOf(design)});
  }
  return table.Text();
}

std::string BestsText(const Json& answer) {
  const Json list = answer.value("by_configuration", Json::array());
  std::string text;
  std::size_t width = std::size(kToOrder) + 1;
  for (const Json& best : list)
    width = std::max(width, best.at("configuration").get_ref<const std::string&>().size());
  if (list.size() > 1)
    for (const Json& best : list)
      text += BestText(best.at("configuration").get<std::string>(), width, best);
  const Json orderable = answer.value("orderable", Json());
  const bool first = orderable.is_object() && orderable.at("design").is_object() &&
                     orderable.at("design").at("rank") == 1;
  if (orderable.is_object() && !first) text += BestText(kToOrder, width, orderable);
  return text.empty()
             ? text
             : "The best of each source, and of products that one can order\n" + text + "\n";
}

std::string VariantsText(const Json& design) {
  const Json variants = design.value("variants", Json());
  if (!variants.is_object()) return "";
  if (variants.at("found") == 0)
    return variants.at("complete").get<bool>() ? "  Variants within 1 %: none, proved.\n"
                                               : "  Variants within 1 %: none found.\n";
  std::string differ;
  for (const Json& family : variants.at("differ_in"))
    differ += (differ.empty() ? "" : ", ") + family.get<std::string>();
  return fmt::format("  Variants within 1 %: {}{}, other in {}.\n",
                     variants.at("complete").get<bool>() ? "" : "at least ",
                     Grouped(variants.at("found")), differ);
}

std::string CostText(const Json& totals) {
  const Json known = totals.value("cost_eur_min", Json(0));
  return totals.at("cost_eur").is_number() || known == 0 ? Short(totals.at("cost_eur"))
                                                         : "≥ " + Short(known);
}

std::string QualityLine(const Json& answer) {
  const Json& designs = answer.at("designs");
  if (designs.empty()) return "";
  const Json& best = designs.front();
  const Json& quality = best.at("data_quality");
  std::string text = "Best: ";
  const std::vector<Minimized> minimized = MinimizedOf(answer);
  for (const Minimized& one : minimized)
    text += one.text(best.at("totals")) + " " + one.unit + ", ";
  text += fmt::format("{} kg, estimates carry {} of {}", Mass(best),
                      Percent(quality.at("mass_share_estimated")),
                      minimized.empty() ? "it" : "the mass");
  if (quality.at("flow_estimated").get<bool>()) text += " and some flow data";
  const std::size_t classes = quality.value("not_orderable", Json::array()).size();
  if (classes > 0)
    text += fmt::format("; {} of {} rows {} no product that one can order", classes,
                        best.at("parts").size(), classes == 1 ? "is" : "are");
  text += ".\n";
  if (answer.value("price_basis", "") == "lower_bound")
    text += "Unknown prices count as 0: ≥ is before the sum of those that are known.\n";
  return text + "\n";
}

}  // namespace plenum::server
