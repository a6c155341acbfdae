// SPDX-License-Identifier: Apache-2.0
// The table of algorithms. Defaults of OpenCV, except where "auto" follows the report of 2014
// (tables "Parameters of evaluated detectors" and "... descriptors").
#include "renderer/core/check.h"
#include "validator/grid/setting.h"

#include <opencv2/opencv_modules.hpp>
#ifdef HAVE_OPENCV_XFEATURES2D
#include <opencv2/xfeatures2d/nonfree.hpp>  // Tells of OPENCV_ENABLE_NONFREE.
#endif

namespace pfseq {
namespace {

constexpr double kMany = 1e6;

Parameter Named(const char* name, double value, double least, double most) {
  return {name, value, least, most, false, true, false};
}
Parameter NamedInteger(const char* name, int value, int least, double most) {
  return {name, static_cast<double>(value), static_cast<double>(least), most, true, true, false};
}
Parameter Real(const char* name, double value, double least, double most) {
  return {name, value, least, most, false, false, false};
}
Parameter Integer(const char* name, int value, int least, double most) {
  return {name, static_cast<double>(value), static_cast<double>(least), most, true, false, false};
}
Parameter Auto(const char* name, double least, double most, bool is_integer) {
  return {name, std::nullopt, least, most, is_integer, false, true};
}

std::vector<Parameter> Corners() {
  return {NamedInteger("maxCorners", 3000, 0, kMany),  // 0: all
          Real("qualityLevel", 0.01, 1e-9, 1.0),
          Real("minDistance", 3.0, 0.0, 1000.0),
          Integer("blockSize", 3, 1, 31)};
}

std::vector<Algorithm> MakeDetectors() {
  std::vector<Algorithm> detectors = {
      {"SIFT",
       {Named("contrastThreshold", 0.04, 0.0, 1.0),
        Named("edgeThreshold", 10.0, 1.0, 1000.0),
        Named("sigma", 1.6, 0.5, 16.0),
        Integer("nOctaveLayers", 3, 1, 10)}},
      {"CenSurE",
       {NamedInteger("maxSize", 16, 4, 128),
        NamedInteger("lineThresholdProjected", 10, 1, 1000),
        NamedInteger("suppressNonmaxSize", 5, 1, 63),
        Integer("responseThreshold", 30, 0, 255),
        Auto("lineThresholdBinarized", 1, 1000, true)}},  // projected - 2
      {"ORB",
       {NamedInteger("nfeatures", 500, 1, kMany),
        Auto("scaleFactor", 1.01, 4.0, false),  // 2^(1/3), SIFT's layers
        Auto("nlevels", 1, 64, true),           // 3 floor(log2(min(width, height)))
        Integer("patchSize", 31, 3, 99),
        Integer("fastThreshold", 20, 1, 255)}},
      {"BRISK",
       {NamedInteger("thresh", 30, 1, 255),
        Named("patternScale", 1.0, 0.1, 10.0),
        Auto("octaves", 0, 16, true)}},  // floor(log2(min(width, height)))
      {"Harris", Corners()},
      {"ShiTomasi", Corners()},
      {"ShiTomasiHarris", Corners()},
      {"FAST", {NamedInteger("threshold", 20, 1, 255), Integer("type", 2, 0, 2)}},
      {"AGAST", {NamedInteger("threshold", 20, 1, 255), Integer("type", 3, 0, 3)}},
      {"MSER",
       {NamedInteger("delta", 5, 1, 255),
        Integer("minArea", 60, 1, kMany),
        Integer("maxArea", 14400, 1, kMany)}},
      {"AKAZE",
       {Named("threshold", 0.001, 1e-6, 1.0),
        Integer("nOctaves", 4, 1, 10),
        Integer("nOctaveLayers", 4, 1, 10)}},
      {"KAZE",
       {Named("threshold", 0.001, 1e-6, 1.0),
        Integer("nOctaves", 4, 1, 10),
        Integer("nOctaveLayers", 4, 1, 10)}},
  };
#ifdef OPENCV_ENABLE_NONFREE
  detectors.push_back({"SURF",
                       {Named("hessianThreshold", 100.0, 0.0, kMany),
                        Integer("nOctaves", 4, 1, 10),
                        Integer("nOctaveLayers", 3, 1, 10)}});
#endif
  return detectors;
}

std::vector<Algorithm> MakeDescriptors() {
  std::vector<Algorithm> descriptors = {
      // sigma and nOctaveLayers follow a SIFT detector; 1.6 and 3 with others.
      {"SIFT", {Real("sizeScale", 1.0, 0.01, 10.0)}},
      {"ORB", {NamedInteger("WTA_K", 2, 2, 4), Real("sizeScale", 1.0, 0.01, 10.0)}},
      {"BRISK", {Named("patternScale", 1.0, 0.1, 10.0), Real("sizeScale", 1.0, 0.01, 10.0)}},
      {"FREAK",
       {Named("patternScale", 22.0, 1.0, 200.0),
        Integer("orientationNormalized", 1, 0, 1),
        Integer("scaleNormalized", 1, 0, 1),
        Auto("nOctaves", 1, 20, true),  // floor(log2(min(width, height)))
        Real("sizeScale", 1.0, 0.01, 10.0)}},
      {"BRIEF", {NamedInteger("bytes", 32, 16, 64)}},
      {"AKAZE", {}},  // Of AKAZE and KAZE key points alone.
      {"KAZE", {}},
  };
#ifdef OPENCV_ENABLE_NONFREE
  descriptors.push_back({"SURF", {Integer("extended", 0, 0, 1)}});
#endif
  return descriptors;
}

}  // namespace

const std::vector<Algorithm>& KnownDetectors() {
  static const std::vector<Algorithm> detectors = MakeDetectors();
  return detectors;
}

const std::vector<Algorithm>& KnownDescriptors() {
  static const std::vector<Algorithm> descriptors = MakeDescriptors();
  return descriptors;
}

const std::vector<Algorithm>& KnownMatchers() {
  static const std::vector<Algorithm> matchers = {
      {"BruteForce", {}},
      {"RatioTest", {Real("ratio", 0.8, 0.01, 1.0)}},
      {"FLANN",
       {Integer("trees", 4, 1, 64),
        Integer("checks", 32, 1, 65536),
        Real("ratio", 0.8, 0.01, 1.0)}},
  };
  return matchers;
}

Norm NormOf(const Setting& descriptor) {
  if (descriptor.Is("ORB")) {
    return descriptor.Integer("WTA_K") == 2 ? Norm::kHamming : Norm::kHamming2;
  }
  const bool is_euclidean = descriptor.Is("SIFT") || descriptor.Is("KAZE") || descriptor.Is("SURF");
  return is_euclidean ? Norm::kL2 : Norm::kHamming;
}

bool CanMatch(const Setting& matcher, const Setting& descriptor) {
  return !matcher.Is("FLANN") || NormOf(descriptor) == Norm::kL2;
}

}  // namespace pfseq
