#pragma once
// How the page looks. Colours of plots are the variables up, down, front, ink, soft and line
// (report_plots.h).

#include <string_view>

namespace cost {

inline constexpr std::string_view page_style = R"(
:root{color-scheme:light dark;--ink:#1d2330;--soft:#5c6675;--line:#dfe3ea;--panel:#f5f7fa;--page:#fff;--up:#2f6fb3;--down:#c2541b;--front:#1f8a4c;--own:#eaf1fa;--best:#e8f5ec}
@media(prefers-color-scheme:dark){:root{--ink:#e6e9ef;--soft:#9aa5b5;--line:#313947;--panel:#1b212b;--page:#12161d;--up:#6cabf0;--down:#f08a4b;--front:#4cc07f;--own:#1b2a3d;--best:#173021}}
*{box-sizing:border-box}
body{font:15px/1.5 system-ui,-apple-system,"Segoe UI",Roboto,sans-serif;color:var(--ink);background:var(--page);max-width:1392px;margin:0 auto;padding:36px 32px 80px}
h1{font-size:34px;line-height:1.15;margin:0 0 8px;letter-spacing:-.01em}
h2{font-size:26px;margin:64px 0 2px;padding-top:18px;border-top:3px solid var(--ink)}
h3{font-size:19px;margin:52px 0 4px;padding-top:12px;border-top:1px solid var(--line)}h3 small{font-weight:400;color:var(--soft)}
p{margin:6px 0;max-width:92ch}a{color:var(--up)}.meta{color:var(--soft)}
.found{font-size:17px;line-height:1.45;border-left:4px solid var(--front);background:var(--panel);padding:10px 16px;margin:10px 0 14px;max-width:none}
.pair{display:flex;flex-wrap:wrap;gap:20px 28px;align-items:flex-start}.pair>svg{flex:0 1 580px;min-width:300px}.pair>.wide{flex:1 1 560px;min-width:0}.pair td,.pair th{padding:4px 7px}
svg{max-width:100%;height:auto}svg text{font-family:system-ui,-apple-system,"Segoe UI",Roboto,sans-serif}
table{border-collapse:collapse;font-size:13.5px;font-variant-numeric:tabular-nums;width:100%}
th,td{text-align:right;padding:4px 9px;border-bottom:1px solid var(--line);white-space:nowrap}
th{color:var(--soft);font-weight:600;vertical-align:bottom}.name{text-align:left}td.text{white-space:normal}
.gap{padding-left:26px}th.up{color:var(--up)}th.down{color:var(--down)}.group th{border-bottom:0;padding-bottom:0}
tr.console td{background:var(--own)}td.best{color:var(--front);font-weight:650}
caption{text-align:left;font-weight:600;padding:12px 0 4px}.wide{overflow-x:auto}
details{margin:14px 0}details table{font-size:12px}details td,details th{padding:3px 5px}summary{cursor:pointer;color:var(--soft)}
.pictures{display:flex;flex-wrap:wrap;gap:20px 16px;margin:18px 0}
figure{margin:0;width:320px;font-size:13px}figure.large{width:640px;max-width:100%}
img{display:block;image-rendering:pixelated;background:#000;width:100%;height:auto}
.two{display:flex}.two img{width:50%}.two img:first-child{image-rendering:auto}
figcaption{padding-top:4px;line-height:1.35}figcaption b{font-size:14px}
.scale{display:inline-block;width:120px;height:11px;margin:0 6px;vertical-align:-1px;border:1px solid var(--line)}
code{background:var(--panel);padding:1px 6px;border-radius:3px;font-size:14px}
)";

}  // namespace cost
