#include "api/catalogue/part_query.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <set>
#include <variant>

#include "api/catalogue/part_document.h"
#include "api/catalogue/part_facets.h"
#include "api/json/json.h"
#include "api/json/request_limits.h"
#include "api/json/words.h"
#include "catalog/fields/fields.h"
#include "catalog/store/store.h"

namespace plenum::api {
namespace {

// Texts that parts of every family may have, beside their id and the derived flags of the table.
const char* const kCommonTexts[] = {"family", "manufacturer", "part_number",
                                    "origin", "series",       "orderable"};
constexpr std::string_view kByMatch = "match";

// Field names of one family, or of all.
struct Vocabulary {
  std::set<std::string, std::less<>> numbers, texts;
};

Vocabulary VocabularyOf(const std::optional<std::string>& family) {
  Vocabulary vocabulary;
  for (const catalog::Family& known : catalog::Families()) {
    if (family && known.name != *family) continue;
    for (const catalog::NumberField& field : known.numbers) vocabulary.numbers.emplace(field.name);
    for (const catalog::TextField& field : known.texts) vocabulary.texts.emplace(field.name);
  }
  for (const char* field : kCommonTexts) vocabulary.texts.emplace(field);
  for (const std::string_view flag : DerivedFlags()) vocabulary.texts.emplace(flag);
  for (const std::string_view share : ProvenanceShares()) vocabulary.numbers.emplace(share);
  return vocabulary;
}

std::vector<std::string> KnownNames(const Vocabulary& vocabulary) {
  std::vector<std::string> names = {"q", "limit", "cursor", "sort", "facets", "revision"};
  for (const std::string& field : vocabulary.texts) names.push_back(field);
  for (const std::string& field : vocabulary.numbers)
    for (const char* suffix : {"_min", "_max", ""}) names.push_back(field + suffix);
  return names;
}

template <typename Number>
std::optional<Number> Whole(std::string_view text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

// Takes the parameters one by one; collects what is wrong.
class QueryReader {
 public:
  QueryReader(const std::multimap<std::string, std::string>& query, Errors& errors)
      : query_(query), errors_(errors) {}

  PartQuery Read() {
    const auto family = query_.find("family");
    if (family != query_.end() && catalog::FindFamily(family->second) != nullptr)
      vocabulary_ = VocabularyOf(family->second);
    for (auto it = query_.begin(); it != query_.end(); it = query_.upper_bound(it->first)) {
      if (query_.count(it->first) > 1)
        Fail(it->first, "query parameter given more than once");
      else
        Take(it->first, it->second);
    }
    for (const auto& [field, range] : result_.numbers)
      if (range.min > range.max)
        Fail(field + "_min", "must be at most " + field + "_max, " + Decimal(range.max) + ", not " +
                                 Decimal(range.min));
    if (!result_.search.empty() && query_.count("sort") == 0) result_.sort = kByMatch;
    const auto& cursor = result_.cursor;
    if (cursor && result_.revision && *result_.revision != cursor->revision)
      Fail("revision", "must be that of the cursor, " + std::to_string(cursor->revision));
    return std::move(result_);
  }

 private:
  void Fail(const std::string& name, std::string detail) {
    errors_.push_back({"/" + EscapePointer(Clip(name, 200)), std::move(detail)});
  }

  void Take(const std::string& name, const std::string& value) {
    if (name == "q") return TakeSearch(value);
    if (name == "limit") return TakeLimit(value);
    if (name == "cursor") return TakeCursor(value);
    if (name == "sort") return TakeSort(value);
    if (name == "facets") return TakeFacets(value);
    if (name == "revision") return TakeRevision(value);
    if (name == "family" && catalog::FindFamily(value) == nullptr) {
      std::vector<std::string> names;
      for (const catalog::Family& known : catalog::Families()) names.emplace_back(known.name);
      return Fail(name, "must be " + OneOf(names) + ", not " + Quoted(value));
    }
    if (IsFlag(name) && value != "true" && value != "false")
      return Fail(name, "must be true or false, not " + Quoted(value));
    if (vocabulary_.texts.contains(name)) {
      result_.texts[name] = value;
      return;
    }
    if (!TakeNumber(name, value)) {
      const std::vector<std::string> known = KnownNames(vocabulary_);
      Fail(name, "unknown query parameter; nearest known: " + Nearest(name, known));
    }
  }

  static bool IsFlag(const std::string& name) {
    const auto flags = DerivedFlags();
    return name == "orderable" || std::find(flags.begin(), flags.end(), name) != flags.end();
  }

  void TakeSearch(const std::string& value) {
    result_.search = value;
    if (value.size() > kSearchBytesMax)
      Fail("q", "must have at most " + std::to_string(kSearchBytesMax) + " bytes, not " +
                    std::to_string(value.size()));
  }

  // A field's own name comes first: duty_max is a field, duty_max_max its upper limit.
  bool TakeNumber(const std::string& name, const std::string& value) {
    std::string field = name;
    const bool equal = vocabulary_.numbers.contains(name);
    const bool min = name.ends_with("_min"), max = name.ends_with("_max");
    if (!equal) {
      if (!min && !max) return false;
      field.resize(field.size() - 4);
      if (!vocabulary_.numbers.contains(field)) return false;
    }
    const auto number = Whole<double>(value);
    if (!number || !std::isfinite(*number)) {
      Fail(name, "must be a finite number, not " + Quoted(value));
      return true;
    }
    NumberRange& range = result_.numbers[field];
    if (equal || min) range.min = std::max(range.min, *number);
    if (equal || max) range.max = std::min(range.max, *number);
    return true;
  }

  void TakeLimit(const std::string& value) {
    const auto limit = Whole<int>(value);
    if (limit && *limit >= 1 && *limit <= kPageMax)
      result_.limit = *limit;
    else
      Fail("limit",
           "must be an integer ≥ 1 and ≤ " + std::to_string(kPageMax) + ", not " + Quoted(value));
  }

  void TakeCursor(const std::string& value) {
    if (value.empty()) return;
    const std::size_t dot = value.find('.');
    const auto revision = Whole<std::int64_t>(std::string_view(value).substr(0, dot));
    if (dot != std::string::npos && revision && *revision >= 0)
      result_.cursor = Cursor{*revision, value.substr(dot + 1)};
    else
      Fail("cursor", "must be the next_cursor of the page before, not " + Quoted(value));
  }

  void TakeSort(const std::string& value) {
    result_.descending = value.starts_with('-');
    result_.sort = value.substr(result_.descending ? 1 : 0);
    if (result_.sort == "id" || result_.sort == kByMatch ||
        vocabulary_.texts.contains(result_.sort) || vocabulary_.numbers.contains(result_.sort))
      return;
    std::vector<std::string> fields = {"id", std::string(kByMatch)};
    fields.insert(fields.end(), vocabulary_.texts.begin(), vocabulary_.texts.end());
    fields.insert(fields.end(), vocabulary_.numbers.begin(), vocabulary_.numbers.end());
    Fail("sort", "must be a field, with - before it for the opposite order, not " + Quoted(value) +
                     "; nearest known: " + Nearest(result_.sort, fields));
  }

  void TakeFacets(const std::string& value) {
    result_.facets = value == "true";
    if (!result_.facets && value != "false")
      Fail("facets", "must be true or false, not " + Quoted(value));
  }

  void TakeRevision(const std::string& value) {
    result_.revision = Whole<std::int64_t>(value);
    if (!result_.revision || *result_.revision < 0)
      Fail("revision", "must be the number of a revision, not " + Quoted(value));
  }

  const std::multimap<std::string, std::string>& query_;
  Errors& errors_;
  Vocabulary vocabulary_ = VocabularyOf(std::nullopt);
  PartQuery result_;
};

// Places of parts in the table.
using RowNumbers = std::vector<std::uint32_t>;

template <typename Keep>
void Filter(RowNumbers& rows, const Keep& keep) {
  std::erase_if(rows, [&](std::uint32_t row) { return !keep(row); });
}

using Grades = std::vector<std::uint8_t>;  // of all parts, by row

// In order of id.
RowNumbers Matching(const PartQuery& query, const Grades& grades, const PartTable& table) {
  RowNumbers rows(table.rows().size());
  std::iota(rows.begin(), rows.end(), 0u);
  if (!query.search.empty())
    Filter(rows, [&](std::uint32_t row) { return grades[row] != kNotFound; });
  for (const auto& [field, wanted] : query.texts) {
    const TextColumn* column = table.Texts(field);
    if (column == nullptr) return {};
    const auto found = std::lower_bound(column->values.begin(), column->values.end(), wanted);
    if (found == column->values.end() || *found != wanted) return {};
    const auto place = static_cast<std::uint32_t>(found - column->values.begin());
    Filter(rows, [&](std::uint32_t row) { return column->place[row] == place; });
  }
  for (const auto& [field, range] : query.numbers) {
    const std::vector<double>* column = table.Numbers(field);
    if (column == nullptr) return {};
    Filter(rows, [column, wanted = range](std::uint32_t row) {  // false for NaN
      return (*column)[row] >= wanted.min && (*column)[row] <= wanted.max;
    });
  }
  return rows;
}

// None where nothing is searched for.
Grades GradesOf(const PartQuery& query, const PartTable& table) {
  return query.search.empty() ? Grades() : table.rows().Search(query.search);
}

// The order that the query asks for: by its field, missing values last in either order, equal ones
// by id; or by how well parts match, the best first. No two parts are equal in it.
class Order {
 public:
  Order(const PartQuery& query, const Grades& grades, const PartTable& table)
      : descending_(query.descending),
        by_id_(query.sort == "id"),
        grades_(query.sort == kByMatch && !grades.empty() ? &grades : nullptr),
        numbers_(table.Numbers(query.sort)),
        texts_(table.Texts(query.sort)) {}

  bool operator()(std::uint32_t a, std::uint32_t b) const {
    if (by_id_) return descending_ ? b < a : a < b;
    if (grades_ != nullptr) {
      const std::uint8_t x = (*grades_)[a], y = (*grades_)[b];
      return x == y ? a < b : (x > y) != descending_;
    }
    if (numbers_ != nullptr) {
      const double x = (*numbers_)[a], y = (*numbers_)[b];
      if (std::isnan(x) || std::isnan(y))
        return std::isnan(x) == std::isnan(y) ? a < b : std::isnan(y);
      return x == y ? a < b : (x < y) != descending_;
    }
    if (texts_ == nullptr) return a < b;
    const std::uint32_t x = texts_->place[a], y = texts_->place[b];
    if (x == TextColumn::kNone || y == TextColumn::kNone)
      return x == y ? a < b : y == TextColumn::kNone;
    return x == y ? a < b : (x < y) != descending_;
  }

 private:
  bool descending_, by_id_;
  const Grades* grades_;
  const std::vector<double>* numbers_;
  const TextColumn* texts_;
};

// The row of a cursor's part among those that match.
std::optional<std::uint32_t> RowOf(const std::string& id, const RowNumbers& matching,
                                   const PartTable& table) {
  const auto found = std::lower_bound(
      matching.begin(), matching.end(), id,
      [&](std::uint32_t row, const std::string& wanted) { return table.rows()[row].id < wanted; });
  if (found == matching.end() || table.rows()[*found].id != id) return std::nullopt;
  return *found;
}

std::string TextOf(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

Parsed<PartQuery> ParsePartQuery(const std::multimap<std::string, std::string>& query) {
  Errors errors;
  PartQuery result = QueryReader(query, errors).Read();
  if (!errors.empty()) return errors;
  return result;
}

std::vector<const catalog::Part*> Select(const PartQuery& query, const PartTable& table) {
  const Grades grades = GradesOf(query, table);
  RowNumbers rows = Matching(query, grades, table);
  std::sort(rows.begin(), rows.end(), Order(query, grades, table));
  std::vector<const catalog::Part*> selected;
  for (const std::uint32_t row : rows) selected.push_back(&table.rows()[row]);
  return selected;
}

Json FacetsOf(const PartQuery& query, const PartTable& table) {
  return RenderFacets(Matching(query, GradesOf(query, table), table), table);
}

namespace {

// "; nearest known: mass_kg": the shortest that begins with the name, else the nearest of a name
// that is long enough to be a misspelling; else what there is.
std::string Neighbour(const std::string& name, const std::vector<std::string>& known) {
  std::string begun;
  for (const std::string& one : known)
    if (!name.empty() && one.starts_with(name) && (begun.empty() || one.size() < begun.size()))
      begun = one;
  if (!begun.empty()) return "; nearest known: " + begun;
  constexpr std::size_t kLongEnough = 3;
  if (name.size() >= kLongEnough) return "; nearest known: " + Nearest(name, known);
  std::string all;
  for (const std::string& one : known) all += (all.empty() ? "" : ", ") + one;
  return "; fields are " + all;
}

}  // namespace

Errors CheckColumns(const std::vector<std::string>& columns,
                    const std::optional<std::string>& family) {
  const Vocabulary vocabulary = VocabularyOf(family);
  std::vector<std::string> known = {"id", "documents"};
  known.insert(known.end(), vocabulary.texts.begin(), vocabulary.texts.end());
  known.insert(known.end(), vocabulary.numbers.begin(), vocabulary.numbers.end());
  Errors errors;
  for (const std::string& column : columns)
    if (std::find(known.begin(), known.end(), column) == known.end())
      errors.push_back(
          {"/columns", Quoted(Clip(column)) + " is no field" + Neighbour(column, known)});
  return errors;
}

Parsed<std::string> RenderPage(const PartQuery& query, const catalog::Revision& revision,
                               const PartTable& table) {
  const Grades grades = GradesOf(query, table);
  const RowNumbers matching = Matching(query, grades, table);
  const Order order(query, grades, table);
  RowNumbers rows = matching;
  if (query.cursor) {
    const auto last = RowOf(query.cursor->id, matching, table);
    if (!last)
      return Errors{{"/cursor", "is of another query: send the filters and the sort it came from"}};
    Filter(rows, [&](std::uint32_t row) { return order(*last, row); });
  }
  const std::size_t shown = std::min<std::size_t>(rows.size(), query.limit);
  std::partial_sort(rows.begin(), rows.begin() + shown, rows.end(), order);

  std::string parts;
  for (std::size_t i = 0; i < shown; ++i)
    parts += (i == 0 ? "" : ",") + TextOf(RenderPart(table.rows()[rows[i]]));
  Json page = {{"next_cursor", nullptr}, {"total", matching.size()}};
  if (shown < rows.size())
    page["next_cursor"] = std::to_string(revision.number) + "." + table.rows()[rows[shown - 1]].id;
  if (query.facets) page["facets"] = RenderFacets(matching, table);
  page["catalogue_revision"] = RenderRevisionName(revision);
  return "{\"parts\":[" + parts + "]," + TextOf(page).substr(1);
}

}  // namespace plenum::api
