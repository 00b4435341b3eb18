#include "catalog/tables/part_rows.h"

#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "catalog/fields/laws/printed_part.h"
#include "catalog/fields/list_cell.h"
#include "catalog/tables/heading_words.h"
#include "catalog/tables/layout.h"
#include "catalog/tables/printed/price_cells.h"
#include "catalog/tables/printed/printed_columns.h"
#include "catalog/units/quantity.h"
#include "catalog/units/text.h"

namespace plenum::catalog {
namespace {

constexpr std::size_t kIdLongest = 100;

std::string Trimmed(const std::string& cell) {
  constexpr std::string_view kBlanks = " \t\r\n";
  std::string_view text = cell;
  for (bool more = true; more;) {
    const std::size_t size = text.size();
    while (!text.empty() && kBlanks.find(text.front()) != std::string_view::npos)
      text.remove_prefix(1);
    while (!text.empty() && kBlanks.find(text.back()) != std::string_view::npos)
      text.remove_suffix(1);
    if (text.starts_with("\u00A0")) text.remove_prefix(2);
    if (text.ends_with("\u00A0")) text.remove_suffix(2);
    more = text.size() != size;
  }
  return std::string(text);
}

// "-" and the like, where a number should stand.
bool SaysNothing(std::string_view cell) {
  static constexpr std::string_view kNothing[] = {"-", "–", "—", "n/a", "N/A", "k.A.", "k. A."};
  return std::find(std::begin(kNothing), std::end(kNothing), cell) != std::end(kNothing);
}

std::string_view WordOf(FlowNotation notation) {
  const auto& specs = FlowNotations();
  return std::find_if(specs.begin(), specs.end(),
                      [&](const FlowNotationSpec& spec) { return spec.notation == notation; })
      ->word;
}

class RowMaker {
 public:
  RowMaker(const TableReading& reading, const TakeError& fail)
      : reading_(reading), family_(*FindFamily(reading.family)), fail_(fail) {
    FindGiven();
  }

  CsvRow Header() const {
    CsvRow header;
    for (const ColumnRead& column : reading_.columns)
      for (const Target& target : column.targets)
        if (FindPrinted(family_, target.column) == nullptr) header.push_back(target.column);
    for (const auto& [column, value] : reading_.set)
      if (FindPrinted(family_, column) == nullptr) header.push_back(column);
    header.insert(header.end(), given_.begin(), given_.end());
    if (reading_.makes_ids) header.emplace_back("id");
    return header;
  }

  // The cells of a row that may be a part.
  CsvRow Make(const CsvRow& cells, int row) {
    row_ = row;
    printed_.clear();
    CsvRow made;
    manufacturer_ = SetTo("manufacturer"), part_number_ = SetTo("part_number");
    for (std::size_t i = 0; i < reading_.columns.size(); ++i) {
      const std::string cell = i < cells.size() ? Trimmed(cells[i]) : "";
      for (const Target& target : reading_.columns[i].targets)
        if (FindPrinted(family_, target.column) != nullptr)
          KeepPrinted(reading_.columns[i], target, cell);
        else
          made.push_back(CellOf(reading_.columns[i], target, cell));
    }
    for (std::size_t i = reading_.columns.size(); i < cells.size(); ++i)
      if (!IsBlank(cells[i])) {
        fail_({row_, "column " + std::to_string(i + 1), "stands beyond the columns of the header"});
        break;
      }
    for (const auto& [column, value] : reading_.set)
      if (FindPrinted(family_, column) == nullptr)
        made.push_back(value);
      else
        KeepSet(column, value);
    for (const std::string& column : given_) made.push_back(CellFromPrinted(column, printed_));
    if (reading_.makes_ids) made.push_back(MadeId());
    return made;
  }

 private:
  std::string SetTo(const char* column) const {
    const auto found = reading_.set.find(column);
    return found == reading_.set.end() ? "" : found->second;
  }

  bool IsGiven(const std::string& column) const {
    for (const ColumnRead& read : reading_.columns)
      for (const Target& target : read.targets)
        if (target.column == column) return true;
    return false;
  }

  // The columns that come of printed ones, where the table does not give them itself.
  void FindGiven() {
    const auto note = [&](const std::string& name) {
      const PrintedColumn* printed = FindPrinted(family_, name);
      if (printed == nullptr) return;
      const std::string gives(printed->gives);
      if (!IsGiven(gives) && !reading_.set.contains(gives) &&
          std::find(given_.begin(), given_.end(), gives) == given_.end())
        given_.push_back(gives);
    };
    for (const ColumnRead& column : reading_.columns)
      for (const Target& target : column.targets) note(target.column);
    for (const auto& [column, value] : reading_.set) note(column);
  }

  void KeepPrinted(const ColumnRead& column, const Target& target, const std::string& cell) {
    if (cell.empty() || SaysNothing(cell)) return;
    if (target.column == kOfferPrice) return KeepPrice(column, target, cell);
    printed_[target.column] = PrintedOf(column, target, cell);
  }

  void KeepSet(const std::string& name, const std::string& value) {
    ColumnRead column;
    column.key = name;
    KeepPrinted(column, {name, ""}, value);
  }

  std::string PrintedOf(const ColumnRead& column, const Target& target, const std::string& cell) {
    if (target.column == kBodySize || target.column == kBodyCylinder)
      return SizeOf(column, target, cell);
    if (target.column == "c_rate") {
      const auto rate = WithPoint(FrontOf(cell).digits, column.decimal);
      return rate ? *rate + "C" : cell;
    }
    if (target.column == kOfferCurrency) {
      const std::string code = CurrencyOf(cell);
      return code.empty() ? cell : code;
    }
    if (target.column == "offer_pack") {
      const auto pack = PackOf(cell);
      if (!pack) fail_({row_, column.key, "must be a number of pieces, is " + Shown(cell)});
      return pack.value_or("");
    }
    if (target.column == "offer_date") {
      DateRead read = DateOf(cell);
      if (!read.error.empty()) fail_({row_, column.key, std::move(read.error)});
      return read.date;
    }
    return FindNumber(family_, target.column) != nullptr ? NumberOf(column, target, cell) : cell;
  }

  // "70,5x30x50" as "70.5 x 30 x 50 mm".
  std::string SizeOf(const ColumnRead& column, const Target& target, const std::string& cell) {
    std::string size, unit = target.unit.empty() ? "mm" : target.unit;
    for (std::string_view piece : SizePieces(cell)) {
      const bool round = piece.starts_with("⌀") || piece.starts_with("Ø") || piece.starts_with("ø");
      if (round) piece.remove_prefix(std::min(piece.find_first_of("0123456789.,"), piece.size()));
      const CellNumber number = FrontOf(piece);
      const auto digits = WithPoint(number.digits, column.decimal);
      if (number.digits.empty() || !digits) return cell;  // what ReadRows refuses
      if (!number.rest.empty()) unit = number.rest;
      size += (size.empty() ? "" : " x ") + std::string(round ? "⌀" : "") + *digits + number.tail;
    }
    const bool across = target.column == kBodyCylinder && !size.starts_with("⌀");
    return (across ? "⌀" : "") + size + " " + unit;
  }

  void KeepPrice(const ColumnRead& column, const Target& target, const std::string& cell) {
    const Money money = MoneyOf(cell);
    const auto price = WithPoint(money.number.digits, column.decimal);
    if (money.number.digits.empty() || !price) {
      fail_({row_, column.key, "must be a price, is " + Shown(cell)});
      return;
    }
    printed_[std::string(kOfferPrice)] = *price;
    // What stands in the cell wins over the heading's.
    std::string unit = target.unit.substr(0, target.unit.find('/'));
    const std::string currency = money.currency.empty() ? CurrencyOf(unit) : money.currency;
    if (!currency.empty()) printed_[std::string(kOfferCurrency)] = currency;
  }

  std::string CellOf(const ColumnRead& column, const Target& target, const std::string& cell) {
    if (FindNumber(family_, target.column) != nullptr)
      return NumberOf(column, target, EndOf(column, target, cell));
    if (target.column == "manufacturer") manufacturer_ = cell;
    if (target.column == "part_number") part_number_ = cell;
    if (cell.empty() || cell.front() == '[') return cell;
    if (target.column == "aliases") return "[" + QuoteJson(cell) + "]";
    if (target.column == "documents") return "[{\"link\":" + QuoteJson(cell) + "}]";
    return cell;
  }

  // Of "0.05 to 0.85 MPa" the end that the target asks for, where the column gives both.
  static std::string EndOf(const ColumnRead& column, const Target& target,
                           const std::string& cell) {
    if (column.targets.size() != 2 || !AreEnds(column.targets[0], column.targets[1])) return cell;
    for (const std::string_view mark : {" to ", " bis ", "...", "…", "..", "–", "~", " - ", "-"}) {
      const std::size_t at = cell.find(mark, 1);
      if (at == std::string::npos) continue;
      const std::string low = Trimmed(cell.substr(0, at)),
                        high = Trimmed(cell.substr(at + mark.size()));
      if (target == column.targets[1]) return high;
      const std::string unit(FrontOf(high).rest);
      return FrontOf(low).is_bare() && !unit.empty() ? low + " " + unit : low;
    }
    return cell;
  }

  std::string NumberOf(const ColumnRead& column, const Target& target, const std::string& cell) {
    if (cell.empty() || SaysNothing(cell)) return "";
    const CellNumber number = FrontOf(cell);
    if (number.digits.empty()) return cell;  // a printed flow, or what ReadRows refuses
    const auto digits = WithPoint(number.digits, column.decimal);
    if (!digits) {
      fail_({row_, column.key,
             Shown(cell) + " is not written with a decimal " +
                 (column.decimal == Decimal::kComma ? "comma" : "point")});
      return "";
    }
    std::string plain = (number.negative ? "-" : "") + *digits + number.tail;
    const std::string unit(number.rest.empty() ? std::string_view(target.unit) : number.rest);
    const std::string text = unit.empty() ? plain : plain + " " + unit;
    if (target.notation) return std::string(WordOf(*target.notation)) + " " + text;
    if (unit.empty() && number.tail.find('/') == std::string::npos) return plain;
    if (target.column == "capacity_ah" && PrintedEnergy(text)) return text;
    const Quantity quantity = ParseQuantity(text, target.column);
    if (quantity.value) return FormatNumber(*quantity.value);
    fail_({row_, column.key, quantity.error});
    return "";
  }

  // "smc-v114-5ls" of SMC, V114-5LS.
  std::string MadeId() const {
    if (part_number_.empty()) return "";
    std::string id;
    for (const char c : PlainWords(manufacturer_ + " " + part_number_))
      if (c != ' ' || (!id.empty() && id.back() != '-')) id += c == ' ' ? '-' : c;
    id.resize(std::min(id.size(), kIdLongest));
    while (!id.empty() && id.back() == '-') id.pop_back();
    return id;
  }

  const TableReading& reading_;
  const Family& family_;
  const TakeError& fail_;
  int row_ = 0;
  std::vector<std::string> given_;                           // columns that come of printed ones
  std::map<std::string, std::string, std::less<>> printed_;  // cells of the row
  std::string manufacturer_, part_number_;                   // of the row
};

}  // namespace

RowSource RowsOf(const TableReading& reading, std::string_view bytes) {
  if (reading.as_exported)
    return [bytes](const TakeRow& take, const TakeError& fail) { ForEachRow(bytes, take, fail); };
  const std::string_view text = reading.text.empty() ? bytes : reading.text;
  return [&reading, text](const TakeRow& take, const TakeError& fail) {
    const Family* family = FindFamily(reading.family);
    RowMaker maker(reading, fail);
    take(maker.Header(), reading.header_row);
    const auto take_part = [&](const CsvRow& cells, int row) {
      if (row <= std::max(reading.header_row, reading.units_row) || CountFilled(cells) == 0 ||
          WhyNoPart(*family, reading.columns, cells) != nullptr)
        return;
      take(maker.Make(cells, row), row);
    };
    ForEachRow(text, take_part, fail, DelimiterOf(reading.delimiter));
  };
}

std::string HeadingOf(const TableReading& reading, std::string_view column) {
  for (const ColumnRead& read : reading.columns)
    for (const Target& target : read.targets)
      if (target.column == column) return read.key;
  const Family* family = FindFamily(reading.family);
  for (const ColumnRead& read : reading.columns)
    for (const Target& target : read.targets)
      if (const PrintedColumn* printed = FindPrinted(*family, target.column))
        if (printed->gives == column) return read.key;
  return std::string(column);
}

}  // namespace plenum::catalog
