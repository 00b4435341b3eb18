#include "server/render/text/text_guarantee.h"

#include <fmt/format.h>

#include "server/render/text/text_ranked.h"
#include "server/render/text/text_table.h"

namespace plenum::server {
namespace {

using api::Json;
using Align = Table::Align;

std::string Widths(const Json& tolerance) {
  return fmt::format("measured ±{:.0f} %, data sheet ±{:.0f} %, estimated ±{:.0f} %",
                     100.0 * tolerance.at("measured").get<double>(),
                     100.0 * tolerance.at("datasheet").get<double>(),
                     100.0 * tolerance.at("estimated").get<double>());
}

std::string LineOf(const char* name, const Json& list) {
  const Json& designs = list.at("designs");
  const std::string status = list.at("status");
  std::string text = fmt::format("  {:<10}  ", name);
  if (designs.empty())
    return text + (status == "infeasible" ? "none, proved\n" : "none found yet\n");
  text += fmt::format("{:.3f} kg, {}", designs.front().at("totals").at("mass_kg").get<double>(),
                      SourceAndValves(designs.front()));
  return text + (status == "optimal" ? "\n" : " (not proved)\n");
}

std::string Saved(const Json& test) {
  if (test.at("saving_share").is_number()) return Percent(test.at("saving_share"));
  const Json& interval = test.at("saving_interval");
  return Short(interval[0]) + " to " + Short(interval[1]);
}

std::string TestName(const Json& test) {
  return test.at("part").get<std::string>() + " (" + test.at("protocol").get<std::string>() + ")";
}

std::string TestsText(const Json& tests, bool complete) {
  std::string rest = complete ? "" : "  Time ran out before all tests were looked at.\n";
  if (tests.empty()) return rest;
  Table table({{"measure first", Align::kLeft}, {"numbers", Align::kLeft}, {"saves"}}, 2);
  for (const Json& test : tests) {
    std::string numbers;
    for (const Json& number : test.at("numbers"))
      numbers += (numbers.empty() ? "" : ", ") + number.get<std::string>();
    std::string name = TestName(test);
    if (test.contains("with")) name += " with " + TestName(test.at("with"));
    table.Add({Cut(name, 48), Cut(numbers, 36), Saved(test)});
  }
  return table.Text() + rest;
}

// One test alone stands above.
std::string TogetherText(const Json& together) {
  std::string text;
  for (const Json& item : together) {
    if (item.at("tests").size() < 2) continue;
    text +=
        fmt::format("  together {} tests save {} (number {} on paper)\n", item.at("tests").size(),
                    Percent(item.at("saving_share")), item.at("rank").get<int>());
    for (const Json& test : item.at("tests")) text += "    " + TestName(test) + "\n";
  }
  return text;
}

}  // namespace

std::string GuaranteeText(const Json& answer) {
  const Json guarantee = answer.value("guarantee", Json());
  if (!guarantee.is_object()) return "";
  std::string text = "Guaranteed with every number of its parts within its tolerance\n  (" +
                     Widths(guarantee.at("tolerance")) + ")\n";
  text += LineOf("guaranteed", answer) + LineOf("on paper", answer.at("on_paper"));
  if (guarantee.at("costs_share").is_number())
    text += "  certainty costs " + Percent(guarantee.at("costs_share")) + "\n";
  return text +
         TestsText(answer.at("measure_first"), answer.at("measure_first_complete").get<bool>()) +
         TogetherText(answer.value("measure_together", Json::array())) + "\n";
}

}  // namespace plenum::server
