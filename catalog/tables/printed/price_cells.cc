#include "catalog/tables/printed/price_cells.h"

#include <algorithm>
#include <cctype>
#include <utility>
#include <vector>

#include "catalog/fields/price.h"
#include "catalog/tables/heading_phrases.h"
#include "catalog/units/text.h"

namespace plenum::catalog {
namespace {

constexpr std::pair<std::string_view, std::string_view> kSigns[] = {
    {"€", "EUR"},   {"EURO", "EUR"}, {"$", "USD"},  {"US$", "USD"}, {"USD$", "USD"},
    {"C$", "CAD"},  {"CA$", "CAD"},  {"A$", "AUD"}, {"AU$", "AUD"}, {"£", "GBP"},
    {"FR.", "CHF"}, {"SFR.", "CHF"}, {"฿", "THB"},  {"RMB", "CNY"}, {"CN¥", "CNY"},
    {"JP¥", "JPY"}, {"元", "CNY"},   {"円", "JPY"}};
constexpr std::string_view kMonths[] = {"jan", "feb", "mar", "apr", "may", "jun",
                                        "jul", "aug", "sep", "oct", "nov", "dec"};

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

std::string Upper(std::string_view text) {
  std::string upper(text);
  for (char& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return upper;
}

// The pieces of digits and of letters, without what stands between them.
std::vector<std::string> Words(std::string_view text) {
  std::vector<std::string> words;
  bool joined = false, digits = false;
  for (const char c : text) {
    const bool is_digit = IsDigit(c);
    const bool is_word = is_digit || std::isalpha(static_cast<unsigned char>(c)) != 0;
    if (is_word && (!joined || is_digit != digits)) words.emplace_back();
    if (is_word) words.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    joined = is_word;
    digits = is_digit;
  }
  return words;
}

bool AreDigits(std::string_view text) { return std::all_of(text.begin(), text.end(), IsDigit); }

int MonthOf(const std::string& word) {
  for (std::size_t i = 0; i < std::size(kMonths); ++i)
    if (word.starts_with(kMonths[i])) return static_cast<int>(i) + 1;
  return word.starts_with("okt")   ? 10
         : word.starts_with("dez") ? 12
         : word.starts_with("mai") ? 5
                                   : 0;
}

std::string Two(int number) { return (number < 10 ? "0" : "") + std::to_string(number); }

std::string Iso(const std::string& year, int month, int day) {
  return year + "-" + Two(month) + "-" + Two(day);
}

}  // namespace

std::string CurrencyOf(std::string_view text) {
  text = Trimmed(text);
  if (text.ends_with("/m")) text.remove_suffix(2);
  const std::string upper = Upper(Trimmed(text));
  const auto known = Currencies();
  if (std::find(known.begin(), known.end(), upper) != known.end()) return upper;
  for (const auto& [sign, code] : kSigns)
    if (upper == sign) return std::string(code);
  return "";
}

Money MoneyOf(std::string_view cell) {
  cell = Trimmed(cell);
  Money money;
  const std::size_t at = cell.find_first_of("0123456789");
  if (at == std::string_view::npos) return money;
  std::string_view before = Trimmed(cell.substr(0, at));
  if (before.ends_with(".") && before != "Fr." && before != "fr.") before.remove_suffix(1);
  money.number = FrontOf(cell.substr(at));
  std::string_view behind = money.number.rest;
  if (behind == ".-" || behind == ",-" || behind == ".–") behind = "";
  const std::string_view given = before.empty() ? behind : before;
  money.currency = given.empty() ? "" : CurrencyOf(given);
  if (money.currency.empty()) money.currency = given;
  return money;
}

std::optional<std::string> PackOf(std::string_view cell) {
  std::optional<std::string> pack;
  for (const std::string& word : Words(cell)) {
    if (!AreDigits(word)) continue;
    if (pack) return std::nullopt;
    pack = word;
  }
  return pack && *pack != "0" ? pack : std::nullopt;
}

DateRead DateOf(std::string_view cell) {
  const std::string wanted =
      "must be a date like 2024-05-31, 2024-05 or 31.05.2024; is " + Shown(cell);
  std::vector<std::string> words = Words(cell);
  if (words.size() > 3 && Trimmed(cell).find(':') != std::string_view::npos) words.resize(3);
  const auto number = [&](std::size_t i) {
    return AreDigits(words[i]) && words[i].size() <= 4 ? std::atoi(words[i].c_str()) : 0;
  };
  const auto is_year = [&](std::size_t i) { return AreDigits(words[i]) && words[i].size() == 4; };
  if (words.size() == 1 && is_year(0)) return {words[0], ""};
  if (words.size() == 2 && is_year(0) && number(1) > 0)
    return {words[0] + "-" + Two(number(1)), ""};
  if (words.size() == 2 && is_year(1)) {
    const int month = number(0) > 0 ? number(0) : MonthOf(words[0]);
    return month > 0 ? DateRead{words[1] + "-" + Two(month), ""} : DateRead{"", wanted};
  }
  if (words.size() != 3) return {"", wanted};
  if (is_year(0) && number(1) > 0 && number(2) > 0)
    return {Iso(words[0], number(1), number(2)), ""};
  if (!is_year(2)) return {"", wanted};
  if (const int month = MonthOf(words[1]); month > 0 && number(0) > 0)
    return {Iso(words[2], month, number(0)), ""};
  if (const int month = MonthOf(words[0]); month > 0 && number(1) > 0)
    return {Iso(words[2], month, number(1)), ""};
  const int first = number(0), second = number(1);
  if (first == 0 || second == 0) return {"", wanted};
  if (cell.find('.') != std::string_view::npos || first > 12 || first == second)
    return {Iso(words[2], second, first), ""};
  if (second > 12) return {Iso(words[2], first, second), ""};
  return {"", "is the month before or behind the day? Write it like 2024-05-31; is " + Shown(cell)};
}

}  // namespace plenum::catalog
