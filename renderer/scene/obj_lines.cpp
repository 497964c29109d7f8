#include "renderer/scene/obj_lines.h"

#include <algorithm>
#include <charconv>

namespace cellcut {
namespace {

constexpr std::string_view kBlanks = " \t";
constexpr std::string_view kLineEnds = "\r\n";

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

/// Calls visit(offset, line) for each line that is not empty.
template <class Visit>
void forEachLine(std::string_view text, const Visit& visit) {
  std::size_t begin = text.find_first_not_of(kLineEnds);
  while (begin != std::string_view::npos) {
    const std::size_t end = std::min(text.find_first_of(kLineEnds, begin), text.size());
    visit(begin, text.substr(begin, end - begin));
    begin = text.find_first_not_of(kLineEnds, end);
  }
}

bool isNumber(std::string_view word) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error != std::errc::invalid_argument && end == word.data() + word.size();  // one out of range is a number
}

bool isColor(std::string_view keyword) {
  return keyword == "Ka" || keyword == "Kd" || keyword == "Ks" || keyword == "Ke";
}

/// Options and name of a map, with three numbers after each of -o, -s and -t.
std::string withThreeNumbers(std::string_view map) {
  std::string plain;
  while (!trimmed(map).empty()) {
    const char* begin = map.data();
    const std::string_view word = takeWord(map);
    const bool isTriple = word == "-o" || word == "-s" || word == "-t";
    int missing = isTriple ? 3 : 0;
    for (std::string_view rest = map; missing > 0 && isNumber(takeWord(rest)); --missing) map = rest;
    plain.append(begin, map.data());
    for (; missing > 0; --missing) plain += word == "-s" ? " 1" : " 0";
  }
  return plain;
}

struct Numbers {
  int count = 0;  ///< of words before a comment
  bool areNumbers = true, areFinite = true;
};

Numbers readNumbers(std::string_view words) {
  words = words.substr(0, words.find('#'));
  Numbers numbers;
  for (std::string_view word = takeWord(words); !word.empty(); word = takeWord(words)) {
    ++numbers.count;
    numbers.areNumbers &= isNumber(word);
    numbers.areFinite &= word.find_first_of("nN") == std::string_view::npos;  // of nan and inf
  }
  return numbers;
}

}  // namespace

std::string_view unquoted(std::string_view name) {
  name = trimmed(name);
  const bool isQuoted = name.size() > 2 && name.front() == '"' && name.back() == '"';
  return isQuoted ? name.substr(1, name.size() - 2) : name;
}

std::string_view takeWord(std::string_view& line) {
  const std::size_t begin = std::min(line.find_first_not_of(kBlanks), line.size());
  const std::size_t end = std::min(line.find_first_of(kBlanks, begin), line.size());
  const std::string_view word = line.substr(begin, end - begin);
  line.remove_prefix(end);
  return word;
}

void joinContinuedLines(std::span<char> text) {
  // A byte order mark is no part of the first word.
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  if (std::string_view(text.data(), text.size()).starts_with(kMark)) std::fill_n(text.begin(), kMark.size(), ' ');

  bool isStart = true, isComment = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\n' || c == '\r') {
      isStart = true;
      isComment = false;
      continue;
    }
    if (isStart && c == '#') isComment = true;
    isStart = c == ' ' || c == '\t';  // of a word: a '#' inside of one is part of a name
    if (c != '\\' || isComment) continue;
    const std::string_view end(text.data() + i + 1, std::min<std::size_t>(2, text.size() - i - 1));
    if (end.empty() || kLineEnds.find(end[0]) == std::string_view::npos) continue;
    std::fill_n(text.begin() + static_cast<std::ptrdiff_t>(i), end == "\r\n" ? 3 : 2, ' ');
  }
}

ObjOutline readOutline(std::span<char> obj) {
  ObjOutline outline;
  forEachLine({obj.data(), obj.size()}, [&](std::size_t offset, std::string_view line) {
    std::string_view rest = line;
    const std::string_view keyword = takeWord(rest);
    if (keyword == "f") {
      const std::size_t comment = std::min(line.find('#'), line.size());
      std::fill_n(obj.begin() + static_cast<std::ptrdiff_t>(offset + comment), line.size() - comment, ' ');
    }
    if (keyword == "v" || keyword == "vn" || keyword == "vt") {
      outline.hasVertices |= keyword == "v";
      const Numbers numbers = readNumbers(rest);
      const bool isWhole = numbers.areNumbers && numbers.areFinite && numbers.count >= (keyword == "vt" ? 1 : 3);
      std::string& first = keyword == "v" && !numbers.areNumbers ? outline.unreadable : outline.doubtful;
      if (!isWhole && first.empty()) first = line;
    }
    if (keyword == "mtllib") outline.libraries.emplace_back(unquoted(rest));
    if (keyword == "s") outline.hasSmoothingGroups |= trimmed(rest) != "0" && trimmed(rest) != "off";
  });
  return outline;
}

PlainMtl plainMtl(std::string_view mtl) {
  PlainMtl plain;
  std::string& text = plain.text;
  bool isInMaterial = false, hasDiffuse = false, hasPicture = false;
  const auto endMaterial = [&] {
    if (isInMaterial && !hasDiffuse) text += hasPicture ? "Kd 1 1 1\n" : "Kd 0.8 0.8 0.8\n";
    hasDiffuse = hasPicture = false;
  };
  forEachLine(mtl, [&](std::size_t, std::string_view line) {
    std::string_view rest = line;
    const std::string_view keyword = takeWord(rest);
    std::string_view afterFirst = rest;
    const std::string_view first = takeWord(afterFirst);
    if (isColor(keyword)) afterFirst = afterFirst.substr(0, afterFirst.find('#'));
    hasDiffuse |= keyword == "Kd";
    hasPicture |= keyword == "map_Kd";
    if (keyword == "newmtl") {
      endMaterial();
      isInMaterial = true;
      text.append("newmtl ").append(std::to_string(plain.names.size()));
      plain.names.emplace_back(unquoted(rest));
    } else if (isColor(keyword) && isNumber(first) && trimmed(afterFirst).empty()) {
      for (const std::string_view word : {keyword, first, first, first}) text.append(word).append(" ");
    } else if (keyword.starts_with("map_")) {
      text.append(keyword).append(withThreeNumbers(rest));
    } else if (keyword != "d" || first != "-halo") {
      text.append(line);
    }
    text += '\n';
  });
  endMaterial();
  return plain;
}

}  // namespace cellcut
