#pragma once

namespace mudline {
constexpr double pi = 3.14159265358979323846;
}
