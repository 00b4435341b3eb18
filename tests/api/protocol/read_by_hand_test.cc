// Numbers that were read from a scale or another instrument.
#include "api/protocol/read_by_hand.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "api/protocol/part_revision.h"
#include "tests/api/support.h"

namespace plenum::api {
namespace read_by_hand_test {

using testing::HasSubstr;

TEST(ReadByHand, AMassIsMeasuredFromThenOn) {
  catalog::Part part = PartOf("valve");
  part.numbers["mass_kg"].provenance = catalog::Provenance::kEstimated;
  part.numbers["mass_kg"].value = 0.025;
  const auto answer = ReadByHandAnswer(part, {"mass_kg=25.3 g"}, "0.5 %", "letter scale");
  const PartRevision revised = RevisePart(part, std::get<Json>(answer), {}, false);
  ASSERT_TRUE(revised.part) << revised.told.dump();
  const catalog::Number& mass = revised.part->numbers.at("mass_kg");
  EXPECT_DOUBLE_EQ(mass.value, 0.0253);
  EXPECT_EQ(mass.provenance, catalog::Provenance::kMeasured);
  EXPECT_DOUBLE_EQ(mass.uncertainty.value(), 0.005);
  EXPECT_EQ(mass.source, "read by hand: letter scale");
  EXPECT_EQ(revised.part->documents.size(), part.documents.size());
}

TEST(ReadByHand, NamesWhatIsWrong) {
  const catalog::Part part = PartOf("valve");
  const auto detail = [&](const std::string& reading, const std::string& share) {
    const auto answer = ReadByHandAnswer(part, {reading}, share, "");
    const auto* errors = std::get_if<Errors>(&answer);
    return errors ? errors->front().pointer + " " + errors->front().detail : std::string();
  };
  EXPECT_THAT(detail("weight=25 g", "0.01"), HasSubstr("one of"));
  EXPECT_THAT(detail("mass_kg", "0.01"), HasSubstr("FIELD=VALUE"));
  EXPECT_THAT(detail("mass_kg=25 mm", "0.01"), HasSubstr("mass_kg"));
  EXPECT_THAT(detail("mass_kg=-1", "0.01"), HasSubstr("mass_kg"));
  EXPECT_THAT(detail("mass_kg=0.02", "0.5"), HasSubstr("from 0.00001 to 0.25"));
  EXPECT_THAT(detail("mass_kg=0.02", "small"), HasSubstr("--uncertainty"));
}

}  // namespace read_by_hand_test
}  // namespace plenum::api
