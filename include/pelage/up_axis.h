#pragma once
// Which axis of a shape points up.

namespace pelage {

enum class UpAxis { y, z };

}  // namespace pelage
