#include "renderer/measure/quality_choice.h"

#include "tests/support/images.h"
#include "tests/support/recipe_scene.h"

#include <algorithm>
#include <atomic>

#include <gtest/gtest.h>

namespace cellcut {
namespace {

class QualityChoiceTest : public testing::Test {
 protected:
  RenderSettings settingsWith(const SamplerSettings& sampler) const {
    return {.width = 64, .height = 36, .maxDepth = 2, .sampler = sampler, .seed = 5};
  }
  ImageRgb picture(Renderer& renderer) const { return test::renderPasses(renderer, 4); }
  void expectThePictureOf(Renderer& renderer, const SamplerSettings& sampler) const {
    Renderer pinned(scene_, settingsWith(sampler));
    const ImageRgb a = picture(renderer), b = picture(pinned);
    EXPECT_EQ(renderer.settings().sampler, sampler);
    EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end()));
  }
  Scene scene_ = test::recipeScene(Recipe::kKinds, 60);
};

TEST_F(QualityChoiceTest, BalancedIsTriedFirstAndEveryPresetIsTried) {
  const std::vector<Quality> all = autoQualities();
  EXPECT_EQ(all.front().settings, SamplerSettings{});
  for (const Quality& preset : kQualities) {
    EXPECT_TRUE(std::any_of(all.begin(), all.end(), [&](const Quality& q) { return q.settings == preset.settings; }));
  }
}

/// Whatever is chosen: that hangs on the clock.
TEST_F(QualityChoiceTest, PictureIsThatOfTheChosenSettings) {
  const std::vector<Quality> all = autoQualities();
  Renderer renderer(scene_, settingsWith(all.front().settings));
  const QualityChoice choice = chooseQuality(renderer, all, {.seconds = 10}, test::kNever);
  EXPECT_EQ(choice.trials.size(), all.size());
  EXPECT_EQ(renderer.film().passes(), 0u);
  EXPECT_GT(choice.seconds, 0);
  expectThePictureOf(renderer, choice.chosen.settings);
}

/// As when a dearer or cheaper setting wins.
TEST_F(QualityChoiceTest, AnotherRendererOfTheSceneMakesThePictureOfItsSettings) {
  Renderer first(scene_, settingsWith({}));
  picture(first);
  for (const Quality& quality : autoQualities()) {
    Renderer other(first, settingsWith(quality.settings));
    expectThePictureOf(other, quality.settings);
  }
}

TEST_F(QualityChoiceTest, SettingsThatAreTheSameForAStrategyAreOneAndNothingIsTried) {
  const std::vector<Quality> all = autoQualities();
  RenderSettings settings = settingsWith(all.front().settings);
  settings.strategy = Strategy::kPower;
  Renderer renderer(scene_, settings);
  const QualityChoice choice = chooseQuality(renderer, all, {.seconds = 100}, test::kNever);
  ASSERT_EQ(choice.trials.size(), 1u);
  EXPECT_EQ(choice.trials[0].passes, 0u);
  EXPECT_EQ(choice.chosen.name, "balanced");
}

TEST_F(QualityChoiceTest, CancelledTrialsLeaveBalanced) {
  const std::vector<Quality> all = autoQualities();
  Renderer renderer(scene_, settingsWith(all.front().settings));
  const std::atomic<bool> cancel = true;
  const QualityChoice choice = chooseQuality(renderer, all, {.seconds = 1e6}, cancel);
  EXPECT_EQ(choice.chosen.name, "balanced");
  EXPECT_EQ(choice.trials[0].passes, 0u);
}

TEST_F(QualityChoiceTest, APassThatIsOutOfTimeLeavesNoTrace) {
  Renderer renderer(scene_, settingsWith({}));
  EXPECT_FALSE(renderer.renderPass(test::kNever, 0));
  EXPECT_EQ(renderer.film().passes(), 0u);
  EXPECT_EQ(renderer.rays().camera, 0u);
  expectThePictureOf(renderer, {});
}

}  // namespace
}  // namespace cellcut
