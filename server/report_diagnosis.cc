#include "server/report_diagnosis.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "server/svg_plot.h"
#include "server/text_diagnosis.h"
#include "server/text_table.h"

namespace plenum::server {
namespace {

using api::Json;

constexpr std::string_view kStyle = R"(<style>
:root { color-scheme: light dark; --ink: #1c2128; --faint: #667080; --paper: #ffffff;
  --line: #d8dde4; --phase: #f1f4f8; --band: #dfe5ec; --measured: #8b95a3; --declared: #8a5fbf;
  --before: #d06a1c; --after: #1f6fc4; }
@media (prefers-color-scheme: dark) { :root { --ink: #e4e8ee; --faint: #98a2b0; --paper: #14181d;
  --line: #333b45; --phase: #1c222a; --band: #2b333d; --measured: #8b95a3; --declared: #b08ae0;
  --before: #f0964a; --after: #5ea8f2; } }
body { font: 15px/1.5 system-ui, sans-serif; color: var(--ink); background: var(--paper);
  max-width: 900px; margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.3rem; margin-bottom: .2rem; } h2 { font-size: 1.1rem; margin-top: 2.2rem; }
.verdict { font-size: 1.25rem; border-left: 4px solid var(--after); padding: .3rem 0 .3rem 1rem; }
.faint { color: var(--faint); } .wide { overflow-x: auto; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; margin: .6rem 0; }
th, td { padding: .2rem .8rem .2rem 0; text-align: right; border-bottom: 1px solid var(--line); }
th { font-weight: 600; } th.text, td.text { text-align: left; }
code { font-size: .85em; overflow-wrap: anywhere; }
figure { margin: 1rem 0; }
svg { width: 100%; height: auto; margin: .6rem 0; font: 12px system-ui, sans-serif; }
svg text { fill: var(--ink); } svg text.title { font-size: 14px; font-weight: 600; }
svg text.faint { fill: var(--faint); }
svg path { fill: none; stroke-width: 1.4; stroke-linejoin: round; }
svg .grid { stroke: var(--line); stroke-width: .6; } svg .tick { stroke: var(--faint); }
svg .phase { fill: var(--phase); } svg .band { fill: var(--band); }
svg path.measured, svg line.measured { stroke: var(--measured); stroke-width: 3.5; }
svg path.declared, svg line.declared { stroke: var(--declared); stroke-dasharray: 2 3; }
svg path.before, svg line.before { stroke: var(--before); stroke-dasharray: 7 3; }
svg path.after, svg line.after { stroke: var(--after); }
svg path.solid, svg line.solid { stroke-dasharray: none; stroke-width: 1; }
svg line.declared, svg line.before, svg line.after { stroke-width: 2; }
svg rect.before { fill: var(--before); } svg rect.after { fill: var(--after); }
svg line.noise { stroke: var(--ink); stroke-dasharray: 4 3; }
</style>
)";

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

struct Column {
  std::string title;
  bool text = false;
};

std::string HtmlTable(const std::vector<Column>& columns,
                      const std::vector<std::vector<std::string>>& rows) {
  if (rows.empty()) return "";
  std::string html = "<div class=\"wide\"><table><tr>";
  const auto cell = [&](std::string_view tag, std::size_t i, const std::string& content) {
    html += fmt::format("<{}{}>{}</{}>", tag, columns[i].text ? " class=\"text\"" : "",
                        Escaped(content), tag);
  };
  for (std::size_t i = 0; i < columns.size(); ++i) cell("th", i, columns[i].title);
  html += "</tr>\n";
  for (const std::vector<std::string>& row : rows) {
    html += "<tr>";
    for (std::size_t i = 0; i < row.size(); ++i) cell("td", i, row[i]);
    html += "</tr>\n";
  }
  return html + "</table></div>\n";
}

std::string Paragraph(std::string_view text, std::string_view css_class = "") {
  return fmt::format("<p{}>{}</p>\n",
                     css_class.empty() ? "" : fmt::format(" class=\"{}\"", css_class),
                     Escaped(text));
}

std::string Heading(std::string_view text) { return fmt::format("<h2>{}</h2>\n", Escaped(text)); }

std::vector<double> Numbers(const Json& list) {
  std::vector<double> values;
  for (const Json& value : list)
    values.push_back(value.is_number() ? value.get<double>() : kMissing);
  return values;
}

std::vector<double> Difference(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> difference(std::min(a.size(), b.size()));
  for (std::size_t i = 0; i < difference.size(); ++i) difference[i] = a[i] - b[i];
  return difference;
}

bool Same(const std::vector<double>& a, const std::vector<double>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double one, double other) {
    return one == other || (std::isnan(one) && std::isnan(other));
  });
}

// --- The sections ------------------------------------------------------------------------------

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
    const std::string id = EffectsText(Json::array({effect.at("id")}), nullptr);
    const std::string law = effect.at("parameters").value("law", "");
    for (const auto& [name, value] : effect.at("parameters").items())
      if (value.is_object())
        AddEstimate(rows, law.empty() ? id : id + " (" + law + ")", name, value);
  }
  for (const auto& [name, value] : answer.at("fitted").items()) {
    const std::string unit = value.at("unit");
    AddEstimate(rows, "declared " + Short(value.at("declared")),
                unit == "1" ? name : name + "_" + unit, value);
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

std::vector<Stretch> Phases(const Json& series, const std::vector<double>& t_s) {
  std::vector<Stretch> stretches;
  const Json& phases = series.at("phase");
  for (std::size_t i = 0; i < phases.size() && i < t_s.size(); ++i) {
    if (!std::isfinite(t_s[i])) continue;
    const std::string phase = phases[i];
    if (!stretches.empty()) stretches.back().to = t_s[i];
    if (stretches.empty() || stretches.back().label != phase)
      stretches.push_back({phase, t_s[i], t_s[i], stretches.size() % 2 == 0});
  }
  return stretches;
}

std::string RunPlots(const Json& series, double noise_kpa) {
  const std::vector<double> t_s = Numbers(series.at("t_s"));
  const std::vector<double> measured = Numbers(series.at("measured_kpa"));
  const std::vector<double> before = Numbers(series.at("before_kpa"));
  const std::vector<double> after = Numbers(series.at("after_kpa"));
  const std::string run = series.at("run");
  const std::string name =
      "Run " + run + (series.at("held_out") == true ? " (held out of every fit)" : "");
  const bool apart = !Same(before, after);

  LinePlot pressure{
      name + ": measured and model", "time, s", "pressure, kPa gauge", {}, {}, {}, ""};
  pressure.stretches = Phases(series, t_s);
  pressure.curves = {{"measured", "measured", t_s, measured},
                     {"as declared", "declared", t_s, Numbers(series.at("declared_kpa"))},
                     {"before (refitted)", "before", t_s, before}};
  if (apart) pressure.curves.push_back({"after (with effects)", "after", t_s, after});

  LinePlot residual{name + ": measured less model", "time, s", "residual, kPa", {}, {}, {}, ""};
  residual.stretches = pressure.stretches;
  residual.curves = {{"before", "before solid", t_s, Difference(measured, before)}};
  if (apart) residual.curves.push_back({"after", "after solid", t_s, Difference(measured, after)});
  if (std::isfinite(noise_kpa)) {
    residual.band = 2.0 * noise_kpa;
    residual.band_label = "±2 standard deviations of the noise";
  }
  for (LinePlot* plot : {&pressure, &residual})
    for (Curve& curve : plot->curves) {
      curve.x.resize(std::min(curve.x.size(), curve.y.size()));
      curve.y.resize(curve.x.size());
    }
  return "<figure>\n" + Svg(pressure) + Svg(residual) + "</figure>\n";
}

// RMS of the residual over all samples of each phase, before and after; runs held out too.
std::string PhasePlot(const Json& answer, double noise_kpa) {
  static constexpr std::array<const char*, 4> kPhases = {"rest", "rise", "hold", "fall"};
  struct Sum {
    double squares = 0.0, count = 0.0;
    double Rms() const { return count > 0.0 ? std::sqrt(squares / count) : kMissing; }
  };
  std::map<std::pair<std::string, std::string>, Sum> sums;  // phase, before or after
  for (const Json& series : answer.at("series")) {
    const std::vector<double> measured = Numbers(series.at("measured_kpa"));
    for (const std::string which : {"before", "after"}) {
      const std::vector<double> off = Difference(measured, Numbers(series.at(which + "_kpa")));
      const Json& phases = series.at("phase");
      for (std::size_t i = 0; i < off.size() && i < phases.size(); ++i) {
        if (!std::isfinite(off[i])) continue;
        Sum& sum = sums[{phases[i].get<std::string>(), which}];
        sum.squares += off[i] * off[i];
        sum.count += 1.0;
      }
    }
  }
  BarPlot plot{"Error by phase, all runs", "residual, RMS, kPa", {}, {}, {}, "noise"};
  plot.series = {{"before", "before", {}}, {"after", "after", {}}};
  for (const char* phase : kPhases) {
    if (!sums.contains({phase, "before"}) && !sums.contains({phase, "after"})) continue;
    plot.groups.emplace_back(phase);
    plot.series[0].values.push_back(sums[{phase, "before"}].Rms());
    plot.series[1].values.push_back(sums[{phase, "after"}].Rms());
  }
  if (plot.groups.empty()) return "";
  if (std::isfinite(noise_kpa)) plot.line = noise_kpa;
  return "<figure>\n" + Svg(plot) + "</figure>\n";
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
  const double noise_kpa = noise.is_number() ? noise.get<double>() : kMissing;
  std::string html = "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n";
  html += "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
  html += fmt::format("<title>{}</title>\n{}</head><body>\n<h1>{}</h1>\n", Escaped(title), kStyle,
                      Escaped(title));
  html += Paragraph("Verdict: " + answer.at("verdict").get<std::string>(), "faint");
  html += Paragraph(VerdictText(answer), "verdict");
  html += Errors(answer) + Estimates(answer) + NextRun(answer);
  if (!answer.at("series").empty()) html += Heading("Measured and model");
  for (const Json& series : answer.at("series")) html += RunPlots(series, noise_kpa);
  html += Residual(answer, noise_kpa) + Candidates(answer) + Discrepancy(answer) +
          Warnings(answer) + Provenance(answer);
  return html + "</body></html>\n";
}

}  // namespace plenum::server
