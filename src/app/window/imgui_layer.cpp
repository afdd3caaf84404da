#include "app/window/imgui_layer.h"

#include <backends/imgui_impl_sdl.h>
#include <imgui.h>

#include <cmath>

namespace app {
namespace {

constexpr float designed_pixels = 13;  // ImGui's own letters, which are crisp at whole multiples

ImVec4 rgb(unsigned hex, float alpha = 1) {
  return {static_cast<float>(hex >> 16U & 255U) / 255, static_cast<float>(hex >> 8U & 255U) / 255,
          static_cast<float>(hex & 255U) / 255, alpha};
}

// Charcoal and one warm accent; square corners, as the console would.
void set_style() {
  ImGui::StyleColorsDark();
  auto& style = ImGui::GetStyle();
  style.WindowRounding = style.FrameRounding = style.GrabRounding = style.ScrollbarRounding = 0;
  style.WindowBorderSize = 1;
  style.WindowMinSize = {1, 1};  // panels are as small as the window makes them
  style.WindowPadding = {12, 10};
  style.ItemSpacing = {8, 5};
  style.AntiAliasedLinesUseTex = false;
  auto* colours = style.Colors;
  colours[ImGuiCol_Text] = rgb(0xe8e6df);
  colours[ImGuiCol_TextDisabled] = rgb(0x8d8b98);
  colours[ImGuiCol_WindowBg] = rgb(0x14141c, 0.94F);
  colours[ImGuiCol_PopupBg] = rgb(0x14141c, 0.98F);
  colours[ImGuiCol_Border] = rgb(0x3a3a4a);
  colours[ImGuiCol_TitleBg] = colours[ImGuiCol_TitleBgActive] = rgb(0x242432);
  colours[ImGuiCol_FrameBg] = rgb(0x262634);
  colours[ImGuiCol_FrameBgHovered] = rgb(0x34344a);
  colours[ImGuiCol_FrameBgActive] = rgb(0x404058);
  colours[ImGuiCol_SliderGrab] = colours[ImGuiCol_CheckMark] = rgb(0xf2a33a);
  colours[ImGuiCol_SliderGrabActive] = rgb(0xffc05a);
  colours[ImGuiCol_Button] = rgb(0x2e2e40);
  colours[ImGuiCol_ButtonHovered] = rgb(0x40405a);
  colours[ImGuiCol_ButtonActive] = rgb(0xb87420);
  colours[ImGuiCol_Header] = rgb(0x34344a);
  colours[ImGuiCol_HeaderHovered] = rgb(0x40405a);
  colours[ImGuiCol_HeaderActive] = rgb(0xb87420);
}

SDL_Texture* make_font_texture(SDL_Renderer* renderer) {
  unsigned char* pixels = nullptr;
  int width = 0;
  int height = 0;
  ImGui::GetIO().Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
  SDL_Texture* texture =
      SDL_CreateTexture(renderer, SDL_PIXELFORMAT_RGBA32, SDL_TEXTUREACCESS_STATIC, width, height);
  if (texture == nullptr) return nullptr;
  SDL_UpdateTexture(texture, nullptr, pixels, width * 4);
  SDL_SetTextureBlendMode(texture, SDL_BLENDMODE_BLEND);
  SDL_SetTextureScaleMode(texture, SDL_ScaleModeNearest);
  ImGui::GetIO().Fonts->SetTexID(texture);
  return texture;
}

void draw(SDL_Renderer* renderer, const ImDrawList& list, const ImDrawCmd& command) {
  const SDL_Rect clip{static_cast<int>(command.ClipRect.x), static_cast<int>(command.ClipRect.y),
                      static_cast<int>(command.ClipRect.z - command.ClipRect.x),
                      static_cast<int>(command.ClipRect.w - command.ClipRect.y)};
  if (clip.w <= 0 || clip.h <= 0) return;
  SDL_RenderSetClipRect(renderer, &clip);
  const ImDrawVert* vertices = list.VtxBuffer.Data + command.VtxOffset;
  static_assert(sizeof(SDL_Color) == sizeof(ImU32));  // both are the bytes r, g, b, a
  SDL_RenderGeometryRaw(
      renderer, static_cast<SDL_Texture*>(command.GetTexID()), &vertices->pos.x, sizeof(ImDrawVert),
      reinterpret_cast<const SDL_Color*>(&vertices->col), sizeof(ImDrawVert), &vertices->uv.x,
      sizeof(ImDrawVert), list.VtxBuffer.Size - static_cast<int>(command.VtxOffset),
      list.IdxBuffer.Data + command.IdxOffset, static_cast<int>(command.ElemCount), sizeof(ImDrawIdx));
}

}  // namespace

ImGuiLayer::ImGuiLayer(SDL_Window* window, SDL_Renderer* renderer) : renderer_(renderer) {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  auto& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // a viewer leaves no files behind
  io.LogFilename = nullptr;
  io.BackendRendererName = "otter";
  set_style();
  ImGui_ImplSDL2_InitForSDLRenderer(window);
  set_scale(1);
}

ImGuiLayer::~ImGuiLayer() {
  SDL_DestroyTexture(font_);
  ImGui_ImplSDL2_Shutdown();
  ImGui::DestroyContext();
}

void ImGuiLayer::renew_font() {
  SDL_DestroyTexture(font_);
  font_ = make_font_texture(renderer_);
}

void ImGuiLayer::set_scale(float scale) {
  const float pixels = std::round(designed_pixels * scale);
  if (pixels == letter_pixels_) return;
  letter_pixels_ = pixels;
  ImFontConfig font;
  font.SizePixels = pixels;
  font.OversampleH = 1;
  font.PixelSnapH = true;
  auto* fonts = ImGui::GetIO().Fonts;
  fonts->Clear();
  fonts->AddFontDefault(&font);
  renew_font();
}

float ImGuiLayer::letter_width() { return ImGui::GetIO().Fonts->Fonts[0]->GetCharAdvance('0'); }

void ImGuiLayer::take(const SDL_Event& event) {
  const bool is_key = event.type == SDL_KEYDOWN || event.type == SDL_KEYUP;
  if (is_key && event.key.keysym.sym == SDLK_TAB) return;
  ImGui_ImplSDL2_ProcessEvent(&event);
}

void ImGuiLayer::begin() {
  ImGui_ImplSDL2_NewFrame();
  ImGui::NewFrame();
}

void ImGuiLayer::end() {
  ImGui::Render();
  const ImDrawData& data = *ImGui::GetDrawData();
  for (int i = 0; i < data.CmdListsCount; ++i) {
    const ImDrawList& list = *data.CmdLists[i];
    for (const ImDrawCmd& command : list.CmdBuffer) draw(renderer_, list, command);
  }
  SDL_RenderSetClipRect(renderer_, nullptr);
}

}  // namespace app
