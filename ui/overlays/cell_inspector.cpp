#include "ui/overlays/cell_inspector.h"

#include "renderer/scene/camera.h"

#include <cassert>

#include <nlohmann/json.hpp>

namespace cellcut {
namespace {

using Json = nlohmann::ordered_json;

void readFilm(const InspectionInputs& inputs, PixelReport& report) {
  const auto [x, y] = std::pair(report.pixel.x, report.pixel.y);
  report.samples = inputs.passes;
  if (inputs.mean) report.radiance = inputs.mean->at(x, y);
  if (inputs.standardError && inputs.passes >= 2) {
    const glm::dvec3 error(inputs.standardError->at(x, y));
    report.variance = static_cast<double>(inputs.passes) * glm::dot(error, error) / 3;
  }
}

/// Shares and mismatches from the contributions of all rows.
void compare(PixelReport& report) {
  for (const ClusterRow& row : report.clusters) {
    report.unoccluded += row.contribution.unoccluded;
    report.visible += row.contribution.visible;
  }
  double sum = 0;
  for (ClusterRow& row : report.clusters) {
    if (report.visible > 0) row.share = row.contribution.visible / report.visible;
    row.mismatch = row.cluster.probability - row.share;
    sum += std::abs(row.mismatch);
  }
  if (report.visible > 0) report.distance = 0.5 * sum;
}

Json toJson(const Vec3& v) {
  return {v.x, v.y, v.z};
}
Json toJson(const Bounds& box) {
  return box.empty() ? Json(nullptr) : Json{toJson(box.lower), toJson(box.upper)};
}
template <class T>
Json orNull(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json toJson(const ClusterRow& row) {
  const ClusterInspection& c = row.cluster;
  Json json{{"kind", c.distant ? "distant" : "local"}, {"lights", c.lightCount}, {"depth", c.depth}};
  if (c.distant) {
    json["direction"] = toJson(c.directions.axis);
    json["cos_half_angle"] = c.directions.cosTheta;
  } else {
    json["box"] = toJson(c.box);
  }
  json["estimate"] = c.estimate;
  json["probability"] = c.probability;
  json["unoccluded"] = row.contribution.unoccluded;
  json["visible"] = row.contribution.visible;
  json["share"] = row.share;
  json["mismatch"] = row.mismatch;
  return json;
}

Json cutToJson(const PixelReport& report) {
  Json cut{{"cell", nullptr},
           {"coarse", nullptr},
           {"box", toJson(report.cellBox)},
           {"touched", report.kept},
           {"visits", report.visits},
           {"size", report.clusters.size()},
           {"unoccluded", report.unoccluded},
           {"visible", report.visible},
           {"distance", orNull(report.distance)},
           {"mirrored", report.mirrored},
           {"clusters", Json::array()}};
  if (report.cell) {
    cut["cell"] = {report.cell->x, report.cell->y, report.cell->z};
    cut["coarse"] = report.cell->coarse;
  }
  for (const ClusterRow& row : report.clusters) cut["clusters"].push_back(toJson(row));
  return cut;
}

}  // namespace

std::optional<PixelReport> inspectPixel(const InspectionInputs& inputs, glm::ivec2 pixel, int samplesPerSide,
                                        const std::atomic<bool>& cancel) {
  assert(pixel.x >= 0 && pixel.y >= 0 && pixel.x < inputs.size.x && pixel.y < inputs.size.y);
  PixelReport report{.pixel = pixel};
  readFilm(inputs, report);
  report.hit = firstHit(inputs.scene, inputs.accel, cameraRay(inputs.camera, Vec2(pixel) + Vec2(0.5f), inputs.size));
  const std::optional<CutInspector> inspector = CutInspector::of(inputs.sampler);
  report.hasCut = inspector.has_value();
  if (!report.hit.hit() || !inspector) return report;

  const CutInspection cut = inspector->inspect(report.hit.point);
  report.mirrored = inspector->mirroredShare(report.hit.point);
  report.cell = cut.cell;
  report.cellBox = cut.cellBox;
  report.kept = cut.kept;
  report.visits = cut.visits;
  for (const ClusterInspection& cluster : cut.clusters) {
    ClusterRow& row =
        report.clusters.emplace_back(ClusterRow{.cluster = cluster, .lights = inspector->lights(cluster)});
    for (const LightId light : row.lights) {
      if (cancel.load(std::memory_order_relaxed)) return std::nullopt;
      const Contribution one = contributionOf(inputs.lights, inputs.accel, light, report.hit, samplesPerSide);
      row.contribution.unoccluded += one.unoccluded;
      row.contribution.visible += one.visible;
    }
  }
  compare(report);
  return report;
}

Json toJson(const PixelReport& report) {
  Json json{{"pixel", {report.pixel.x, report.pixel.y}}, {"samples", report.samples}};
  json["radiance"] = report.radiance ? toJson(*report.radiance) : Json(nullptr);
  json["variance"] = orNull(report.variance);
  json["hit"] = nullptr;
  if (report.hit.hit()) {
    json["hit"] = {{"point", toJson(report.hit.point.p)},
                   {"normal", toJson(report.hit.point.n)},
                   {"distance", report.hit.distance}};
  }
  json["cut"] = report.hasCut && report.hit.hit() ? cutToJson(report) : Json(nullptr);
  return json;
}

}  // namespace cellcut
