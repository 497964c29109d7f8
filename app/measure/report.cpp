#include "app/measure/report.h"

#include "app/json_text.h"
#include "renderer/base/image_io.h"
#include "renderer/measure/flip.h"
#include "ui/overlays/colormap.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cellcut {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Source: RFC 4648, section 4.
std::string base64(std::span<const std::byte> bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8 | (k < count ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0u);
    }
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? kDigits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::string pngUrl(std::span<const std::byte> png) {
  return "data:image/png;base64," + base64(png);
}

std::string fileUrl(const fs::path& file) {
  constexpr std::uintmax_t kMostBytes = std::uintmax_t{1} << 30;
  return pngUrl(readFile(file, kMostBytes));
}

/// The colours that ꟻLIP's authors show it in.
std::string errorMapUrl(const Image<float>& error) {
  ImageRgba8 image(error.width(), error.height());
  for (std::size_t i = 0; i < error.size(); ++i) {
    const Rgb8 color = colorOf(Colormap::kMagma, error[i]);
    image[i] = {color.x, color.y, color.z, 255};
  }
  return pngUrl(encodePng(image));
}

struct Crop {
  int x, y, width, height;
};

/// Where the configurations' errors differ most: windows of an eighth of the picture's width, none over another.
std::vector<Crop> chooseCrops(const std::vector<Image<float>>& errors) {
  constexpr std::size_t kCrops = 3;
  if (errors.empty()) return {};
  const int side = std::max(1, std::min(errors[0].width() / 8, errors[0].height()));
  struct Scored {
    double score;
    Crop crop;
  };
  std::vector<Scored> all;
  for (int y = 0; y + side <= errors[0].height(); y += std::max(1, side / 2)) {
    for (int x = 0; x + side <= errors[0].width(); x += std::max(1, side / 2)) {
      double least = std::numeric_limits<double>::infinity(), most = 0;
      for (const Image<float>& error : errors) {
        double sum = 0;
        for (int j = y; j < y + side; ++j) {
          for (int i = x; i < x + side; ++i) sum += error.at(i, j);
        }
        least = std::min(least, sum);
        most = std::max(most, sum);
      }
      all.push_back({errors.size() > 1 ? most - least : most, {x, y, side, side}});
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const Scored& a, const Scored& b) { return a.score > b.score; });
  std::vector<Crop> chosen;
  for (const Scored& s : all) {
    const bool overlaps = std::any_of(chosen.begin(), chosen.end(), [&](const Crop& c) {
      return std::abs(c.x - s.crop.x) < side && std::abs(c.y - s.crop.y) < side;
    });
    if (!overlaps) chosen.push_back(s.crop);
    if (chosen.size() == kCrops) break;
  }
  return chosen;
}

/// Pictures and error maps of one case's base configurations.
Json caseImages(const Json& results, const std::string& caseName, const fs::path& images) {
  const fs::path referenceFile = images / (caseName + ".reference.exr");
  const ImageRgb reference = readImage(referenceFile);
  Json json{{"case", caseName},
            {"width", reference.width()},
            {"height", reference.height()},
            {"reference", fileUrl(images / (caseName + ".reference.png"))},
            {"configurations", Json::array()}};
  std::vector<Image<float>> errors;
  for (const Json& c : results.at("configurations")) {
    const std::string name = c.at("name");
    if (c.at("case") != caseName || !c.at("base").get<bool>() || !fs::exists(images / (name + ".exr"))) continue;
    errors.push_back(flipHdr(readImage(images / (name + ".exr")), reference));
    json["configurations"].push_back(
        {{"name", name}, {"picture", fileUrl(images / (name + ".png"))}, {"error", errorMapUrl(errors.back())}});
  }
  for (const Crop& c : chooseCrops(errors)) json["crops"].push_back({c.x, c.y, c.width, c.height});
  return json;
}

/// A text inside of a script element: nothing in it may end the element.
std::string scriptSafe(std::string text) {
  for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos; at += 6) text.replace(at, 1, "\\u003c");
  return text;
}

}  // namespace

std::string reportPage(const Json& results, const fs::path& folder) {
  Json data = results;
  data.erase("runs");  // the page shows what they say together
  data["images"] = Json::array();
  for (const Json& c : results.at("cases")) {
    const std::string name = c.at("name");
    if (fs::exists(folder / "images" / (name + ".reference.exr"))) {
      data["images"].push_back(caseImages(results, name, folder / "images"));
    }
  }
  constexpr std::string_view kPlace = "{\"place\":\"of the results\"}";
  std::string page(reportTemplate());
  const std::size_t at = page.find(kPlace);
  assert(at != std::string::npos);
  page.replace(at, kPlace.size(), scriptSafe(jsonText(data)));
  return page;
}

}  // namespace cellcut
