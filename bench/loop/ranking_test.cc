#include "bench/loop/ranking.h"

#include <gtest/gtest.h>

#include <fstream>

#include "api/catalogue/stores.h"
#include "tests/support/places.h"

namespace plenum::bench {
namespace {

using api::Json;
using Rows = std::vector<catalog::Part>;

Rows Catalogue() {
  return catalog::Store(test::SourceDir() / "catalog.db", catalog::Access::kRead).List();
}

Json Gripper() {
  std::ifstream file(test::SourceDir() / "examples" / "gripper_guaranteed.json");
  Json requirements = Json::parse(file);
  requirements["ranking"] = {{"count", 3}, {"time_limit_s", 60}};
  return requirements;
}

TEST(Judging, ADesignMeetsInTheWorldThatItWasRankedIn) {
  const Rows rows = Catalogue();
  const Json answer = Rank(Gripper(), rows);
  const Json paper = FirstOf(answer.at("on_paper"));
  const Verdict verdict = Judge(Gripper(), paper, rows);
  EXPECT_TRUE(verdict.meets) << verdict.missed;
  EXPECT_NEAR(*verdict.objective, paper["totals"]["mass_kg"].get<double>(), 1e-9);
  EXPECT_NEAR(*BestOf(Gripper(), rows), paper["totals"]["mass_kg"].get<double>(), 1e-9);
  EXPECT_TRUE(Judge(Gripper(), FirstOf(answer), rows).meets);
  EXPECT_TRUE(SameParts(paper, paper));
  EXPECT_FALSE(SameParts(paper, FirstOf(answer)));
}

// Its valve passes less than it should, and weighs more.
TEST(Judging, ADesignMissesWhatItsPartsDoNotDo) {
  Rows rows = Catalogue();
  const Json paper = FirstOf(Rank(Gripper(), rows).at("on_paper"));
  const std::string valve = paper["parts"][0]["id"];
  for (catalog::Part& row : rows)
    if (row.id == valve) {
      row.numbers.at("sonic_conductance_fill_dm3_per_s_bar").value *= 0.8;
      row.numbers.at("mass_kg").value += 0.01;
    }
  const Verdict verdict = Judge(Gripper(), paper, rows);
  EXPECT_FALSE(verdict.meets);
  EXPECT_EQ(verdict.missed, "/actuators/0/rise_time_s_max");
  EXPECT_LT(verdict.margin, -0.02);
  EXPECT_NEAR(*verdict.objective, paper["totals"]["mass_kg"].get<double>() + 0.04, 1e-9);
  EXPECT_GT(*BestOf(Gripper(), rows), paper["totals"]["mass_kg"].get<double>());
}

}  // namespace
}  // namespace plenum::bench
