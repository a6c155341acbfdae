// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/sequence/sequence_reader.h"
#include "validator/benchmark/view_source.h"

namespace pfseq {

/// A sequence's folder.
class SequenceViews : public ViewSource {
 public:
  explicit SequenceViews(const std::filesystem::path& folder);

  std::string Name() const override;
  std::vector<std::string> Cameras() const override { return reader_.Cameras(); }
  std::vector<std::string> Lenses() const override { return reader_.Lenses(); }
  const Lens& LensOf(const std::string& lens) const override { return reader_.LensOf(lens); }
  RigidTransform WorldFromCamera(const ViewName& view) const override;
  std::vector<std::string> Variants() const override;
  std::vector<int> Frames(const std::string& lens,
                          const std::string& camera,
                          const std::string& variant) const override;
  Image<uint8_t> ReadImage(const std::string& lens,
                           const ViewName& view,
                           const std::string& variant) const override;
  Image<float> ReadDistance(const std::string& lens, const ViewName& view) const override;
  std::shared_ptr<const RayScene> Scene() const override;
  double MaxDistanceM() const override { return reader_.MaxDistanceM(); }

 private:
  std::filesystem::path ImageFolder(const std::string& lens,
                                    const std::string& camera,
                                    const std::string& variant) const;

  SequenceReader reader_;
};

}  // namespace pfseq
