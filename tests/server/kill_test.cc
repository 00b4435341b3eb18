// The service is killed (SIGKILL) again and again while clients write and post jobs: what was
// acknowledged is there, what was not is done wholly or not at all, and both files pass every
// check.
//
// PLENUM_KILLS and PLENUM_KILL_WRITES (acknowledged writes, over all rounds) make it longer:
//   PLENUM_KILLS=500 PLENUM_KILL_WRITES=50000 build/release/server_tests --gtest_filter='Kill*'
#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>
#include <httplib.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <optional>
#include <random>
#include <thread>

#include "api/catalogue/stores.h"
#include "api/json/json.h"
#include "tests/server/workbench.h"

namespace plenum::server {
namespace kill_test {

constexpr int kClients = 6;
constexpr int kIdsPerClient = 24;
constexpr int kRowsPerImport = 12;

int FromEnvironment(const char* name, int fallback) {
  const char* text = std::getenv(name);
  return text == nullptr ? fallback : std::atoi(text);
}

// What a part is known by here: its mass in grams; none where it does not exist.
using State = std::map<std::string, std::optional<int>>;

api::Json PartOf(const std::string& id, int grams) {
  api::Json part = NewFitting(id);
  part["mass_kg"] = grams / 1000.0;
  return part;
}

// One request: what it makes of the parts it names.
struct Write {
  enum { kAdd, kReplace, kRemove, kImport } kind = kAdd;
  State after;
  std::string key;  // of additions and imports
};

// One client with parts of its own, which nobody else touches.
class Client {
 public:
  Client(int number, unsigned seed) : number_(number), random_(seed) {
    for (int i = 0; i < kIdsPerClient; ++i) known_[Id(i)] = std::nullopt;
  }

  // Writes until the service is gone. A request that was cut off is sent again first, with its key.
  void Run(int port, std::atomic<int>& acknowledged) {
    httplib::Client http("127.0.0.1", port);
    http.set_keep_alive(true);
    http.set_tcp_nodelay(true);
    for (;;) {
      if (!open_) open_ = Choose();
      const int status = Send(http, *open_);
      if (status == 0) return;
      // Without a key, only what Settle saw tells whether the request was done.
      ASSERT_TRUE(status == 200 || status == 201 || status == 204)
          << status << " for kind " << open_->kind;
      for (const auto& [id, grams] : open_->after) known_[id] = grams;
      open_.reset();
      ++acknowledged;
    }
  }

  // Compares with what is stored after a crash; a request under way counts as done or as not done.
  void Settle(const State& stored) {
    State expected = known_;
    if (open_ && !Same(stored, known_))
      for (const auto& [id, grams] : open_->after) expected[id] = grams;
    EXPECT_EQ(Mine(stored), expected) << "client " << number_;
    done_unseen_ += open_ && expected != known_;
    // With a key it is safe to ask again; otherwise the client goes on from what it found.
    if (open_ && open_->key.empty()) {
      known_ = expected;
      open_.reset();
    }
  }

  int done_unseen() const { return done_unseen_; }

 private:
  std::string Id(int i) const { return "k" + std::to_string(number_) + "-" + std::to_string(i); }

  State Mine(const State& stored) const {
    State mine;
    for (const auto& [id, grams] : known_) {
      const auto found = stored.find(id);
      mine[id] = found == stored.end() ? std::nullopt : found->second;
    }
    return mine;
  }
  bool Same(const State& stored, const State& state) const { return Mine(stored) == state; }

  Write Choose() {
    const auto grams = [&] { return static_cast<int>(1 + random_() % 400); };
    Write write;
    const std::string id = Id(static_cast<int>(random_() % kIdsPerClient));
    if (random_() % 6 == 0) {
      write.kind = Write::kImport;
      for (int i = 0; i < kRowsPerImport; ++i)
        write.after[Id(static_cast<int>(random_() % kIdsPerClient))] = grams();
    } else if (!known_.at(id)) {
      write.kind = Write::kAdd;
      write.after[id] = grams();
    } else if (random_() % 2 == 0) {
      write.kind = Write::kReplace;
      write.after[id] = grams();
    } else {
      write.kind = Write::kRemove;
      write.after[id] = std::nullopt;
    }
    if (write.kind == Write::kAdd || write.kind == Write::kImport)
      write.key = Id(0) + "/" + std::to_string(++keys_);
    return write;
  }

  // The status, or 0 when no answer came.
  static int Send(httplib::Client& http, const Write& write) {
    const auto status = [](const httplib::Result& result) { return result ? result->status : 0; };
    const auto& [id, grams] = *write.after.begin();
    const std::string path = "/v1/parts/" + id;
    const httplib::Headers key = {{"Idempotency-Key", write.key}}, any = {{"If-Match", "*"}};
    switch (write.kind) {
      case Write::kAdd:
        return status(http.Post("/v1/parts", key, PartOf(id, *grams).dump(), "application/json"));
      case Write::kReplace:
        return status(http.Put(path.c_str(), any, PartOf(id, *grams).dump(), "application/json"));
      case Write::kRemove:
        return status(http.Delete(path.c_str(), any));
      default: {
        std::string csv =
            "id,manufacturer,part_number,tube_outer_diameter_mm,sonic_conductance_dm3_per_s_bar,"
            "critical_ratio,mass_kg,body_volume_ml,pressure_max_kpa_gauge,thread\n";
        for (const auto& [row, mass] : write.after)
          csv += row + ",bench,F1,4,0.31,0.4," + std::to_string(*mass) + " g,0.7,800,M5\n";
        return status(http.Post("/v1/parts/import?family=fitting", key, csv, "text/csv"));
      }
    }
  }

  const int number_;
  std::mt19937 random_;
  State known_;
  std::optional<Write> open_;  // sent, but not known to be done
  int keys_ = 0;
  int done_unseen_ = 0;
};

// One client that posts jobs and asks again for those that it got no answer to.
class JobClient {
 public:
  void Run(int port) {
    httplib::Client http("127.0.0.1", port);
    http.set_tcp_nodelay(true);
    for (;;) {
      if (key_.empty()) key_ = "job " + std::to_string(++keys_);
      const auto posted =
          http.Post("/v1/designs", {{"Idempotency-Key", key_}}, request_, "application/json");
      if (!posted) return;
      ASSERT_TRUE(posted->status == 202 || posted->status == 429) << posted->body;
      if (posted->status == 429)
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
      else
        Acknowledge(posted->get_header_value("Location"));
    }
  }

  // After a kill: the newest acknowledged jobs are there under their keys, and those that ended
  // have the result that every one of them must have.
  void Settle(const std::string& file) {
    const catalog::JobStore store(file, {});
    const std::size_t kept = 200;  // of 256; older ones may have been dropped
    for (std::size_t i = acknowledged_.size() - std::min(kept, acknowledged_.size());
         i < acknowledged_.size(); ++i) {
      const auto& [key, id] = acknowledged_[i];
      const auto job = store.FindKey("design", key);
      ASSERT_TRUE(job) << key << " was acknowledged and is lost";
      EXPECT_EQ(job->id, id);
      if (!Ended(job->status)) continue;
      EXPECT_EQ(job->status, catalog::JobStatus::kDone) << job->failure;
      const auto designs = std::get<api::Json>(api::ParseJson(job->result))["designs"];
      if (designs_.is_null()) designs_ = designs;
      EXPECT_TRUE(designs == designs_);
    }
  }

  std::size_t acknowledged() const { return acknowledged_.size(); }

 private:
  void Acknowledge(const std::string& location) {
    acknowledged_.emplace_back(key_, location.substr(location.rfind('/') + 1));
    key_.clear();
  }

  const std::string request_ = Example("gripper", 60.0).dump();
  std::string key_;  // of a request that was sent and not answered
  int keys_ = 0;
  std::vector<std::pair<std::string, std::string>> acknowledged_;  // key, id
  api::Json designs_;
};

std::string IntegrityOf(const std::string& file) {
  SQLite::Database db(file, SQLite::OPEN_READWRITE);  // which rolls back or plays the log
  return db.execAndGet("PRAGMA integrity_check").getString();
}

State Stored(const catalog::Store& store) {
  State state;
  for (const auto& part : store.List("fitting"))
    state[part.id] = static_cast<int>(part.numbers.at("mass_kg").value * 1000 + 0.5);
  return state;
}

TEST(Kill, LosesNothingAcknowledgedAndLeavesNothingHalfDone) {
  const int kills = FromEnvironment("PLENUM_KILLS", 15);
  const int writes_per_kill = FromEnvironment("PLENUM_KILL_WRITES", 600) / kills;
  const Workbench bench;
  std::vector<Client> clients;
  for (int i = 0; i < kClients; ++i) clients.emplace_back(i, 1000 + i);
  JobClient jobs;
  std::mt19937 random(4711);
  std::atomic<int> acknowledged = 0;
  int in_the_middle = 0;  // kills that left a transaction to be rolled back
  for (int round = 0; round < kills && !HasFailure(); ++round) {
    ServeProcess serve(bench.catalog());
    std::vector<std::thread> threads;
    for (Client& client : clients)
      threads.emplace_back([&] { client.Run(serve.port(), acknowledged); });
    threads.emplace_back([&] { jobs.Run(serve.port()); });
    const int enough = acknowledged + writes_per_kill;
    while (acknowledged < enough && !HasFailure())
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 20'000));
    EXPECT_EQ(serve.End(SIGKILL), -SIGKILL);
    for (std::thread& thread : threads) thread.join();
    in_the_middle += std::filesystem::exists(bench.catalog() + "-journal");

    const catalog::Store store(bench.catalog(), catalog::Access::kRead);
    EXPECT_EQ(store.Check(), std::vector<std::string>()) << "round " << round;
    const State stored = Stored(store);
    for (Client& client : clients) client.Settle(stored);
    EXPECT_EQ(IntegrityOf(bench.catalog() + "-jobs"), "ok") << "round " << round;
    jobs.Settle(bench.catalog() + "-jobs");
  }
  EXPECT_GE(acknowledged, kills * writes_per_kill);
  int unseen = 0;
  for (const Client& client : clients) unseen += client.done_unseen();
  EXPECT_GT(jobs.acknowledged(), 0u);
  std::printf(
      "%d kills, %d inside a transaction; %d acknowledged writes, %d done unacknowledged; %zu "
      "jobs\n",
      kills, in_the_middle, acknowledged.load(), unseen, jobs.acknowledged());
}

}  // namespace kill_test
}  // namespace plenum::server
