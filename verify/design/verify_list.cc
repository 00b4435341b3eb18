#include "verify/design/verify_list.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "verify/design/verify_design.h"
#include "verify/design/verify_ids.h"

namespace plenum::verify {
namespace {

constexpr std::size_t kFindingsShown = 3;

}  // namespace

void CheckOrder(const Problem& problem, const std::vector<Design>& designs, Findings& findings) {
  if (static_cast<int>(designs.size()) > problem.count)
    findings.push_back({"order", "more designs than were asked for"});
  std::set<std::pair<Configuration, Ids>> seen;
  std::vector<double> least_behind(designs.size() + 1, kUnlimited);  // from each rank on
  for (std::size_t i = designs.size(); i-- > 0;)
    least_behind[i] = std::min(least_behind[i + 1], designs[i].objective);
  double begin = -kUnlimited;  // of the run of ties
  for (std::size_t i = 0; i < designs.size(); ++i) {
    const std::string rank = "rank " + std::to_string(i + 1);
    if (!seen.insert({designs[i].configuration, IdsOf(designs[i])}).second)
      findings.push_back({"order", rank + " is listed twice"});
    const double objective = designs[i].objective, tie = TieOf(problem) * std::abs(begin);
    if (i == 0 || objective > begin + (1.0 + kSettled) * tie) {
      begin = least_behind[i];
      if (objective > begin + (1.0 + kSettled) * TieOf(problem) * std::abs(begin))
        findings.push_back({"order", rank + " comes before a better one"});
    } else if (objective <= begin + (1.0 - kSettled) * tie &&
               TieKeyOf(problem, designs[i]) < TieKeyOf(problem, designs[i - 1])) {
      findings.push_back(
          {"order", rank + " ties with the one before and comes first by mass, cost or ids"});
    }
  }
}

void CheckDesigns(const Problem& problem, const std::vector<Design>& designs, const Stop& stop,
                  Findings& findings, std::vector<NotRechecked>& open) {
  BigCount not_simulated = 0;
  for (std::size_t i = 0; i < designs.size(); ++i) {
    Findings own;
    const Design& design = designs[i];
    if (const std::optional<Assembly> assembly = Assemble(problem, design, own)) {
      CheckAmounts(problem, design, *assembly, own);
      if (!CheckPerformance(problem, design, *assembly, stop, own)) not_simulated += 1;
    }
    for (Finding& finding : own) {
      finding.detail = "rank " + std::to_string(i + 1) + ": " + finding.detail;
      findings.push_back(std::move(finding));
    }
  }
  if (not_simulated > 0)
    open.push_back(
        {"listed designs whose periodic state the simulator did not reach", not_simulated});
}

std::vector<Check> Gather(const CheckNames& names, const Findings& findings) {
  std::vector<Check> checks;
  for (const auto& [name, what] : names) {
    Check check{name, true, what};
    std::size_t count = 0;
    for (const Finding& finding : findings) {
      if (finding.check != name) continue;
      if (count == 0) check.detail.clear();
      if (count < kFindingsShown) check.detail += (count ? "; " : "") + finding.detail;
      ++count;
    }
    if (count > kFindingsShown)
      check.detail += "; and " + std::to_string(count - kFindingsShown) + " more";
    check.ok = count == 0;
    checks.push_back(std::move(check));
  }
  return checks;
}

}  // namespace plenum::verify
