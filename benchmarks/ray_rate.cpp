// SPDX-License-Identifier: Apache-2.0
// Rays per second of the renderer beside Embree alone on the very same rays. Linked with --wrap, so
// that the renderer's calls of Embree pass through here: they are counted and recorded, then
// replayed on Embree alone, in the same order. Usage: ray_rate SEQUENCE.yaml [KEY=VALUE ...] one
// thread; medians of kNumRuns runs, all in one process
#include "renderer/cached_light.h"
#include "renderer/core/parallel.h"
#include "renderer/frame_renderer.h"
#include "renderer/ground_truth.h"
#include "renderer/sequence/sequence_model.h"
#include "renderer/sequence/sequence_schema.h"
#include "scenes/catalog.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <embree3/rtcore.h>
#include <fmt/format.h>

namespace {

struct RecordedRay {
  RTCRay ray;
  bool is_shadow;
};

struct RecordedPacket {
  RTCRay8 rays;
  std::array<int, 8> valid;
  RTCIntersectContextFlags flags;
  bool is_shadow;
};

bool recording = false;
std::vector<RecordedRay> recorded;
std::vector<RecordedPacket> recorded_packets;
RTCScene traced_scene = nullptr;

void Record(const int* valid, RTCIntersectContext* context, const RTCRay8& rays, bool is_shadow) {
  RecordedPacket packet{rays, {}, context->flags, is_shadow};
  std::copy_n(valid, packet.valid.size(), packet.valid.begin());
  recorded_packets.push_back(packet);
}

}  // namespace

extern "C" {

void __real_rtcIntersect1(RTCScene scene, RTCIntersectContext* context, RTCRayHit* query);
void __real_rtcOccluded1(RTCScene scene, RTCIntersectContext* context, RTCRay* ray);

void __wrap_rtcIntersect1(RTCScene scene, RTCIntersectContext* context, RTCRayHit* query) {
  if (recording) {
    traced_scene = scene;
    recorded.push_back({query->ray, false});
  }
  __real_rtcIntersect1(scene, context, query);
}

void __wrap_rtcOccluded1(RTCScene scene, RTCIntersectContext* context, RTCRay* ray) {
  if (recording) {
    recorded.push_back({*ray, true});
  }
  __real_rtcOccluded1(scene, context, ray);
}

void __real_rtcIntersect8(const int* valid,
                          RTCScene scene,
                          RTCIntersectContext* context,
                          RTCRayHit8* query);
void __real_rtcOccluded8(const int* valid,
                         RTCScene scene,
                         RTCIntersectContext* context,
                         RTCRay8* rays);

void __wrap_rtcIntersect8(const int* valid,
                          RTCScene scene,
                          RTCIntersectContext* context,
                          RTCRayHit8* query) {
  if (recording) {
    traced_scene = scene;
    Record(valid, context, query->ray, false);
  }
  __real_rtcIntersect8(valid, scene, context, query);
}

void __wrap_rtcOccluded8(const int* valid,
                         RTCScene scene,
                         RTCIntersectContext* context,
                         RTCRay8* rays) {
  if (recording) {
    Record(valid, context, *rays, true);
  }
  __real_rtcOccluded8(valid, scene, context, rays);
}
}

namespace {

constexpr int kNumRuns = 5;

double MedianSeconds(const std::function<void()>& work) {
  std::vector<double> seconds;
  for (int run = 0; run < kNumRuns; ++run) {
    const auto start = std::chrono::steady_clock::now();
    work();
    seconds.push_back(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  std::nth_element(seconds.begin(), seconds.begin() + kNumRuns / 2, seconds.end());
  return seconds[kNumRuns / 2];
}

void Replay() {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  for (const RecordedRay& entry : recorded) {
    if (entry.is_shadow) {
      RTCRay ray = entry.ray;
      __real_rtcOccluded1(traced_scene, &context, &ray);
    } else {
      RTCRayHit query{};
      query.ray = entry.ray;
      query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      __real_rtcIntersect1(traced_scene, &context, &query);
    }
  }
  for (const RecordedPacket& packet : recorded_packets) {
    context.flags = packet.flags;
    alignas(32) std::array<int, 8> valid = packet.valid;
    if (packet.is_shadow) {
      RTCRay8 rays = packet.rays;
      __real_rtcOccluded8(valid.data(), traced_scene, &context, &rays);
    } else {
      RTCRayHit8 query;
      query.ray = packet.rays;
      std::fill_n(query.hit.geomID, 8, RTC_INVALID_GEOMETRY_ID);
      std::fill_n(query.hit.instID[0], 8, RTC_INVALID_GEOMETRY_ID);
      __real_rtcIntersect8(valid.data(), traced_scene, &context, &query);
    }
  }
}

size_t NumRecordedRays() {
  size_t count = recorded.size();
  for (const RecordedPacket& packet : recorded_packets) {
    count += static_cast<size_t>(std::count(packet.valid.begin(), packet.valid.end(), -1));
  }
  return count;
}

/// Prints one row: how fast `work` casts its rays, and how fast Embree alone does.
void Compare(const std::string& name, const std::function<void()>& work) {
  recorded.clear();
  recorded_packets.clear();
  recording = true;
  work();
  recording = false;
  const double renderer_s = MedianSeconds(work);
  const double embree_s = MedianSeconds(Replay);
  const double mega_rays = static_cast<double>(NumRecordedRays()) * 1e-6;
  fmt::print("{:28} {:8.2f} {:14.2f} {:14.2f} {:8.2f}\n",
             name,
             mega_rays,
             mega_rays / renderer_s,
             mega_rays / embree_s,
             embree_s / renderer_s);
}

void Run(const std::string& path, const std::vector<std::string>& overrides) {
  using namespace pfseq;  // NOLINT(google-build-using-namespace)
  const SequenceSpec spec = ReadSequenceSpec(path, overrides);
  const auto scene = std::make_shared<const Scene>(LoadScene(spec, ""));
  const auto start = std::chrono::steady_clock::now();
  const RayScene rays(scene);
  const double build_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  fmt::print("triangles {}, acceleration structure built in {:.2f} s (one thread), {:.1f} MiB\n",
             scene->NumTriangles(),
             build_s,
             static_cast<double>(rays.MemoryBytes()) / 1048576.0);
  const std::vector<Named<Lens>> lenses = MakeLenses(spec);
  const RigidTransform world_from_camera = FramePoses(spec.trajectory).front().world_from_rig *
                                           MakeCameras(spec).front().rig_from_camera;
  const int width_px = spec.image.size_px[0];
  const int height_px = spec.image.size_px[1];
  fmt::print(
      "{:28} {:>8} {:>14} {:>14} {:>8}\n", "", "Mrays", "pfseq Mrays/s", "Embree Mrays/s", "ratio");
  const TextureSet textures(*scene);
  const Lighting lighting = MakeLighting(spec.light, scene->sun);
  const LensRaster raster(lenses.front().value, width_px, height_px, NumHardwareThreads());
  const View view{
      &lenses.front().value, world_from_camera, width_px, height_px, spec.render.seed, 0, 0};
  Compare(lenses.front().name + " distance map", [&] {
    RenderGroundTruth(rays, raster, world_from_camera, spec.ground_truth.max_distance_m, 1);
  });
  CachedLight light(
      rays, textures, lighting, spec.render, {world_from_camera.translation_m}, "", {});
  const PixelSampling sampling{.num_samples = spec.render.samples,
                               .max_samples = spec.render.samples};
  const auto render = [&] {
    RenderCachedRadiance(light.Tracer(), raster, view, sampling, 1, nullptr, {});
  };
  // The light of all surfaces that these samples meet is there before anything is measured.
  light.Prepare({{&raster, view}}, sampling, NumHardwareThreads(), true);
  render();
  Compare(lenses.front().name + " frame, stored light", render);
  for (const int max_bounces : {1, 3}) {
    const PathTracer tracer(
        rays, textures, lighting, PathTracerOptions{.max_bounces = max_bounces});
    Compare(fmt::format("{} paths, {} bounces", lenses.front().name, max_bounces),
            [&] { RenderRadiance(tracer, view, spec.render.samples, 1, nullptr, {}); });
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "usage: ray_rate SEQUENCE.yaml [KEY=VALUE ...]\n");
    return 2;
  }
  try {
    Run(argv[1], std::vector<std::string>(argv + 2, argv + argc));
  } catch (const std::exception& error) {
    fmt::print(stderr, "ray_rate: {}\n", error.what());
    return 1;
  }
  return 0;
}
