#include "catalog/tables/cell_evidence.h"

#include <algorithm>

#include "catalog/fields/laws/printed_part.h"
#include "catalog/fields/price.h"
#include "catalog/tables/layout.h"
#include "catalog/tables/printed/price_cells.h"
#include "catalog/tables/printed/printed_columns.h"
#include "catalog/units/quantity.h"
#include "catalog/units/text.h"

namespace plenum::catalog {
namespace {

constexpr std::size_t kSamples = 3;
constexpr std::size_t kSampleBytes = 60;

bool HasNumbers(const Family& family, const ColumnRead& column) {
  return std::any_of(column.targets.begin(), column.targets.end(), [&](const Target& target) {
    return FindNumber(family, target.column) != nullptr || target.column == kOfferPrice ||
           target.column == "c_rate";
  });
}

bool Gives(const ColumnRead& column, std::string_view name) {
  return std::any_of(column.targets.begin(), column.targets.end(),
                     [&](const Target& target) { return target.column == name; });
}

// The numbers of a cell: each side of a size, a price behind its sign.
void NoteCells(const ColumnRead& column, const std::string& cell, ColumnEvidence& evidence) {
  const bool is_size = Gives(column, kBodySize) || Gives(column, kBodyCylinder);
  if (!is_size && !Gives(column, kOfferPrice)) return NoteCell(cell, evidence);
  if (is_size) {
    const auto pieces = SizePieces(cell);
    const bool bare = FrontOf(pieces.back()).rest.empty();
    for (const std::string_view piece : pieces) {
      const std::size_t at = piece.find_first_of("0123456789");
      if (at != std::string_view::npos) NoteCell(std::string(piece.substr(at)), evidence);
    }
    if (!bare) evidence.bare.clear();
    return;
  }
  const Money money = MoneyOf(cell);
  NoteCell(money.number.digits, evidence);
  if (!money.currency.empty()) evidence.bare.clear();
}

void AskForDecimal(const ColumnRead& column, const std::string& why, TableReading& reading) {
  reading.questions.push_back(
      {"decimal", column.key, Shown(column.key) + ": " + why, {"point", "comma"}});
}

std::string EitherWay(const std::string& example) {
  return "is " + Shown(example) + " a number with decimals or with thousands?";
}

std::string Cut(const std::string& cell) {
  const std::string shown = Shown(cell);
  return cell.size() <= kSampleBytes ? cell : shown.substr(1, shown.size() - 2);
}

}  // namespace

void NoteCell(const std::string& cell, ColumnEvidence& evidence) {
  const CellNumber number = FrontOf(cell);
  if (number.digits.empty()) return;
  const auto show = [&](std::string& example) {
    if (example.empty()) example = cell.substr(0, kSampleBytes);
  };
  if (number.is_bare()) {
    show(evidence.bare);
    const auto value = ParseQuantity(number.digits, "").value;
    evidence.bare_least = std::min(evidence.bare_least, value.value_or(-HUGE_VAL));
    evidence.bare_most = std::max(evidence.bare_most, value.value_or(HUGE_VAL));
  }
  switch (EvidenceOf(number.digits)) {
    case Evidence::kPoint:
      return show(evidence.point);
    case Evidence::kComma:
      return show(evidence.comma);
    case Evidence::kEitherComma:
      return show(evidence.either_comma);
    case Evidence::kEitherPoint:
      return show(evidence.either_point);
    case Evidence::kNone:
    case Evidence::kBroken:
      return;
  }
}

std::vector<ColumnEvidence> LookAtCells(const Family& family, std::string_view text,
                                        TableReading& reading) {
  std::vector<ColumnEvidence> evidence(reading.columns.size());
  std::vector<bool> has_numbers;
  for (const ColumnRead& column : reading.columns)
    has_numbers.push_back(HasNumbers(family, column));
  const auto leave_out = [&](int row, const char* why) {
    if (++reading.left_out_count <= kRowsLeftOutShown) reading.left_out.push_back({row, why});
  };
  const auto take = [&](const CsvRow& cells, int row) {
    if (row == reading.header_row || CountFilled(cells) == 0) return;
    if (row < reading.header_row) return leave_out(row, "above the header");
    if (row == reading.units_row) return leave_out(row, "units of the columns");
    if (const char* why = WhyNoPart(family, reading.columns, cells)) return leave_out(row, why);
    for (std::size_t i = 0; i < std::min(cells.size(), evidence.size()); ++i) {
      if (IsBlank(cells[i])) continue;
      auto& samples = reading.columns[i].samples;
      if (samples.size() < kSamples) samples.push_back(Cut(cells[i]));
      if (has_numbers[i]) NoteCells(reading.columns[i], cells[i], evidence[i]);
    }
  };
  ForEachRow(
      text, take, [](const CsvError&) {}, DelimiterOf(reading.delimiter));
  return evidence;
}

void FindDecimals(const std::vector<ColumnEvidence>& evidence, const TableOptions& options,
                  TableReading& reading) {
  const auto any = [&](const std::string ColumnEvidence::*mark) {
    return std::any_of(evidence.begin(), evidence.end(),
                       [&](const ColumnEvidence& one) { return !(one.*mark).empty(); });
  };
  const bool like_commas =
      any(&ColumnEvidence::comma) || (reading.delimiter != "comma" && !any(&ColumnEvidence::point));
  for (std::size_t i = 0; i < evidence.size(); ++i) {
    const ColumnEvidence& shown = evidence[i];
    ColumnRead& column = reading.columns[i];
    column.has_decimals = !shown.point.empty() || !shown.comma.empty() ||
                          !shown.either_comma.empty() || !shown.either_point.empty();
    if (!options.decimal.empty()) {
      column.decimal = options.decimal == "comma" ? Decimal::kComma : Decimal::kPoint;
    } else if (!shown.point.empty() && !shown.comma.empty()) {
      AskForDecimal(column,
                    "has " + Shown(shown.point) + " and " + Shown(shown.comma) +
                        ": does a point or a comma stand before decimals?",
                    reading);
    } else if (!shown.comma.empty() || !shown.point.empty()) {
      column.decimal = shown.comma.empty() ? Decimal::kPoint : Decimal::kComma;
    } else if (!shown.either_comma.empty()) {
      AskForDecimal(column, EitherWay(shown.either_comma), reading);
    } else if (!shown.either_point.empty() && like_commas) {
      AskForDecimal(column, EitherWay(shown.either_point), reading);
    }
  }
}

// The only unit of volts with which all bare numbers are in the field's range; empty: there is not
// just one, or they are no voltages.
std::string OnlyVoltage(const NumberField& field, const ColumnEvidence& evidence) {
  if (UnitOf(field.name) != "V") return "";
  std::string only;
  const std::string units = UnitNames(field.name);
  for (std::string_view unit : Split(units, ',')) {
    unit = unit.substr(unit.find_first_not_of(' '));
    const auto in_range = [&](double bare) {
      const auto value =
          ParseQuantity(FormatNumber(bare) + " " + std::string(unit), field.name).value;
      return value && field.min <= *value && *value <= field.max;
    };
    if (!in_range(evidence.bare_least) || !in_range(evidence.bare_most)) continue;
    if (!only.empty()) return "";
    only = unit;
  }
  return only;
}

void AskForUnits(const Family& family, const std::vector<ColumnEvidence>& evidence,
                 TableReading& reading) {
  for (std::size_t i = 0; i < evidence.size(); ++i) {
    ColumnRead& column = reading.columns[i];
    if (evidence[i].bare.empty()) continue;
    for (Target& target : column.targets) {
      const bool needs_one = FindNumber(family, target.column) != nullptr && target.unit.empty() &&
                             !target.by_full_name;
      std::string_view field = target.column;
      if (target.notation)
        for (const FlowNotationSpec& spec : FlowNotations())
          if (spec.notation == *target.notation) field = spec.field;
      if (!needs_one || UnitOf(field).empty()) continue;
      if (target.unit = OnlyVoltage(*FindNumber(family, target.column), evidence[i]);
          !target.unit.empty())
        continue;
      Question question{"column", column.key, "", {}};
      question.text = Shown(column.key) + ": in which unit is " + Shown(evidence[i].bare) +
                      "? Units of " + target.column + " are " + UnitNames(field);
      const std::string units = UnitNames(field);
      for (const std::string_view unit : Split(units, ',')) {
        Target answer = target;
        answer.unit = unit.substr(unit.find_first_not_of(' '));
        question.answers.push_back(FormatTarget(answer));
      }
      reading.questions.push_back(std::move(question));
      break;
    }
  }
}

void AskForCurrency(const Family& family, const std::vector<ColumnEvidence>& evidence,
                    TableReading& reading) {
  const auto is_given = [&](std::string_view name) {
    return reading.set.contains(std::string(name)) ||
           std::any_of(reading.columns.begin(), reading.columns.end(),
                       [&](const ColumnRead& column) { return Gives(column, name); });
  };
  const bool by_length = FindNumber(family, "price_eur_per_m") != nullptr;
  for (std::size_t i = 0; i < evidence.size(); ++i) {
    const ColumnRead& column = reading.columns[i];
    for (const Target& target : column.targets) {
      if (target.column != kOfferPrice || column.samples.empty()) continue;
      const bool no_currency =
          target.unit.empty() && !evidence[i].bare.empty() && !is_given(kOfferCurrency);
      const bool no_length = by_length && !target.unit.ends_with("/m") && !is_given("offer_pack");
      if (!no_currency && !no_length) continue;
      Question question{"column", column.key, "", {}};
      question.text =
          Shown(column.key) + ": " +
          (no_currency ? "in which currency is " + Shown(evidence[i].bare) + "?"
                       : "is it the price of a metre? The metres of a roll go into offer_pack");
      const std::string code = CurrencyOf(target.unit);
      for (const std::string_view known : Currencies())
        if (code.empty() || code == known)
          question.answers.push_back("offer_price [" + std::string(known) +
                                     (no_length ? "/m]" : "]"));
      reading.questions.push_back(std::move(question));
    }
  }
}

}  // namespace plenum::catalog
