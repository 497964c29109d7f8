#include "renderer/trace/integrator.h"

#include "renderer/base/capabilities.h"
#include "renderer/trace/light_mask.h"
#include "renderer/trace/surface.h"

#include <array>
#include <cassert>

namespace cellcut {
namespace {

/// From this vertex on a path survives with the probability of its throughput. Two free bounces keep the variance of
/// what is seen first low.
constexpr int kRouletteDepth = 2;

/// Weight of a sample of density a against a strategy of density b. Source: Veach 1997, power heuristic, β = 2; as a
/// ratio, so that no square overflows.
float powerHeuristic(float a, float b) {
  const float ratio = b / a;
  return 1 / (1 + ratio * ratio);
}

/// A path vertex that scatters.
struct Vertex {
  SurfacePoint surface;
  Vec3 normal;  ///< geometric, on the side of wo
  Frame frame;  ///< around the shading normal
  Vec3 wo;      ///< in the frame
  Bsdf bsdf;
  GlossyLobe lobe;
  bool indirect;

  ShadingPoint shadingPoint() const { return {surface.p, frame.z, lobe, indirect}; }
  /// Cosine-weighted BSDF towards a world direction with the density that sampleBsdf has for it; 0 through the surface.
  Bsdf::Value scattering(const Vec3& direction) const {
    if (!(glm::dot(direction, normal) > 0)) return {};
    const Vec3 wi = frame.toLocal(direction);
    Bsdf::Value scattering = bsdf.eval(wo, wi);
    scattering.value *= wi.z;
    return scattering;
  }
};

/// \param outgoing  unit, world space, away from the surface
/// \param indirect  not the first of its path
Vertex makeVertex(const PathContext& context, const SurfacePoint& surface, const Vec3& outgoing, bool indirect) {
  const Scene& scene = context.scene;
  const Vec3 normal = glm::dot(surface.normal, outgoing) < 0 ? -surface.normal : surface.normal;
  const Frame frame(shadingNormalTowards(scene, surface.at, normal, outgoing));
  Vertex vertex{surface, normal, frame, frame.toLocal(outgoing), bsdfAt(scene, surface.at), {}, indirect};
  if (context.sampler.usesLobe()) vertex.lobe = lobeOf(vertex.bsdf, frame, outgoing);
  return vertex;
}

/// The vertex that a bounce ray left from: what MIS at the next hit needs.
struct Bounce {
  ShadingPoint from;
  float pdf;
};

class Path {
 public:
  Path(const PathContext& context, PixelSampler& random, PathCounts& counts)
      : context_(context), random_(random), counts_(counts) {}

  PathSample trace(Ray ray, std::optional<Hit> hit) {
    for (int depth = 0;; ++depth) {
      if (context_.record) context_.record->rays.push_back({ray, false});
      if (!hit) {
        addEnvironment(ray.direction);
        break;
      }
      const Material& material = context_.scene.materials[indexOf(context_.scene.meshes[indexOf(hit->mesh)].material)];
      const bool last = depth == context_.maxDepth;
      if (last && depth > 0 && isBlack(material.emission) && !material.unlit) break;
      const SurfacePoint surface = surfaceAt(context_.scene, *hit);
      if (depth == 0) recordFirstHit(surface, *hit, ray);
      if (material.unlit) {
        result_.radiance += throughput_ * baseColor(context_.scene, surface.at);
        break;
      }
      addEmission(surface, material, *hit, ray.direction);
      if (last) break;

      const Vertex vertex = makeVertex(context_, surface, -ray.direction, depth > 0);
      if (depth == 0 && context_.auxiliary) result_.normal = vertex.frame.z;
      addDirectLight(vertex);
      if (depth + 1 == context_.maxDepth && !context_.bounceCanFind) break;
      const Sample4 numbers = random_.next();
      const std::optional<Ray> next = scatter(vertex, numbers);
      if (!next || !survives(depth, numbers)) break;
      ++counts_.bounceRays;
      ray = *next;
      hit = context_.accel.intersect(ray, static_cast<std::uint32_t>(numbers.extra));
    }
    return result_;
  }

 private:
  bool shows(LightId light) const { return !context_.shownLights || context_.shownLights->shows(light); }

  void recordFirstHit(const SurfacePoint& surface, const Hit& hit, const Ray& ray) {
    if (!context_.auxiliary) return;
    result_.depth = hit.t;
    result_.albedo = glm::clamp(baseColor(context_.scene, surface.at), 0.0f, 1.0f);
    result_.normal = glm::dot(surface.normal, ray.direction) < 0 ? surface.normal : -surface.normal;
  }

  void addEnvironment(const Vec3& direction) {
    if (!kCanHaveEnvironment || !context_.scene.environment) return;
    const Vec2 uv = latLongFromDirection(*context_.scene.environment, direction);
    float weight = 1;
    if (bounce_) {
      const std::optional<LightId> light = context_.lights.environmentLightAt(uv);
      if (!light || !shows(*light)) return;
      weight = powerHeuristic(bounce_->pdf,
                              context_.sampler.pmf(bounce_->from, *light) * context_.lights.environmentPdf(*light, uv));
    }
    result_.radiance += throughput_ * weight * environmentRadiance(*context_.scene.environment, uv);
  }

  void addEmission(const SurfacePoint& surface, const Material& material, const Hit& hit, const Vec3& direction) {
    if (isBlack(material.emission)) return;
    if (!material.doubleSided && glm::dot(surface.normal, direction) >= 0) return;
    float weight = 1;
    if (bounce_) {
      const std::optional<LightId> light = context_.lights.lightAt(hit.mesh, hit.triangle);
      if (!light || !shows(*light)) return;
      weight = powerHeuristic(bounce_->pdf, context_.sampler.pmf(bounce_->from, *light) *
                                                context_.lights.trianglePdf(*light, bounce_->from.p, surface.p));
    }
    result_.radiance += throughput_ * weight * emission(context_.scene, surface.at);
  }

  void addDirectLight(const Vertex& vertex) {
    if (context_.record) context_.record->vertices.push_back(vertex.shadingPoint());
    const Sample4 numbers = random_.next();
    const std::optional<SampledLight> choice = context_.sampler.sample(vertex.shadingPoint(), numbers.wide(0));
    if (!choice || !shows(choice->light)) return;
    const std::optional<LightSample> light =
        context_.lights.sample(choice->light, vertex.surface.p, {numbers[1], numbers[2]});
    if (!light) {
      if (context_.lights.liesAt(choice->light, vertex.surface.p)) ++counts_.dropped;
      return;
    }
    const Bsdf::Value scattering = vertex.scattering(light->wi);
    if (isBlack(scattering.value)) return;

    const Vec3 origin = offsetRayOrigin(vertex.surface.p, vertex.surface.error, vertex.normal, light->wi);
    const Ray ray = kCanHaveDistantLights && light->distant ? Ray{origin, light->wi} : shadowRay(origin, light->end);
    ++counts_.shadowRays;
    if (context_.record) context_.record->rays.push_back({ray, true});
    if (context_.accel.occluded(ray, static_cast<std::uint32_t>(numbers.extra))) return;
    const float pdf = choice->pmf * light->pdf;
    const float weight = light->delta ? 1.0f : powerHeuristic(pdf, scattering.pdf);
    result_.radiance += throughput_ * scattering.value * light->radiance * (weight / pdf);
  }

  std::optional<Ray> scatter(const Vertex& vertex, const Sample4& numbers) {
    const std::optional<BsdfSample> sample = vertex.bsdf.sample(vertex.wo, numbers[0], {numbers[1], numbers[2]});
    if (!sample) return std::nullopt;
    const Vec3 direction = glm::normalize(vertex.frame.toWorld(sample->wi));
    if (!(glm::dot(direction, vertex.normal) > 0)) return std::nullopt;
    throughput_ *= sample->value * (sample->wi.z / sample->pdf);
    bounce_ = Bounce{vertex.shadingPoint(), sample->pdf};
    return Ray{offsetRayOrigin(vertex.surface.p, vertex.surface.error, vertex.normal, direction), direction};
  }

  bool survives(int depth, const Sample4& numbers) {
    if (depth < kRouletteDepth) return true;
    const float probability = std::min(1.0f, maxComponent(throughput_));
    if (!(numbers[3] < probability)) return false;
    throughput_ /= probability;
    return true;
  }

  const PathContext& context_;
  PixelSampler& random_;
  PathCounts& counts_;
  PathSample result_;
  Vec3 throughput_{1.0f};
  std::optional<Bounce> bounce_;  ///< nothing on the camera ray
};

/// Decides where partly covered surfaces let the camera ray through.
std::uint32_t coverageSeed(PixelSampler& random) {
  return static_cast<std::uint32_t>(random.nextBits());
}

}  // namespace

PathSample tracePath(const PathContext& context, const Ray& cameraRay, PixelSampler& random, PathCounts& counts) {
  const std::optional<Hit> hit = context.accel.intersect(cameraRay, coverageSeed(random));
  return Path(context, random, counts).trace(cameraRay, hit);
}

void findFirstHits(const Accel& accel, std::span<CameraPath> paths) {
  assert(paths.size() <= kRayPacket);
  std::array<Ray, kRayPacket> rays;
  std::array<std::uint32_t, kRayPacket> seeds;
  std::array<std::optional<Hit>, kRayPacket> hits;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    rays[i] = paths[i].ray;
    seeds[i] = coverageSeed(paths[i].random);
  }
  accel.intersect(std::span(rays).first(paths.size()), std::span(seeds).first(paths.size()),
                  std::span(hits).first(paths.size()));
  for (std::size_t i = 0; i < paths.size(); ++i) paths[i].hit = hits[i];
}

PathSample tracePath(const PathContext& context, CameraPath& path, PathCounts& counts) {
  return Path(context, path.random, counts).trace(path.ray, path.hit);
}

}  // namespace cellcut
