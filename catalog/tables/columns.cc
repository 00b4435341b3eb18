#include "catalog/tables/columns.h"

#include <algorithm>
#include <set>
#include <utility>

#include "catalog/tables/heading_words.h"
#include "catalog/tables/layout.h"
#include "catalog/tables/printed/printed_columns.h"
#include "catalog/units/quantity.h"
#include "catalog/units/text.h"

namespace plenum::catalog {
namespace {

constexpr char kRest[] = "*";

// Targets with '+' between them; none: the column is left out.
std::vector<Target> GivenTargets(const Family& family, std::string_view text,
                                 const ColumnRead& column, TableReading& reading) {
  std::vector<Target> targets;
  if (IsBlank(text)) return targets;
  for (const std::string_view piece : Split(text, '+')) {
    GivenTarget given = ParseTarget(family, piece);
    if (!given.error.empty()) {
      reading.errors.push_back({0, "column", Shown(column.key) + ": " + given.error});
      continue;
    }
    // The heading's own unit, where the answer names none.
    if (given.target.unit.empty() && !given.target.notation) {
      std::vector<Target> said = MatchHeading(family, column.heading).targets;
      std::erase_if(said,
                    [&](const Target& target) { return target.column != given.target.column; });
      if (said.size() == 1) given.target = said.front();
    }
    targets.push_back(std::move(given.target));
  }
  return targets;
}

std::string_view WithoutBrackets(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" [(");
  if (first == std::string_view::npos) return "";
  return text.substr(first, text.find_last_not_of(" ])") - first + 1);
}

// The matches of each heading with the unit below it; empty where the row below holds anything but
// units, or none.
std::vector<HeadingMatch> MatchesWithUnits(const Family& family, const CsvRow& header,
                                           const CsvRow& below) {
  std::vector<HeadingMatch> matches;
  bool has_unit = false;
  for (std::size_t i = 0; i < header.size(); ++i) {
    const std::string_view unit = i < below.size() ? WithoutBrackets(below[i]) : "";
    if (unit.empty() || unit == "-" || unit == "–") {
      matches.push_back(MatchHeading(family, header[i]));
      continue;
    }
    std::string with_unit = header[i];
    with_unit.append(" [").append(unit).append("]");
    matches.push_back(MatchHeading(family, with_unit));
    const auto& targets = matches.back().targets;
    if (targets.empty() || targets.front().unit != unit) return {};
    has_unit = true;
  }
  return has_unit ? matches : std::vector<HeadingMatch>{};
}

std::string Listed(const std::vector<Target>& targets) {
  std::string text;
  for (const Target& target : targets) text += (text.empty() ? "" : " or ") + target.column;
  return text;
}

// Whether they are one column, its normal litres at 0 °C or at 20 °C.
bool AskForTemperature(const std::vector<Target>& targets) {
  return targets.size() == 2 && targets[0].column == targets[1].column &&
         targets[0].unit.find("°C") != std::string::npos;
}

// "Set pressure range": both ends stand in each cell.
bool IsRange(std::string_view heading, const HeadingMatch& match) {
  const std::string plain = PlainWords(heading);
  return match.targets.size() == 2 && AreEnds(match.targets[0], match.targets[1]) &&
         (plain.find("range") != std::string::npos || plain.find("bereich") != std::string::npos);
}

Question QuestionOf(const Family& family, const ColumnRead& column, const HeadingMatch& match) {
  Question question{"column", column.key, "", {}};
  const std::string what = column.heading.empty() ? "column " + column.key.substr(1) +
                                                        " has no "
                                                        "heading: "
                                                  : Shown(column.heading) + ": ";
  if (!match.wrong_unit.empty()) {
    question.text = what + Shown(match.wrong_unit) +
                    " is no unit of the field that it names: which unit or which field is meant?";
    return question;
  }
  if (match.targets.empty()) {
    question.text = what + "which column of " + std::string(family.name) +
                    " is it? An empty answer leaves it out";
    return question;
  }
  question.text = what + (AskForTemperature(match.targets)
                              ? "is its normal litre counted at 0 °C or at 20 °C, 7 % apart?"
                              : "is it " + Listed(match.targets) + "?");
  std::string all;
  for (const Target& target : match.targets) {
    question.answers.push_back(FormatTarget(target));
    all += (all.empty() ? "" : " + ") + FormatTarget(target);
  }
  if (match.targets.size() == 2 &&
      (IsConductance(match.targets.front().column) || AreEnds(match.targets[0], match.targets[1])))
    question.answers.push_back(std::move(all));
  return question;
}

bool IsOffer(const Family& family, const Target& target) {
  const PrintedColumn* printed = FindPrinted(family, target.column);
  return printed != nullptr && printed->gives == "offers";
}

bool SaysPerMetre(std::string_view heading) {
  const std::string plain = PlainWords(heading) + " ";
  for (const std::string_view per :
       {"per m ", "per metre ", "per meter ", "pro m ", "pro meter ", "je m ", "je meter "})
    if (plain.find(per) != std::string::npos) return true;
  return false;
}

// A price without a unit, or one beside a supplier, a date or a pack, is an offer; what else an
// offer has says nothing without a price, and what it is is asked.
void MakeOffers(const Family& family, TableReading& reading, std::vector<OpenColumn>& open) {
  bool has_more = reading.set.contains("offer_supplier") || reading.set.contains("offer_date");
  for (const ColumnRead& column : reading.columns)
    for (const Target& target : column.targets) has_more |= IsOffer(family, target);
  bool has_price = false;
  for (ColumnRead& column : reading.columns)
    for (Target& target : column.targets) {
      const bool in_euro = target.column.starts_with("price_eur") && !target.by_full_name;
      if (in_euro && (has_more || target.unit.empty())) {
        const bool per_metre = target.unit.ends_with("/m");
        const std::string unit = target.unit.empty() ? "" : per_metre ? "EUR/m" : "EUR";
        target = {std::string(kOfferPrice), unit};
      }
      if (target.column != kOfferPrice) continue;
      has_price = true;
      if (SaysPerMetre(column.heading) && !target.unit.empty() && !target.unit.ends_with("/m"))
        target.unit += "/m";
    }
  if (has_price) return;
  for (std::size_t i = 0; i < reading.columns.size(); ++i)
    if (auto& targets = reading.columns[i].targets;
        targets.size() == 1 && IsOffer(family, targets.front())) {
      targets.clear();
      open.push_back({i, {}});
    }
}

bool HasTarget(const ColumnRead& column, std::string_view name) {
  return std::any_of(column.targets.begin(), column.targets.end(),
                     [&](const Target& target) { return target.column == name; });
}

// "Part" beside a maker is the maker's number of it.
void TakePartNumber(const Family& family, TableReading& reading, std::vector<OpenColumn>& open) {
  const auto has = [&](std::string_view name) {
    return reading.set.contains(std::string(name)) ||
           std::any_of(reading.columns.begin(), reading.columns.end(),
                       [&](const ColumnRead& column) { return HasTarget(column, name); });
  };
  if (!has("manufacturer") || has("part_number")) return;
  const auto says_part = [&](const OpenColumn& one) {
    return FieldWords(family.name, reading.columns[one.index].heading) ==
           std::vector<std::string>{"part"};
  };
  if (std::count_if(open.begin(), open.end(), says_part) != 1) return;
  const auto found = std::find_if(open.begin(), open.end(), says_part);
  reading.columns[found->index].targets = {{"part_number", ""}};
  open.erase(found);
}

void AskForTwins(TableReading& reading) {
  for (std::size_t i = 0; i < reading.columns.size(); ++i)
    for (const Target& target : reading.columns[i].targets) {
      const auto gives = [&](const ColumnRead& column) {
        return std::any_of(column.targets.begin(), column.targets.end(),
                           [&](const Target& other) { return other.column == target.column; });
      };
      const auto first = std::find_if(reading.columns.begin(), reading.columns.end(), gives);
      const auto index = static_cast<std::size_t>(first - reading.columns.begin());
      if (index < i)
        reading.questions.push_back({"column",
                                     reading.columns[i].key,
                                     Shown(first->key) + " and " + Shown(reading.columns[i].key) +
                                         " both give " + target.column +
                                         ": which one? An empty answer leaves a column out",
                                     {}});
      if (reading.set.contains(target.column))
        reading.errors.push_back({0, "set",
                                  target.column + " is given, and the table has it in " +
                                      Shown(reading.columns[i].key)});
    }
}

}  // namespace

std::string NumberKey(std::size_t index) { return "#" + std::to_string(index + 1); }

const std::string* GivenFor(const ColumnRead& column, std::size_t index,
                            const TableOptions& options) {
  for (const std::string& key : {NumberKey(index), column.heading})
    if (const auto found = options.columns.find(key); found != options.columns.end())
      return &found->second;
  return nullptr;
}

std::vector<OpenColumn> MapColumns(const Family& family, const CsvRow& header, const CsvRow& below,
                                   const TableOptions& options, TableReading& reading) {
  std::vector<HeadingMatch> matches = MatchesWithUnits(family, header, below);
  if (!matches.empty()) reading.units_row = reading.header_row + 1;
  std::set<std::string> seen;
  std::vector<OpenColumn> open;
  for (std::size_t i = 0; i < header.size(); ++i) {
    ColumnRead column;
    column.heading = IsBlank(header[i]) ? "" : header[i];
    const bool own_key = !column.heading.empty() && seen.insert(column.heading).second;
    column.key = own_key ? column.heading : NumberKey(i);
    HeadingMatch match =
        matches.empty() ? MatchHeading(family, column.heading) : std::move(matches[i]);
    if (const std::string* given = GivenFor(column, i, options))
      column.targets = GivenTargets(family, *given, column, reading);
    else if (match.targets.size() == 1 || IsRange(column.heading, match))
      column.targets = std::move(match.targets);
    else
      open.push_back({i, std::move(match)});
    reading.columns.push_back(std::move(column));
  }
  MakeOffers(family, reading, open);
  TakePartNumber(family, reading, open);
  return open;
}

void AskForColumns(const Family& family, const std::vector<OpenColumn>& open,
                   const TableOptions& options, TableReading& reading) {
  const auto rest = options.columns.find(kRest);
  for (const OpenColumn& one : open) {
    const ColumnRead& column = reading.columns[one.index];
    const bool known = !one.match.targets.empty() || !one.match.wrong_unit.empty();
    if (column.samples.empty() || (!known && rest != options.columns.end())) continue;
    reading.questions.push_back(QuestionOf(family, column, one.match));
  }
  AskForTwins(reading);
}

}  // namespace plenum::catalog
