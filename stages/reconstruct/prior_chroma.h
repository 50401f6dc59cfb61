// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/direction.h"
#include "stages/reconstruct/leave_out.h"

#include <Eigen/Core>

#include <vector>

namespace abrdf {

/// Chroma is a colour divided by its luminance L = (R + G + B) / 3: a row a sample; its three
/// channels sum to 3. Rows of black samples are the mean of the others.
Eigen::MatrixX3d chromaOf(const Eigen::MatrixX3d& colors);

/// Rows bounded below by 0 and scaled to sum to 3.
Eigen::MatrixX3d normalizedChroma(const Eigen::MatrixX3d& chroma);

/// Mean CIE 1976 Delta E between the rows of two lists of colours, at an exposure.
double meanDeltaE(const Eigen::MatrixX3d& a, const Eigen::MatrixX3d& b, double exposure);

/// Kriging of chroma about the samples' mean, by directions and lightness. A mixture of kernels,
/// weighted by how well the samples predict one another's colour (design: estimator.md, 2.6).
class ChromaKriging {
  public:
    /// pairs, colors: the samples of the material's mean, a row each; texels: samples of those by
    /// which the kernels are chosen, at least one.
    ChromaKriging(const std::vector<LightAndView>& pairs, const Eigen::MatrixX3d& colors,
                  const std::vector<Eigen::MatrixX3d>& texels, double exposure);

    /// The matrix by which (chroma - its mean) at the samples makes (chroma - mean) at the outputs
    /// of this luminance; a row an output. vectors: where only these are to be multiplied with it,
    /// a column each, what it would make of them.
    Eigen::MatrixXf outputMatrix(const std::vector<LightAndView>& outputs,
                                 const Eigen::VectorXd& outputLuminance,
                                 const Eigen::MatrixXd* vectors = nullptr) const;

    /// The chroma of each texel's samples, predicted from the others.
    const std::vector<Eigen::MatrixX3d>& leaveOneOut() const { return leaveOneOut_; }

    /// What leaveOutMatrix() makes of each kernel, mixed: of chroma about its mean.
    Eigen::MatrixXd leaveOut(const SampleBlocks& blocks) const;

    /// The mixture's covariance of the samples, noise included.
    const Eigen::MatrixXd& covariance() const { return covariance_; }

    /// True where a direction's azimuth matters, not only those between light and view.
    bool isAnisotropic() const { return ofVectors_.size() > 0; }

  private:
    enum Shape { kExponential, kMatern, kWideMatern, kShapes };

    struct Member {
        Shape shape = kExponential;
        double vectorShare = 0;  ///< Weight of the kernel over unit vectors beside it.
        double noise = 0;
        Eigen::MatrixXd inverse;                    ///< Of the samples' covariance.
        std::vector<Eigen::MatrixX3d> leaveOneOut;  ///< One a texel.
        double error = 0;
    };

    void predict(Member& member, const std::vector<Eigen::MatrixX3d>& texels,
                 double exposure) const;
    static Eigen::MatrixXd kernel(Shape shape, const Eigen::MatrixXd& squaredDistances);
    Eigen::MatrixXd features(const std::vector<LightAndView>& pairs,
                             const Eigen::VectorXd& luminance) const;
    void mix(std::vector<Member> members);

    std::vector<LightAndView> pairs_;
    double medianLuminance_ = 1;
    Eigen::MatrixXd features_;
    std::vector<Eigen::MatrixXd> ofShape_;   ///< What each shape's kernel is multiplied with.
    Eigen::MatrixXd ofVectors_;              ///< The same of unit vectors; empty where unused.
    std::vector<double> weights_;            ///< Of the mixture's members, all sum to 1 ...
    std::vector<Eigen::MatrixXd> inverses_;  ///< ... and the inverses of their covariances.
    Eigen::MatrixXd covariance_;
    std::vector<Eigen::MatrixX3d> leaveOneOut_;
};

}  // namespace abrdf
