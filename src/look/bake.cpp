#include "look/bake.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/srgb.h"
#include "shape/normals.h"
#include "shape/tangents.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

Point sum_of(const Point& a, const Point& b, double share = 1) {
  return {a[0] + share * b[0], a[1] + share * b[1], a[2] + share * b[2]};
}

/// Where a texel is sampled, from its middle [texels].
using Offsets = std::span<const std::array<double, 2>>;
constexpr std::array<std::array<double, 2>, 1> middle = {{{0, 0}}};
constexpr std::array<std::array<double, 2>, 4> around = {{{-0.25, -0.25}, {0.25, -0.25}, {-0.25, 0.25}, {0.25, 0.25}}};

/// Of a colour between those of its neighbours [1/255]: where it is further off than this the colours are no plane, and
/// their mean over a texel differs from that in its middle.
constexpr int uneven = 2;

/// Viewers interpolate between texels, by which a hill whose second difference is d loses d/8 half way between two of
/// them, and the mean of four places has lost d/32 of it before. Texels that are higher by 3/32 d share the loss
/// evenly: d/16 too high at texels, d/16 too low between them, which is the least that any texels can do.
constexpr double lost_height = 3.0 / 32;

/// Of that, so that sharp edges, which no texels show, get no seam that is seen [linear light].
constexpr double most_raised = 8.0 / 255;

// --- normals -------------------------------------------------------------------------------------------

template <class Get>
Point mean_of_corners(const MeshPlace& place, const Get& get) {
  const double v = std::clamp(place.v, 0.0, 1.0), w = std::clamp(place.w, 0.0, 1.0 - v);
  Point sum{};
  const std::size_t corner = 3 * at(place.face);
  for (const auto& [k, share] : {std::pair{0, 1 - v - w}, {1, v}, {2, w}}) sum = sum_of(sum, get(corner + k), share);
  return unit(sum);
}

/// The gradient on the surface of what changes by (du, dv) along (along_u, along_v).
Point gradient(const Point& along_u, const Point& along_v, double du, double dv) {
  const double uu = dot(along_u, along_u), uv = dot(along_u, along_v), vv = dot(along_v, along_v);
  const double det = uu * vv - uv * uv;
  if (!(det > 1e-12 * uu * vv)) return {};
  const double a = (vv * du - uv * dv) / det, b = (uu * dv - uv * du) / det;
  return sum_of(sum_of({}, along_u, a), along_v, b);
}

/// As long as it was, but perpendicular to the normal.
Point laid_down(const Point& gradient, const Point& normal) {
  const Point flat = unit(sum_of(gradient, normal, -dot(gradient, normal)));
  return sum_of({}, flat, length(gradient));
}

/// Of a unit normal in the frame of a tangent that need not be perpendicular to n.
Point in_frame(const Point& direction, const Point& tangent, const Point& bitangent, const Point& normal) {
  const double det = dot(cross(tangent, bitangent), normal);
  if (det == 0) return {0, 0, 1};
  return unit({dot(cross(bitangent, normal), direction) / det, dot(cross(normal, tangent), direction) / det,
               dot(cross(tangent, bitangent), direction) / det});
}

std::uint8_t signed_byte(double x) { return static_cast<std::uint8_t>(std::lround(127.5 + 127.5 * x)); }

}  // namespace

ShadingFrames::ShadingFrames(TriangleMesh mesh) {
  const Attribute* own = mesh.find("normal");
  if (!own || own->components != 3 || own->domain == Domain::face) {
    Attribute means{"normal", 3, Domain::vertex, {}};
    for (const Point& n : vertex_normals(mesh.triangles, mesh.points))
      means.values.insert(means.values.end(), n.begin(), n.end());
    mesh.set(std::move(means));
    own = mesh.find("normal");
  }
  const Attribute tangents = corner_tangents(mesh);
  for (std::size_t c = 0; c < 3 * mesh.triangles.size(); ++c) {
    const double* n = &own->values[3 * (own->domain == Domain::corner ? c : at(mesh.triangles[c / 3][c % 3]))];
    const double* t = &tangents.values[4 * c];
    normal.push_back(unit({n[0], n[1], n[2]}));
    tangent.push_back({t[0], t[1], t[2]});
    mirrored.push_back(t[3] < 0);
  }
}

// --- texels --------------------------------------------------------------------------------------------

namespace {

/// Linear light of bytes that are sRGB.
std::array<double, 256> light_of_bytes() {
  std::array<double, 256> light;
  for (std::size_t byte = 0; byte < light.size(); ++byte)
    light[byte] = linear_from_srgb(static_cast<double>(byte) / 255);
  return light;
}

/// One making of the images of a tile.
class TileBaker {
 public:
  TileBaker(const CoatSampler& coat, const Palette& palette, const ChannelScales& scales, const UvLayout& layout,
            const ShadingFrames* frames, std::size_t tile)
      : coat_(coat),
        palette_(palette),
        scales_(scales),
        layout_(layout),
        frames_(frames),
        number_(tile),
        size_(layout.size()) {
    const std::size_t texels = at(size_) * at(size_);
    tile_.number = layout.tiles()[tile];
    const auto pixels = [&](int channels) {
      return Pixels{size_, size_, channels, std::vector<std::uint8_t>(at(channels) * texels)};
    };
    tile_.color = pixels(3);
    tile_.height.resize(texels);
    if (frames) tile_.normal = pixels(3);
    if (palette.paint.channels.contains(Channel::emission)) tile_.emission = pixels(3);
    for (const Channel channel :
         {Channel::roughness, Channel::metalness, Channel::opacity, Channel::transmission, Channel::thickness})
      if (palette.paint.channels.contains(channel)) tile_.greys[channel] = pixels(1);
    shown_.resize(texels);
  }

  BakedTile make(std::vector<char>& hidden) {
    const auto all = [](const UvLayout::Texel&) { return true; };
    each_part(all, middle, hidden);
    const std::vector<char> bent = uneven_texels();
    in_middles_ = tile_.color.bytes;
    each_part([&](const UvLayout::Texel& t) { return frames_ || bent[texel_of(t)] != 0; }, around, hidden);
    fill_between();
    return std::move(tile_);
  }

 private:
  /// Evaluates the texels that are wanted.
  template <class Wanted>
  void each_part(const Wanted& wanted, Offsets offsets, std::vector<char>& hidden) {
    constexpr int rows = 4;  // a few thousand texels of a large image, and thousands of parts
    std::vector<std::vector<Index>> hidden_of_part(at((size_ + rows - 1) / rows));
    parallel_chunks(hidden_of_part.size(), [&](std::size_t p) {
      const int first = static_cast<int>(p) * rows;
      std::vector<UvLayout::Texel> texels =
          layout_.texels(number_, first, std::min(first + rows, size_), hidden_of_part[p]);
      std::erase_if(texels, [&](const UvLayout::Texel& t) { return !wanted(t); });
      const std::size_t at_a_time = default_chunk / offsets.size();  // a single chunk of the loops inside
      for (std::size_t begin = 0; begin < texels.size(); begin += at_a_time)
        bake_texels({&texels[begin], std::min(at_a_time, texels.size() - begin)}, offsets);
    });
    for (const std::vector<Index>& faces : hidden_of_part)
      for (const Index face : faces) hidden[at(face)] = 1;
  }

  /// Those that are no mean of their neighbours.
  std::vector<char> uneven_texels() const {
    std::vector<char> bent(shown_.size(), 0);
    const auto look_at = [&](const Pixels& pixels) {
      const auto n = at(pixels.channels);
      const auto bends = [&](std::size_t texel, std::size_t step) {
        if (!shown_[texel - step] || !shown_[texel + step]) return false;
        for (std::size_t c = n * texel; c < n * (texel + 1); ++c)
          if (std::abs(pixels.bytes[c - n * step] - 2 * pixels.bytes[c] + pixels.bytes[c + n * step]) > uneven)
            return true;
        return false;
      };
      parallel_for(
          at(size_),
          [&](std::size_t begin, std::size_t end) {
            for (std::size_t y = begin; y < end; ++y)
              for (std::size_t x = 0, texel = y * at(size_); x < at(size_); ++x, ++texel)
                if (shown_[texel] && ((x > 0 && x + 1 < at(size_) && bends(texel, 1)) ||
                                      (y > 0 && y + 1 < at(size_) && bends(texel, at(size_)))))
                  bent[texel] = 1;
          },
          16);
    };
    look_at(tile_.color);
    for (const auto& [channel, pixels] : tile_.greys) look_at(pixels);
    return bent;
  }

  void bake_texels(std::span<const UvLayout::Texel> texels, Offsets offsets) {
    std::vector<MeshPlace> places;
    places.reserve(offsets.size() * texels.size());
    for (const UvLayout::Texel& t : texels)
      for (const auto& [dx, dy] : offsets) places.push_back(t.shows->place(t.x + 0.5 + dx, t.y + 0.5 + dy));
    const CoatSamples samples = coat_.samples(places);
    const std::vector<double> colors = paint(samples, palette_), heights = heights_of(samples);
    const std::size_t n = offsets.size();
    for (std::size_t i = 0; i < texels.size(); ++i) {
      const std::size_t texel = texel_of(texels[i]);
      shown_[texel] = 1;
      for (std::size_t c = 0; c < 3; ++c)
        tile_.color.bytes[3 * texel + c] = srgb_(static_cast<float>(
            mean_of(n, i, [&](std::size_t k) { return colors[3 * k + c]; }) + (n > 1 ? raised(texel, c) : 0)));
      tile_.height[texel] = static_cast<float>(mean_of(n, i, [&](std::size_t k) { return heights[k]; }));
      if (frames_ && n > 1)
        set_normal(texel, texels[i], std::span(samples.position).subspan(n * i, n),
                   std::span(samples.normal).subspan(n * i, n), std::span(heights).subspan(n * i, n));
    }
    bake_channels(texels, n, samples, colors);
  }

  /// `n`: samples of a texel.
  void bake_channels(std::span<const UvLayout::Texel> texels, std::size_t n, const CoatSamples& samples,
                     const std::vector<double>& colors) {
    for (auto& [channel, pixels] : tile_.greys) {
      const std::vector<double> values = channel_values(samples, palette_.paint, channel);
      const double white = channel == Channel::thickness ? scales_.deepest : 1;
      for (std::size_t i = 0; i < texels.size(); ++i)
        pixels.bytes[texel_of(texels[i])] = static_cast<std::uint8_t>(
            std::lround(255 * std::min(mean_of(n, i, [&](std::size_t k) { return values[k]; }) / white, 1.0)));
    }
    if (tile_.emission.bytes.empty()) return;
    const std::vector<double> light = channel_values(samples, palette_.paint, Channel::emission);
    for (std::size_t i = 0; i < texels.size(); ++i)
      for (std::size_t c = 0; c < 3; ++c)
        tile_.emission.bytes[3 * texel_of(texels[i]) + c] = srgb_(static_cast<float>(
            mean_of(n, i, [&](std::size_t k) { return light[k] * colors[3 * k + c]; }) / scales_.brightest));
  }

  /// What interpolation will take away from a texel's channel of the colour, and is therefore added.
  double raised(std::size_t texel, std::size_t channel) const {
    const auto light = [&](std::size_t t) { return light_of_byte_[in_middles_[3 * t + channel]]; };
    const auto second_difference = [&](std::size_t step) {
      if (!shown_[texel - step] || !shown_[texel + step]) return 0.0;
      return light(texel - step) - 2 * light(texel) + light(texel + step);
    };
    const std::size_t n = at(size_), x = texel % n, y = texel / n;
    double sum = 0;
    if (x > 0 && x + 1 < n) sum += second_difference(1);
    if (y > 0 && y + 1 < n) sum += second_difference(n);
    return std::clamp(-lost_height * sum, -most_raised, most_raised);
  }

  std::vector<double> heights_of(const CoatSamples& samples) const {
    const Paint& paint = palette_.paint;
    return paint.channels.contains(Channel::height) ? channel_values(samples, paint, Channel::height)
                                                    : samples.fields[paint.shown];
  }

  std::size_t texel_of(const UvLayout::Texel& t) const { return at(t.y) * at(size_) + at(t.x); }

  /// Over the n samples of the texel number i.
  template <class Value>
  static double mean_of(std::size_t n, std::size_t i, const Value& value) {
    double sum = 0;
    for (std::size_t k = 0; k < n; ++k) sum += value(n * i + k);
    return sum / static_cast<double>(n);
  }

  /// The samples are those around the middle: halves of their differences are those along the sides of the texel.
  void set_normal(std::size_t texel, const UvLayout::Texel& t, std::span<const Point> position,
                  std::span<const Point> surface_normal, std::span<const double> height) {
    const auto across = [&](std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
      return sum_of(difference(position[a], position[b]), difference(position[c], position[d]));
    };
    const Point slope =
        !has_height_ ? Point{}
                     : gradient(across(1, 0, 3, 2), across(2, 0, 3, 1), height[1] - height[0] + height[3] - height[2],
                                height[2] - height[0] + height[3] - height[1]);
    const MeshPlace place = t.shows->place(t.x + 0.5, t.y + 0.5);
    const Point normal = mean_of_corners(place, [&](std::size_t c) -> const Point& { return frames_->normal[c]; });
    const Point tangent = mean_of_corners(place, [&](std::size_t c) -> const Point& { return frames_->tangent[c]; });
    Point bitangent = cross(normal, tangent);
    if (frames_->mirrored[3 * at(place.face)])
      for (double& x : bitangent) x = -x;
    // On the shape itself smooth shading stands for the smooth surface; another mesh shows that surface's own normals.
    Point bare = normal;
    if (coat_.onto_other()) {
      bare = {};
      for (const Point& n : surface_normal) bare = sum_of(bare, n);
      bare = unit(bare);
    }
    const Point bent = unit(sum_of(bare, laid_down(slope, bare), -1));
    Point seen = in_frame(bent, tangent, bitangent, normal);
    if (seen[2] < 0) seen = unit({seen[0], seen[1], 0});  // no normal map looks back
    for (std::size_t k = 0; k < 3; ++k) tile_.normal.bytes[3 * texel + k] = signed_byte(seen[k]);
  }

  /// Of the texels that show something.
  std::array<double, 4> mean_color_and_height() const {
    std::array<double, 4> sum{};
    double count = 0;
    for (std::size_t texel = 0; texel < shown_.size(); ++texel) {
      if (!shown_[texel]) continue;
      for (std::size_t c = 0; c < 3; ++c) sum[c] += light_of_byte_[tile_.color.bytes[3 * texel + c]];
      sum[3] += tile_.height[texel];
      ++count;
    }
    for (double& x : sum) x /= std::max(count, 1.0);
    return sum;
  }

  void fill_between() {
    const std::array<double, 4> mean = mean_color_and_height();
    const std::array<std::uint8_t, 3> color = {srgb_(static_cast<float>(mean[0])), srgb_(static_cast<float>(mean[1])),
                                               srgb_(static_cast<float>(mean[2]))};
    const std::array<std::uint8_t, 3> up = {signed_byte(0), signed_byte(0), signed_byte(1)};
    for (std::size_t texel = 0; texel < shown_.size(); ++texel) {
      if (shown_[texel]) continue;
      std::ranges::copy(color, &tile_.color.bytes[3 * texel]);
      tile_.height[texel] = static_cast<float>(mean[3]);
      if (frames_) std::ranges::copy(up, &tile_.normal.bytes[3 * texel]);
      for (auto& [channel, pixels] : tile_.greys)
        pixels.bytes[texel] = static_cast<std::uint8_t>(std::lround(255 * kind_of(channel).usual));
    }
  }

  const CoatSampler& coat_;
  const Palette& palette_;
  const ChannelScales& scales_;
  const UvLayout& layout_;
  const ShadingFrames* frames_;
  const std::size_t number_;
  const int size_;
  const bool has_height_ = palette_.paint.channels.contains(Channel::height);
  const SrgbBytes srgb_;
  std::vector<char> shown_;  ///< per texel
  const std::array<double, 256> light_of_byte_ = light_of_bytes();
  std::vector<std::uint8_t> in_middles_;  ///< colours there, before others are there
  BakedTile tile_;
};

ChannelScales scales_of(const CoatSamples& samples, const Palette& palette) {
  ChannelScales scales;
  if (palette.paint.channels.contains(Channel::emission)) {
    const std::vector<double> light = channel_values(samples, palette.paint, Channel::emission),
                              colors = paint(samples, palette);
    for (std::size_t i = 0; i < colors.size(); ++i)
      scales.brightest = std::max(scales.brightest, light[i / 3] * colors[i]);
  }
  if (palette.paint.channels.contains(Channel::thickness))
    if (const double most = std::ranges::max(channel_values(samples, palette.paint, Channel::thickness)); most > 0)
      scales.deepest = most;
  return scales;
}

}  // namespace

TextureMaps maps_of(BakedTile tile, const ChannelScales& scales) {
  const auto shared = [](Pixels& pixels) {
    return pixels.bytes.empty() ? nullptr : std::make_shared<const Pixels>(std::move(pixels));
  };
  const auto grey = [&](Channel channel) {
    const auto found = tile.greys.find(channel);
    return found == tile.greys.end() ? nullptr : shared(found->second);
  };
  return {shared(tile.color),     shared(tile.normal),   grey(Channel::roughness),    grey(Channel::metalness),
          grey(Channel::opacity), shared(tile.emission), grey(Channel::transmission), grey(Channel::thickness),
          scales.brightest,       scales.deepest};
}

BakedCoat bake(const CoatSampler& coat, const Palette& palette, const UvLayout& layout, const ShadingFrames* frames) {
  std::vector<char> hidden(layout.face_count(), 0);
  BakedCoat baked;
  baked.scales = scales_of(coat.tessellation().samples, palette);
  for (std::size_t tile = 0; tile < layout.tiles().size(); ++tile)
    baked.tiles.push_back(TileBaker(coat, palette, baked.scales, layout, frames, tile).make(hidden));
  baked.hidden.count = static_cast<std::size_t>(std::ranges::count(hidden, 1));
  baked.hidden.first = static_cast<Index>(std::ranges::find(hidden, 1) - hidden.begin());
  return baked;
}

}  // namespace pelage
