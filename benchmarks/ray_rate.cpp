// SPDX-License-Identifier: Apache-2.0
// Rays per second of the renderer beside Embree alone on the very same rays. Linked with --wrap, so
// that the renderer's calls of Embree pass through here: they are counted and recorded, then
// replayed on Embree alone, in the same order. Usage: ray_rate SEQUENCE.yaml [KEY=VALUE ...] one
// thread; medians of kNumRuns runs, all in one process
#include "renderer/frame_renderer.h"
#include "renderer/ground_truth.h"
#include "renderer/sequence/sequence_model.h"
#include "renderer/sequence/sequence_schema.h"
#include "scenes/catalog.h"

#include <algorithm>
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

bool recording = false;
std::vector<RecordedRay> recorded;
RTCScene traced_scene = nullptr;

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
}

/// Prints one row: how fast `work` casts its rays, and how fast Embree alone does.
void Compare(const std::string& name, const std::function<void()>& work) {
  recorded.clear();
  recording = true;
  work();
  recording = false;
  const double renderer_s = MedianSeconds(work);
  const double embree_s = MedianSeconds(Replay);
  const double mega_rays = static_cast<double>(recorded.size()) * 1e-6;
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
  for (const Named<Lens>& lens : lenses) {
    Compare(lens.name + " distance map", [&] {
      RenderGroundTruth(rays,
                        lens.value,
                        world_from_camera,
                        width_px,
                        height_px,
                        spec.ground_truth.max_distance_m,
                        1);
    });
  }
  for (const int max_bounces : {1, 3}) {
    const PathTracer tracer(
        rays, MakeLighting(spec.light, scene->sun), PathTracerOptions{.max_bounces = max_bounces});
    const View view{
        &lenses.front().value, world_from_camera, width_px, height_px, spec.render.seed, 0, 0};
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
