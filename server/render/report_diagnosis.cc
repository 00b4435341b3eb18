#include "server/render/report_diagnosis.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>
#include <vector>

#include "server/render/html.h"
#include "server/render/residual_plots.h"
#include "server/render/svg_plot.h"
#include "server/render/text/text_diagnosis.h"
#include "server/render/text/text_table.h"

namespace plenum::server {
namespace {

using api::Json;

std::string Errors(const Json& answer) {
  std::vector<std::vector<std::string>> rows;
  static constexpr std::pair<const char*, const char*> kRows[] = {
      {"declared", "model as declared"},
      {"before", "before: base model, refitted"},
      {"after", "after: with the effects"}};
  for (const auto& [field, title] : kRows) {
    const Json& error = answer.at(field);
    rows.push_back({title, Short(error.at("rms_kpa")), Short(error.at("rms_percent")),
                    Short(error.at("peak_kpa")), Short(error.at("holdout_rms_kpa"))});
  }
  return Heading("Error before and after") +
         HtmlTable({{"", true},
                    {"RMS, kPa"},
                    {"RMS, % of operating pressure"},
                    {"peak, kPa"},
                    {"held-out runs, RMS, kPa"}},
                   rows) +
         Paragraph(fmt::format("Noise of the readings: {} kPa (standard deviation).",
                               Short(answer.at("noise_kpa"))),
                   "faint");
}

void AddEstimate(std::vector<std::vector<std::string>>& rows, std::string of,
                 const std::string& parameter, const Json& estimate) {
  const auto [name, unit] = Spoken(parameter);
  const Json& interval = estimate.at("ci95");
  rows.push_back({std::move(of), name, Short(estimate.at("value")),
                  Short(interval[0]) + " to " + Short(interval[1]), unit,
                  estimate.at("identified") == true ? "" : "not fixed by the data"});
}

std::string Estimates(const Json& answer) {
  std::vector<std::vector<std::string>> rows;
  for (const Json& effect : answer.at("effects")) {
    std::string id = EffectsText(Json::array({effect.at("id")}), nullptr);
    if (const std::string law = effect.at("parameters").value("law", ""); !law.empty())
      ((id += " (") += law) += ")";
    for (const auto& [name, value] : effect.at("parameters").items())
      if (value.is_object()) AddEstimate(rows, id, name, value);
  }
  for (const auto& [name, value] : answer.at("fitted").items()) {
    if (value.contains("specimen")) continue;  // in the table of the specimens
    const std::string unit = value.at("unit");
    AddEstimate(rows, "declared " + Short(value.at("declared")), WithUnit(name, unit), value);
  }
  if (rows.empty()) return "";
  return Heading("What was fitted") + HtmlTable({{"effect", true},
                                                 {"parameter", true},
                                                 {"value"},
                                                 {"95 % interval"},
                                                 {"unit", true},
                                                 {"", true}},
                                                rows);
}

std::string Specimens(const Json& answer) {
  const std::vector<std::vector<std::string>> rows = SpecimenRows(answer);
  if (rows.empty()) return "";
  const std::string spread = SpreadInWords(answer);
  return Heading("Specimens") +
         HtmlTable({{"specimen", true},
                    {"runs", true},
                    {"number", true},
                    {"value"},
                    {"95 % interval"},
                    {"unit", true}},
                   rows) +
         (spread.empty() ? "" : Paragraph(spread + ".", "faint"));
}

std::string WrongNumbers(const Json& answer) {
  std::vector<std::vector<std::string>> rows;
  for (const Json& number : answer.value("numbers", Json::array())) {
    const auto [name, spoken] = WrongNumberSpoken(number);
    rows.push_back({name, Short(number.at("declared")), Short(number.at("fitted")), spoken,
                    Short(number.at("deviation_sigma")),
                    EffectsText(number.at("instead_of"), Json::object())});
  }
  if (rows.empty()) return "";
  return Heading("Declared numbers that are wrong") + HtmlTable({{"number", true},
                                                                 {"declared"},
                                                                 {"fitted"},
                                                                 {"unit", true},
                                                                 {"deviation, σ"},
                                                                 {"instead of", true}},
                                                                rows);
}

std::string Stability(const Json& answer) {
  std::vector<std::vector<std::string>> rows;
  for (const Json& change : answer.value("stability", Json::array()))
    rows.push_back({change.at("change").get<std::string>(), Short(change.at("delta_bic")),
                    change.at("holds") == true ? "yes" : "no"});
  if (rows.empty()) return "";
  return Heading("Whether the names hold when the readings change") +
         HtmlTable({{"change", true}, {"best other set, ΔBIC"}, {"holds", true}}, rows);
}

std::string NextRun(const Json& answer) {
  const Json& next = answer.at("next_experiment");
  if (next.is_null()) return "";
  std::vector<std::vector<std::string>> rows;
  for (const Json& command : next.at("valve"))
    rows.push_back({Short(command.at("t_s")), command.at("state").get<std::string>()});
  std::string measure;
  for (const Json& channel : next.at("measure")) {
    const auto [name, unit] = Spoken(channel);
    measure += (measure.empty() ? "" : ", ") + name;
  }
  std::string set = next.at("blocked") == true ? "actuator blocked" : "actuator free";
  if (next.contains("source_pressure_kpa_gauge"))
    set += ", source at " + Short(next.at("source_pressure_kpa_gauge")) + " kPa gauge";
  return Heading("The next run") + Paragraph(next.at("why").get<std::string>()) +
         Paragraph(fmt::format("{}; measure: {}. Expected difference {} kPa (RMS), ΔBIC {}.", set,
                               measure, Short(next.at("expected_difference_kpa")),
                               Short(next.at("expected_delta_bic")))) +
         HtmlTable({{"time, s"}, {"valve", true}}, rows);
}

std::string Residual(const Json& answer, double noise_kpa) {
  const Json& residual = answer.at("residual");
  const std::vector<std::vector<std::string>> tests = {
      {"white: no memory (Ljung–Box over 20 lags)", PassedText(residual.at("white")),
       Short(residual.at("portmanteau")), Short(residual.at("portmanteau_limit"))},
      {"independent of the inputs (largest correlation, in standard deviations)",
       PassedText(residual.at("independent_of_inputs")), Short(residual.at("cross")),
       Short(residual.at("cross_limit"))},
      {"no larger than the noise (variance over that of the noise)",
       PassedText(residual.at("lack_of_fit").is_number() &&
                  residual.at("lack_of_fit_limit").is_number() &&
                  residual.at("lack_of_fit") <= residual.at("lack_of_fit_limit")),
       Short(residual.at("lack_of_fit")), Short(residual.at("lack_of_fit_limit"))}};
  std::vector<std::vector<std::string>> phases;
  for (const Json& phase : residual.at("phases"))
    phases.push_back({phase.at("run").get<std::string>(), phase.at("phase").get<std::string>(),
                      phase.at("cycle").dump(), Short(phase.at("start_s")),
                      Short(phase.at("end_s")), Short(phase.at("mean_kpa")),
                      Short(phase.at("rms_kpa")), Short(phase.at("trend_kpa_per_s"))});
  std::string html = Heading("The residual after the fit") +
                     HtmlTable({{"test", true}, {"passed", true}, {"value"}, {"limit"}}, tests) +
                     PhasePlot(answer, noise_kpa);
  if (!phases.empty())
    html += "<details><summary>Every phase of every run</summary>\n" +
            HtmlTable({{"run", true},
                       {"phase", true},
                       {"cycle"},
                       {"from, s"},
                       {"to, s"},
                       {"mean, kPa"},
                       {"RMS, kPa"},
                       {"trend, kPa/s"}},
                      phases) +
            "</details>\n";
  return html;
}

std::string Candidates(const Json& answer) {
  std::vector<std::vector<std::string>> rows;
  for (const Json& candidate : answer.at("candidates"))
    rows.push_back({EffectsText(candidate.at("effects"), candidate.at("laws")),
                    Short(candidate.at("bic")), Short(candidate.at("delta_bic")),
                    candidate.at("parameters").dump(), Short(candidate.at("rms_kpa")),
                    Short(candidate.at("holdout_rms_kpa")),
                    candidate.at("found_again").dump() + " of " + candidate.at("starts").dump(),
                    candidate.at("converged") == true ? "" : "did not converge"});
  if (rows.empty()) return "";
  return Heading("Candidates") + HtmlTable({{"effects", true},
                                            {"BIC"},
                                            {"ΔBIC"},
                                            {"fitted numbers"},
                                            {"RMS, kPa"},
                                            {"held out, kPa"},
                                            {"optimum found again"},
                                            {"", true}},
                                           rows);
}

std::string Discrepancy(const Json& answer) {
  const Json& discrepancy = answer.at("discrepancy");
  if (discrepancy.is_null()) return "";
  std::vector<std::vector<std::string>> rows;
  for (const Json& place : discrepancy.at("places"))
    rows.push_back({place.at("axis").get<std::string>(), place.at("where").get<std::string>(),
                    Short(place.at("share"))});
  return Heading("What no known effect accounts for") +
         Paragraph(fmt::format(
             "A term learned in the equation of the {} takes the error from {} to {} kPa, of the "
             "held-out runs from {} to {} kPa. Unexplained share of the residual's variance above "
             "the noise: {}.",
             discrepancy.at("equation").get<std::string>(), Short(discrepancy.at("rms_before_kpa")),
             Short(discrepancy.at("rms_after_kpa")), Short(discrepancy.at("holdout_before_kpa")),
             Short(discrepancy.at("holdout_after_kpa")),
             Short(answer.at("unexplained_fraction")))) +
         HtmlTable({{"by", true}, {"where the residual lives", true}, {"share of its energy"}},
                   rows);
}

std::string Warnings(const Json& answer) {
  if (answer.at("warnings").empty()) return "";
  std::string html = Heading("To be known") + "<ul>\n";
  for (const Json& warning : answer.at("warnings"))
    html += "<li>" + Escaped(warning.get<std::string>()) + "</li>\n";
  return html + "</ul>\n";
}

std::string Provenance(const Json& answer) {
  const Json& provenance = answer.at("provenance");
  std::string html = Heading("To make this again");
  for (const Json& file : provenance.at("files"))
    html += fmt::format("<p>{}<br><code>sha256 {}</code></p>\n",
                        Escaped(file.at("name").get<std::string>()),
                        Escaped(file.at("sha256").get<std::string>()));
  return html + Paragraph(fmt::format("Seed {}. Units: {}.", provenance.at("seed").dump(),
                                      provenance.at("units").get<std::string>()));
}

}  // namespace

std::string DiagnosisReport(const Json& answer) {
  const std::string name = answer.at("name");
  const std::string title = name.empty() ? "Diagnosis" : "Diagnosis of " + name;
  const Json& noise = answer.at("noise_kpa");
  const double noise_kpa = noise.is_number() ? noise.get<double>() : std::nan("");
  std::string html = Paragraph("Verdict: " + answer.at("verdict").get<std::string>(), "faint");
  html += Paragraph(VerdictText(answer), "verdict");
  for (const char* field : {"numbers", "effects"})
    for (const Json& found : answer.value(field, Json::array()))
      if (const std::string words = found.value("words", ""); !words.empty())
        html += Paragraph(words, "found");
  html += Errors(answer) + WrongNumbers(answer) + Estimates(answer) + Specimens(answer) +
          NextRun(answer);
  if (!answer.at("series").empty()) html += Heading("Measured and model");
  for (const Json& series : answer.at("series")) html += RunPlots(series, noise_kpa);
  html += Residual(answer, noise_kpa) + Candidates(answer) + Stability(answer) +
          Discrepancy(answer) + Warnings(answer) + Provenance(answer);
  return HtmlDocument(title, html);
}

}  // namespace plenum::server
