// A diagnosis for a person: terminal text and report.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>

#include "api/measure/diagnosis_document.h"
#include "server/render/report_diagnosis.h"
#include "server/render/svg_plot.h"
#include "server/render/text/text_diagnosis.h"
#include "tests/support/sample_diagnosis.h"

namespace plenum::server {
namespace diagnosis_test {

using api::Json;
using testing::HasSubstr;
using testing::Not;

Json Sample(int samples = 801) {
  const test::SampleDiagnosis sample = test::MakeSampleDiagnosis(samples);
  return api::RenderDiagnosis(sample.diagnosis, sample.dataset, {{{"bench.json", "ab12"}}, 7});
}

std::size_t Count(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
  return count;
}

TEST(DiagnosisText, BeginsWithTheVerdictAndShowsErrorsEffectsAndCandidates) {
  const std::string text = DiagnosisText(Sample());
  EXPECT_EQ(text.find("Explained by creep"), 0u);
  EXPECT_THAT(text, HasSubstr("base model, refitted"));
  EXPECT_THAT(text, HasSubstr("0.140 to 0.160"));
  EXPECT_THAT(text, HasSubstr("time constant"));
  EXPECT_THAT(text, HasSubstr("dm³/(s·bar)"));
  EXPECT_THAT(text, HasSubstr("leak (porous)"));
  EXPECT_THAT(text, HasSubstr("did not converge"));
  EXPECT_THAT(text, HasSubstr("note: r2: 3 readings"));
}

TEST(DiagnosisText, AnEmptyDiagnosisIsSaidToBeUndecided) {
  const Json answer = api::RenderDiagnosis({}, {});
  EXPECT_EQ(DiagnosisText(answer).find("Verdict: undecided."), 0u);
  EXPECT_THAT(DiagnosisReport(answer), HasSubstr("Verdict: undecided."));
}

TEST(DiagnosisText, HasATableOfSpecimensAsTheReportHas) {
  test::SampleDiagnosis sample = test::MakeSampleDiagnosis(801);
  using calibration::Declared;
  sample.dataset.specimens = {"thin", "thick", ""};
  sample.dataset.relative_uncertainty[static_cast<std::size_t>(Declared::kRestVolume)] = 0.1;
  sample.dataset.runs.back().specimen = 1;
  sample.diagnosis.fitted = {{Declared::kRestVolume, {0.9, 0.89, 0.91, true}, 0},
                             {Declared::kRestVolume, {1.1, 1.09, 1.11, true}, 1}};
  const Json answer = api::RenderDiagnosis(sample.diagnosis, sample.dataset);
  for (const std::string& shown : {DiagnosisText(answer), DiagnosisReport(answer)}) {
    EXPECT_THAT(shown, HasSubstr("thick"));
    EXPECT_THAT(shown, HasSubstr("54.5 to 55.5"));
    EXPECT_THAT(shown, HasSubstr("without a name"));
    EXPECT_THAT(shown, HasSubstr("between the specimens: rest volume 14 %"));
  }
}

TEST(DiagnosisReport, StandsAlone) {
  const std::string html = DiagnosisReport(Sample());
  for (const char* foreign : {"<script", "src=", "href=", "url(", "@import"})
    EXPECT_THAT(html, Not(HasSubstr(foreign)));
  EXPECT_EQ(Count(html, "http"), Count(html, "http://www.w3.org/2000/svg"));
  EXPECT_EQ(Count(html, "<svg"), 2u * 3u + 1u);  // two a run, one by phase
  EXPECT_EQ(Count(html, "<svg"), Count(html, "</svg>"));
  EXPECT_EQ(Count(html, "class=\"title\""), Count(html, "<svg"));
  EXPECT_THAT(html, HasSubstr("prefers-color-scheme: dark"));
  EXPECT_THAT(html, HasSubstr("sha256 ab12"));
  EXPECT_THAT(html, HasSubstr("pressure, kPa gauge"));
  EXPECT_THAT(html, HasSubstr("Run r3 (held out of every fit)"));
  EXPECT_THAT(html, Not(HasSubstr("nan")));
  EXPECT_THAT(html, Not(HasSubstr("inf ")));
}

TEST(DiagnosisReport, TextOfTheUserStaysText) {
  Json answer = Sample(41);
  const std::string hostile = "<script>alert(1)</script>\"'&";
  answer["name"] = hostile;
  answer["sentence"] = hostile;
  answer["warnings"] = Json::array({hostile});
  answer["series"][0]["run"] = hostile;
  answer["residual"]["phases"][0]["run"] = hostile;
  answer["provenance"]["files"][0]["name"] = hostile;
  answer["candidates"][0]["effects"] = Json::array({hostile});
  EXPECT_THAT(DiagnosisReport(answer), Not(HasSubstr("<script")));
}

TEST(DiagnosisReport, GapsAndNumbersThatAreMissingDoNotStopIt) {
  Json answer = Sample(41);
  for (const char* field : {"measured_kpa", "before_kpa", "after_kpa", "declared_kpa", "t_s"})
    for (int i = 0; i < 41; i += 3) answer["series"][0][field][i] = nullptr;
  answer["series"][1]["after_kpa"] = Json::array();
  answer["series"][1]["t_s"] = Json::array();
  answer["noise_kpa"] = answer["unexplained_fraction"] = nullptr;
  answer["before"]["rms_kpa"] = nullptr;
  answer["residual"]["lack_of_fit"] = nullptr;
  const std::string html = DiagnosisReport(answer);
  EXPECT_THAT(html, Not(HasSubstr("nan")));
  EXPECT_THAT(DiagnosisText(answer), HasSubstr("–"));
}

TEST(DiagnosisReport, LongRunsStaySmall) {
  const std::string html = DiagnosisReport(Sample(100'001));
  EXPECT_LT(html.size(), 800'000u);
  if (const char* folder = std::getenv("PLENUM_REPORT_FOLDER"))
    std::ofstream(std::string(folder) + "/report.html") << DiagnosisReport(Sample(1601));
}

TEST(SvgPlot, ThinningKeepsEveryPeak) {
  Curve curve{"", "", {}, {}};
  for (int i = 0; i < 50'000; ++i) {
    curve.x.push_back(i);
    curve.y.push_back(std::sin(i * 0.01));
  }
  curve.y[12'345] = 9.0;
  curve.y[23'456] = -9.0;
  const Curve thin = Thinned(curve, 700);
  EXPECT_LE(thin.x.size(), 1500u);
  EXPECT_TRUE(std::is_sorted(thin.x.begin(), thin.x.end()));
  EXPECT_EQ(*std::max_element(thin.y.begin(), thin.y.end()), 9.0);
  EXPECT_EQ(*std::min_element(thin.y.begin(), thin.y.end()), -9.0);
  EXPECT_EQ(Thinned(thin, 100'000).x.size(), thin.x.size());
}

TEST(SvgPlot, TicksAreRoundAndInside) {
  EXPECT_THAT(Ticks(0.0, 10.0, 5), testing::ElementsAre(0, 2, 4, 6, 8, 10));
  for (const double tick : Ticks(-0.337, 0.912, 6)) {
    EXPECT_GE(tick, -0.337);
    EXPECT_LE(tick, 0.912);
  }
  EXPECT_TRUE(Ticks(1.0, 1.0, 5).empty());
  EXPECT_TRUE(Ticks(0.0, std::nan(""), 5).empty());
}

}  // namespace diagnosis_test
}  // namespace plenum::server
