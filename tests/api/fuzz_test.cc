// Seeded mutation of good documents: whatever comes in, the answer is a value or a list of errors
// with pointers into the document, never a crash, and can be written as JSON.
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "api/catalogue/part_document.h"
#include "api/catalogue/stores.h"
#include "api/design/read/requirements_reader.h"
#include "api/json/json.h"
#include "api/simulate/map.h"
#include "api/simulate/simulation.h"
#include "tests/api/support.h"

namespace plenum::api {
namespace fuzz_test {

using Random = std::mt19937_64;

std::size_t Below(Random& random, std::size_t n) {
  return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
}

const char* const kTokens[] = {"null",
                               "true",
                               "-1",
                               "0",
                               "1e308",
                               "-1e-320",
                               "1e999",
                               "NaN",
                               "[]",
                               "{}",
                               "\"\"",
                               "[[[",
                               "}",
                               ",",
                               "\"a\":",
                               "1.5",
                               "\xff",
                               "\\u0000",
                               "9223372036854775808",
                               "99999999999999999999"};

// Mutation of bytes: delete, repeat, replace, insert a token, cut.
std::string MutateBytes(std::string text, Random& random) {
  for (std::size_t i = 0; i <= Below(random, 4); ++i) {
    if (text.empty()) return text;
    const std::size_t at = Below(random, text.size());
    const std::size_t length = 1 + Below(random, 12);
    switch (Below(random, 5)) {
      case 0:
        text.erase(at, length);
        break;
      case 1:
        text.insert(at, text.substr(Below(random, text.size()), length));
        break;
      case 2:
        text[at] = static_cast<char>(Below(random, 256));
        break;
      case 3:
        text.insert(at, kTokens[Below(random, std::size(kTokens))]);
        break;
      default:
        if (Below(random, 8) == 0) text.resize(at);
    }
  }
  return text;
}

Json RandomValue(Random& random, const Json& other) {
  switch (Below(random, 9)) {
    case 0:
      return nullptr;
    case 1:
      return -1;
    case 2:
      return 0;
    case 3:
      return 1e300;
    case 4:
      return "text";
    case 5:
      return Json::array();
    case 6:
      return Json::object();
    case 7:
      return true;
    default:
      return other;
  }
}

// Mutation of the tree: the value at a random pointer is replaced, or its field renamed or removed.
Json MutateTree(const Json& document, Random& random) {
  const Json flat = document.flatten();
  Json changed = document;
  for (std::size_t i = 0; i <= Below(random, 3); ++i) {
    auto leaf = flat.begin();
    std::advance(leaf, static_cast<std::ptrdiff_t>(Below(random, flat.size())));
    Json::json_pointer pointer(leaf.key());
    for (std::size_t up = Below(random, 3); up > 0 && !pointer.parent_pointer().empty(); --up)
      pointer = pointer.parent_pointer();
    if (!changed.contains(pointer)) continue;
    Json& parent = changed[pointer.parent_pointer()];
    if (Below(random, 3) == 0 && parent.is_object()) {
      Json value = parent[pointer.back()];
      parent.erase(pointer.back());
      if (Below(random, 2) == 0) parent[pointer.back() + "x"] = std::move(value);
    } else {
      changed[pointer] = RandomValue(random, flat.at(leaf.key()));
    }
  }
  return changed;
}

// The pointers of errors lead into the document, to where it ends or to what is missing.
void ExpectSound(const Errors& errors, const Json& document) {
  for (const Error& error : errors) {
    EXPECT_FALSE(error.detail.empty());
    ASSERT_NO_THROW(Json(error.detail).dump()) << error.pointer;
    if (error.pointer.empty()) continue;
    const Json::json_pointer pointer(error.pointer);
    EXPECT_TRUE(document.contains(pointer.parent_pointer()) ||
                document.contains(pointer.parent_pointer().parent_pointer()))
        << error.pointer << " " << error.detail;
  }
}

void Submit(const Json& document, const std::vector<catalog::Part>& parts, int& accepted) {
  const auto requirements = ParseRequirements(document, parts);
  ExpectSound(ErrorsOf(requirements), document);
  accepted += std::holds_alternative<DesignRequest>(requirements);
  const auto part = ParsePart(document);
  ExpectSound(ErrorsOf(part), document);
  accepted += std::holds_alternative<catalog::Part>(part);
}

TEST(Fuzz, MutatedTextIsRefusedOrReadNeverACrash) {
  Random random(20240611);
  const auto parts = SmallCatalogue();
  const std::string texts[] = {RequirementsText(), SimulationText(), MapText(),
                               RenderPart(PartOf("compressor")).dump(1)};
  int accepted = 0, parsed = 0;
  for (int i = 0; i < 20'000; ++i) {
    const auto json = ParseJson(MutateBytes(texts[i % 4], random));
    if (const Errors* errors = std::get_if<Errors>(&json)) {
      ASSERT_EQ(errors->size(), 1u);
      ASSERT_NO_THROW(Json(errors->front().detail).dump());
      ASSERT_NO_THROW(Json::json_pointer(errors->front().pointer));
      continue;
    }
    ++parsed;
    Submit(std::get<Json>(json), parts, accepted);
  }
  EXPECT_GT(parsed, 2000);
  EXPECT_GT(accepted, 100);
}

TEST(Fuzz, MutatedTreesAreRefusedOrReadNeverACrash) {
  Random random(777);
  const auto parts = SmallCatalogue();
  const Json documents[] = {Requirements(), RenderPart(PartOf("compressor")),
                            RenderPart(PartOf("valve"))};
  int accepted = 0;
  for (int i = 0; i < 20'000; ++i) Submit(MutateTree(documents[i % 3], random), parts, accepted);
  EXPECT_GT(accepted, 500);
}

TEST(Fuzz, MutatedSimulationsAndMapsAnswerOrSayWhy) {
  Random random(4242);
  const auto parts = SmallCatalogue();
  const Json simulation =
      With(With(Simulation(), "/sample_hz", 5), "/effects",
           Parse(R"([{"id": "leak", "parameters": {"law": "porous", "viscous_pa2_s_per_kg": 1e15,
                                              "inertial_pa2_s2_per_kg2": 1e21}},
                {"id": "heat_transfer", "parameters": {"time_constant_s": 0.5}},
                {"id": "valve_ramp", "parameters": {"duration_s": 0.02}},
                {"id": "sensor_lag", "parameters": {"time_constant_s": 0.01}}])"));
  const Json map = Map();
  int answered = 0;
  for (int i = 0; i < 3'000; ++i) {
    const Json document = MutateTree(i % 2 == 0 ? simulation : map, random);
    const auto result = i % 2 == 0 ? RunSimulation(document, parts) : RunMap(document);
    ExpectSound(ErrorsOf(result), document);
    answered += std::holds_alternative<Json>(result);
  }
  EXPECT_GT(answered, 100);
}

}  // namespace fuzz_test
}  // namespace plenum::api
