#include "cli/report/report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "cli/report/plot.h"
#include "cli/report/plot_axes.h"

namespace petrichor::cli {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t kMostRows = 20000;

// What the script draws: times, panels with their values, events. Five digits are plenty for
// pixels.
std::string data_json(const SimulationTable& table)
{
    const auto rows = rows_to_draw(table, kMostRows);
    const auto short_number = [](double value) {
        char digits[40];
        std::snprintf(digits, sizeof digits, "%.5g", value);
        return std::isnan(value) ? value : std::strtod(digits, nullptr);
    };
    ordered_json times = ordered_json::array();
    for (std::size_t r : rows) times.push_back(table.rows[r][0]);
    ordered_json panels = ordered_json::array();
    for (const PlotPanel& panel : table.panels) {
        const auto [low, high] = axis_range(table, panel);
        ordered_json series = ordered_json::array();
        for (const PlotSeries& line : panel.series) {
            const std::size_t column = column_index(table, line.column);
            if (column == table.columns.size()) continue;
            const auto numbers = [&](const std::string& name) {
                ordered_json out = ordered_json::array();
                const auto values = series_values(table, line, name);
                for (std::size_t r : rows) out.push_back(short_number(values[r]));  // a gap: null
                return out;
            };
            ordered_json entry{{"label", line.label},
                               {"color", line.color},
                               {"filled", line.filled},
                               {"values", numbers(line.column)}};
            if (line.steps) entry["steps"] = true;
            if (!line.band_low.empty()) {
                entry["low"] = numbers(line.band_low);
                entry["high"] = numbers(line.band_high);
            }
            series.push_back(std::move(entry));
        }
        ordered_json dots = ordered_json::array();
        for (const PlotDots& d : panel.dots) {
            dots.push_back({{"label", d.label}, {"times", d.time_s}, {"values", d.values}});
        }
        panels.push_back({{"title", panel.title},
                          {"forcing", panel.forcing},
                          {"low", low},
                          {"high", high},
                          {"series", series},
                          {"dots", dots}});
    }
    ordered_json events = ordered_json::array();
    for (const SimulationEvent& event : table.events) {
        events.push_back({{"t", event.time_s}, {"text", event.text}});
    }
    ordered_json all{{"times", times}, {"panels", panels}, {"events", events}};
    if (!table.gaps_s.empty()) all["gaps"] = table.gaps_s;
    // Milliseconds since 1970 of time 0 by the clock shown, for the names of days.
    if (table.dated) {
        all["start_ms"] = static_cast<double>(table.utc_start_us) * 1e-3 + table.utc_offset_s * 1e3;
        all["clock"] = clock_name(table);
    }
    std::string text = all.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    for (std::size_t at = text.find('<'); at != text.npos; at = text.find('<', at)) {
        text.replace(at, 1, "\\u003c");  // a title must not end the script
    }
    return text;
}

constexpr const char* kStyle = R"css(
:root{color-scheme:light dark;--ground:#f6f8fa;--card:#fff;--ink:#1b2430;--soft:#5b6977;--grid:#e4e9ef;--axis:#93a0ae;--mark:#8a97a6;--accent:#1d6fd1;--warn:#a8480a;--dot:#111827}
@media (prefers-color-scheme:dark){:root{--ground:#10151b;--card:#19212a;--ink:#e6ebf0;--soft:#9aa8b6;--grid:#28323d;--axis:#5d6b79;--mark:#6d7b8a;--accent:#6fb1ff;--warn:#f0a868;--dot:#f3f4f6}}
*{box-sizing:border-box}
body{margin:0;background:var(--ground);color:var(--ink);font:15px/1.5 system-ui,"Segoe UI",Roboto,"DejaVu Sans",sans-serif;-webkit-text-size-adjust:100%}
main{max-width:1080px;margin:0 auto;padding:16px}
h1{font-size:1.35rem;line-height:1.25;margin:4px 0;overflow-wrap:anywhere}
.sub{color:var(--soft);margin:0 0 12px;overflow-wrap:anywhere}
.card{background:var(--card);border-radius:12px;padding:12px;margin:0 0 14px;box-shadow:0 1px 2px rgba(0,0,0,.08)}
.bar{position:sticky;top:0;z-index:2;background:var(--card);display:flex;gap:8px;align-items:center;justify-content:space-between;padding:4px 0 8px}
#now{font-variant-numeric:tabular-nums;font-weight:600}
.bar>span:last-child{flex:none;white-space:nowrap}
button{font:inherit;color:var(--ink);background:none;border:1px solid var(--grid);border-radius:8px;min-width:40px;min-height:36px;padding:0 10px;cursor:pointer}
button:hover{border-color:var(--accent)}
.panel{margin:0 0 8px}
.panel h2{font-size:.92rem;margin:0 0 2px}
.panel h2 b{font-variant-numeric:tabular-nums;margin-left:8px}
.legend{display:flex;flex-wrap:wrap;gap:2px 14px;font-size:.86rem;color:var(--soft);margin-bottom:2px}
.legend span{white-space:nowrap}
.legend i{display:inline-block;width:14px;height:4px;border-radius:2px;margin-right:6px;vertical-align:middle}
.legend i.dot{width:7px;height:7px;border-radius:4px;background:var(--dot)}
.legend b{color:var(--ink);font-variant-numeric:tabular-nums;font-weight:600;display:inline-block;min-width:2.6em}
canvas{display:block;width:100%;touch-action:pan-y;cursor:crosshair}
ol{margin:0;padding-left:0;list-style:none;columns:2 300px;column-gap:24px}
li{break-inside:avoid}
li button{border:0;min-height:34px;padding:2px 4px;text-align:left;width:100%;display:grid;grid-template-columns:1.7em var(--when,5.4em) 1fr;align-items:center}
li .t{color:var(--soft);font-variant-numeric:tabular-nums}
li .n{color:var(--soft)}
.warn{color:var(--warn);margin:0 0 12px;overflow-wrap:anywhere}
table.scores{border-collapse:collapse;font-size:.9rem;margin:0 0 4px}
.scores td,.scores th{padding:2px 14px 2px 0;text-align:left;font-weight:400}
.scores th,.scores small{color:var(--soft)}
.scores td+td{white-space:nowrap}
@media (max-width:560px){.scores small{display:none}}
details{margin:6px 0}
footer{color:var(--soft);font-size:.86rem;overflow-wrap:anywhere}
footer p{margin:2px 0}
)css";

constexpr const char* kScript = R"js(
"use strict";
const D=JSON.parse(document.getElementById("data").textContent);
const T=D.times,N=T.length,t0=T[0],t1=T[N-1]>t0?T[N-1]:t0+1;
let from=t0,to=t1,cursor=null,drawn=false;
const $=id=>document.getElementById(id),charts=$("charts");
const css=name=>getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const tidy=v=>{const s=v.toFixed(6);return s.replace(/\.?0+$/,"")||"0"};
function steps(){const s=[];for(let p=-6;p<2;p++)for(const d of[1,2,5]){const v=d*10**p;if(v<50)s.push(v)}
 s.push(60,120,300,600,1800,3600,7200,10800,21600,43200);for(const d of[1,2,5,10,20,50,100,200,500,1e3,5e3,2e4])s.push(86400*d);return s}
const STEPS=steps();
function ticks(a,b,most){const s=STEPS.find(v=>(b-a)/v<=most)||STEPS[STEPS.length-1],r=[];
 for(let k=Math.ceil(a/s-1e-9);k*s<=b+1e-9*(b-a);k++)r.push(k*s);return[r,s]}
function valueTicks(a,b,most){let s=1e12;for(let p=-6;p<=12;p++){for(const d of[1,2,5]){const v=d*10**p;if((b-a)/v<=most){s=v;p=99;break}}}
 const r=[];for(let k=Math.ceil(a/s-1e-9);k*s<=b+1e-9*(b-a);k++)r.push(k*s);return r}
function timeText(t,s){if(t===0)return"0";if(s>=86400)return tidy(t/86400)+" d";if(s>=3600)return tidy(t/3600)+" h";if(s>=60)return tidy(t/60)+" min";return tidy(t)+" s"}
const S=D.start_ms,MONTHS="Jan Feb Mar Apr May Jun Jul Aug Sep Oct Nov Dec".split(" "),two=v=>String(v).padStart(2,"0");
const dateOf=t=>new Date(S+t*1000),DAY=86400;
const dayText=d=>d.getUTCDate()+" "+MONTHS[d.getUTCMonth()],clockText=d=>two(d.getUTCHours())+":"+two(d.getUTCMinutes());
// Round dates: clock times, days of a month, months, years; as in the static plot.
function dateTicks(a,b,most){const span=b-a,r=[];let step=0;
 for(const m of[1,2,5,10,15,30,60,120,180,360,720])if(!step&&span/(60*m)<=most)step=60*m;
 if(step){const o=S/1000;for(let k=Math.ceil((a+o)/step);k*step-o<=b;k++){const t=k*step-o,d=dateOf(t);r.push([t,d.getUTCHours()||d.getUTCMinutes()?clockText(d):dayText(d)])}if(r.length&&r[0][1].includes(":"))r[0][1]+=" "+dayText(dateOf(r[0][0]));return r}
 for(const n of[1,2,5,10,15])if(!step&&span/(DAY*n)<=most)step=n;
 if(step){const o=S/1000;for(let k=Math.ceil((a+o)/DAY);k*DAY-o<=b;k++){const t=k*DAY-o,d=dateOf(t),n=d.getUTCDate();if((n-1)%step===0&&!(step>1&&n>31-step))r.push([t,dayText(d)])}return r}
 for(const n of[1,2,3,6,12,24,60,120,600])if(!step&&span/(30.4*DAY*n)<=most)step=n;step=step||1200;
 const first=dateOf(a);let m=first.getUTCFullYear()*12+first.getUTCMonth();m-=m%step;
 for(;;m+=step){const t=(Date.UTC(Math.floor(m/12),m%12,1)-S)/1000;if(t>b)break;if(t>=a)r.push([t,m%12?MONTHS[m%12]:String(m/12)])}return r}
function timeTicks(a,b,most){if(S!==undefined&&b-a>=60){const r=dateTicks(a,b,most);if(r.length)return r}const[t,s]=ticks(a,b,most);return t.map(v=>[v,timeText(v,s)])}
function nowText(t){if(S!==undefined){const d=dateOf(t);return d.getUTCFullYear()+"-"+two(d.getUTCMonth()+1)+"-"+two(d.getUTCDate())+" "+clockText(d)}
 if(t1-t0<600)return t.toFixed(2)+" s";const d=Math.floor(t/86400),h=Math.floor(t/3600)%24,m=Math.floor(t/60)%60,s=Math.floor(t%60),z=v=>String(v).padStart(2,"0");
 return(d?d+" d ":"")+z(h)+":"+z(m)+":"+z(s)}
function rowBefore(t){let a=0,b=N-1;while(a<b){const m=(a+b+1)>>1;T[m]<=t?a=m:b=m-1}return a}
function valueAt(s,t){const v=s.values,i=rowBefore(t);if(i===N-1||t<=T[i]||v[i]===null||v[i+1]===null)return v[i];if(s.steps)return v[i+1];const u=(t-T[i])/(T[i+1]-T[i]);return v[i]+(v[i+1]-v[i])*u}
const panels=D.panels.map((p,index)=>{const box=document.createElement("div");box.className="panel";
 const h=document.createElement("h2");h.textContent=p.title;box.append(h);
 const legend=document.createElement("div");legend.className="legend";box.append(legend);
 const reads=p.series.map(s=>{const e=document.createElement("span"),i=document.createElement("i"),b=document.createElement("b");
  if(!s.label&&p.series.length===1&&!p.dots.length){legend.remove();h.append(" ",b);return b}
  i.style.background=s.color;e.append(i,(s.label?s.label+" ":""),b);legend.append(e);return b});
 for(const d of p.dots){const e=document.createElement("span"),i=document.createElement("i");i.className="dot";e.append(i,d.label+" ");legend.append(e)}
 const canvas=document.createElement("canvas");canvas.setAttribute("role","img");canvas.setAttribute("aria-label",p.title);box.append(canvas);charts.append(box);
 return{p,canvas,reads,last:index===D.panels.length-1}});
const LEFT=44,RIGHT=10,GAPS=D.gaps||[];
// Over months a line of hours is a smear: the mean of each day between its lowest and highest hour.
const DAYS=S===undefined?null:T.map(t=>Math.floor((S/1000+t)/86400)),daily=new Map();
function days(s){if(daily.has(s))return daily.get(s);const out=[];let cur=null;
 for(let i=0;i<N;i++){const v=s.values[i];if(v===null){cur=null;continue}
  if(!cur||cur.d!==DAYS[i]){cur={d:DAYS[i],t:(DAYS[i]+.5)*86400-S/1000,lo:v,hi:v,sum:0,n:0,gap:!cur};out.push(cur)}
  cur.lo=Math.min(cur.lo,v);cur.hi=Math.max(cur.hi,v);cur.sum+=v;cur.n++}
 daily.set(s,out);return out}
const PERDAY=(t1-t0)>0?N*86400/(t1-t0):0,MONTHLY=120*86400;
function draw(){const soft=css("--soft"),grid=css("--grid"),axis=css("--axis"),mark=css("--mark"),ink=css("--ink"),dot=css("--dot");
 const width=charts.clientWidth,inner=width-LEFT-RIGHT,x=t=>LEFT+inner*(t-from)/(to-from);
 const tt=timeTicks(from,to,Math.max(2,Math.floor(inner/66)));
 for(const{p,canvas,reads,last}of panels){const base=p.forcing?104:168,narrow=width<560?.86:1,h=Math.round(base*narrow),foot=last?40:22,top=6,ratio=window.devicePixelRatio||1;
  canvas.style.height=h+foot+top+"px";canvas.width=Math.round(width*ratio);canvas.height=Math.round((h+foot+top)*ratio);
  const c=canvas.getContext("2d");c.scale(ratio,ratio);c.clearRect(0,0,width,h+foot+top);c.font="12px system-ui,'DejaVu Sans',sans-serif";
  const y=v=>top+h*(1-(Math.min(p.high,Math.max(p.low,v))-p.low)/(p.high-p.low));
  c.lineWidth=1;c.strokeStyle=grid;c.fillStyle=soft;c.textAlign="right";c.textBaseline="middle";
  for(const v of valueTicks(p.low,p.high,p.forcing?4:5)){c.beginPath();c.moveTo(LEFT,y(v));c.lineTo(width-RIGHT,y(v));c.stroke();c.fillText(tidy(v),LEFT-6,y(v))}
  c.textAlign="center";c.textBaseline="top";
  for(const[t,s]of tt){c.beginPath();c.moveTo(x(t),top);c.lineTo(x(t),top+h);c.stroke();
   const half=c.measureText(s).width/2;c.fillText(s,Math.min(width-half,Math.max(half,x(t))),top+h+(last?22:6))}
  if(p.low<0&&p.high>0){c.strokeStyle=axis;c.beginPath();c.moveTo(LEFT,y(0));c.lineTo(width-RIGHT,y(0));c.stroke()}
  c.save();c.beginPath();c.rect(LEFT,0,inner,h+top+1);c.clip();
  c.fillStyle=mark;c.globalAlpha=.22;for(const[a,b]of GAPS)if(b>from&&a<to)c.fillRect(x(a),top,x(b)-x(a),h);c.globalAlpha=1;
  const i0=rowBefore(from),i1=Math.min(N-1,rowBefore(to)+1);
  const crowd=i1-i0>1500?1.2:2;
  for(const s of p.series){if(DAYS&&PERDAY>5&&to-from>MONTHLY&&!s.filled&&!s.low){const d=days(s).filter(o=>o.t>=from-86400&&o.t<=to+86400);
   for(let a=0;a<d.length;){let b=a+1;while(b<d.length&&!d[b].gap)b++;c.beginPath();for(let k=a;k<b;k++)c.lineTo(x(d[k].t),y(d[k].hi));for(let k=b-1;k>=a;k--)c.lineTo(x(d[k].t),y(d[k].lo));c.closePath();c.globalAlpha=.3;c.fillStyle=s.color;c.fill();c.globalAlpha=1;
    c.beginPath();for(let k=a;k<b;k++)c.lineTo(x(d[k].t),y(d[k].sum/d[k].n));c.strokeStyle=s.color;c.lineWidth=1.3;c.lineJoin="round";c.stroke();a=b}continue}
   if(s.low){c.beginPath();for(let i=i0;i<=i1;i++)c.lineTo(x(T[i]),y(s.high[i]));for(let i=i1;i>=i0;i--)c.lineTo(x(T[i]),y(s.low[i]));c.closePath();c.globalAlpha=.25;c.fillStyle=s.color;c.fill();c.globalAlpha=1}
   c.beginPath();let pen=false;for(let i=i0;i<=i1;i++){const v=s.values[i];if(v===null){pen=false;continue}const X=x(T[i]),Y=y(v);if(s.steps&&pen)c.lineTo(x(T[i-1]),Y);pen?c.lineTo(X,Y):c.moveTo(X,Y);pen=true}
   c.strokeStyle=s.color;c.lineWidth=crowd;c.lineJoin="round";c.stroke();
   if(s.filled&&!s.values.includes(null)){c.lineTo(x(T[i1]),y(p.low));c.lineTo(x(T[i0]),y(p.low));c.closePath();c.globalAlpha=.2;c.fillStyle=s.color;c.fill();c.globalAlpha=1}}
  for(const d of p.dots){c.fillStyle=dot;for(let i=0;i<d.times.length;i++)if(d.times[i]>=from&&d.times[i]<=to){c.beginPath();c.arc(x(d.times[i]),y(d.values[i]),d.times.length>150&&to-from>.5*(t1-t0)?1.6:2.6,0,7);c.fill()}}
  c.restore();
  let lastX=-99;c.fillStyle=soft;c.textBaseline="top";
  const many=D.events.filter(e=>e.t>=from&&e.t<=to).length>20;
  D.events.forEach((e,i)=>{if(e.t<from||e.t>to)return;const X=x(e.t);c.strokeStyle=mark;c.lineWidth=1;c.setLineDash([3,4]);c.globalAlpha=many?.3:1;c.beginPath();c.moveTo(X,0);c.lineTo(X,top+h+4);c.stroke();c.setLineDash([]);c.globalAlpha=1;
   if(last&&X-lastX>14){lastX=X;c.fillText(String(i+1),X,top+h+6)}});
  if(cursor!==null&&cursor>=from&&cursor<=to){c.strokeStyle=ink;c.lineWidth=1;c.beginPath();c.moveTo(x(cursor),0);c.lineTo(x(cursor),top+h);c.stroke();
   for(const s of p.series){if(valueAt(s,cursor)===null)continue;c.fillStyle=s.color;c.beginPath();c.arc(x(cursor),y(valueAt(s,cursor)),3.5,0,7);c.fill()}}
  p.series.forEach((s,i)=>{const v=cursor===null?null:valueAt(s,cursor);reads[i].textContent=cursor===null?"":v===null?"\u2013":v.toFixed(p.high-p.low>5?1:3)})}
 $("now").textContent=cursor===null?"point to read values"+(D.clock?"; times are "+D.clock:"")+(DAYS&&PERDAY>5&&to-from>MONTHLY?"; a line is the mean of each day, its band from the lowest to the highest hour":""):nowText(cursor);drawn=true}
let asked=false;function redraw(){if(asked)return;asked=true;requestAnimationFrame(()=>{asked=false;draw()})}
function view(a,b){const least=(t1-t0)/2000,span=Math.min(t1-t0,Math.max(least,b-a));let f=Math.max(t0,Math.min(a,t1-span));from=f;to=f+span;redraw()}
function zoom(at,factor){view(at-(at-from)*factor,at+(to-at)*factor)}
const timeOf=X=>{const box=charts.getBoundingClientRect();return from+(to-from)*(X-box.left-LEFT)/(box.width-LEFT-RIGHT)};
const pointers=new Map();let grabbed=null;
charts.addEventListener("pointerdown",e=>{if(e.target.tagName!=="CANVAS")return;pointers.set(e.pointerId,e.clientX);
 if(e.pointerType==="mouse")e.target.setPointerCapture(e.pointerId);
 grabbed={x:e.clientX,from,to,moved:false};if(e.pointerType!=="mouse"){cursor=Math.min(to,Math.max(from,timeOf(e.clientX)));redraw()}});
charts.addEventListener("pointermove",e=>{const was=pointers.get(e.pointerId);
 if(was!==undefined&&pointers.size===2){const other=[...pointers].find(p=>p[0]!==e.pointerId)[1],a=Math.abs(was-other),b=Math.abs(e.clientX-other);
  if(a>8&&b>8)zoom(timeOf((e.clientX+other)/2),a/b)}
 else if(was!==undefined&&e.pointerType==="mouse"&&grabbed){const inner=charts.clientWidth-LEFT-RIGHT,d=(e.clientX-grabbed.x)/inner*(grabbed.to-grabbed.from);view(grabbed.from-d,grabbed.to-d)}
 else{cursor=Math.min(to,Math.max(from,timeOf(e.clientX)));redraw()}
 if(was!==undefined)pointers.set(e.pointerId,e.clientX)});
for(const end of["pointerup","pointercancel"])addEventListener(end,e=>{pointers.delete(e.pointerId);grabbed=null});
charts.addEventListener("pointerleave",e=>{if(e.pointerType==="mouse"){cursor=null;redraw()}});
charts.addEventListener("wheel",e=>{if(e.target.tagName!=="CANVAS"||!(e.ctrlKey||e.shiftKey||Math.abs(e.deltaY)<Math.abs(e.deltaX)||document.activeElement===charts))return;
 e.preventDefault();if(Math.abs(e.deltaX)>Math.abs(e.deltaY)){const d=e.deltaX/charts.clientWidth*(to-from);view(from+d,to+d)}else zoom(timeOf(e.clientX),Math.exp(e.deltaY*.002))},{passive:false});
charts.addEventListener("keydown",e=>{const s=(to-from)/40;if(cursor===null)cursor=(from+to)/2;
 if(e.key==="ArrowLeft")cursor=Math.max(t0,cursor-s);else if(e.key==="ArrowRight")cursor=Math.min(t1,cursor+s);
 else if(e.key==="+")zoom(cursor,.7);else if(e.key==="-")zoom(cursor,1/.7);else if(e.key==="Escape")view(t0,t1);else return;
 e.preventDefault();if(cursor<from||cursor>to)view(cursor-(to-from)/2,cursor+(to-from)/2);redraw()});
$("in").onclick=()=>zoom(cursor??(from+to)/2,.6);$("out").onclick=()=>zoom(cursor??(from+to)/2,1/.6);$("all").onclick=()=>view(t0,t1);
D.events.forEach((e,i)=>{const li=document.createElement("li"),b=document.createElement("button"),n=document.createElement("span"),t=document.createElement("span");
 n.className="n";n.textContent=i+1;t.className="t";t.textContent=nowText(e.t);const w=document.createElement("span");w.textContent=e.text;b.append(n,t,w);
 b.onclick=()=>{cursor=e.t;const s=to-from;if(e.t<from||e.t>to)view(e.t-s/2,e.t+s/2);redraw();charts.scrollIntoView({block:"nearest",behavior:"smooth"})};li.append(b);$("events").append(li)});
if(!D.events.length)$("eventcard").hidden=true;
if(S!==undefined)document.documentElement.style.setProperty("--when","9.6em");
// #t=3600 (seconds) or #t=2005-12-01T06:00 sets the cursor, for links to a moment.
function fromHash(){const m=/[#&]t=([^&]+)/.exec(location.hash);if(!m)return;const word=decodeURIComponent(m[1]);let t=Number(word);
 if(Number.isNaN(t)&&S!==undefined)t=(Date.parse(/[zZ]|[+-]\d\d:\d\d$/.test(word)||!word.includes("T")?word:word+"Z")-S)/1000;
 if(!Number.isNaN(t)){cursor=Math.min(t1,Math.max(t0,t));if(cursor<from||cursor>to)view(cursor-(to-from)/2,cursor+(to-from)/2)}}
fromHash();addEventListener("hashchange",()=>{fromHash();redraw()});
new ResizeObserver(redraw).observe(charts);matchMedia("(prefers-color-scheme:dark)").addEventListener("change",redraw);
draw();document.documentElement.dataset.ready=String(drawn&&panels.every(p=>p.canvas.width>0))+":"+panels.length+":"+D.events.length+":"+(document.documentElement.scrollWidth<=innerWidth?"fits":"overflows");
)js";

// "snow_depth_m" as "snow depth".
std::string spelt_out(const std::string& column)
{
    if (column == "swe_kg_m2") return "snow water equivalent";
    std::string words = column;
    for (const char* unit : {"_kg_m2", "_w_m2", "_c", "_m"}) {
        if (words.ends_with(unit)) {
            words.erase(words.rfind(unit));
            break;
        }
    }
    std::replace(words.begin(), words.end(), '_', ' ');
    return words;
}

// Model against observation, where there is any.
std::string scores_table(const SimulationTable& table)
{
    if (table.scores.empty()) return "";
    std::string html =
        "<table class=\"scores\"><tr><th>model against "
        "observation</th><th>RMSE</th><th>bias</th><th>values</th></tr>\n";
    for (const Score& s : table.scores) {
        char cells[160];
        if (s.agreement)
            std::snprintf(cells, sizeof cells, "<td>%.0f %% agree</td><td></td><td>%zu</td></tr>\n",
                          *s.agreement * 100.0, s.count);
        else
            std::snprintf(cells, sizeof cells, "<td>%.3g%s</td><td>%+.2g%s</td><td>%zu</td></tr>\n",
                      s.rmse, unit_text(s).c_str(), s.bias, unit_text(s).c_str(), s.count);
        html += "<tr><td>" + escaped(spelt_out(s.column)) + " <small>" + escaped(s.how) +
                "</small></td>" + cells;
    }
    return html + "</table>\n";
}

// What the shaded times are.
std::string gaps_line(const SimulationTable& table)
{
    const std::string text = gaps_text(table);
    return text.empty() ? text : "<p class=\"warn\">" + text + "</p>\n";
}

// The first and last time of a dated table.
std::string period(const SimulationTable& table)
{
    if (!table.dated || table.rows.empty()) return "";
    return time_text(table, table.rows.front()[0]) + " to " +
           time_text(table, table.rows.back()[0]) + " " + clock_name(table) + "; " +
           (table.typical_year ? "a typical year: months of different years; " : "");
}

}  // namespace

std::string html_report(const SimulationTable& table)
{
    const std::string title = escaped(table.title.empty() ? "weather" : table.title);
    std::string notes, warnings;
    for (const std::string& note : table.notes) notes += "<p>" + escaped(note) + "</p>\n";
    for (const std::string& warning : table.warnings)
        warnings += "<p class=\"warn\">" + escaped(warning) + "</p>\n";
    if (table.rows.size() > rows_to_draw(table, kMostRows).size()) {
        notes += "<p>" + std::to_string(rows_to_draw(table, kMostRows).size()) + " of " +
                 std::to_string(table.rows.size()) + " rows are drawn; the CSV holds all.</p>\n";
    }
    return std::string("<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n") +
           "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
           title + " - petrichor</title>\n<style>" + kStyle +
           "</style>\n</head>\n<body>\n<main>\n" + "<h1>" + title + "</h1>\n<p class=\"sub\">" +
           escaped(table.model) + " model, " + escaped(table.mode) + "; " + period(table) +
           "state " + hash_text(table.state_hash) + "</p>\n" + warnings + gaps_line(table) + scores_table(table) +
           "<noscript>" + svg_plot(table) + "</noscript>\n" +
           "<section class=\"card\"><div class=\"bar\"><span id=\"now\"></span><span>"
           "<button id=\"out\" aria-label=\"zoom out\">&minus;</button> "
           "<button id=\"in\" aria-label=\"zoom in\">+</button> "
           "<button id=\"all\">all</button></span></div>\n"
           "<div id=\"charts\" tabindex=\"0\"></div></section>\n"
           "<section class=\"card\" id=\"eventcard\"><h2 style=\"font-size:1rem;margin:0 0 6px\">"
           "Events</h2><ol id=\"events\"></ol></section>\n<footer><details><summary>What was read, "
           "filled and left out</summary>" +
           notes +
           "</details><p>Drag to move, + and - or pinch to zoom (with a mouse: Shift and wheel); "
           "arrow keys "
           "read values.</p></footer>\n</main>\n<script type=\"application/json\" id=\"data\">" +
           data_json(table) + "</script>\n<script>" + kScript + "</script>\n</body>\n</html>\n";
}

}  // namespace petrichor::cli
