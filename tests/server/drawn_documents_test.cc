// Documents drawn from their own schema: each optional field is there or not, lists have none to
// three items, numbers are those of an example, near them or anywhere in their range, some of them
// as a text with a unit. Each ends in an answer or in errors that name what is wrong, computations
// included (tests/fuzz/computations.h aborts on anything else).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

#include "api/describe/descriptions.h"
#include "api/design/given/evaluation.h"
#include "api/design/read/requirements_reader.h"
#include "api/measure/diagnose_request.h"
#include "api/simulate/simulation.h"
#include "tests/api/support.h"
#include "tests/fuzz/computations.h"
#include "tests/server/enemy.h"
#include "tests/support/places.h"

namespace plenum::server {
namespace drawn_documents_test {

using api::Json;

class Draw {
 public:
  explicit Draw(unsigned seed) : random_(seed) {}

  // A value of the schema, near `like` where that is not null.
  Json Value(const Json& schema, const Json& like) {
    if (schema.contains("anyOf")) {
      const Json value = Value(FormFor(schema["anyOf"], like), like);
      return value.is_number() && Chance(0.05) ? WithUnit(schema["anyOf"], value) : value;
    }
    if (schema.contains("const")) return schema["const"];
    if (schema.contains("enum"))
      return like.is_null() || Chance(0.03) ? schema["enum"][Below(schema["enum"].size())] : like;
    const std::string type = TypeOf(schema);
    if (type == "object") return Object(schema, like);
    if (type == "array") return Array(schema, like);
    if (type == "number" || type == "integer") return Number(schema, like, type == "integer");
    if (type == "boolean" && (like.is_null() || Chance(0.2))) return Chance(0.5);
    if (like.is_null()) return type == "string" ? Json("a") : Json();
    return like;
  }

 private:
  // As a text in the unit of the field, where it may be one: its example is "1 kPa".
  static Json WithUnit(const Json& forms, const Json& number) {
    for (const Json& form : forms)
      if (TypeOf(form) == "string" && form.contains("examples"))
        return number.dump() + form["examples"][0].get<std::string>().substr(1);
    return number;
  }
  bool Chance(double share) { return std::uniform_real_distribution<>()(random_) < share; }
  std::size_t Below(std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random_);
  }

  // One that the example is written in, if any is.
  const Json& FormFor(const Json& forms, const Json& like) {
    if (!Chance(0.02))
      for (const Json& form : forms)
        if (const std::string type = TypeOf(form);
            (type == "object" && like.is_object()) || (type == "array" && like.is_array()) ||
            (type == "number" && like.is_number()) || (type == "string" && like.is_string()))
          return form;
    return forms[Below(forms.size())];
  }

  Json Object(const Json& schema, const Json& like) {
    Json object = Json::object();
    for (const auto& [name, inner] : In(schema, "properties").items()) {
      bool required = false;
      for (const Json& one : In(schema, "required")) required = required || one == name;
      const Json& own = In(like, name);
      if (required || Chance(own.is_null() ? 0.01 : 0.97)) object[name] = Value(inner, own);
    }
    return object;
  }

  Json Array(const Json& schema, const Json& like) {
    Json array = Json::array();
    const bool keep = like.is_array() && !like.empty() && Chance(0.97);
    const std::size_t least = schema.value("minItems", 0u);
    const std::size_t size = keep ? like.size() : std::max(least, Below(4));
    static const Json kNothing;
    for (std::size_t i = 0; i < size && schema.contains("items"); ++i)
      array.push_back(Value(schema["items"], like.is_array() && !like.empty()
                                                 ? like[std::min(i, like.size() - 1)]
                                                 : kNothing));
    return array;
  }

  Json Number(const Json& schema, const Json& like, bool whole) {
    const double low = schema.value("minimum", schema.value("exclusiveMinimum", -1e6));
    const double high = schema.value("maximum", schema.value("exclusiveMaximum", 1e6));
    double value = 0.0;
    if (like.is_number() && Chance(0.95)) return like;
    if (like.is_number() && Chance(0.7))
      value = like.get<double>() * std::exp(std::normal_distribution<>(0.0, 1.0)(random_));
    else if (Chance(0.3))
      value = Chance(0.5) ? low : high;
    else
      value = low + (high - low) * std::pow(std::uniform_real_distribution<>()(random_), 8.0);
    value = std::clamp(value, low, high);
    if (whole) return static_cast<std::int64_t>(std::llround(value));
    return value;
  }

  std::mt19937 random_;
};

struct Count {
  int drawn = 0, valid = 0;
};

// Runs what is drawn; `valid` says whether a document was read without an error.
template <typename Run, typename Valid>
Count Drawn(const Json& schema, const Json& example, int documents, Run run, Valid valid) {
  Count count;
  for (int seed = 0; seed < documents; ++seed) {
    const Json document = Draw(static_cast<unsigned>(seed)).Value(schema, example);
    ++count.drawn;
    if (valid(document)) ++count.valid;
    run(document.dump());
  }
  return count;
}

// One of the corpus of the fuzzer of evaluations.
Json Seed(const char* name) {
  std::ifstream file(test::SourceDir() / "tests/fuzz/corpus/evaluation" / name);
  return api::Parse(std::string(std::istreambuf_iterator<char>(file), {}));
}

// Enough of what is drawn must come through to the computation.
void ExpectValid(const Count& count) {
  testing::Test::RecordProperty("valid", count.valid);
  EXPECT_GE(count.valid, count.drawn / 20);
}

TEST(DrawnDocuments, RequirementsEndInAnAnswerOrNamedErrors) {
  const auto parts = api::SmallCatalogue();
  ExpectValid(Drawn(api::DescribeRequirements(), api::Requirements(), 400, fuzz::Design,
                    [&](const Json& document) {
                      return api::ErrorsOf(api::ParseRequirements(document, parts)).empty();
                    }));
}

TEST(DrawnDocuments, EvaluationsEndInAnAnswerOrNamedErrors) {
  const Json schema = {{"type", "object"},
                       {"properties",
                        {{"schema", {{"const", "evaluation/1"}}},
                         {"requirements", api::DescribeRequirements()},
                         {"design", api::DescribeGivenDesign()}}},
                       {"required", {"schema", "requirements", "design"}}};
  const auto parts = api::SmallCatalogue();
  Count all;
  for (const char* configuration : {"co2", "compressor", "cylinder", "made", "mains"}) {
    const Count count =
        Drawn(schema, Seed(configuration), 200, fuzz::Evaluation, [&](const Json& document) {
          return api::ErrorsOf(api::RunEvaluation(document, parts, {})).empty();
        });
    all.drawn += count.drawn;
    all.valid += count.valid;
  }
  ExpectValid(all);
}

TEST(DrawnDocuments, SimulationsEndInAnAnswerOrNamedErrors) {
  const auto parts = api::SmallCatalogue();
  ExpectValid(Drawn(api::DescribeSimulation(), api::Simulation(), 400, fuzz::Simulation,
                    [&](const Json& document) {
                      return api::ErrorsOf(api::RunSimulation(document, parts, 0.01)).empty();
                    }));
}

TEST(DrawnDocuments, MeasurementsEndInAnAnswerOrNamedErrors) {
  ExpectValid(Drawn(
      api::DescribeMeasurement(), api::ExampleMeasurement(), 200, fuzz::Diagnosis,
      [](const Json& document) { return api::ErrorsOf(api::ParseMeasurement(document)).empty(); }));
}

}  // namespace drawn_documents_test
}  // namespace plenum::server
