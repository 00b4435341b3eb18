// Engineers in hidden worlds; a line of JSON for each world and way to buy.
//   loop_bench CATALOG REQUIREMENTS.json SEED WORLDS [--first I] [--tests N] [--saving S]
// REQUIREMENTS.json: [{ "name", "from", "merge" }], the file that a request comes from and what is
// merged into it (JSON Merge Patch). Worlds are SEED/name/0 to SEED/name/WORLDS-1; a line is
//   { "requirements", "world", "way", "bought", "meets", "missed", "margin", "mass_kg",
//     "printed_mass_kg", "best_kg", "best_printed_kg", "tests", "answer_status", "seconds" }
// mass and best as drawn, and with masses and outer volumes as printed (world.h).
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fstream>
#include <string>
#include <vector>

#include "api/catalogue/stores.h"
#include "bench/loop/engineer.h"
#include "bench/loop/ranking.h"
#include "bench/loop/world.h"

namespace plenum::bench {
namespace {

using api::Json;
using Rows = std::vector<catalog::Part>;

struct Options {
  std::string catalog, requirements, seed;
  int worlds = 0, first = 0;
  Habits habits;
};

Json ReadFile(const std::string& path) {
  std::ifstream file(path);
  return Json::parse(file);
}

struct Hidden {
  Rows truth, as_printed;  // world.h
  std::optional<double> best_kg, best_printed_kg;
};

Json OrNull(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json LineOf(const Json& requirements, const Json& design, const Hidden& hidden) {
  Json line = {{"bought", !design.is_null()},
               {"meets", false},
               {"missed", ""},
               {"margin", 0.0},
               {"mass_kg", nullptr},
               {"printed_mass_kg", nullptr}};
  line["best_kg"] = OrNull(hidden.best_kg);
  line["best_printed_kg"] = OrNull(hidden.best_printed_kg);
  if (design.is_null()) return line;
  const Verdict verdict = Judge(requirements, design, hidden.truth);
  line["meets"] = verdict.meets;
  line["missed"] = verdict.missed;
  line["margin"] = verdict.margin;
  line["mass_kg"] = OrNull(verdict.objective);
  line["printed_mass_kg"] = OrNull(Judge(requirements, design, hidden.as_printed).objective);
  return line;
}

class WorldRun {
 public:
  WorldRun(const std::string& name, const std::string& world, Json requirements, const Rows& rows,
           const Json& first)
      : name_(name),
        world_(world),
        requirements_(std::move(requirements)),
        rows_(rows),
        first_(first) {
    hidden_.truth = DrawWorld(rows, world, Weights::kDrawn);
    hidden_.as_printed = DrawWorld(rows, world, Weights::kAsPrinted);
    hidden_.best_kg = BestOf(requirements_, hidden_.truth);
    hidden_.best_printed_kg = BestOf(requirements_, hidden_.as_printed);
  }

  void BuyAll(const Habits& habits) {
    Tell("nominal", FirstOf(first_.at("on_paper")), Json::array());
    Tell("guaranteed", FirstOf(first_), Json::array());
    Engineer engineer = NewEngineer(1);
    FollowLoop(engineer, habits);
    Tell("loop", FirstOf(engineer.answer), engineer.tests);
    const int made = static_cast<int>(engineer.tests.size());
    Confirm(engineer, habits);
    Tell("loop and confirmed", FirstOf(engineer.answer), engineer.tests);
    Engineer other = NewEngineer(2);
    TestAtRandom(other, made);
    Tell("random", FirstOf(other.answer), other.tests);
  }

 private:
  Engineer NewEngineer(std::uint64_t stream) const {
    return {requirements_, hidden_.truth, rows_, first_, test::Random(SeedOf(world_), stream)};
  }

  void Tell(const char* way, const Json& design, const Json& tests) {
    Json line = {{"requirements", name_}, {"world", world_}, {"way", way}};
    line.update(LineOf(requirements_, design, hidden_));
    line["tests"] = tests;
    line["seconds"] =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    std::printf("%s\n", line.dump().c_str());
    std::fflush(stdout);
    start_ = std::chrono::steady_clock::now();
  }

  std::string name_, world_;
  Json requirements_;
  const Rows& rows_;
  const Json& first_;
  Hidden hidden_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

void Run(const Options& options) {
  const Rows rows = catalog::Store(options.catalog, catalog::Access::kRead).List();
  for (const Json& listed : ReadFile(options.requirements)) {
    const auto name = listed.at("name").get<std::string>();
    Json requirements = ReadFile(listed.at("from").get<std::string>());
    requirements.merge_patch(listed.at("merge"));
    const Json first = Rank(requirements, rows);
    for (int i = options.first; i < options.first + options.worlds; ++i) {
      const std::string world = options.seed + "/" + name + "/" + std::to_string(i);
      WorldRun(name, world, requirements, rows, first).BuyAll(options.habits);
    }
  }
}

std::optional<Options> ReadOptions(int argc, char** argv) {
  if (argc < 5 || (argc - 5) % 2 != 0) return {};
  Options options{argv[1], argv[2], argv[3], std::atoi(argv[4]), 0, {}};
  for (int i = 5; i < argc; i += 2) {
    const std::string flag = argv[i];
    if (flag == "--first")
      options.first = std::atoi(argv[i + 1]);
    else if (flag == "--tests")
      options.habits.tests_most = std::atoi(argv[i + 1]);
    else if (flag == "--saving")
      options.habits.saving_least = std::atof(argv[i + 1]);
    else
      return {};
  }
  return options;
}

}  // namespace
}  // namespace plenum::bench

int main(int argc, char** argv) {
  const auto options = plenum::bench::ReadOptions(argc, argv);
  if (!options) {
    std::fprintf(stderr,
                 "usage: loop_bench CATALOG REQUIREMENTS.json SEED WORLDS [--first I] [--tests N] "
                 "[--saving S]\n");
    return 2;
  }
  try {
    plenum::bench::Run(*options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 3;
  }
  return 0;
}
