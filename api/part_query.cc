#include "api/part_query.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <variant>

#include "api/limits.h"
#include "api/services.h"
#include "api/text.h"
#include "catalog/fields.h"

namespace plenum::api {
namespace {

// Texts that every part has, beside its id.
const char* const kCommonTexts[] = {"family", "manufacturer", "part_number", "origin"};
// Of these a facet counts the values; part numbers are all different.
const char* const kFacetTexts[] = {"family", "manufacturer", "origin"};

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
  return vocabulary;
}

std::vector<std::string> KnownNames(const Vocabulary& vocabulary) {
  std::vector<std::string> names = {"limit", "cursor", "sort", "facets", "revision"};
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
    if (vocabulary_.texts.contains(name)) {
      result_.texts[name] = value;
      return;
    }
    if (!TakeNumber(name, value)) {
      const std::vector<std::string> known = KnownNames(vocabulary_);
      Fail(name, "unknown query parameter; nearest known: " + Nearest(name, known));
    }
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
    if (result_.sort == "id" || vocabulary_.texts.contains(result_.sort) ||
        vocabulary_.numbers.contains(result_.sort))
      return;
    std::vector<std::string> fields = {"id"};
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

const double* NumberOf(const catalog::Part& part, const std::string& field) {
  const auto found = part.numbers.find(field);
  return found == part.numbers.end() ? nullptr : &found->second.value;
}

const std::string* TextOf(const catalog::Part& part, const std::string& field) {
  if (field == "id") return &part.id;
  if (field == "family") return &part.family;
  if (field == "manufacturer") return &part.manufacturer;
  if (field == "part_number") return &part.part_number;
  if (field == "origin") return &part.origin;
  const auto found = part.texts.find(field);
  return found == part.texts.end() ? nullptr : &found->second.value;
}

bool Matches(const PartQuery& query, const catalog::Part& part) {
  for (const auto& [field, wanted] : query.texts) {
    const std::string* text = TextOf(part, field);
    if (text == nullptr || *text != wanted) return false;
  }
  for (const auto& [field, range] : query.numbers) {
    const double* number = NumberOf(part, field);
    if (number == nullptr || *number < range.min || *number > range.max) return false;
  }
  return true;
}

// Missing values last, in either order.
template <typename Value>
void SortBy(const PartQuery& query, std::vector<const catalog::Part*>& parts, const Value& value) {
  std::stable_sort(parts.begin(), parts.end(), [&](const auto* a, const auto* b) {
    const auto *x = value(*a, query.sort), *y = value(*b, query.sort);
    if (x == nullptr || y == nullptr) return x != nullptr && y == nullptr;
    return query.descending ? *y < *x : *x < *y;
  });
}

Json Facets(const std::vector<const catalog::Part*>& parts) {
  std::map<std::string, std::map<std::string, int>> texts;
  struct Spread {
    int count = 0;
    NumberRange range{std::numeric_limits<double>::infinity(),
                      -std::numeric_limits<double>::infinity()};
  };
  std::map<std::string, Spread> numbers;
  for (const catalog::Part* part : parts) {
    for (const char* field : kFacetTexts) ++texts[field][*TextOf(*part, field)];
    for (const auto& [field, text] : part->texts) ++texts[field][text.value];
    for (const auto& [field, number] : part->numbers) {
      Spread& spread = numbers[field];
      ++spread.count;
      spread.range.min = std::min(spread.range.min, number.value);
      spread.range.max = std::max(spread.range.max, number.value);
    }
  }
  Json facets = {{"texts", Json::object()}, {"numbers", Json::object()}};
  for (const auto& [field, counts] : texts)
    for (const auto& [value, count] : counts) facets["texts"][field][value] = count;
  for (const auto& [field, spread] : numbers)
    facets["numbers"][field] = {
        {"count", spread.count}, {"min", spread.range.min}, {"max", spread.range.max}};
  return facets;
}

}  // namespace

Parsed<PartQuery> ParsePartQuery(const std::multimap<std::string, std::string>& query) {
  Errors errors;
  PartQuery result = QueryReader(query, errors).Read();
  if (!errors.empty()) return errors;
  return result;
}

std::vector<const catalog::Part*> Select(const PartQuery& query,
                                         const std::vector<catalog::Part>& parts) {
  std::vector<const catalog::Part*> selected;
  for (const catalog::Part& part : parts)
    if (Matches(query, part)) selected.push_back(&part);
  // A field is either a number or a text; the other order leaves all parts where they are.
  SortBy(query, selected, TextOf);
  SortBy(query, selected, NumberOf);
  return selected;
}

Parsed<Json> RenderPage(const PartQuery& query, const catalog::Revision& revision,
                        const std::vector<catalog::Part>& parts) {
  const std::vector<const catalog::Part*> selected = Select(query, parts);
  auto begin = selected.begin();
  if (query.cursor) {
    begin = std::find_if(begin, selected.end(),
                         [&](const auto* part) { return part->id == query.cursor->id; });
    if (begin == selected.end())
      return Errors{{"/cursor", "is of another query: send the filters and the sort it came from"}};
    ++begin;
  }
  const auto end = selected.end() - begin > query.limit ? begin + query.limit : selected.end();
  Json page = {{"parts", Json::array()}, {"next_cursor", nullptr}, {"total", selected.size()}};
  for (auto part = begin; part != end; ++part) page["parts"].push_back(RenderPart(**part));
  if (end != selected.end())
    page["next_cursor"] = std::to_string(revision.number) + "." + (*(end - 1))->id;
  if (query.facets) page["facets"] = Facets(selected);
  page["catalogue_revision"] = RenderRevisionName(revision);
  return page;
}

}  // namespace plenum::api
