#include "server/render/text/text_explain.h"

#include <fmt/format.h>

#include "server/render/text/text_table.h"

namespace plenum::server {
namespace {

using api::Json;
using Align = Table::Align;

std::string UnexploredText(const Json& front_proof) {
  std::string text;
  for (const auto& region : front_proof.at("unexplored")) {
    std::string where;
    for (const auto& [name, value] : region.at("limits").items())
      where += fmt::format("{}{} ≤ {}", where.empty() ? "" : ", ", name.substr(0, name.size() - 4),
                           Short(value));
    for (const auto& [name, value] : region.items())
      if (name != "limits")
        where += fmt::format("{}{} ≥ {}", where.empty() ? "" : ", ",
                             name.substr(0, name.size() - 4), Short(value));
    text += "  not searched to the end: " + where + "\n";
  }
  return text;
}

}  // namespace

std::string FrontText(const Json& answer) {
  if (!answer.contains("front")) return "";
  const auto& front = answer.at("front");
  const auto& proof = answer.at("front_proof");
  std::string text = "Pareto front\n";
  if (!front.empty()) {
    std::vector<Table::Column> columns{{"design"}};
    for (const auto& [name, value] : front.front().at("objectives").items())
      columns.push_back({name});
    Table table(columns, 2);
    for (const auto& point : front) {
      std::vector<std::string> cells{Grouped(point.at("rank"))};
      for (const auto& [name, value] : point.at("objectives").items())
        cells.push_back(fmt::format("{:.4f}", value.get<double>()));
      table.Add(cells);
    }
    text += table.Text();
  }
  text += proof.at("complete")
              ? fmt::format("  whole, by {} searches\n", Grouped(proof.at("searches")))
              : fmt::format("  {} of {} searches were proved\n", Grouped(proof.at("proved")),
                            Grouped(proof.at("searches")));
  return text + UnexploredText(proof) + "\n";
}

std::string RobustText(const Json& answer) {
  if (!answer.contains("robust")) return "";
  const auto& robust = answer.at("robust");
  const auto percent = [](const Json& share) {
    return share.is_number() ? fmt::format("{:.0f} %", 100.0 * share.get<double>())
                             : std::string("–");
  };
  std::string text =
      fmt::format("Part numbers within their tolerance, {} draws\n", Grouped(robust.at("draws")));
  Table table({{"design"}, {"meets all"}, {"95 % interval"}, {"is first"}}, 2);
  for (const auto& design : answer.at("designs")) {
    const auto& robustness = design.at("robustness");
    const auto& interval = robustness.at("probability_ci95");
    table.Add({Grouped(design.at("rank")), percent(robustness.at("probability")),
               percent(interval[0]) + " to " + percent(interval[1]),
               percent(robustness.at("share_rank_1"))});
  }
  if (!answer.at("designs").empty()) text += table.Text();
  if (robust.at("probability_min").is_number())
    text +=
        fmt::format("  {} better designs meet all in less than {} of the draws, and are left out\n",
                    Grouped(robust.at("left_out")), percent(robust.at("probability_min")));
  return text + "\n";
}

std::string PricesText(const Json& answer) {
  if (!answer.contains("prices")) return "";
  Table table(
      {{"requirement", Align::kLeft}, {"required"}, {"loosened"}, {"saves"}, {"", Align::kLeft}},
      2);
  for (const auto& price : answer.at("prices")) {
    const auto& share = price.at("saving_share");
    const bool proved = price.at("status") == "optimal";
    table.Add({price.at("requirement").get<std::string>(), Short(price.at("required")),
               Short(price.at("loosened")),
               share.is_number() ? fmt::format("{:.2f} %", 100.0 * share.get<double>()) : "–",
               proved ? "proved" : "not proved, at least this"});
  }
  return "Price of each requirement: what a tenth less of it saves of the objective\n" +
         table.Text() + "\n";
}

std::string FlipsText(const Json& answer) {
  std::string text;
  const auto sure = [](const Json& flip) { return flip.at("confirmed") ? "" : " (not confirmed)"; };
  for (const auto& design : answer.at("designs")) {
    if (!design.contains("to_be_first")) continue;
    const auto& flip = design.at("to_be_first");
    text += fmt::format("Design {} would be first\n", Grouped(design.at("rank")));
    for (const auto& part : flip.at("parts"))
      text += fmt::format("  if {} took {:.2f} % less{}\n", part.at("id").get<std::string>(),
                          100.0 * part.at("reduction_share").get<double>(), sure(part));
    for (const auto& requirement : flip.at("requirements"))
      text += fmt::format(
          "  if {} were {} instead of {}{}\n", requirement.at("requirement").get<std::string>(),
          Short(requirement.at("tightened")), Short(requirement.at("required")), sure(requirement));
    if (flip.at("parts").empty() && flip.at("requirements").empty())
      text += "  by no change of a single part or requirement that was tried\n";
    if (!flip.at("complete").get<bool>()) text += "  (time ran out before all were tried)\n";
  }
  return text.empty() ? text : text + "\n";
}

}  // namespace plenum::server
