// What a new user types first: nothing, a word that is not quite right, help, init.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "server/commands/commands.h"
#include "server/commands/manual/man_page.h"
#include "server/commands/manual/suggestion.h"
#include "tests/server/workbench.h"
#include "tests/support/places.h"

namespace plenum::server {
namespace first_words_test {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;

// All commands with what is typed for them: "catalog list".
void ForEach(const std::vector<Command>& commands, const std::string& before,
             const std::function<void(const std::string&, const Command&)>& take) {
  for (const Command& command : commands) {
    take(before + command.name, command);
    ForEach(command.commands, before + command.name + " ", take);
  }
}

TEST(FirstWords, ABarePlenumSaysWhatToTypeFirst) {
  const Workbench bench;
  const auto outcome = bench.Run("");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.out, IsEmpty());
  EXPECT_THAT(outcome.err, HasSubstr("plenum init"));
  EXPECT_THAT(outcome.err, HasSubstr("plenum serve"));
}

TEST(FirstWords, TheNearestWordOfATypo) {
  const auto commands = AllCommands();
  const auto unknown = [&](const std::vector<std::string>& words) {
    return UnknownWord(commands, words);
  };
  EXPECT_THAT(unknown({"desing", "my.json"}), HasSubstr("\"desing\"; nearest: design."));
  EXPECT_THAT(unknown({"design", "my.json", "--tpo", "3"}),
              HasSubstr("\"--tpo\"; nearest: --top."));
  EXPECT_THAT(unknown({"design", "my.json", "--tpo=3"}), HasSubstr("plenum design has no option"));
  EXPECT_THAT(unknown({"catalog", "lst"}),
              HasSubstr("plenum catalog has no command \"lst\"; nearest: list."));
  EXPECT_THAT(unknown({"--versoin"}), HasSubstr("nearest: --version"));
  EXPECT_EQ(unknown({"design", "desing", "--top", "3"}), "");            // a file
  EXPECT_EQ(unknown({"jobs", "--catalog", "agian", "again", "1"}), "");  // a value
  EXPECT_EQ(unknown({"jobs", "again", "1", "--json"}), "");              // of the command above
  EXPECT_EQ(unknown({"serve", "--no-log"}), "");

  const Workbench bench;
  const auto outcome = bench.Run("design - --tpo 3");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("nearest: --top"));
}

TEST(FirstWords, EachHelpEndsWithAnExample) {
  const Workbench bench;
  EXPECT_THAT(bench.Run("--help").out, HasSubstr("Example: plenum design"));
  ForEach(AllCommands(), "", [&](const std::string& typed, const Command& command) {
    const auto help = bench.Run(typed + " --help");
    EXPECT_EQ(help.status, 0) << typed;
    EXPECT_THAT(help.out, HasSubstr("Example: plenum " + typed)) << typed;
    EXPECT_THAT(command.example, HasSubstr("plenum " + typed));
  });
}

// In the order of the list each example finds what those before it have written.
TEST(FirstWords, TheExamplesOfTheHelpRun) {
  const Workbench bench;
  fs::copy(test::SourceDir() / "examples", bench.Path("examples"));
  bench.Write("part.json", NewFitting("my-valve").dump());
  const auto run = [&](const std::string& line) {
    const auto outcome = bench.Run(line.substr(std::string("plenum ").size()));
    EXPECT_EQ(outcome.status, 0) << line << "\n" << outcome.err;
    return outcome.out;
  };
  bench.Write("packs.csv", run("plenum catalog export battery"));
  bench.Write("result.json", run("plenum design examples/gripper.json --json"));
  ForEach(AllCommands(), "", [&](const std::string& typed, const Command& command) {
    // Jobs, tokens and revisions have names of their own; workers need a server; the exosuit is
    // designed by other tests.
    if (typed == "serve" || typed == "worker" || typed == "catalog undo" || typed == "jobs again" ||
        typed == "jobs cancel" || typed == "design" || typed == "token revoke")
      return;
    run(command.example);
  });
}

TEST(FirstWords, TheManualHoldsEveryCommandAndOption) {
  const Workbench bench;
  const auto page = bench.Run("--man");
  EXPECT_EQ(page.status, 0);
  EXPECT_EQ(page.out, ManPage(AllCommands()));
  std::string plain = page.out;
  for (std::size_t at; (at = plain.find("\\-")) != std::string::npos;) plain.erase(at, 1);
  ForEach(AllCommands(), "", [&](const std::string& typed, const Command& command) {
    EXPECT_THAT(plain, HasSubstr(".SS \"plenum " + typed + "\"\n" + command.help));
    for (const Option& option : command.options)
      EXPECT_THAT(plain, HasSubstr(option.name.substr(option.name.front() == '!')));
  });
  bench.Write("plenum.1", page.out);
  if (std::system("command -v groff >/dev/null") != 0) return;
  const std::string warnings = bench.Path("warnings");
  EXPECT_EQ(std::system(("groff -man -Tutf8 -ww '" + bench.Path("plenum.1").string() +
                         "' >/dev/null 2>'" + warnings + "'")
                            .c_str()),
            0);
  EXPECT_EQ(ReadAll(warnings), "");
}

// What bash would offer for the last of the words.
std::string Completed(const Workbench& bench, const std::string& words) {
  bench.Write("ask.sh", "source completion.sh\nCOMP_WORDS=(" + words +
                            ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_plenum\n"
                            "echo \"${COMPREPLY[*]}\" >offered\n");
  EXPECT_EQ(std::system(("cd '" + bench.Path("").string() + "' && bash ask.sh").c_str()), 0);
  return ReadAll(bench.Path("offered"));
}

TEST(FirstWords, BashCompletesCommandsOptionsAndTheirWords) {
  const Workbench bench;
  bench.Write("completion.sh", bench.Run("--bash-completion").out);
  EXPECT_EQ(Completed(bench, "plenum des"), "design\n");
  EXPECT_EQ(Completed(bench, "plenum catalog ex"), "export\n");
  EXPECT_EQ(Completed(bench, "plenum design my.json --to"), "--top\n");
  EXPECT_EQ(Completed(bench, "plenum catalog import battery --decimal ''"), "point comma\n");
  EXPECT_EQ(Completed(bench, "plenum design ''"), "\n");  // names of files follow
}

}  // namespace first_words_test
}  // namespace plenum::server
