#define GL_GLEXT_PROTOTYPES
#include "tests/bench/gl_peer/gl_context.h"

#include <GL/osmesa.h>

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace quadrig::gl_peer {
namespace {

std::string text_of(const std::string& shader) {
    const std::string path = QUADRIG_PEER_SHADERS "/" + shader;
    std::ifstream file(path);
    std::ostringstream text;
    if (!(text << file.rdbuf())) throw std::runtime_error(path + ": cannot be read");
    return text.str();
}

unsigned compile(GLenum stage, const std::string& source, const std::string& name) {
    const unsigned shader = glCreateShader(stage);
    const char* text = source.c_str();
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    int compiled = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (compiled == 0) {
        char log[2000] = "";
        glGetShaderInfoLog(shader, sizeof log, nullptr, log);
        throw std::runtime_error("shader " + name + ": " + log);
    }
    return shader;
}

}  // namespace

void GlContext::Deleter::operator()(void* context) const {
    OSMesaMakeCurrent(nullptr, nullptr, 0, 0, 0);
    OSMesaDestroyContext(static_cast<OSMesaContext>(context));
}

GlContext::GlContext(int width, int height)
    : width_(width), height_(height), pixels_(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
    const int attributes[] = {OSMESA_FORMAT,
                              OSMESA_RGBA,
                              OSMESA_DEPTH_BITS,
                              0,
                              OSMESA_PROFILE,
                              OSMESA_CORE_PROFILE,
                              OSMESA_CONTEXT_MAJOR_VERSION,
                              4,
                              OSMESA_CONTEXT_MINOR_VERSION,
                              5,
                              0,
                              0};
    context_.reset(OSMesaCreateContextAttribs(attributes, nullptr));
    if (!context_) throw std::runtime_error("OSMesa gives no context of GL 4.5 core");
    make_current();
    OSMesaPixelStore(OSMESA_Y_UP, 0);
}

GlContext::~GlContext() = default;

void GlContext::make_current() const {
    auto* pixels = const_cast<std::uint8_t*>(pixels_.data());
    if (!OSMesaMakeCurrent(static_cast<OSMesaContext>(context_.get()), pixels, GL_UNSIGNED_BYTE, width_, height_))
        throw std::runtime_error("OSMesa refuses a frame buffer of " + std::to_string(width_) + "x" +
                                 std::to_string(height_));
}

FrameImage GlContext::image() { return {pixels_.data(), width_, height_, std::ptrdiff_t{4} * width_}; }

std::string GlContext::renderer() const { return reinterpret_cast<const char*>(glGetString(GL_RENDERER)); }

unsigned make_program(const std::string& vertex, std::initializer_list<std::string> fragment,
                      const std::vector<std::string>& defines) {
    std::string head = "#version 450 core\n";
    for (const std::string& define : defines) head += "#define " + define + "\n";
    head += text_of("frame.glsl");
    std::string body = head, name;
    for (const std::string& file : fragment) body += text_of(file), name = file;
    const unsigned program = glCreateProgram();
    for (const unsigned shader :
         {compile(GL_VERTEX_SHADER, head + text_of(vertex), vertex), compile(GL_FRAGMENT_SHADER, body, name)}) {
        glAttachShader(program, shader);
        glDeleteShader(shader);
    }
    glLinkProgram(program);
    int linked = 0;
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    if (linked == 0) throw std::runtime_error("shaders " + vertex + " and " + name + " do not link");
    constexpr const char* kBlocks[] = {"Frame", "Textures"};
    for (unsigned i = 0; i < 2; ++i) {
        const unsigned block = glGetUniformBlockIndex(program, kBlocks[i]);
        if (block != GL_INVALID_INDEX) glUniformBlockBinding(program, block, i);
    }
    glUseProgram(program);
    constexpr const char* kSamplers[] = {"objects", "planes", "seen", "picture"};
    for (int i = 0; i < 4; ++i) {
        const int place = glGetUniformLocation(program, kSamplers[i]);
        if (place >= 0) glUniform1i(place, i);
    }
    return program;
}

RecordBuffer::RecordBuffer(unsigned unit) {
    unsigned texture = 0;
    glGenBuffers(1, &buffer_);
    glGenTextures(1, &texture);
    glActiveTexture(GL_TEXTURE0 + unit);
    glBindTexture(GL_TEXTURE_BUFFER, texture);
    fill(nullptr, 4);
    glTexBuffer(GL_TEXTURE_BUFFER, GL_RGBA32F, buffer_);
}

void RecordBuffer::fill(const float* values, std::size_t floats) {
    glBindBuffer(GL_TEXTURE_BUFFER, buffer_);
    glBufferData(GL_TEXTURE_BUFFER, static_cast<GLsizeiptr>(floats * sizeof(float)), values, GL_STREAM_DRAW);
}

Target make_target(int width, int height, unsigned colour_format, unsigned unit, unsigned depth) {
    Target target;
    glGenTextures(1, &target.colour);
    glActiveTexture(GL_TEXTURE0 + unit);
    glBindTexture(GL_TEXTURE_2D, target.colour);
    glTexStorage2D(GL_TEXTURE_2D, 1, colour_format, width, height);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glGenFramebuffers(1, &target.frame_buffer);
    glBindFramebuffer(GL_FRAMEBUFFER, target.frame_buffer);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target.colour, 0);
    if (depth != 0) glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw std::runtime_error("OSMesa does not draw into a texture of format " + std::to_string(colour_format));
    return target;
}

unsigned make_depth(int width, int height) {
    unsigned depth = 0;
    glGenRenderbuffers(1, &depth);
    glBindRenderbuffer(GL_RENDERBUFFER, depth);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, width, height);
    return depth;
}

}  // namespace quadrig::gl_peer
