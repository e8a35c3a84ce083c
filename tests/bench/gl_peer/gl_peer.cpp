#define GL_GLEXT_PROTOTYPES
#include "tests/bench/gl_peer/gl_peer.h"

#include <GL/osmesa.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "ig_core/scene/motion.h"
#include "tests/bench/gl_peer/frame_objects.h"
#include "tests/bench/gl_peer/gl_context.h"

namespace quadrig::gl_peer {
namespace {

constexpr std::size_t kMostTextures = 256, kTextureVectors = 15;
enum Unit : unsigned { kObjects, kPlanes, kSeen, kPicture };

const Scene& drawable(const Scene& scene) {
    if (!scene.ground_polygons.empty() || !scene.lights.empty() || scene.textures.size() > kMostTextures)
        throw std::runtime_error("the GL peer draws no ground polygons, no lights and at most 256 textures");
    return scene;
}

void put(std::vector<float>& out, const glm::dvec3& v, double w) {
    for (const double value : {v.x, v.y, v.z, w}) out.push_back(static_cast<float>(value));
}

/// The block Frame of frame.glsl.
std::vector<float> frame_block(const Scene& scene, const View& view) {
    const ImagePlane& image = view.image;
    const glm::dmat3& turn = view.eye_from_scene;
    const double a = scene.sun.azimuth.radians(), e = scene.sun.elevation.radians();
    const glm::dvec3 to_sun(std::sin(a) * std::cos(e), std::cos(a) * std::cos(e), std::sin(e));
    std::vector<float> block;
    put(block, {image.left, image.z(image.height), image.column_step}, image.row_step);
    const glm::dmat3 back = glm::transpose(turn);
    for (int column = 0; column < 3; ++column) put(block, back[column], 0.0);
    put(block, glm::dvec3(0.0), 1.0);
    put(block, turn * to_sun, scene.sun.ambient);
    put(block, turn[2], view.eye.metres.z);
    put(block, scene.sky.horizon, scene.haze ? 2.996 / (scene.haze->visibility * std::numbers::ln2) : 0.0);
    put(block, scene.sky.zenith, 0.0);
    put(block, scene.haze ? scene.haze->colour : Colour(0.0), 0.0);
    return block;
}

/// An angle in turns, 0..1.
double turns(double radians) {
    const double t = radians / (2.0 * std::numbers::pi);
    return t - std::floor(t);
}

/// The block Textures of paint.glsl, at time 0. Phases are reduced at the eye in double precision.
std::vector<float> texture_block(const Scene& scene, const glm::dvec3& eye) {
    std::vector<float> block(4 * kTextureVectors * kMostTextures);
    for (std::size_t i = 0; i < scene.textures.size(); ++i) {
        const Texture& texture = scene.textures[i];
        std::vector<TextureTerm> terms = texture.terms;
        std::stable_sort(terms.begin(), terms.end(),
                         [](const TextureTerm& a, const TextureTerm& b) { return a.frequency < b.frequency; });
        double sum = 0.0, variance = 0.0;
        for (const TextureTerm& term : terms) sum += term.coefficient;
        for (const TextureTerm& term : terms) variance += 0.125 * std::pow(term.coefficient / sum, 2);
        std::vector<float> out;
        put(out, {static_cast<double>(terms.size()), texture.vertical, 0.0}, 0.0);
        for (const auto& [coefficient, w, phase] : terms) {
            put(out, {w / (2.0 * std::numbers::pi), coefficient / sum, turns(w * eye.x)}, turns(w * eye.y));
            put(out, {turns(0.5 * w * eye.x + phase), turns(0.5 * w * eye.y + phase), turns(0.5 * w * eye.z + phase)},
                variance);
            variance -= 0.125 * std::pow(coefficient / sum, 2);
        }
        std::copy(out.begin(), out.end(), block.begin() + static_cast<std::ptrdiff_t>(4 * kTextureVectors * i));
    }
    return block;
}

void fill_block(unsigned buffer, unsigned place, const std::vector<float>& values) {
    glBindBuffer(GL_UNIFORM_BUFFER, buffer);
    glBufferData(GL_UNIFORM_BUFFER, static_cast<GLsizeiptr>(values.size() * sizeof(float)), values.data(),
                 GL_STREAM_DRAW);
    glBindBufferBase(GL_UNIFORM_BUFFER, place, buffer);
}

std::vector<std::string> defines_of(unsigned variant, bool holes, bool forward) {
    std::vector<std::string> defines;
    if ((variant & kWithPlanes) != 0) defines.emplace_back("PLANES");
    if ((variant & kGeneral) != 0) defines.emplace_back("GENERAL");
    if (holes) defines.emplace_back("HOLES");
    if (forward) defines.emplace_back("FORWARD");
    return defines;
}

}  // namespace

struct GlPeer::Impl {
    Impl(const Scene& s, int width, int height, Shading shading)
        : scene(scene_at(drawable(s), 0.0)),
          objects(scene),
          context(width, height),
          records(kObjects),
          planes(kPlanes),
          forward(shading == Shading::forward) {
        const unsigned depth = make_depth(width, height);
        seen = make_target(width, height, GL_RG32UI, kSeen, depth);
        picture = make_target(width, height, GL_RGBA16F, kPicture, depth);
        glGenBuffers(2, blocks.data());
        glGenVertexArrays(1, &no_attributes);
        glBindVertexArray(no_attributes);
        const auto painted = [&](const char* vertex, std::initializer_list<std::string> fragment, unsigned variant,
                                 bool holes) {
            return make_program(vertex, fragment, defines_of(variant, holes, forward));
        };
        for (unsigned variant = 0; variant < kVariants; ++variant) {
            const auto solids = {std::string("entry.glsl"), std::string("paint.glsl"), std::string("translucent.frag")};
            opaque[variant] = forward ? painted("quads.vert", solids, variant, false)
                                      : painted("quads.vert", {"entry.glsl", "opaque.frag"}, variant, false);
            translucent[variant] = painted("quads.vert", solids, variant, true);
        }
        const auto plane = {std::string("paint.glsl"), std::string("deck.frag")};
        deck = painted("whole_picture.vert", plane, kPlain, true);
        ground = forward ? painted("whole_picture.vert", plane, kPlain, false)
                         : painted("whole_picture.vert", {"ground.frag"}, kPlain, false);
        sky = make_program("whole_picture.vert", {"sky.frag"}, {});
        shade = make_program("whole_picture.vert", {"paint.glsl", "shade.frag"}, {});
        shade_last = make_program("whole_picture.vert", {"paint.glsl", "shade.frag"}, {"LAST"});
        encode = make_program("whole_picture.vert", {"paint.glsl", "encode.frag"}, {});
        // From 0 (far away) to 1 (near): inverse depth in floating point loses nothing far away.
        const auto clip_control = reinterpret_cast<PFNGLCLIPCONTROLPROC>(OSMesaGetProcAddress("glClipControl"));
        if (clip_control == nullptr) throw std::runtime_error("OSMesa has no glClipControl");
        clip_control(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
        glClearDepth(0.0);
        glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    }

    static void cover_picture(unsigned program) {
        glUseProgram(program);
        glDrawArrays(GL_TRIANGLES, 0, 3);
    }
    static void draw(unsigned program, const Batch& batch) {
        glUseProgram(program);
        glUniform1i(glGetUniformLocation(program, "first"), batch.first);
        if (batch.deck)
            glDrawArrays(GL_TRIANGLES, 0, 3);
        else
            glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, batch.count);
    }

    void draw_opaque(const FrameRecords& frame) const {
        glDepthMask(GL_TRUE);
        glClear(GL_DEPTH_BUFFER_BIT);
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_GREATER);
        for (const Batch& batch : frame.opaque) draw(opaque[batch.variant], batch);
        if (scene.ground) draw(ground, {kPlain, true, 0, 1});
        glDisable(GL_DEPTH_TEST);
    }
    void find_what_is_seen(const FrameRecords& frame) const {
        glBindFramebuffer(GL_FRAMEBUFFER, seen.frame_buffer);
        const std::array<unsigned, 4> nothing{};
        glClearBufferuiv(GL_COLOR, 0, nothing.data());
        draw_opaque(frame);
    }
    void draw_translucent(const FrameRecords& frame) const {
        glEnable(GL_BLEND);
        glDepthMask(GL_FALSE);
        for (const Batch& batch : frame.translucent) {
            if (batch.deck && !forward)
                glDisable(GL_DEPTH_TEST);
            else
                glEnable(GL_DEPTH_TEST);
            draw(batch.deck ? deck : translucent[batch.variant], batch);
        }
        glDisable(GL_BLEND);
        glDisable(GL_DEPTH_TEST);
    }
    void encode_picture() const {
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        cover_picture(encode);
    }

    void draw_forward(const FrameRecords& frame) const {
        glBindFramebuffer(GL_FRAMEBUFFER, picture.frame_buffer);
        cover_picture(sky);
        draw_opaque(frame);
        draw_translucent(frame);
        encode_picture();
    }
    void draw_deferred(const FrameRecords& frame) const {
        find_what_is_seen(frame);
        if (frame.translucent.empty()) {
            glBindFramebuffer(GL_FRAMEBUFFER, 0);
            cover_picture(shade_last);
            return;
        }
        glBindFramebuffer(GL_FRAMEBUFFER, picture.frame_buffer);
        cover_picture(shade);
        draw_translucent(frame);
        encode_picture();
    }

    Scene scene;
    FrameObjects objects;
    GlContext context;
    RecordBuffer records, planes;
    bool forward;
    Target seen, picture;
    std::array<unsigned, 2> blocks{};
    unsigned no_attributes = 0;
    std::array<unsigned, kVariants> opaque{}, translucent{};
    unsigned ground = 0, sky = 0, shade = 0, shade_last = 0, deck = 0, encode = 0;
};

GlPeer::GlPeer(const Scene& scene, int width, int height, Shading shading)
    : impl_(std::make_unique<Impl>(scene, width, height, shading)) {}
GlPeer::~GlPeer() = default;
std::string GlPeer::renderer() const { return impl_->context.renderer(); }

FrameImage GlPeer::render(const View& view) {
    Impl& p = *impl_;
    p.context.make_current();
    const FrameRecords& frame = p.objects.look(view);
    p.records.fill(frame.objects.data(), frame.objects.size());
    if (!frame.planes.empty()) p.planes.fill(frame.planes.data(), frame.planes.size());
    fill_block(p.blocks[0], 0, frame_block(p.scene, view));
    fill_block(p.blocks[1], 1, texture_block(p.scene, view.eye.metres));
    glViewport(0, 0, view.image.width, view.image.height);

    if (p.forward)
        p.draw_forward(frame);
    else
        p.draw_deferred(frame);
    glFinish();
    return p.context.image();
}

}  // namespace quadrig::gl_peer
