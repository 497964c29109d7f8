#include "renderer/base/error.h"

#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

TEST(Printable, KeepsWordsThatCanBeShown) {
  for (const std::string word : {"", "lamp", "Grün €", "\xfc"}) EXPECT_EQ(printable(word), word);
  EXPECT_EQ(printable(std::string(80, 'x')), std::string(80, 'x'));
}

TEST(Printable, HasNoControlCharacters) {
  EXPECT_EQ(printable(std::string("a\0\x1b[2J\n\x7f", 8)), "a??[2J??");
  EXPECT_EQ(printable("\xc2\x9bm\xc2\xa0"), "??m\xc2\xa0");  // U+009B is what ESC [ is; U+00A0 is a blank
}

TEST(Printable, IsShortAndCutsNoCharacterInHalf) {
  EXPECT_EQ(printable(std::string(81, 'x')), std::string(80, 'x') + "…");
  for (std::size_t before = 0; before < 4; ++before) {
    for (const std::string character : {"ü", "€", "😀"}) {
      std::string word(before, 'x');
      while (word.size() < 100) word += character;
      const std::size_t fit = (20 - before) / character.size();
      EXPECT_EQ(printable(word, 20), word.substr(0, before + fit * character.size()) + "…");
    }
  }
  EXPECT_EQ(printable(std::string(100, '\x80'), 20).size(), 17u + 3) << "no UTF-8";
  EXPECT_EQ(printable("ü", 0), "…");
  EXPECT_EQ(printable("ü", 1), "…");
}

}  // namespace
}  // namespace cellcut::test
