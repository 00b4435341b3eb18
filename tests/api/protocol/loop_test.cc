// The tutorial's way: guaranteed list, recording, revision of the part, guaranteed list.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "api/design/answer.h"
#include "api/design/read/requirements_reader.h"
#include "api/measure/csv/measurement_csv.h"
#include "api/measure/diagnose_request.h"
#include "api/measure/rig_parts.h"
#include "api/protocol/part_revision.h"
#include "tests/api/support.h"
#include "tests/api/verified.h"
#include "tests/support/places.h"

namespace plenum::api {
namespace loop_test {

constexpr const char* kPart = "generic-lp-small-200kpa";

std::string ExampleText(const std::string& name) {
  std::ifstream file(test::SourceDir() / "examples" / name);
  return {std::istreambuf_iterator<char>(file), {}};
}

Json AnswerWith(const std::vector<catalog::Part>& parts) {
  const Json request = Example("gripper_guaranteed");
  const auto parsed = std::get<DesignRequest>(ParseRequirements(request, parts));
  return AnswerRequest(parsed, {}, parts);
}

Json Diagnosed(const std::vector<catalog::Part>& parts) {
  const auto recording = MeasurementFromCsv(ExampleText("bottle_test_simulated.csv"),
                                            Parse(ExampleText("bottle_test_rig.json")));
  DiagnosisRequest request;
  Errors errors;
  request.measurement = WithParts(std::get<Json>(recording), parts, errors);
  EXPECT_TRUE(errors.empty());
  request.dataset = std::get<calibration::Dataset>(ParseMeasurement(request.measurement));
  return RunDiagnosis(request, {}).answer;
}

// Truth: C 0.53, b 0.26, as the recording was simulated.
TEST(Loop, AMeasuredPartMakesTheGuaranteedListLighter) {
  std::vector<catalog::Part> parts = Project().parts;
  const Json before = AnswerWith(parts);
  EXPECT_EQ(before["measure_first"][0]["part"], kPart);
  const Json diagnosis = Diagnosed(parts);
  ASSERT_EQ(diagnosis["measured"].size(), 2u);
  const double truth[] = {0.53, 0.26};
  for (std::size_t i = 0; i < 2; ++i) {
    const Json& interval = diagnosis["measured"][i]["interval_95"];
    EXPECT_LE(interval[0].get<double>(), truth[i]);
    EXPECT_GE(interval[1].get<double>(), truth[i]);
  }
  const auto part = std::find_if(parts.begin(), parts.end(),
                                 [](const catalog::Part& one) { return one.id == kPart; });
  ASSERT_NE(part, parts.end());
  const PartRevision revised =
      RevisePart(*part, diagnosis, {{"recording.csv", std::string(64, 'c')}}, false);
  ASSERT_TRUE(revised.part) << revised.told.dump(1);
  *part = *revised.part;
  const Json after = AnswerWith(parts);
  EXPECT_EQ(after["status"], "optimal");
  EXPECT_LT(after["designs"][0]["objective"].get<double>(),
            before["designs"][0]["objective"].get<double>());
}

// Smaller uncertainties never cost: the worlds that must be met are fewer.
TEST(Loop, ASmallerUncertaintyNeverMakesTheGuaranteedListHeavier) {
  std::vector<catalog::Part> parts = Project().parts;
  double before = AnswerWith(parts)["designs"][0]["objective"].get<double>();
  for (const double uncertainty : {0.05, 0.01, 0.002}) {
    for (catalog::Part& part : parts) {
      if (part.family != "regulator" && part.family != "valve") continue;
      for (auto& [field, number] : part.numbers)
        if (number.provenance == catalog::Provenance::kEstimated) number.uncertainty = uncertainty;
    }
    const double now = AnswerWith(parts)["designs"][0]["objective"].get<double>();
    EXPECT_LE(now, before * (1.0 + 1e-9)) << uncertainty;
    before = now;
  }
}

}  // namespace loop_test
}  // namespace plenum::api
