/// \file viewer_fixture.h
/// The viewer as its tests open and play it.
#pragma once

#include "renderer/base/error.h"
#include "renderer/scene/load_scene.h"
#include "tests/support/own_threads.h"
#include "tests/support/refusal.h"
#include "tests/support/scenes.h"
#include "tests/support/temporary_directory.h"
#include "ui/viewer/script.h"
#include "ui/viewer/viewer.h"

#include <fstream>
#include <memory>
#include <string>

#include <gtest/gtest.h>

namespace cellcut::test {

/// The viewer in memory on a small stage of all kinds of light, played by scripts as a person plays it.
class ViewerTest : public testing::Test {
 protected:
  ViewerTest() : window_(openWindow(WindowKind::kEgl, {.size = {400, 720}})), scene_(sceneOf(40)) { open({}); }
  ViewerOptions optionsOfTests(ViewerOptions options = {}) const {
    options.uiScale = 0.5f;  // all panels on a small picture, which llvmpipe draws quickly
    options.state.settings.maxDepth = 1;
    options.state.settings.threads = 2;
    options.state.passLimit = 2;
    options.saveFolder = folder_.path();
    return options;
  }
  void open(ViewerOptions options) {
    viewer_.reset();
    viewer_ = std::make_unique<Viewer>(
        *window_, scene_,
        [](const std::filesystem::path& file) { return std::make_shared<const Scene>(loadScene(file)); },
        optionsOfTests(std::move(options)));
  }
  static std::shared_ptr<const Scene> sceneOf(int lights) {
    return std::make_shared<const Scene>(stage(LightMix::kAll, lights, 3));
  }
  void play(const std::string& text) {
    const std::filesystem::path file = folder_ / "script.txt";
    std::ofstream(file) << text;
    playScript(readScript(file), folder_.path(), *viewer_, *window_);
  }
  std::string refusalOf(const std::string& text) {
    return test::refusalOf([&] { play(text); });
  }

  OnlyOwnThreads onlyOwnThreads_;
  TemporaryDirectory folder_;
  std::unique_ptr<Window> window_;
  std::shared_ptr<const Scene> scene_;
  std::unique_ptr<Viewer> viewer_;
};

}  // namespace cellcut::test
