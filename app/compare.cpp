/// The verb `compare`: two pictures → their error as JSON.
#include "app/command_line.h"
#include "app/json_text.h"
#include "app/numbers.h"
#include "app/verbs.h"
#include "renderer/base/error.h"
#include "renderer/base/image_io.h"
#include "renderer/measure/metrics.h"

#include <memory>

#include <CLI/CLI.hpp>

namespace cellcut {
namespace {

constexpr const char* kCompareExamples =
    "Prints JSON: mse, relmse (per channel (A-B)^2 / (B^2 + epsilon), averaged over channels and pixels), epsilon\n"
    "(0.01 times the squared mean of B), smape (|A-B| / (|A| + |B| + 0.01 times the mean of B)), flip (HDR-FLIP), "
    "flip_ldr\n"
    "(FLIP of the tone-mapped pictures), mean_a, mean_b, max_abs. B is the reference.\n"
    "\n"
    "Example:\n"
    "  cellcut compare noisy.exr reference.exr";

int comparePictures(const std::string& fileA, const std::string& fileB, const Console& console) {
  const ImageRgb a = readImage(fileA);
  const ImageRgb b = readImage(fileB);
  if (a.width() != b.width() || a.height() != b.height()) {
    throw InputError(fileA, "is " + sizeText(a.width(), a.height()) + " and " + fileB + " is " +
                                sizeText(b.width(), b.height()) + "; only equal sizes compare");
  }
  const ImageComparison c = compareImages(a, b);
  const nlohmann::ordered_json result = {{"mse", c.mse},      {"relmse", c.relmse}, {"epsilon", c.epsilon},
                                         {"smape", c.smape},  {"flip", c.flip},     {"flip_ldr", c.flipLdr},
                                         {"mean_a", c.meanA}, {"mean_b", c.meanB},  {"max_abs", c.maxAbs}};
  console.out << jsonText(result, 2) << '\n';
  return kDone;
}

}  // namespace

Verb addCompare(CLI::App& program) {
  struct Files {
    std::string a, b;
  };
  CLI::App* verb = program.add_subcommand("compare", "Print the error of a picture against a reference");
  const auto files = std::make_shared<Files>();
  verb->add_option("A", files->a, "Picture: .exr, .pfm or .hdr")->required()->type_name("");
  verb->add_option("B", files->b, "Reference of the same size")->required()->type_name("");
  verb->footer(kCompareExamples);
  return {verb, [files](const Console& console) { return comparePictures(files->a, files->b, console); }};
}

}  // namespace cellcut
