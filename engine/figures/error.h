#pragma once
#include "platform/error.h"

namespace dynlab::inline figures {

/// A figure could not be drawn: names its file and says what gnuplot complained of.
class FigureError : public EnvironmentError {
  public:
    using EnvironmentError::EnvironmentError;
};

}  // namespace dynlab::inline figures
