/* three:
The MIT License

Copyright © 2010-2024 three.js authors

Permission is hereby granted, free of charge, to any person obtaining a copy
of this software and associated documentation files (the "Software"), to deal
in the Software without restriction, including without limitation the rights
to use, copy, modify, merge, publish, distribute, sublicense, and/or sell
copies of the Software, and to permit persons to whom the Software is
furnished to do so, subject to the following conditions:

The above copyright notice and this permission notice shall be included in
all copies or substantial portions of the Software.

THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR
IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY,
FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE
AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER
LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM,
OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN
THE SOFTWARE.
*/
/* uplot:
The MIT License (MIT)

Copyright (c) 2022 Leon Sorokin

Permission is hereby granted, free of charge, to any person obtaining a copy
of this software and associated documentation files (the "Software"), to deal
in the Software without restriction, including without limitation the rights
to use, copy, modify, merge, publish, distribute, sublicense, and/or sell
copies of the Software, and to permit persons to whom the Software is
furnished to do so, subject to the following conditions:

The above copyright notice and this permission notice shall be included in
all copies or substantial portions of the Software.

THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR
IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY,
FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE
AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER
LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM,
OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN
THE SOFTWARE.*/
"use strict";(()=>{function $i(i){return`\u2068${i}\u2069`}function U(i,t={},...e){let n=document.createElement(i);for(let[s,r]of Object.entries(t))r===void 0||r===!1||n.setAttribute(s,r===!0?"":String(r));return n.append(...e),n}function ee(i,t,e,n){let s=U("button",{type:"button",title:t,"aria-pressed":n===void 0?void 0:String(n)},i);return s.addEventListener("click",e),s}function Ci(i,t,e,n){let s=ee(i,t,()=>{let r=s.getAttribute("aria-pressed")!=="true";s.setAttribute("aria-pressed",String(r)),n(r)},e);return s}function Sn(i,t,e,n){let s=U("select",{"aria-label":i,title:i});for(let[r,o]of t)s.append(U("option",{value:r,selected:r===e},o));return s.addEventListener("change",()=>n(s.value)),s}function $o(i){return i.map(([t,e])=>U("th",{scope:"col",title:e},t))}function Zs(i,t){i?.setAttribute("role","img"),i?.setAttribute("aria-label",t)}function qo(i){let{clientWidth:t,clientHeight:e}=i;if(t===0)return null;let n=devicePixelRatio;i.width=t*n,i.height=e*n;let s=i.getContext("2d");return s?.scale(n,n),s}function Yo(i,t,e){i.hidden=!(t>=0&&t<=e),i.hidden||(i.style.transform=`translateX(${t}px)`)}function Le(i){return getComputedStyle(document.documentElement).getPropertyValue(`--${i}`).trim()}function me(i){if(i==null||!Number.isFinite(i))return"\u2013";if(Number.isInteger(i))return un(i);let t=Math.abs(i);if(t<1e-4)return i.toExponential(1);let e=t>=100?0:Math.min(6,2-Math.floor(Math.log10(t||1)));return i.toFixed(e)}function un(i){return i.toLocaleString("en-US")}function Dn(i,t){return`${un(i)} ${t}${i===1?"":"s"}`}function qn(i){return i.replace(/_/g," ")}var Zo="button, select, input, a[href]";function qi(i,t){let e=null,n=l=>[...l.querySelectorAll(Zo)].filter(c=>!c.matches(":disabled")),s=()=>[...i.querySelectorAll(t)].filter(l=>!l.hidden).map(n).filter(l=>l.length>0),r=()=>{let l=s();(e===null||!l.some(c=>c.includes(e)))&&(e=(l.find(c=>c[0].closest("thead")===null)??l[0])?.[0]??null);for(let c of i.querySelectorAll(Zo)){let u=c===e?0:-1;c.tabIndex!==u&&(c.tabIndex=u)}},o=l=>l.closest("td, th")?.cellIndex??0,a=(l,c)=>{let u=s(),d=u.findIndex(f=>f.includes(l));if(d<0)return null;let h=u[d],p=h.indexOf(l),g=c.ctrlKey,v={ArrowUp:d-1,ArrowDown:d+1,PageUp:Math.max(0,d-10),PageDown:Math.min(u.length-1,d+10),Home:0,End:u.length-1};if(c.key in v&&(g||!/^(Home|End)$/.test(c.key))){if(/^Arrow/.test(c.key)&&l.tagName==="SELECT"&&!g)return null;let f=u[v[c.key]];return f?.find(T=>o(T)===o(l))??f?.[0]??null}let m={ArrowLeft:p-1,ArrowRight:p+1,Home:0,End:h.length-1};return c.key in m&&h.length>1?h[m[c.key]]??l:null};i.addEventListener("focusin",l=>{let c=l.target.closest(Zo);c!==null&&(e=c,r())}),i.addEventListener("keydown",l=>{if(l.altKey||l.metaKey||l.shiftKey)return;let c=l.target.closest(Zo),u=c===null?null:a(c,l);u!==null&&(l.preventDefault(),l.stopPropagation(),u.focus())}),new MutationObserver(r).observe(i,{childList:!0,subtree:!0,attributes:!0,attributeFilter:["hidden","disabled"]}),r()}var Au=matchMedia("(prefers-color-scheme: dark)");function Tu(){let i=document.documentElement.dataset.theme;return i===void 0?Au.matches:i==="dark"}function Js(i,t){let e=ee("","switch between light and dark",()=>{document.documentElement.dataset.theme=Tu()?"light":"dark",n(),i()}),n=()=>{e.textContent=Tu()?"Light":"Dark"};return Au.addEventListener("change",()=>{n(),i()},{signal:t}),n(),e}function Jo(i){return(i.figures?.frames_repaired??0)/Math.max(1,i.frames??1)}function $l(i){return(i.status==="failed"?1e9:0)+1e3*(i.warnings?.length??0)+Jo(i)}var Cu=[["all","all takes",()=>!0],["failed","failed",i=>i.status==="failed"],["warnings","with warnings",i=>(i.warnings?.length??0)>0],["repaired","with repairs",i=>Jo(i)>0],["refused","with gaps left",i=>(i.figures?.gaps_refused??0)+(i.figures?.gaps_left??0)>0],["clean","nothing to review",i=>$l(i)===0]];function ag({row:i,page:t,picture:e}){let n=t===""?U("span",{},i.name):U("a",{href:t.split("/").map(encodeURIComponent).join("/")},i.name),s=U("th",{scope:"row"},n);e&&s.append(U("img",{class:"poses",src:`data:image/svg+xml,${encodeURIComponent(e)}`,alt:`poses of ${i.name}`,loading:"lazy"}));let r=U("tr",{},s),o=U("td",{class:"share"}),a=U("i");a.style.width=`${Math.min(100,100*Jo(i))}%`,o.append(a,U("span",{},i.status==="failed"?"\u2013":`${me(100*Jo(i))} %`));let l=i.frames&&i.frame_rate_hz?i.frames/i.frame_rate_hz:null;return r.append(U("td",{class:"words"},i.error??i.verdict??"",...(i.warnings??[]).map(c=>U("p",{class:"warning"},c))),o,U("td",{},me(i.figures?.spikes)),U("td",{},me(i.figures?.gaps)),U("td",{},l===null?"\u2013":`${me(l)} s`)),r.className=i.status,r}function Ru(i,t){let e=t.rows.filter(({row:h})=>h.status!=="copied").sort((h,p)=>$l(p.row)-$l(h.row)||h.row.name.localeCompare(p.row.name)),n=U("tbody"),s=U("p",{class:"verdict",role:"status"}),r=U("input",{type:"search",placeholder:"find a take","aria-label":"find a take"}),o="all",a=()=>{let h=Cu.find(([v])=>v===o)?.[2]??(()=>!0),p=r.value.toLowerCase(),g=e.filter(({row:v})=>h(v)&&`${v.name} ${v.verdict??""} ${v.error??""}`.toLowerCase().includes(p));n.replaceChildren(...g.map(ag)),s.textContent=`${un(g.length)} of ${Dn(e.length,"take")}; needs review, worst first`,g.length===0&&n.append(U("tr",{},U("td",{colspan:"6",class:"words empty"},"No take matches.")))};r.addEventListener("input",a);let l=Sn("which takes",Cu.map(([h,p,g])=>[h,`${p} (${un(e.filter(({row:v})=>g(v)).length)})`]),o,h=>{o=h,a()}),c=U("tr",{},...$o([["take","Name of the file; a link leads to the page of this take."],["what was found","The verdict of this take, its warnings, or why it failed."],["frames repaired","Share of the frames in which a spike was repaired or a gap filled, in percent."],["spikes","Number of spikes that were repaired."],["gaps","Number of gaps that were filled."],["length","Duration of the take, in seconds."]])),u=U("dl");for(let[h,p]of Object.entries(t.summary.figures))u.append(U("div",{},U("dt",{},qn(h)),U("dd",{},me(p))));let d=U("table",{},U("thead",{},c),n);qi(d,"tr"),i.replaceChildren(U("header",{},U("div",{},U("h1",{},"Batch"),s),Js(()=>{})),U("section",{class:"batch"},U("div",{class:"head"},l,r),U("div",{class:"scroll",tabindex:e.some(({page:h})=>h!=="")?void 0:"0"},d)),U("div",{class:"facts"},U("section",{class:"box"},U("h2",{},"All takes"),u),U("section",{class:"box"},U("h2",{},"Made by"),U("p",{},`kinemend ${t.summary.kinemend}`),U("code",{tabindex:"0"},t.command_line)))),a(),i.dataset.ready="true"}var{port1:lg,port2:cg}=new MessageChannel,Pu=[];lg.onmessage=()=>Pu.shift()?.();function Ks(){return new Promise(i=>{Pu.push(i),cg.postMessage(null)})}var Ko=class{constructor(){this.end=performance.now()+8}async rest(){performance.now()<this.end||(await Ks(),this.end=performance.now()+8)}};function hg(i){let t=atob(i.textContent??"");i.textContent="";let e=new Uint8Array(t.length);for(let n=0;n<t.length;++n)e[n]=t.charCodeAt(n);return e}async function Yl(i){let t=document.getElementById(`data-${i}`);if(t===null)return null;let e=hg(t),n=new Blob([e]).stream().pipeThrough(new DecompressionStream("deflate"));return new Uint8Array(await new Response(n).arrayBuffer())}async function _i(i,t=Yl){let e=await t(i);return e===null?null:JSON.parse(new TextDecoder().decode(e))}function Lu(i,t,e){return Array.from({length:i},()=>({before:new Int32Array(t),after:e?new Int32Array(t):null}))}var ql=class{constructor(t){this.bytes=t;this.at=0}byte(){return this.bytes[this.at++]??0}remainders(t){let e=new Int32Array(t),n=this.bytes;for(let s=0;s<4;++s){let r=8*s,o=this.at+s*t;for(let a=0;a<t;++a)e[a]|=n[o+a]<<r}this.at+=4*t;for(let s=0;s<t;++s)e[s]=e[s]>>>1^-(e[s]&1);return e}};function ug(i,t,e,n){return i+Math.floor((t-i)*e/n)|0}function dg(i,t){for(let e=0;e<i.length;++e){let n=e%t;if(n===0)continue;let s=e-n,r=s+t;i[e]=r<i.length?ug(i[s],i[r],n,t):i[s]}}function fg(i,t,e){let n=i.byte(),s=i.remainders(Math.ceil(t.length/e)),r=0,o=0;s.forEach((a,l)=>{let c=n===0?0:n===1?r:2*r-o,u=a+c|0;o=l===0?u:r,r=u,t[l*e]=u}),e>1&&dg(t,e)}function pg(i,t,e){let n=i.byte(),s=i.remainders(t.length-Math.ceil(t.length/e)),r=0;for(let o=0;o<t.length;++o)o%e!==0&&(t[o]=s[r++]+(n===0?0:t[o])|0)}async function Iu(i,t,e,n){let s=new ql(i),r=new Ko;for(let o of t){if(await r.rest(),o.before.length===0)continue;if(o.after===null){n(s,o.before,e);continue}let[a,l]=s.byte()===1?[o.before,o.after]:[o.after,o.before];for(let c=0;c<l.length;++c)l[c]=l[c]-a[c]|0;n(s,a,e),n(s,l,e);for(let c=0;c<l.length;++c)l[c]=l[c]+a[c]|0}}function Du(i,t,e){return Iu(i,t,e,fg)}function Nu(i,t,e){return Iu(i,t,e,pg)}var mg="\u2026";function gg(i){if(i.length<2)return"";let t=i[0].length;for(let n of i){let s=0;for(;s<Math.min(t,n.length)&&n[s]===i[0][s];)++s;t=s}let e=/^.*[:|_.\-/ ]/s.exec(i[0].slice(0,t))?.[0]??"";return i.every(n=>n.length>e.length)?e:""}function _g(i){let t=Array.from(i);if(t.length<=18)return i;let e=Math.ceil((18-1)/2);return t.slice(0,18-1-e).join("")+mg+t.slice(-e).join("")}function Uu(i){let t=gg(i),e=i.map(r=>r.slice(t.length)),n=e.map(_g),s=new Map;return n.forEach((r,o)=>s.set(r,(s.get(r)??new Set).add(i[o]))),n.map((r,o)=>(s.get(r)?.size??0)>1?e[o]:r)}var Ou={X:0,Y:1,Z:2,x:0,y:1,z:2},Fu=Math.PI/360;function jo(i,t){return[i[0]*t[0]-i[1]*t[1]-i[2]*t[2]-i[3]*t[3],i[0]*t[1]+i[1]*t[0]+i[2]*t[3]-i[3]*t[2],i[0]*t[2]-i[1]*t[3]+i[2]*t[0]+i[3]*t[1],i[0]*t[3]+i[1]*t[2]-i[2]*t[1]+i[3]*t[0]]}function zu(i,t){let[e,n,s,r]=jo([i[0],-i[1],-i[2],-i[3]],t),o=Math.hypot(n,s,r);if(o<1e-12)return[0,0,0];let a=2*Math.atan2(o,Math.abs(e))*(e<0?-1:1)*180/Math.PI/o;return[n*a,s*a,r*a]}function ku(i,t,e,n,s){let[r,o,a,l]=i,c=2*(a*t[2]-l*t[1]),u=2*(l*t[0]-o*t[2]),d=2*(o*t[1]-a*t[0]);e[s]=e[n]+t[0]+r*c+a*d-l*u,e[s+1]=e[n+1]+t[1]+r*u+l*c-o*d,e[s+2]=e[n+2]+t[2]+r*d+o*u-a*c}function Bu(i,t,e){let n=new Map;for(let[s,r,o]of i){let a=n.get(s)??new Uint8Array(t);a.fill(1,Math.ceil(r/e),Math.floor(o/e)+1),n.set(s,a)}return n}var Yi=class{constructor(t,e){this.data=t;this.parts=e;this.rotationChannels=[];this.translatedChannels=new Map;this.missing=new Map;this.told=t.told,this.samples=Lu(t.quanta.length,t.told,t.two),this.points=t.names.length+(t.skeleton?.ends.length??0),this.whole=t.stride===1,this.short=Uu(t.names);let n=t.skeleton;if(n){let s=3;for(let r of n.translated)this.translatedChannels.set(r,s),s+=3;for(let r of n.orders)this.rotationChannels.push(s),s+=r.length}for(let s of["before","after"]){let r=t.gaps[s];r!==null&&(this.missing.set(`${s} own`,Bu(r.own,t.told,t.step)),this.missing.set(`${s} positions`,Bu(r.positions,t.told,t.step)))}}static async load(t,e=Yl){let n=new Yi(t,e),s=await e("first");return s!==null&&await Du(s,n.samples,t.stride),n}async loadRest(){let t=this.whole?null:await this.parts("second");t!==null&&await Nu(t,this.samples,this.data.stride),this.whole=!0}get isJoints(){return this.data.skeleton!==void 0}get takes(){return this.data.two?["before","after"]:["before"]}get last(){return this.data.two?"after":"before"}get rate(){return this.data.rate/this.data.step}nameOf(t){return this.data.names[t]||`(no name, ${t+1})`}shortName(t){return this.short[t]||this.nameOf(t)}tracksOf(t){let e=this.data.names.indexOf(t??"");return e>=0?[e]:(t??"").split(", ").map(n=>this.data.names.indexOf(n)).filter(n=>n>=0)}distance(t){if(!this.data.two)return 0;let e=this.pose(t,"before"),n=this.pose(t,"after"),s=0,r=0;for(let o=0;o<this.points;++o){let a=Math.hypot(n[3*o]-e[3*o],n[3*o+1]-e[3*o+1],n[3*o+2]-e[3*o+2]);!this.isShown(o)||Number.isNaN(a)||(s+=a,++r)}return r>0?s/r:0}number(t){return t*this.data.step+this.data.first_frame}frameOf(t){let e=Math.round((t-this.data.first_frame)/this.data.step);return Math.max(0,Math.min(this.told-1,e))}value(t,e,n){let s=this.samples[t];return(n==="after"&&s.after!==null?s.after:s.before)[e]*this.data.quanta[t]}isShown(t){return this.data.shown?.[t]??!0}isMissing(t,e,n){return this.missing.get(`${n} own`)?.get(t)?.[e]===1}isPositionMissing(t,e,n){return this.missing.get(`${n} positions`)?.get(t)?.[e]===1}firstSeen(){return Math.max(0,this.findSeen())}get isEverSeen(){return this.findSeen()>=0}findSeen(){if(this.told===0||this.points===0)return-1;if(this.isJoints)return 0;for(let t=0;t<this.told;++t)for(let e=0;e<this.points;++e)if(this.isShown(e)&&!this.isMissing(e,t,this.last))return t;return-1}order(t){return this.data.skeleton?.orders[t]??""}angle(t,e,n,s){return this.isMissing(t,n,s)?null:this.value(this.rotationChannels[t]+e,n,s)}channel(t,e){let{before:n,after:s}=this.samples[t];return[e==="after"&&s!==null?s:n,this.data.quanta[t]]}rotations(t,e){let n=new Float64Array(4*this.told);for(let s=0;s<this.told;++s)n[4*s]=1;return[...this.order(t)].forEach((s,r)=>{let[o,a]=this.channel(this.rotationChannels[t]+r,e),l=1+Ou[s],c=1+l%3,u=1+c%3;for(let d=0,h=0;d<this.told;++d,h+=4){let p=o[d]*a*Fu,g=Math.cos(p),v=Math.sin(p),m=n[h],f=n[h+l],T=n[h+c],b=n[h+u];n[h]=m*g-f*v,n[h+l]=m*v+f*g,n[h+c]=T*g+b*v,n[h+u]=b*g-T*v}}),n}turnsApart(t){let e=this.rotations(t,"before"),n=this.rotations(t,"after"),s=this.missing.get("before own")?.get(t),r=this.missing.get("after own")?.get(t),o=new Array(this.told);for(let a=0,l=0;a<this.told;++a,l+=4){if(s?.[a]===1||r?.[a]===1){o[a]=null;continue}let[c,u,d,h]=[e[l],e[l+1],e[l+2],e[l+3]],[p,g,v,m]=[n[l],n[l+1],n[l+2],n[l+3]],f=Math.hypot(c*g-u*p-d*m+h*v,c*v+u*m-d*p-h*g,c*m-u*v+d*g-h*p);o[a]=2*Math.atan2(f,Math.abs(c*p+u*g+d*v+h*m))*180/Math.PI}return o}rotation(t,e,n){let s=[1,0,0,0],r=this.order(t);for(let o=0;o<r.length;++o){let a=this.value(this.rotationChannels[t]+o,e,n)*Fu,l=[Math.cos(a),0,0,0];l[1+Ou[r[o]]]=Math.sin(a),s=jo(s,l)}return s}vector(t,e,n){return[this.value(t,e,n),this.value(t+1,e,n),this.value(t+2,e,n)]}pose(t,e,n=new Float32Array(3*this.points)){let s=this.data.skeleton;if(this.told===0)return n.fill(NaN);if(!s){for(let o=0;o<this.points;++o)n.set(this.vector(3*o,t,e),3*o),this.isMissing(o,t,e)&&(n[3*o]=NaN);return n}let r=[];return s.parents.forEach((o,a)=>{let l=jo(s.rests[a],this.rotation(a,t,e)),c=a===0?0:this.translatedChannels.get(a),u=c===void 0?s.offsets[a]:this.vector(c,t,e);o<0?(r.push(l),n.set(u,3*a)):(r.push(jo(r[o],l)),ku(r[o],u,n,3*o,3*a))}),s.ends.forEach((o,a)=>ku(r[o.parent],o.offset,n,3*o.parent,3*(s.parents.length+a))),n}path(t,e){let n=[[],[],[]],s=this.isJoints&&t===0,r=new Float32Array(3*this.points);for(let o=0;o<this.told;++o){let l=!this.isJoints||s?this.vector(3*(s?0:t),o,e):this.pose(o,e,r).subarray(3*t,3*t+3),c=s?this.isPositionMissing(0,o,e):this.isMissing(t,o,e);for(let u=0;u<3;++u)n[u].push(c?null:l[u])}return n}angles(t,e){let n=this.missing.get(`${e} own`)?.get(t);return[...this.order(t)].map((s,r)=>{let[o,a]=this.channel(this.rotationChannels[t]+r,e),l=new Array(this.told);for(let c=0;c<this.told;++c)l[c]=n?.[c]===1?null:o[c]*a;return l})}};/**
 * @license
 * Copyright 2010-2024 Three.js Authors
 * SPDX-License-Identifier: MIT
 */var uh="165",Ps={LEFT:0,MIDDLE:1,RIGHT:2,ROTATE:0,DOLLY:1,PAN:2},Ls={ROTATE:0,PAN:1,DOLLY_PAN:2,DOLLY_ROTATE:3},vg=0,Vu=1,yg=2;var yf=1,xg=2,Ni=3,ss=0,Un=1,Ui=2,ns=0,vr=1,Hu=2,Gu=3,Wu=4,Mg=5,ws=100,bg=101,wg=102,Sg=103,Eg=104,Tg=200,Ag=201,Cg=202,Rg=203,Cc=204,Rc=205,Pg=206,Lg=207,Ig=208,Dg=209,Ng=210,Ug=211,Og=212,Fg=213,kg=214,Bg=0,zg=1,Vg=2,Ea=3,Hg=4,Gg=5,Wg=6,Xg=7,dh=0,$g=1,qg=2,is=0,Yg=1,Zg=2,Jg=3,Kg=4,jg=5,Qg=6,t0=7;var xf=300,br=301,wr=302,Pc=303,Lc=304,tl=306,Ic=1e3,Es=1001,Dc=1002,Nn=1003,e0=1004;var Qo=1005;var ai=1006,Zl=1007;var Ts=1008;var rs=1009,n0=1010,i0=1011,Ta=1012,Mf=1013,Sr=1014,Oi=1015,el=1016,bf=1017,wf=1018,Er=1020,s0=35902,r0=1021,o0=1022,xi=1023,a0=1024,l0=1025,yr=1026,Tr=1027,Sf=1028,Ef=1029,c0=1030,Tf=1031,Af=1033,Jl=33776,Kl=33777,jl=33778,Ql=33779,Xu=35840,$u=35841,qu=35842,Yu=35843,Zu=36196,Ju=37492,Ku=37496,ju=37808,Qu=37809,td=37810,ed=37811,nd=37812,id=37813,sd=37814,rd=37815,od=37816,ad=37817,ld=37818,cd=37819,hd=37820,ud=37821,tc=36492,dd=36494,fd=36495,h0=36283,pd=36284,md=36285,gd=36286;var Aa=2300,Nc=2301,ec=2302,_d=2400,vd=2401,yd=2402;var u0=3200,d0=3201,Cf=0,f0=1,es="",vi="srgb",ls="srgb-linear",fh="display-p3",nl="display-p3-linear",Ca="linear",Ue="srgb",Ra="rec709",Pa="p3";var js=7680;var xd=519,p0=512,m0=513,g0=514,Rf=515,_0=516,v0=517,y0=518,x0=519,Md=35044;var bd="300 es",Fi=2e3,La=2001,bi=class{addEventListener(t,e){this._listeners===void 0&&(this._listeners={});let n=this._listeners;n[t]===void 0&&(n[t]=[]),n[t].indexOf(e)===-1&&n[t].push(e)}hasEventListener(t,e){if(this._listeners===void 0)return!1;let n=this._listeners;return n[t]!==void 0&&n[t].indexOf(e)!==-1}removeEventListener(t,e){if(this._listeners===void 0)return;let s=this._listeners[t];if(s!==void 0){let r=s.indexOf(e);r!==-1&&s.splice(r,1)}}dispatchEvent(t){if(this._listeners===void 0)return;let n=this._listeners[t.type];if(n!==void 0){t.target=this;let s=n.slice(0);for(let r=0,o=s.length;r<o;r++)s[r].call(this,t);t.target=null}}},gn=["00","01","02","03","04","05","06","07","08","09","0a","0b","0c","0d","0e","0f","10","11","12","13","14","15","16","17","18","19","1a","1b","1c","1d","1e","1f","20","21","22","23","24","25","26","27","28","29","2a","2b","2c","2d","2e","2f","30","31","32","33","34","35","36","37","38","39","3a","3b","3c","3d","3e","3f","40","41","42","43","44","45","46","47","48","49","4a","4b","4c","4d","4e","4f","50","51","52","53","54","55","56","57","58","59","5a","5b","5c","5d","5e","5f","60","61","62","63","64","65","66","67","68","69","6a","6b","6c","6d","6e","6f","70","71","72","73","74","75","76","77","78","79","7a","7b","7c","7d","7e","7f","80","81","82","83","84","85","86","87","88","89","8a","8b","8c","8d","8e","8f","90","91","92","93","94","95","96","97","98","99","9a","9b","9c","9d","9e","9f","a0","a1","a2","a3","a4","a5","a6","a7","a8","a9","aa","ab","ac","ad","ae","af","b0","b1","b2","b3","b4","b5","b6","b7","b8","b9","ba","bb","bc","bd","be","bf","c0","c1","c2","c3","c4","c5","c6","c7","c8","c9","ca","cb","cc","cd","ce","cf","d0","d1","d2","d3","d4","d5","d6","d7","d8","d9","da","db","dc","dd","de","df","e0","e1","e2","e3","e4","e5","e6","e7","e8","e9","ea","eb","ec","ed","ee","ef","f0","f1","f2","f3","f4","f5","f6","f7","f8","f9","fa","fb","fc","fd","fe","ff"],wd=1234567,vo=Math.PI/180,Mo=180/Math.PI;function Ur(){let i=Math.random()*4294967295|0,t=Math.random()*4294967295|0,e=Math.random()*4294967295|0,n=Math.random()*4294967295|0;return(gn[i&255]+gn[i>>8&255]+gn[i>>16&255]+gn[i>>24&255]+"-"+gn[t&255]+gn[t>>8&255]+"-"+gn[t>>16&15|64]+gn[t>>24&255]+"-"+gn[e&63|128]+gn[e>>8&255]+"-"+gn[e>>16&255]+gn[e>>24&255]+gn[n&255]+gn[n>>8&255]+gn[n>>16&255]+gn[n>>24&255]).toLowerCase()}function vn(i,t,e){return Math.max(t,Math.min(e,i))}function ph(i,t){return(i%t+t)%t}function M0(i,t,e,n,s){return n+(i-t)*(s-n)/(e-t)}function b0(i,t,e){return i!==t?(e-i)/(t-i):0}function yo(i,t,e){return(1-e)*i+e*t}function w0(i,t,e,n){return yo(i,t,1-Math.exp(-e*n))}function S0(i,t=1){return t-Math.abs(ph(i,t*2)-t)}function E0(i,t,e){return i<=t?0:i>=e?1:(i=(i-t)/(e-t),i*i*(3-2*i))}function T0(i,t,e){return i<=t?0:i>=e?1:(i=(i-t)/(e-t),i*i*i*(i*(i*6-15)+10))}function A0(i,t){return i+Math.floor(Math.random()*(t-i+1))}function C0(i,t){return i+Math.random()*(t-i)}function R0(i){return i*(.5-Math.random())}function P0(i){i!==void 0&&(wd=i);let t=wd+=1831565813;return t=Math.imul(t^t>>>15,t|1),t^=t+Math.imul(t^t>>>7,t|61),((t^t>>>14)>>>0)/4294967296}function L0(i){return i*vo}function I0(i){return i*Mo}function D0(i){return(i&i-1)===0&&i!==0}function N0(i){return Math.pow(2,Math.ceil(Math.log(i)/Math.LN2))}function U0(i){return Math.pow(2,Math.floor(Math.log(i)/Math.LN2))}function O0(i,t,e,n,s){let r=Math.cos,o=Math.sin,a=r(e/2),l=o(e/2),c=r((t+n)/2),u=o((t+n)/2),d=r((t-n)/2),h=o((t-n)/2),p=r((n-t)/2),g=o((n-t)/2);switch(s){case"XYX":i.set(a*u,l*d,l*h,a*c);break;case"YZY":i.set(l*h,a*u,l*d,a*c);break;case"ZXZ":i.set(l*d,l*h,a*u,a*c);break;case"XZX":i.set(a*u,l*g,l*p,a*c);break;case"YXY":i.set(l*p,a*u,l*g,a*c);break;case"ZYZ":i.set(l*g,l*p,a*u,a*c);break;default:console.warn("THREE.MathUtils: .setQuaternionFromProperEuler() encountered an unknown order: "+s)}}function gr(i,t){switch(t.constructor){case Float32Array:return i;case Uint32Array:return i/4294967295;case Uint16Array:return i/65535;case Uint8Array:return i/255;case Int32Array:return Math.max(i/2147483647,-1);case Int16Array:return Math.max(i/32767,-1);case Int8Array:return Math.max(i/127,-1);default:throw new Error("Invalid component type.")}}function En(i,t){switch(t.constructor){case Float32Array:return i;case Uint32Array:return Math.round(i*4294967295);case Uint16Array:return Math.round(i*65535);case Uint8Array:return Math.round(i*255);case Int32Array:return Math.round(i*2147483647);case Int16Array:return Math.round(i*32767);case Int8Array:return Math.round(i*127);default:throw new Error("Invalid component type.")}}var Pf={DEG2RAD:vo,RAD2DEG:Mo,generateUUID:Ur,clamp:vn,euclideanModulo:ph,mapLinear:M0,inverseLerp:b0,lerp:yo,damp:w0,pingpong:S0,smoothstep:E0,smootherstep:T0,randInt:A0,randFloat:C0,randFloatSpread:R0,seededRandom:P0,degToRad:L0,radToDeg:I0,isPowerOfTwo:D0,ceilPowerOfTwo:N0,floorPowerOfTwo:U0,setQuaternionFromProperEuler:O0,normalize:En,denormalize:gr},Jt=class{constructor(t=0,e=0){Jt.prototype.isVector2=!0,this.x=t,this.y=e}get width(){return this.x}set width(t){this.x=t}get height(){return this.y}set height(t){this.y=t}set(t,e){return this.x=t,this.y=e,this}setScalar(t){return this.x=t,this.y=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;default:throw new Error("index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;default:throw new Error("index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y)}copy(t){return this.x=t.x,this.y=t.y,this}add(t){return this.x+=t.x,this.y+=t.y,this}addScalar(t){return this.x+=t,this.y+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this}subScalar(t){return this.x-=t,this.y-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this}multiply(t){return this.x*=t.x,this.y*=t.y,this}multiplyScalar(t){return this.x*=t,this.y*=t,this}divide(t){return this.x/=t.x,this.y/=t.y,this}divideScalar(t){return this.multiplyScalar(1/t)}applyMatrix3(t){let e=this.x,n=this.y,s=t.elements;return this.x=s[0]*e+s[3]*n+s[6],this.y=s[1]*e+s[4]*n+s[7],this}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this}clamp(t,e){return this.x=Math.max(t.x,Math.min(e.x,this.x)),this.y=Math.max(t.y,Math.min(e.y,this.y)),this}clampScalar(t,e){return this.x=Math.max(t,Math.min(e,this.x)),this.y=Math.max(t,Math.min(e,this.y)),this}clampLength(t,e){let n=this.length();return this.divideScalar(n||1).multiplyScalar(Math.max(t,Math.min(e,n)))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this}negate(){return this.x=-this.x,this.y=-this.y,this}dot(t){return this.x*t.x+this.y*t.y}cross(t){return this.x*t.y-this.y*t.x}lengthSq(){return this.x*this.x+this.y*this.y}length(){return Math.sqrt(this.x*this.x+this.y*this.y)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)}normalize(){return this.divideScalar(this.length()||1)}angle(){return Math.atan2(-this.y,-this.x)+Math.PI}angleTo(t){let e=Math.sqrt(this.lengthSq()*t.lengthSq());if(e===0)return Math.PI/2;let n=this.dot(t)/e;return Math.acos(vn(n,-1,1))}distanceTo(t){return Math.sqrt(this.distanceToSquared(t))}distanceToSquared(t){let e=this.x-t.x,n=this.y-t.y;return e*e+n*n}manhattanDistanceTo(t){return Math.abs(this.x-t.x)+Math.abs(this.y-t.y)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this}lerpVectors(t,e,n){return this.x=t.x+(e.x-t.x)*n,this.y=t.y+(e.y-t.y)*n,this}equals(t){return t.x===this.x&&t.y===this.y}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this}rotateAround(t,e){let n=Math.cos(e),s=Math.sin(e),r=this.x-t.x,o=this.y-t.y;return this.x=r*n-o*s+t.x,this.y=r*s+o*n+t.y,this}random(){return this.x=Math.random(),this.y=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y}},ie=class{constructor(t,e,n,s,r,o,a,l,c){ie.prototype.isMatrix3=!0,this.elements=[1,0,0,0,1,0,0,0,1],t!==void 0&&this.set(t,e,n,s,r,o,a,l,c)}set(t,e,n,s,r,o,a,l,c){let u=this.elements;return u[0]=t,u[1]=s,u[2]=a,u[3]=e,u[4]=r,u[5]=l,u[6]=n,u[7]=o,u[8]=c,this}identity(){return this.set(1,0,0,0,1,0,0,0,1),this}copy(t){let e=this.elements,n=t.elements;return e[0]=n[0],e[1]=n[1],e[2]=n[2],e[3]=n[3],e[4]=n[4],e[5]=n[5],e[6]=n[6],e[7]=n[7],e[8]=n[8],this}extractBasis(t,e,n){return t.setFromMatrix3Column(this,0),e.setFromMatrix3Column(this,1),n.setFromMatrix3Column(this,2),this}setFromMatrix4(t){let e=t.elements;return this.set(e[0],e[4],e[8],e[1],e[5],e[9],e[2],e[6],e[10]),this}multiply(t){return this.multiplyMatrices(this,t)}premultiply(t){return this.multiplyMatrices(t,this)}multiplyMatrices(t,e){let n=t.elements,s=e.elements,r=this.elements,o=n[0],a=n[3],l=n[6],c=n[1],u=n[4],d=n[7],h=n[2],p=n[5],g=n[8],v=s[0],m=s[3],f=s[6],T=s[1],b=s[4],A=s[7],N=s[2],L=s[5],C=s[8];return r[0]=o*v+a*T+l*N,r[3]=o*m+a*b+l*L,r[6]=o*f+a*A+l*C,r[1]=c*v+u*T+d*N,r[4]=c*m+u*b+d*L,r[7]=c*f+u*A+d*C,r[2]=h*v+p*T+g*N,r[5]=h*m+p*b+g*L,r[8]=h*f+p*A+g*C,this}multiplyScalar(t){let e=this.elements;return e[0]*=t,e[3]*=t,e[6]*=t,e[1]*=t,e[4]*=t,e[7]*=t,e[2]*=t,e[5]*=t,e[8]*=t,this}determinant(){let t=this.elements,e=t[0],n=t[1],s=t[2],r=t[3],o=t[4],a=t[5],l=t[6],c=t[7],u=t[8];return e*o*u-e*a*c-n*r*u+n*a*l+s*r*c-s*o*l}invert(){let t=this.elements,e=t[0],n=t[1],s=t[2],r=t[3],o=t[4],a=t[5],l=t[6],c=t[7],u=t[8],d=u*o-a*c,h=a*l-u*r,p=c*r-o*l,g=e*d+n*h+s*p;if(g===0)return this.set(0,0,0,0,0,0,0,0,0);let v=1/g;return t[0]=d*v,t[1]=(s*c-u*n)*v,t[2]=(a*n-s*o)*v,t[3]=h*v,t[4]=(u*e-s*l)*v,t[5]=(s*r-a*e)*v,t[6]=p*v,t[7]=(n*l-c*e)*v,t[8]=(o*e-n*r)*v,this}transpose(){let t,e=this.elements;return t=e[1],e[1]=e[3],e[3]=t,t=e[2],e[2]=e[6],e[6]=t,t=e[5],e[5]=e[7],e[7]=t,this}getNormalMatrix(t){return this.setFromMatrix4(t).invert().transpose()}transposeIntoArray(t){let e=this.elements;return t[0]=e[0],t[1]=e[3],t[2]=e[6],t[3]=e[1],t[4]=e[4],t[5]=e[7],t[6]=e[2],t[7]=e[5],t[8]=e[8],this}setUvTransform(t,e,n,s,r,o,a){let l=Math.cos(r),c=Math.sin(r);return this.set(n*l,n*c,-n*(l*o+c*a)+o+t,-s*c,s*l,-s*(-c*o+l*a)+a+e,0,0,1),this}scale(t,e){return this.premultiply(nc.makeScale(t,e)),this}rotate(t){return this.premultiply(nc.makeRotation(-t)),this}translate(t,e){return this.premultiply(nc.makeTranslation(t,e)),this}makeTranslation(t,e){return t.isVector2?this.set(1,0,t.x,0,1,t.y,0,0,1):this.set(1,0,t,0,1,e,0,0,1),this}makeRotation(t){let e=Math.cos(t),n=Math.sin(t);return this.set(e,-n,0,n,e,0,0,0,1),this}makeScale(t,e){return this.set(t,0,0,0,e,0,0,0,1),this}equals(t){let e=this.elements,n=t.elements;for(let s=0;s<9;s++)if(e[s]!==n[s])return!1;return!0}fromArray(t,e=0){for(let n=0;n<9;n++)this.elements[n]=t[n+e];return this}toArray(t=[],e=0){let n=this.elements;return t[e]=n[0],t[e+1]=n[1],t[e+2]=n[2],t[e+3]=n[3],t[e+4]=n[4],t[e+5]=n[5],t[e+6]=n[6],t[e+7]=n[7],t[e+8]=n[8],t}clone(){return new this.constructor().fromArray(this.elements)}},nc=new ie;function Lf(i){for(let t=i.length-1;t>=0;--t)if(i[t]>=65535)return!0;return!1}function Ia(i){return document.createElementNS("http://www.w3.org/1999/xhtml",i)}function F0(){let i=Ia("canvas");return i.style.display="block",i}var Sd={};function If(i){i in Sd||(Sd[i]=!0,console.warn(i))}function k0(i,t,e){return new Promise(function(n,s){function r(){switch(i.clientWaitSync(t,i.SYNC_FLUSH_COMMANDS_BIT,0)){case i.WAIT_FAILED:s();break;case i.TIMEOUT_EXPIRED:setTimeout(r,e);break;default:n()}}setTimeout(r,e)})}var Ed=new ie().set(.8224621,.177538,0,.0331941,.9668058,0,.0170827,.0723974,.9105199),Td=new ie().set(1.2249401,-.2249404,0,-.0420569,1.0420571,0,-.0196376,-.0786361,1.0982735),ta={[ls]:{transfer:Ca,primaries:Ra,toReference:i=>i,fromReference:i=>i},[vi]:{transfer:Ue,primaries:Ra,toReference:i=>i.convertSRGBToLinear(),fromReference:i=>i.convertLinearToSRGB()},[nl]:{transfer:Ca,primaries:Pa,toReference:i=>i.applyMatrix3(Td),fromReference:i=>i.applyMatrix3(Ed)},[fh]:{transfer:Ue,primaries:Pa,toReference:i=>i.convertSRGBToLinear().applyMatrix3(Td),fromReference:i=>i.applyMatrix3(Ed).convertLinearToSRGB()}},B0=new Set([ls,nl]),we={enabled:!0,_workingColorSpace:ls,get workingColorSpace(){return this._workingColorSpace},set workingColorSpace(i){if(!B0.has(i))throw new Error(`Unsupported working color space, "${i}".`);this._workingColorSpace=i},convert:function(i,t,e){if(this.enabled===!1||t===e||!t||!e)return i;let n=ta[t].toReference,s=ta[e].fromReference;return s(n(i))},fromWorkingColorSpace:function(i,t){return this.convert(i,this._workingColorSpace,t)},toWorkingColorSpace:function(i,t){return this.convert(i,t,this._workingColorSpace)},getPrimaries:function(i){return ta[i].primaries},getTransfer:function(i){return i===es?Ca:ta[i].transfer}};function xr(i){return i<.04045?i*.0773993808:Math.pow(i*.9478672986+.0521327014,2.4)}function ic(i){return i<.0031308?i*12.92:1.055*Math.pow(i,.41666)-.055}var Qs,Uc=class{static getDataURL(t){if(/^data:/i.test(t.src)||typeof HTMLCanvasElement>"u")return t.src;let e;if(t instanceof HTMLCanvasElement)e=t;else{Qs===void 0&&(Qs=Ia("canvas")),Qs.width=t.width,Qs.height=t.height;let n=Qs.getContext("2d");t instanceof ImageData?n.putImageData(t,0,0):n.drawImage(t,0,0,t.width,t.height),e=Qs}return e.width>2048||e.height>2048?(console.warn("THREE.ImageUtils.getDataURL: Image converted to jpg for performance reasons",t),e.toDataURL("image/jpeg",.6)):e.toDataURL("image/png")}static sRGBToLinear(t){if(typeof HTMLImageElement<"u"&&t instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&t instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&t instanceof ImageBitmap){let e=Ia("canvas");e.width=t.width,e.height=t.height;let n=e.getContext("2d");n.drawImage(t,0,0,t.width,t.height);let s=n.getImageData(0,0,t.width,t.height),r=s.data;for(let o=0;o<r.length;o++)r[o]=xr(r[o]/255)*255;return n.putImageData(s,0,0),e}else if(t.data){let e=t.data.slice(0);for(let n=0;n<e.length;n++)e instanceof Uint8Array||e instanceof Uint8ClampedArray?e[n]=Math.floor(xr(e[n]/255)*255):e[n]=xr(e[n]);return{data:e,width:t.width,height:t.height}}else return console.warn("THREE.ImageUtils.sRGBToLinear(): Unsupported image type. No color space conversion applied."),t}},z0=0,Da=class{constructor(t=null){this.isSource=!0,Object.defineProperty(this,"id",{value:z0++}),this.uuid=Ur(),this.data=t,this.dataReady=!0,this.version=0}set needsUpdate(t){t===!0&&this.version++}toJSON(t){let e=t===void 0||typeof t=="string";if(!e&&t.images[this.uuid]!==void 0)return t.images[this.uuid];let n={uuid:this.uuid,url:""},s=this.data;if(s!==null){let r;if(Array.isArray(s)){r=[];for(let o=0,a=s.length;o<a;o++)s[o].isDataTexture?r.push(sc(s[o].image)):r.push(sc(s[o]))}else r=sc(s);n.url=r}return e||(t.images[this.uuid]=n),n}};function sc(i){return typeof HTMLImageElement<"u"&&i instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&i instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&i instanceof ImageBitmap?Uc.getDataURL(i):i.data?{data:Array.from(i.data),width:i.width,height:i.height,type:i.data.constructor.name}:(console.warn("THREE.Texture: Unable to serialize Texture."),{})}var V0=0,mn=class extends bi{constructor(t=mn.DEFAULT_IMAGE,e=mn.DEFAULT_MAPPING,n=Es,s=Es,r=ai,o=Ts,a=xi,l=rs,c=mn.DEFAULT_ANISOTROPY,u=es){super(),this.isTexture=!0,Object.defineProperty(this,"id",{value:V0++}),this.uuid=Ur(),this.name="",this.source=new Da(t),this.mipmaps=[],this.mapping=e,this.channel=0,this.wrapS=n,this.wrapT=s,this.magFilter=r,this.minFilter=o,this.anisotropy=c,this.format=a,this.internalFormat=null,this.type=l,this.offset=new Jt(0,0),this.repeat=new Jt(1,1),this.center=new Jt(0,0),this.rotation=0,this.matrixAutoUpdate=!0,this.matrix=new ie,this.generateMipmaps=!0,this.premultiplyAlpha=!1,this.flipY=!0,this.unpackAlignment=4,this.colorSpace=u,this.userData={},this.version=0,this.onUpdate=null,this.isRenderTargetTexture=!1,this.pmremVersion=0}get image(){return this.source.data}set image(t=null){this.source.data=t}updateMatrix(){this.matrix.setUvTransform(this.offset.x,this.offset.y,this.repeat.x,this.repeat.y,this.rotation,this.center.x,this.center.y)}clone(){return new this.constructor().copy(this)}copy(t){return this.name=t.name,this.source=t.source,this.mipmaps=t.mipmaps.slice(0),this.mapping=t.mapping,this.channel=t.channel,this.wrapS=t.wrapS,this.wrapT=t.wrapT,this.magFilter=t.magFilter,this.minFilter=t.minFilter,this.anisotropy=t.anisotropy,this.format=t.format,this.internalFormat=t.internalFormat,this.type=t.type,this.offset.copy(t.offset),this.repeat.copy(t.repeat),this.center.copy(t.center),this.rotation=t.rotation,this.matrixAutoUpdate=t.matrixAutoUpdate,this.matrix.copy(t.matrix),this.generateMipmaps=t.generateMipmaps,this.premultiplyAlpha=t.premultiplyAlpha,this.flipY=t.flipY,this.unpackAlignment=t.unpackAlignment,this.colorSpace=t.colorSpace,this.userData=JSON.parse(JSON.stringify(t.userData)),this.needsUpdate=!0,this}toJSON(t){let e=t===void 0||typeof t=="string";if(!e&&t.textures[this.uuid]!==void 0)return t.textures[this.uuid];let n={metadata:{version:4.6,type:"Texture",generator:"Texture.toJSON"},uuid:this.uuid,name:this.name,image:this.source.toJSON(t).uuid,mapping:this.mapping,channel:this.channel,repeat:[this.repeat.x,this.repeat.y],offset:[this.offset.x,this.offset.y],center:[this.center.x,this.center.y],rotation:this.rotation,wrap:[this.wrapS,this.wrapT],format:this.format,internalFormat:this.internalFormat,type:this.type,colorSpace:this.colorSpace,minFilter:this.minFilter,magFilter:this.magFilter,anisotropy:this.anisotropy,flipY:this.flipY,generateMipmaps:this.generateMipmaps,premultiplyAlpha:this.premultiplyAlpha,unpackAlignment:this.unpackAlignment};return Object.keys(this.userData).length>0&&(n.userData=this.userData),e||(t.textures[this.uuid]=n),n}dispose(){this.dispatchEvent({type:"dispose"})}transformUv(t){if(this.mapping!==xf)return t;if(t.applyMatrix3(this.matrix),t.x<0||t.x>1)switch(this.wrapS){case Ic:t.x=t.x-Math.floor(t.x);break;case Es:t.x=t.x<0?0:1;break;case Dc:Math.abs(Math.floor(t.x)%2)===1?t.x=Math.ceil(t.x)-t.x:t.x=t.x-Math.floor(t.x);break}if(t.y<0||t.y>1)switch(this.wrapT){case Ic:t.y=t.y-Math.floor(t.y);break;case Es:t.y=t.y<0?0:1;break;case Dc:Math.abs(Math.floor(t.y)%2)===1?t.y=Math.ceil(t.y)-t.y:t.y=t.y-Math.floor(t.y);break}return this.flipY&&(t.y=1-t.y),t}set needsUpdate(t){t===!0&&(this.version++,this.source.needsUpdate=!0)}set needsPMREMUpdate(t){t===!0&&this.pmremVersion++}};mn.DEFAULT_IMAGE=null;mn.DEFAULT_MAPPING=xf;mn.DEFAULT_ANISOTROPY=1;var Ze=class{constructor(t=0,e=0,n=0,s=1){Ze.prototype.isVector4=!0,this.x=t,this.y=e,this.z=n,this.w=s}get width(){return this.z}set width(t){this.z=t}get height(){return this.w}set height(t){this.w=t}set(t,e,n,s){return this.x=t,this.y=e,this.z=n,this.w=s,this}setScalar(t){return this.x=t,this.y=t,this.z=t,this.w=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setZ(t){return this.z=t,this}setW(t){return this.w=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;case 2:this.z=e;break;case 3:this.w=e;break;default:throw new Error("index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;case 2:return this.z;case 3:return this.w;default:throw new Error("index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y,this.z,this.w)}copy(t){return this.x=t.x,this.y=t.y,this.z=t.z,this.w=t.w!==void 0?t.w:1,this}add(t){return this.x+=t.x,this.y+=t.y,this.z+=t.z,this.w+=t.w,this}addScalar(t){return this.x+=t,this.y+=t,this.z+=t,this.w+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this.z=t.z+e.z,this.w=t.w+e.w,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this.z+=t.z*e,this.w+=t.w*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this.z-=t.z,this.w-=t.w,this}subScalar(t){return this.x-=t,this.y-=t,this.z-=t,this.w-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this.z=t.z-e.z,this.w=t.w-e.w,this}multiply(t){return this.x*=t.x,this.y*=t.y,this.z*=t.z,this.w*=t.w,this}multiplyScalar(t){return this.x*=t,this.y*=t,this.z*=t,this.w*=t,this}applyMatrix4(t){let e=this.x,n=this.y,s=this.z,r=this.w,o=t.elements;return this.x=o[0]*e+o[4]*n+o[8]*s+o[12]*r,this.y=o[1]*e+o[5]*n+o[9]*s+o[13]*r,this.z=o[2]*e+o[6]*n+o[10]*s+o[14]*r,this.w=o[3]*e+o[7]*n+o[11]*s+o[15]*r,this}divideScalar(t){return this.multiplyScalar(1/t)}setAxisAngleFromQuaternion(t){this.w=2*Math.acos(t.w);let e=Math.sqrt(1-t.w*t.w);return e<1e-4?(this.x=1,this.y=0,this.z=0):(this.x=t.x/e,this.y=t.y/e,this.z=t.z/e),this}setAxisAngleFromRotationMatrix(t){let e,n,s,r,l=t.elements,c=l[0],u=l[4],d=l[8],h=l[1],p=l[5],g=l[9],v=l[2],m=l[6],f=l[10];if(Math.abs(u-h)<.01&&Math.abs(d-v)<.01&&Math.abs(g-m)<.01){if(Math.abs(u+h)<.1&&Math.abs(d+v)<.1&&Math.abs(g+m)<.1&&Math.abs(c+p+f-3)<.1)return this.set(1,0,0,0),this;e=Math.PI;let b=(c+1)/2,A=(p+1)/2,N=(f+1)/2,L=(u+h)/4,C=(d+v)/4,F=(g+m)/4;return b>A&&b>N?b<.01?(n=0,s=.707106781,r=.707106781):(n=Math.sqrt(b),s=L/n,r=C/n):A>N?A<.01?(n=.707106781,s=0,r=.707106781):(s=Math.sqrt(A),n=L/s,r=F/s):N<.01?(n=.707106781,s=.707106781,r=0):(r=Math.sqrt(N),n=C/r,s=F/r),this.set(n,s,r,e),this}let T=Math.sqrt((m-g)*(m-g)+(d-v)*(d-v)+(h-u)*(h-u));return Math.abs(T)<.001&&(T=1),this.x=(m-g)/T,this.y=(d-v)/T,this.z=(h-u)/T,this.w=Math.acos((c+p+f-1)/2),this}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this.z=Math.min(this.z,t.z),this.w=Math.min(this.w,t.w),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this.z=Math.max(this.z,t.z),this.w=Math.max(this.w,t.w),this}clamp(t,e){return this.x=Math.max(t.x,Math.min(e.x,this.x)),this.y=Math.max(t.y,Math.min(e.y,this.y)),this.z=Math.max(t.z,Math.min(e.z,this.z)),this.w=Math.max(t.w,Math.min(e.w,this.w)),this}clampScalar(t,e){return this.x=Math.max(t,Math.min(e,this.x)),this.y=Math.max(t,Math.min(e,this.y)),this.z=Math.max(t,Math.min(e,this.z)),this.w=Math.max(t,Math.min(e,this.w)),this}clampLength(t,e){let n=this.length();return this.divideScalar(n||1).multiplyScalar(Math.max(t,Math.min(e,n)))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this.w=Math.floor(this.w),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this.w=Math.ceil(this.w),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this.w=Math.round(this.w),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this.w=Math.trunc(this.w),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this.w=-this.w,this}dot(t){return this.x*t.x+this.y*t.y+this.z*t.z+this.w*t.w}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)+Math.abs(this.w)}normalize(){return this.divideScalar(this.length()||1)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this.z+=(t.z-this.z)*e,this.w+=(t.w-this.w)*e,this}lerpVectors(t,e,n){return this.x=t.x+(e.x-t.x)*n,this.y=t.y+(e.y-t.y)*n,this.z=t.z+(e.z-t.z)*n,this.w=t.w+(e.w-t.w)*n,this}equals(t){return t.x===this.x&&t.y===this.y&&t.z===this.z&&t.w===this.w}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this.z=t[e+2],this.w=t[e+3],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t[e+2]=this.z,t[e+3]=this.w,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this.z=t.getZ(e),this.w=t.getW(e),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this.w=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z,yield this.w}},Oc=class extends bi{constructor(t=1,e=1,n={}){super(),this.isRenderTarget=!0,this.width=t,this.height=e,this.depth=1,this.scissor=new Ze(0,0,t,e),this.scissorTest=!1,this.viewport=new Ze(0,0,t,e);let s={width:t,height:e,depth:1};n=Object.assign({generateMipmaps:!1,internalFormat:null,minFilter:ai,depthBuffer:!0,stencilBuffer:!1,resolveDepthBuffer:!0,resolveStencilBuffer:!0,depthTexture:null,samples:0,count:1},n);let r=new mn(s,n.mapping,n.wrapS,n.wrapT,n.magFilter,n.minFilter,n.format,n.type,n.anisotropy,n.colorSpace);r.flipY=!1,r.generateMipmaps=n.generateMipmaps,r.internalFormat=n.internalFormat,this.textures=[];let o=n.count;for(let a=0;a<o;a++)this.textures[a]=r.clone(),this.textures[a].isRenderTargetTexture=!0;this.depthBuffer=n.depthBuffer,this.stencilBuffer=n.stencilBuffer,this.resolveDepthBuffer=n.resolveDepthBuffer,this.resolveStencilBuffer=n.resolveStencilBuffer,this.depthTexture=n.depthTexture,this.samples=n.samples}get texture(){return this.textures[0]}set texture(t){this.textures[0]=t}setSize(t,e,n=1){if(this.width!==t||this.height!==e||this.depth!==n){this.width=t,this.height=e,this.depth=n;for(let s=0,r=this.textures.length;s<r;s++)this.textures[s].image.width=t,this.textures[s].image.height=e,this.textures[s].image.depth=n;this.dispose()}this.viewport.set(0,0,t,e),this.scissor.set(0,0,t,e)}clone(){return new this.constructor().copy(this)}copy(t){this.width=t.width,this.height=t.height,this.depth=t.depth,this.scissor.copy(t.scissor),this.scissorTest=t.scissorTest,this.viewport.copy(t.viewport),this.textures.length=0;for(let n=0,s=t.textures.length;n<s;n++)this.textures[n]=t.textures[n].clone(),this.textures[n].isRenderTargetTexture=!0;let e=Object.assign({},t.texture.image);return this.texture.source=new Da(e),this.depthBuffer=t.depthBuffer,this.stencilBuffer=t.stencilBuffer,this.resolveDepthBuffer=t.resolveDepthBuffer,this.resolveStencilBuffer=t.resolveStencilBuffer,t.depthTexture!==null&&(this.depthTexture=t.depthTexture.clone()),this.samples=t.samples,this}dispose(){this.dispatchEvent({type:"dispose"})}},ki=class extends Oc{constructor(t=1,e=1,n={}){super(t,e,n),this.isWebGLRenderTarget=!0}},Na=class extends mn{constructor(t=null,e=1,n=1,s=1){super(null),this.isDataArrayTexture=!0,this.image={data:t,width:e,height:n,depth:s},this.magFilter=Nn,this.minFilter=Nn,this.wrapR=Es,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1,this.layerUpdates=new Set}addLayerUpdate(t){this.layerUpdates.add(t)}clearLayerUpdates(){this.layerUpdates.clear()}};var Fc=class extends mn{constructor(t=null,e=1,n=1,s=1){super(null),this.isData3DTexture=!0,this.image={data:t,width:e,height:n,depth:s},this.magFilter=Nn,this.minFilter=Nn,this.wrapR=Es,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}};var On=class{constructor(t=0,e=0,n=0,s=1){this.isQuaternion=!0,this._x=t,this._y=e,this._z=n,this._w=s}static slerpFlat(t,e,n,s,r,o,a){let l=n[s+0],c=n[s+1],u=n[s+2],d=n[s+3],h=r[o+0],p=r[o+1],g=r[o+2],v=r[o+3];if(a===0){t[e+0]=l,t[e+1]=c,t[e+2]=u,t[e+3]=d;return}if(a===1){t[e+0]=h,t[e+1]=p,t[e+2]=g,t[e+3]=v;return}if(d!==v||l!==h||c!==p||u!==g){let m=1-a,f=l*h+c*p+u*g+d*v,T=f>=0?1:-1,b=1-f*f;if(b>Number.EPSILON){let N=Math.sqrt(b),L=Math.atan2(N,f*T);m=Math.sin(m*L)/N,a=Math.sin(a*L)/N}let A=a*T;if(l=l*m+h*A,c=c*m+p*A,u=u*m+g*A,d=d*m+v*A,m===1-a){let N=1/Math.sqrt(l*l+c*c+u*u+d*d);l*=N,c*=N,u*=N,d*=N}}t[e]=l,t[e+1]=c,t[e+2]=u,t[e+3]=d}static multiplyQuaternionsFlat(t,e,n,s,r,o){let a=n[s],l=n[s+1],c=n[s+2],u=n[s+3],d=r[o],h=r[o+1],p=r[o+2],g=r[o+3];return t[e]=a*g+u*d+l*p-c*h,t[e+1]=l*g+u*h+c*d-a*p,t[e+2]=c*g+u*p+a*h-l*d,t[e+3]=u*g-a*d-l*h-c*p,t}get x(){return this._x}set x(t){this._x=t,this._onChangeCallback()}get y(){return this._y}set y(t){this._y=t,this._onChangeCallback()}get z(){return this._z}set z(t){this._z=t,this._onChangeCallback()}get w(){return this._w}set w(t){this._w=t,this._onChangeCallback()}set(t,e,n,s){return this._x=t,this._y=e,this._z=n,this._w=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._w)}copy(t){return this._x=t.x,this._y=t.y,this._z=t.z,this._w=t.w,this._onChangeCallback(),this}setFromEuler(t,e=!0){let n=t._x,s=t._y,r=t._z,o=t._order,a=Math.cos,l=Math.sin,c=a(n/2),u=a(s/2),d=a(r/2),h=l(n/2),p=l(s/2),g=l(r/2);switch(o){case"XYZ":this._x=h*u*d+c*p*g,this._y=c*p*d-h*u*g,this._z=c*u*g+h*p*d,this._w=c*u*d-h*p*g;break;case"YXZ":this._x=h*u*d+c*p*g,this._y=c*p*d-h*u*g,this._z=c*u*g-h*p*d,this._w=c*u*d+h*p*g;break;case"ZXY":this._x=h*u*d-c*p*g,this._y=c*p*d+h*u*g,this._z=c*u*g+h*p*d,this._w=c*u*d-h*p*g;break;case"ZYX":this._x=h*u*d-c*p*g,this._y=c*p*d+h*u*g,this._z=c*u*g-h*p*d,this._w=c*u*d+h*p*g;break;case"YZX":this._x=h*u*d+c*p*g,this._y=c*p*d+h*u*g,this._z=c*u*g-h*p*d,this._w=c*u*d-h*p*g;break;case"XZY":this._x=h*u*d-c*p*g,this._y=c*p*d-h*u*g,this._z=c*u*g+h*p*d,this._w=c*u*d+h*p*g;break;default:console.warn("THREE.Quaternion: .setFromEuler() encountered an unknown order: "+o)}return e===!0&&this._onChangeCallback(),this}setFromAxisAngle(t,e){let n=e/2,s=Math.sin(n);return this._x=t.x*s,this._y=t.y*s,this._z=t.z*s,this._w=Math.cos(n),this._onChangeCallback(),this}setFromRotationMatrix(t){let e=t.elements,n=e[0],s=e[4],r=e[8],o=e[1],a=e[5],l=e[9],c=e[2],u=e[6],d=e[10],h=n+a+d;if(h>0){let p=.5/Math.sqrt(h+1);this._w=.25/p,this._x=(u-l)*p,this._y=(r-c)*p,this._z=(o-s)*p}else if(n>a&&n>d){let p=2*Math.sqrt(1+n-a-d);this._w=(u-l)/p,this._x=.25*p,this._y=(s+o)/p,this._z=(r+c)/p}else if(a>d){let p=2*Math.sqrt(1+a-n-d);this._w=(r-c)/p,this._x=(s+o)/p,this._y=.25*p,this._z=(l+u)/p}else{let p=2*Math.sqrt(1+d-n-a);this._w=(o-s)/p,this._x=(r+c)/p,this._y=(l+u)/p,this._z=.25*p}return this._onChangeCallback(),this}setFromUnitVectors(t,e){let n=t.dot(e)+1;return n<Number.EPSILON?(n=0,Math.abs(t.x)>Math.abs(t.z)?(this._x=-t.y,this._y=t.x,this._z=0,this._w=n):(this._x=0,this._y=-t.z,this._z=t.y,this._w=n)):(this._x=t.y*e.z-t.z*e.y,this._y=t.z*e.x-t.x*e.z,this._z=t.x*e.y-t.y*e.x,this._w=n),this.normalize()}angleTo(t){return 2*Math.acos(Math.abs(vn(this.dot(t),-1,1)))}rotateTowards(t,e){let n=this.angleTo(t);if(n===0)return this;let s=Math.min(1,e/n);return this.slerp(t,s),this}identity(){return this.set(0,0,0,1)}invert(){return this.conjugate()}conjugate(){return this._x*=-1,this._y*=-1,this._z*=-1,this._onChangeCallback(),this}dot(t){return this._x*t._x+this._y*t._y+this._z*t._z+this._w*t._w}lengthSq(){return this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w}length(){return Math.sqrt(this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w)}normalize(){let t=this.length();return t===0?(this._x=0,this._y=0,this._z=0,this._w=1):(t=1/t,this._x=this._x*t,this._y=this._y*t,this._z=this._z*t,this._w=this._w*t),this._onChangeCallback(),this}multiply(t){return this.multiplyQuaternions(this,t)}premultiply(t){return this.multiplyQuaternions(t,this)}multiplyQuaternions(t,e){let n=t._x,s=t._y,r=t._z,o=t._w,a=e._x,l=e._y,c=e._z,u=e._w;return this._x=n*u+o*a+s*c-r*l,this._y=s*u+o*l+r*a-n*c,this._z=r*u+o*c+n*l-s*a,this._w=o*u-n*a-s*l-r*c,this._onChangeCallback(),this}slerp(t,e){if(e===0)return this;if(e===1)return this.copy(t);let n=this._x,s=this._y,r=this._z,o=this._w,a=o*t._w+n*t._x+s*t._y+r*t._z;if(a<0?(this._w=-t._w,this._x=-t._x,this._y=-t._y,this._z=-t._z,a=-a):this.copy(t),a>=1)return this._w=o,this._x=n,this._y=s,this._z=r,this;let l=1-a*a;if(l<=Number.EPSILON){let p=1-e;return this._w=p*o+e*this._w,this._x=p*n+e*this._x,this._y=p*s+e*this._y,this._z=p*r+e*this._z,this.normalize(),this}let c=Math.sqrt(l),u=Math.atan2(c,a),d=Math.sin((1-e)*u)/c,h=Math.sin(e*u)/c;return this._w=o*d+this._w*h,this._x=n*d+this._x*h,this._y=s*d+this._y*h,this._z=r*d+this._z*h,this._onChangeCallback(),this}slerpQuaternions(t,e,n){return this.copy(t).slerp(e,n)}random(){let t=2*Math.PI*Math.random(),e=2*Math.PI*Math.random(),n=Math.random(),s=Math.sqrt(1-n),r=Math.sqrt(n);return this.set(s*Math.sin(t),s*Math.cos(t),r*Math.sin(e),r*Math.cos(e))}equals(t){return t._x===this._x&&t._y===this._y&&t._z===this._z&&t._w===this._w}fromArray(t,e=0){return this._x=t[e],this._y=t[e+1],this._z=t[e+2],this._w=t[e+3],this._onChangeCallback(),this}toArray(t=[],e=0){return t[e]=this._x,t[e+1]=this._y,t[e+2]=this._z,t[e+3]=this._w,t}fromBufferAttribute(t,e){return this._x=t.getX(e),this._y=t.getY(e),this._z=t.getZ(e),this._w=t.getW(e),this._onChangeCallback(),this}toJSON(){return this.toArray()}_onChange(t){return this._onChangeCallback=t,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._w}},V=class{constructor(t=0,e=0,n=0){V.prototype.isVector3=!0,this.x=t,this.y=e,this.z=n}set(t,e,n){return n===void 0&&(n=this.z),this.x=t,this.y=e,this.z=n,this}setScalar(t){return this.x=t,this.y=t,this.z=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setZ(t){return this.z=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;case 2:this.z=e;break;default:throw new Error("index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;case 2:return this.z;default:throw new Error("index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y,this.z)}copy(t){return this.x=t.x,this.y=t.y,this.z=t.z,this}add(t){return this.x+=t.x,this.y+=t.y,this.z+=t.z,this}addScalar(t){return this.x+=t,this.y+=t,this.z+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this.z=t.z+e.z,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this.z+=t.z*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this.z-=t.z,this}subScalar(t){return this.x-=t,this.y-=t,this.z-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this.z=t.z-e.z,this}multiply(t){return this.x*=t.x,this.y*=t.y,this.z*=t.z,this}multiplyScalar(t){return this.x*=t,this.y*=t,this.z*=t,this}multiplyVectors(t,e){return this.x=t.x*e.x,this.y=t.y*e.y,this.z=t.z*e.z,this}applyEuler(t){return this.applyQuaternion(Ad.setFromEuler(t))}applyAxisAngle(t,e){return this.applyQuaternion(Ad.setFromAxisAngle(t,e))}applyMatrix3(t){let e=this.x,n=this.y,s=this.z,r=t.elements;return this.x=r[0]*e+r[3]*n+r[6]*s,this.y=r[1]*e+r[4]*n+r[7]*s,this.z=r[2]*e+r[5]*n+r[8]*s,this}applyNormalMatrix(t){return this.applyMatrix3(t).normalize()}applyMatrix4(t){let e=this.x,n=this.y,s=this.z,r=t.elements,o=1/(r[3]*e+r[7]*n+r[11]*s+r[15]);return this.x=(r[0]*e+r[4]*n+r[8]*s+r[12])*o,this.y=(r[1]*e+r[5]*n+r[9]*s+r[13])*o,this.z=(r[2]*e+r[6]*n+r[10]*s+r[14])*o,this}applyQuaternion(t){let e=this.x,n=this.y,s=this.z,r=t.x,o=t.y,a=t.z,l=t.w,c=2*(o*s-a*n),u=2*(a*e-r*s),d=2*(r*n-o*e);return this.x=e+l*c+o*d-a*u,this.y=n+l*u+a*c-r*d,this.z=s+l*d+r*u-o*c,this}project(t){return this.applyMatrix4(t.matrixWorldInverse).applyMatrix4(t.projectionMatrix)}unproject(t){return this.applyMatrix4(t.projectionMatrixInverse).applyMatrix4(t.matrixWorld)}transformDirection(t){let e=this.x,n=this.y,s=this.z,r=t.elements;return this.x=r[0]*e+r[4]*n+r[8]*s,this.y=r[1]*e+r[5]*n+r[9]*s,this.z=r[2]*e+r[6]*n+r[10]*s,this.normalize()}divide(t){return this.x/=t.x,this.y/=t.y,this.z/=t.z,this}divideScalar(t){return this.multiplyScalar(1/t)}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this.z=Math.min(this.z,t.z),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this.z=Math.max(this.z,t.z),this}clamp(t,e){return this.x=Math.max(t.x,Math.min(e.x,this.x)),this.y=Math.max(t.y,Math.min(e.y,this.y)),this.z=Math.max(t.z,Math.min(e.z,this.z)),this}clampScalar(t,e){return this.x=Math.max(t,Math.min(e,this.x)),this.y=Math.max(t,Math.min(e,this.y)),this.z=Math.max(t,Math.min(e,this.z)),this}clampLength(t,e){let n=this.length();return this.divideScalar(n||1).multiplyScalar(Math.max(t,Math.min(e,n)))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this}dot(t){return this.x*t.x+this.y*t.y+this.z*t.z}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)}normalize(){return this.divideScalar(this.length()||1)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this.z+=(t.z-this.z)*e,this}lerpVectors(t,e,n){return this.x=t.x+(e.x-t.x)*n,this.y=t.y+(e.y-t.y)*n,this.z=t.z+(e.z-t.z)*n,this}cross(t){return this.crossVectors(this,t)}crossVectors(t,e){let n=t.x,s=t.y,r=t.z,o=e.x,a=e.y,l=e.z;return this.x=s*l-r*a,this.y=r*o-n*l,this.z=n*a-s*o,this}projectOnVector(t){let e=t.lengthSq();if(e===0)return this.set(0,0,0);let n=t.dot(this)/e;return this.copy(t).multiplyScalar(n)}projectOnPlane(t){return rc.copy(this).projectOnVector(t),this.sub(rc)}reflect(t){return this.sub(rc.copy(t).multiplyScalar(2*this.dot(t)))}angleTo(t){let e=Math.sqrt(this.lengthSq()*t.lengthSq());if(e===0)return Math.PI/2;let n=this.dot(t)/e;return Math.acos(vn(n,-1,1))}distanceTo(t){return Math.sqrt(this.distanceToSquared(t))}distanceToSquared(t){let e=this.x-t.x,n=this.y-t.y,s=this.z-t.z;return e*e+n*n+s*s}manhattanDistanceTo(t){return Math.abs(this.x-t.x)+Math.abs(this.y-t.y)+Math.abs(this.z-t.z)}setFromSpherical(t){return this.setFromSphericalCoords(t.radius,t.phi,t.theta)}setFromSphericalCoords(t,e,n){let s=Math.sin(e)*t;return this.x=s*Math.sin(n),this.y=Math.cos(e)*t,this.z=s*Math.cos(n),this}setFromCylindrical(t){return this.setFromCylindricalCoords(t.radius,t.theta,t.y)}setFromCylindricalCoords(t,e,n){return this.x=t*Math.sin(e),this.y=n,this.z=t*Math.cos(e),this}setFromMatrixPosition(t){let e=t.elements;return this.x=e[12],this.y=e[13],this.z=e[14],this}setFromMatrixScale(t){let e=this.setFromMatrixColumn(t,0).length(),n=this.setFromMatrixColumn(t,1).length(),s=this.setFromMatrixColumn(t,2).length();return this.x=e,this.y=n,this.z=s,this}setFromMatrixColumn(t,e){return this.fromArray(t.elements,e*4)}setFromMatrix3Column(t,e){return this.fromArray(t.elements,e*3)}setFromEuler(t){return this.x=t._x,this.y=t._y,this.z=t._z,this}setFromColor(t){return this.x=t.r,this.y=t.g,this.z=t.b,this}equals(t){return t.x===this.x&&t.y===this.y&&t.z===this.z}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this.z=t[e+2],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t[e+2]=this.z,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this.z=t.getZ(e),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this}randomDirection(){let t=Math.random()*Math.PI*2,e=Math.random()*2-1,n=Math.sqrt(1-e*e);return this.x=n*Math.cos(t),this.y=e,this.z=n*Math.sin(t),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z}},rc=new V,Ad=new On,Jn=class{constructor(t=new V(1/0,1/0,1/0),e=new V(-1/0,-1/0,-1/0)){this.isBox3=!0,this.min=t,this.max=e}set(t,e){return this.min.copy(t),this.max.copy(e),this}setFromArray(t){this.makeEmpty();for(let e=0,n=t.length;e<n;e+=3)this.expandByPoint(ii.fromArray(t,e));return this}setFromBufferAttribute(t){this.makeEmpty();for(let e=0,n=t.count;e<n;e++)this.expandByPoint(ii.fromBufferAttribute(t,e));return this}setFromPoints(t){this.makeEmpty();for(let e=0,n=t.length;e<n;e++)this.expandByPoint(t[e]);return this}setFromCenterAndSize(t,e){let n=ii.copy(e).multiplyScalar(.5);return this.min.copy(t).sub(n),this.max.copy(t).add(n),this}setFromObject(t,e=!1){return this.makeEmpty(),this.expandByObject(t,e)}clone(){return new this.constructor().copy(this)}copy(t){return this.min.copy(t.min),this.max.copy(t.max),this}makeEmpty(){return this.min.x=this.min.y=this.min.z=1/0,this.max.x=this.max.y=this.max.z=-1/0,this}isEmpty(){return this.max.x<this.min.x||this.max.y<this.min.y||this.max.z<this.min.z}getCenter(t){return this.isEmpty()?t.set(0,0,0):t.addVectors(this.min,this.max).multiplyScalar(.5)}getSize(t){return this.isEmpty()?t.set(0,0,0):t.subVectors(this.max,this.min)}expandByPoint(t){return this.min.min(t),this.max.max(t),this}expandByVector(t){return this.min.sub(t),this.max.add(t),this}expandByScalar(t){return this.min.addScalar(-t),this.max.addScalar(t),this}expandByObject(t,e=!1){t.updateWorldMatrix(!1,!1);let n=t.geometry;if(n!==void 0){let r=n.getAttribute("position");if(e===!0&&r!==void 0&&t.isInstancedMesh!==!0)for(let o=0,a=r.count;o<a;o++)t.isMesh===!0?t.getVertexPosition(o,ii):ii.fromBufferAttribute(r,o),ii.applyMatrix4(t.matrixWorld),this.expandByPoint(ii);else t.boundingBox!==void 0?(t.boundingBox===null&&t.computeBoundingBox(),ea.copy(t.boundingBox)):(n.boundingBox===null&&n.computeBoundingBox(),ea.copy(n.boundingBox)),ea.applyMatrix4(t.matrixWorld),this.union(ea)}let s=t.children;for(let r=0,o=s.length;r<o;r++)this.expandByObject(s[r],e);return this}containsPoint(t){return!(t.x<this.min.x||t.x>this.max.x||t.y<this.min.y||t.y>this.max.y||t.z<this.min.z||t.z>this.max.z)}containsBox(t){return this.min.x<=t.min.x&&t.max.x<=this.max.x&&this.min.y<=t.min.y&&t.max.y<=this.max.y&&this.min.z<=t.min.z&&t.max.z<=this.max.z}getParameter(t,e){return e.set((t.x-this.min.x)/(this.max.x-this.min.x),(t.y-this.min.y)/(this.max.y-this.min.y),(t.z-this.min.z)/(this.max.z-this.min.z))}intersectsBox(t){return!(t.max.x<this.min.x||t.min.x>this.max.x||t.max.y<this.min.y||t.min.y>this.max.y||t.max.z<this.min.z||t.min.z>this.max.z)}intersectsSphere(t){return this.clampPoint(t.center,ii),ii.distanceToSquared(t.center)<=t.radius*t.radius}intersectsPlane(t){let e,n;return t.normal.x>0?(e=t.normal.x*this.min.x,n=t.normal.x*this.max.x):(e=t.normal.x*this.max.x,n=t.normal.x*this.min.x),t.normal.y>0?(e+=t.normal.y*this.min.y,n+=t.normal.y*this.max.y):(e+=t.normal.y*this.max.y,n+=t.normal.y*this.min.y),t.normal.z>0?(e+=t.normal.z*this.min.z,n+=t.normal.z*this.max.z):(e+=t.normal.z*this.max.z,n+=t.normal.z*this.min.z),e<=-t.constant&&n>=-t.constant}intersectsTriangle(t){if(this.isEmpty())return!1;this.getCenter(co),na.subVectors(this.max,co),tr.subVectors(t.a,co),er.subVectors(t.b,co),nr.subVectors(t.c,co),Zi.subVectors(er,tr),Ji.subVectors(nr,er),gs.subVectors(tr,nr);let e=[0,-Zi.z,Zi.y,0,-Ji.z,Ji.y,0,-gs.z,gs.y,Zi.z,0,-Zi.x,Ji.z,0,-Ji.x,gs.z,0,-gs.x,-Zi.y,Zi.x,0,-Ji.y,Ji.x,0,-gs.y,gs.x,0];return!oc(e,tr,er,nr,na)||(e=[1,0,0,0,1,0,0,0,1],!oc(e,tr,er,nr,na))?!1:(ia.crossVectors(Zi,Ji),e=[ia.x,ia.y,ia.z],oc(e,tr,er,nr,na))}clampPoint(t,e){return e.copy(t).clamp(this.min,this.max)}distanceToPoint(t){return this.clampPoint(t,ii).distanceTo(t)}getBoundingSphere(t){return this.isEmpty()?t.makeEmpty():(this.getCenter(t.center),t.radius=this.getSize(ii).length()*.5),t}intersect(t){return this.min.max(t.min),this.max.min(t.max),this.isEmpty()&&this.makeEmpty(),this}union(t){return this.min.min(t.min),this.max.max(t.max),this}applyMatrix4(t){return this.isEmpty()?this:(Ri[0].set(this.min.x,this.min.y,this.min.z).applyMatrix4(t),Ri[1].set(this.min.x,this.min.y,this.max.z).applyMatrix4(t),Ri[2].set(this.min.x,this.max.y,this.min.z).applyMatrix4(t),Ri[3].set(this.min.x,this.max.y,this.max.z).applyMatrix4(t),Ri[4].set(this.max.x,this.min.y,this.min.z).applyMatrix4(t),Ri[5].set(this.max.x,this.min.y,this.max.z).applyMatrix4(t),Ri[6].set(this.max.x,this.max.y,this.min.z).applyMatrix4(t),Ri[7].set(this.max.x,this.max.y,this.max.z).applyMatrix4(t),this.setFromPoints(Ri),this)}translate(t){return this.min.add(t),this.max.add(t),this}equals(t){return t.min.equals(this.min)&&t.max.equals(this.max)}},Ri=[new V,new V,new V,new V,new V,new V,new V,new V],ii=new V,ea=new Jn,tr=new V,er=new V,nr=new V,Zi=new V,Ji=new V,gs=new V,co=new V,na=new V,ia=new V,_s=new V;function oc(i,t,e,n,s){for(let r=0,o=i.length-3;r<=o;r+=3){_s.fromArray(i,r);let a=s.x*Math.abs(_s.x)+s.y*Math.abs(_s.y)+s.z*Math.abs(_s.z),l=t.dot(_s),c=e.dot(_s),u=n.dot(_s);if(Math.max(-Math.max(l,c,u),Math.min(l,c,u))>a)return!1}return!0}var H0=new Jn,ho=new V,ac=new V,li=class{constructor(t=new V,e=-1){this.isSphere=!0,this.center=t,this.radius=e}set(t,e){return this.center.copy(t),this.radius=e,this}setFromPoints(t,e){let n=this.center;e!==void 0?n.copy(e):H0.setFromPoints(t).getCenter(n);let s=0;for(let r=0,o=t.length;r<o;r++)s=Math.max(s,n.distanceToSquared(t[r]));return this.radius=Math.sqrt(s),this}copy(t){return this.center.copy(t.center),this.radius=t.radius,this}isEmpty(){return this.radius<0}makeEmpty(){return this.center.set(0,0,0),this.radius=-1,this}containsPoint(t){return t.distanceToSquared(this.center)<=this.radius*this.radius}distanceToPoint(t){return t.distanceTo(this.center)-this.radius}intersectsSphere(t){let e=this.radius+t.radius;return t.center.distanceToSquared(this.center)<=e*e}intersectsBox(t){return t.intersectsSphere(this)}intersectsPlane(t){return Math.abs(t.distanceToPoint(this.center))<=this.radius}clampPoint(t,e){let n=this.center.distanceToSquared(t);return e.copy(t),n>this.radius*this.radius&&(e.sub(this.center).normalize(),e.multiplyScalar(this.radius).add(this.center)),e}getBoundingBox(t){return this.isEmpty()?(t.makeEmpty(),t):(t.set(this.center,this.center),t.expandByScalar(this.radius),t)}applyMatrix4(t){return this.center.applyMatrix4(t),this.radius=this.radius*t.getMaxScaleOnAxis(),this}translate(t){return this.center.add(t),this}expandByPoint(t){if(this.isEmpty())return this.center.copy(t),this.radius=0,this;ho.subVectors(t,this.center);let e=ho.lengthSq();if(e>this.radius*this.radius){let n=Math.sqrt(e),s=(n-this.radius)*.5;this.center.addScaledVector(ho,s/n),this.radius+=s}return this}union(t){return t.isEmpty()?this:this.isEmpty()?(this.copy(t),this):(this.center.equals(t.center)===!0?this.radius=Math.max(this.radius,t.radius):(ac.subVectors(t.center,this.center).setLength(t.radius),this.expandByPoint(ho.copy(t.center).add(ac)),this.expandByPoint(ho.copy(t.center).sub(ac))),this)}equals(t){return t.center.equals(this.center)&&t.radius===this.radius}clone(){return new this.constructor().copy(this)}},Pi=new V,lc=new V,sa=new V,Ki=new V,cc=new V,ra=new V,hc=new V,Ar=class{constructor(t=new V,e=new V(0,0,-1)){this.origin=t,this.direction=e}set(t,e){return this.origin.copy(t),this.direction.copy(e),this}copy(t){return this.origin.copy(t.origin),this.direction.copy(t.direction),this}at(t,e){return e.copy(this.origin).addScaledVector(this.direction,t)}lookAt(t){return this.direction.copy(t).sub(this.origin).normalize(),this}recast(t){return this.origin.copy(this.at(t,Pi)),this}closestPointToPoint(t,e){e.subVectors(t,this.origin);let n=e.dot(this.direction);return n<0?e.copy(this.origin):e.copy(this.origin).addScaledVector(this.direction,n)}distanceToPoint(t){return Math.sqrt(this.distanceSqToPoint(t))}distanceSqToPoint(t){let e=Pi.subVectors(t,this.origin).dot(this.direction);return e<0?this.origin.distanceToSquared(t):(Pi.copy(this.origin).addScaledVector(this.direction,e),Pi.distanceToSquared(t))}distanceSqToSegment(t,e,n,s){lc.copy(t).add(e).multiplyScalar(.5),sa.copy(e).sub(t).normalize(),Ki.copy(this.origin).sub(lc);let r=t.distanceTo(e)*.5,o=-this.direction.dot(sa),a=Ki.dot(this.direction),l=-Ki.dot(sa),c=Ki.lengthSq(),u=Math.abs(1-o*o),d,h,p,g;if(u>0)if(d=o*l-a,h=o*a-l,g=r*u,d>=0)if(h>=-g)if(h<=g){let v=1/u;d*=v,h*=v,p=d*(d+o*h+2*a)+h*(o*d+h+2*l)+c}else h=r,d=Math.max(0,-(o*h+a)),p=-d*d+h*(h+2*l)+c;else h=-r,d=Math.max(0,-(o*h+a)),p=-d*d+h*(h+2*l)+c;else h<=-g?(d=Math.max(0,-(-o*r+a)),h=d>0?-r:Math.min(Math.max(-r,-l),r),p=-d*d+h*(h+2*l)+c):h<=g?(d=0,h=Math.min(Math.max(-r,-l),r),p=h*(h+2*l)+c):(d=Math.max(0,-(o*r+a)),h=d>0?r:Math.min(Math.max(-r,-l),r),p=-d*d+h*(h+2*l)+c);else h=o>0?-r:r,d=Math.max(0,-(o*h+a)),p=-d*d+h*(h+2*l)+c;return n&&n.copy(this.origin).addScaledVector(this.direction,d),s&&s.copy(lc).addScaledVector(sa,h),p}intersectSphere(t,e){Pi.subVectors(t.center,this.origin);let n=Pi.dot(this.direction),s=Pi.dot(Pi)-n*n,r=t.radius*t.radius;if(s>r)return null;let o=Math.sqrt(r-s),a=n-o,l=n+o;return l<0?null:a<0?this.at(l,e):this.at(a,e)}intersectsSphere(t){return this.distanceSqToPoint(t.center)<=t.radius*t.radius}distanceToPlane(t){let e=t.normal.dot(this.direction);if(e===0)return t.distanceToPoint(this.origin)===0?0:null;let n=-(this.origin.dot(t.normal)+t.constant)/e;return n>=0?n:null}intersectPlane(t,e){let n=this.distanceToPlane(t);return n===null?null:this.at(n,e)}intersectsPlane(t){let e=t.distanceToPoint(this.origin);return e===0||t.normal.dot(this.direction)*e<0}intersectBox(t,e){let n,s,r,o,a,l,c=1/this.direction.x,u=1/this.direction.y,d=1/this.direction.z,h=this.origin;return c>=0?(n=(t.min.x-h.x)*c,s=(t.max.x-h.x)*c):(n=(t.max.x-h.x)*c,s=(t.min.x-h.x)*c),u>=0?(r=(t.min.y-h.y)*u,o=(t.max.y-h.y)*u):(r=(t.max.y-h.y)*u,o=(t.min.y-h.y)*u),n>o||r>s||((r>n||isNaN(n))&&(n=r),(o<s||isNaN(s))&&(s=o),d>=0?(a=(t.min.z-h.z)*d,l=(t.max.z-h.z)*d):(a=(t.max.z-h.z)*d,l=(t.min.z-h.z)*d),n>l||a>s)||((a>n||n!==n)&&(n=a),(l<s||s!==s)&&(s=l),s<0)?null:this.at(n>=0?n:s,e)}intersectsBox(t){return this.intersectBox(t,Pi)!==null}intersectTriangle(t,e,n,s,r){cc.subVectors(e,t),ra.subVectors(n,t),hc.crossVectors(cc,ra);let o=this.direction.dot(hc),a;if(o>0){if(s)return null;a=1}else if(o<0)a=-1,o=-o;else return null;Ki.subVectors(this.origin,t);let l=a*this.direction.dot(ra.crossVectors(Ki,ra));if(l<0)return null;let c=a*this.direction.dot(cc.cross(Ki));if(c<0||l+c>o)return null;let u=-a*Ki.dot(hc);return u<0?null:this.at(u/o,r)}applyMatrix4(t){return this.origin.applyMatrix4(t),this.direction.transformDirection(t),this}equals(t){return t.origin.equals(this.origin)&&t.direction.equals(this.direction)}clone(){return new this.constructor().copy(this)}},ve=class{constructor(t,e,n,s,r,o,a,l,c,u,d,h,p,g,v,m){ve.prototype.isMatrix4=!0,this.elements=[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],t!==void 0&&this.set(t,e,n,s,r,o,a,l,c,u,d,h,p,g,v,m)}set(t,e,n,s,r,o,a,l,c,u,d,h,p,g,v,m){let f=this.elements;return f[0]=t,f[4]=e,f[8]=n,f[12]=s,f[1]=r,f[5]=o,f[9]=a,f[13]=l,f[2]=c,f[6]=u,f[10]=d,f[14]=h,f[3]=p,f[7]=g,f[11]=v,f[15]=m,this}identity(){return this.set(1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1),this}clone(){return new ve().fromArray(this.elements)}copy(t){let e=this.elements,n=t.elements;return e[0]=n[0],e[1]=n[1],e[2]=n[2],e[3]=n[3],e[4]=n[4],e[5]=n[5],e[6]=n[6],e[7]=n[7],e[8]=n[8],e[9]=n[9],e[10]=n[10],e[11]=n[11],e[12]=n[12],e[13]=n[13],e[14]=n[14],e[15]=n[15],this}copyPosition(t){let e=this.elements,n=t.elements;return e[12]=n[12],e[13]=n[13],e[14]=n[14],this}setFromMatrix3(t){let e=t.elements;return this.set(e[0],e[3],e[6],0,e[1],e[4],e[7],0,e[2],e[5],e[8],0,0,0,0,1),this}extractBasis(t,e,n){return t.setFromMatrixColumn(this,0),e.setFromMatrixColumn(this,1),n.setFromMatrixColumn(this,2),this}makeBasis(t,e,n){return this.set(t.x,e.x,n.x,0,t.y,e.y,n.y,0,t.z,e.z,n.z,0,0,0,0,1),this}extractRotation(t){let e=this.elements,n=t.elements,s=1/ir.setFromMatrixColumn(t,0).length(),r=1/ir.setFromMatrixColumn(t,1).length(),o=1/ir.setFromMatrixColumn(t,2).length();return e[0]=n[0]*s,e[1]=n[1]*s,e[2]=n[2]*s,e[3]=0,e[4]=n[4]*r,e[5]=n[5]*r,e[6]=n[6]*r,e[7]=0,e[8]=n[8]*o,e[9]=n[9]*o,e[10]=n[10]*o,e[11]=0,e[12]=0,e[13]=0,e[14]=0,e[15]=1,this}makeRotationFromEuler(t){let e=this.elements,n=t.x,s=t.y,r=t.z,o=Math.cos(n),a=Math.sin(n),l=Math.cos(s),c=Math.sin(s),u=Math.cos(r),d=Math.sin(r);if(t.order==="XYZ"){let h=o*u,p=o*d,g=a*u,v=a*d;e[0]=l*u,e[4]=-l*d,e[8]=c,e[1]=p+g*c,e[5]=h-v*c,e[9]=-a*l,e[2]=v-h*c,e[6]=g+p*c,e[10]=o*l}else if(t.order==="YXZ"){let h=l*u,p=l*d,g=c*u,v=c*d;e[0]=h+v*a,e[4]=g*a-p,e[8]=o*c,e[1]=o*d,e[5]=o*u,e[9]=-a,e[2]=p*a-g,e[6]=v+h*a,e[10]=o*l}else if(t.order==="ZXY"){let h=l*u,p=l*d,g=c*u,v=c*d;e[0]=h-v*a,e[4]=-o*d,e[8]=g+p*a,e[1]=p+g*a,e[5]=o*u,e[9]=v-h*a,e[2]=-o*c,e[6]=a,e[10]=o*l}else if(t.order==="ZYX"){let h=o*u,p=o*d,g=a*u,v=a*d;e[0]=l*u,e[4]=g*c-p,e[8]=h*c+v,e[1]=l*d,e[5]=v*c+h,e[9]=p*c-g,e[2]=-c,e[6]=a*l,e[10]=o*l}else if(t.order==="YZX"){let h=o*l,p=o*c,g=a*l,v=a*c;e[0]=l*u,e[4]=v-h*d,e[8]=g*d+p,e[1]=d,e[5]=o*u,e[9]=-a*u,e[2]=-c*u,e[6]=p*d+g,e[10]=h-v*d}else if(t.order==="XZY"){let h=o*l,p=o*c,g=a*l,v=a*c;e[0]=l*u,e[4]=-d,e[8]=c*u,e[1]=h*d+v,e[5]=o*u,e[9]=p*d-g,e[2]=g*d-p,e[6]=a*u,e[10]=v*d+h}return e[3]=0,e[7]=0,e[11]=0,e[12]=0,e[13]=0,e[14]=0,e[15]=1,this}makeRotationFromQuaternion(t){return this.compose(G0,t,W0)}lookAt(t,e,n){let s=this.elements;return kn.subVectors(t,e),kn.lengthSq()===0&&(kn.z=1),kn.normalize(),ji.crossVectors(n,kn),ji.lengthSq()===0&&(Math.abs(n.z)===1?kn.x+=1e-4:kn.z+=1e-4,kn.normalize(),ji.crossVectors(n,kn)),ji.normalize(),oa.crossVectors(kn,ji),s[0]=ji.x,s[4]=oa.x,s[8]=kn.x,s[1]=ji.y,s[5]=oa.y,s[9]=kn.y,s[2]=ji.z,s[6]=oa.z,s[10]=kn.z,this}multiply(t){return this.multiplyMatrices(this,t)}premultiply(t){return this.multiplyMatrices(t,this)}multiplyMatrices(t,e){let n=t.elements,s=e.elements,r=this.elements,o=n[0],a=n[4],l=n[8],c=n[12],u=n[1],d=n[5],h=n[9],p=n[13],g=n[2],v=n[6],m=n[10],f=n[14],T=n[3],b=n[7],A=n[11],N=n[15],L=s[0],C=s[4],F=s[8],S=s[12],x=s[1],R=s[5],z=s[9],B=s[13],X=s[2],J=s[6],q=s[10],st=s[14],nt=s[3],gt=s[7],dt=s[11],pt=s[15];return r[0]=o*L+a*x+l*X+c*nt,r[4]=o*C+a*R+l*J+c*gt,r[8]=o*F+a*z+l*q+c*dt,r[12]=o*S+a*B+l*st+c*pt,r[1]=u*L+d*x+h*X+p*nt,r[5]=u*C+d*R+h*J+p*gt,r[9]=u*F+d*z+h*q+p*dt,r[13]=u*S+d*B+h*st+p*pt,r[2]=g*L+v*x+m*X+f*nt,r[6]=g*C+v*R+m*J+f*gt,r[10]=g*F+v*z+m*q+f*dt,r[14]=g*S+v*B+m*st+f*pt,r[3]=T*L+b*x+A*X+N*nt,r[7]=T*C+b*R+A*J+N*gt,r[11]=T*F+b*z+A*q+N*dt,r[15]=T*S+b*B+A*st+N*pt,this}multiplyScalar(t){let e=this.elements;return e[0]*=t,e[4]*=t,e[8]*=t,e[12]*=t,e[1]*=t,e[5]*=t,e[9]*=t,e[13]*=t,e[2]*=t,e[6]*=t,e[10]*=t,e[14]*=t,e[3]*=t,e[7]*=t,e[11]*=t,e[15]*=t,this}determinant(){let t=this.elements,e=t[0],n=t[4],s=t[8],r=t[12],o=t[1],a=t[5],l=t[9],c=t[13],u=t[2],d=t[6],h=t[10],p=t[14],g=t[3],v=t[7],m=t[11],f=t[15];return g*(+r*l*d-s*c*d-r*a*h+n*c*h+s*a*p-n*l*p)+v*(+e*l*p-e*c*h+r*o*h-s*o*p+s*c*u-r*l*u)+m*(+e*c*d-e*a*p-r*o*d+n*o*p+r*a*u-n*c*u)+f*(-s*a*u-e*l*d+e*a*h+s*o*d-n*o*h+n*l*u)}transpose(){let t=this.elements,e;return e=t[1],t[1]=t[4],t[4]=e,e=t[2],t[2]=t[8],t[8]=e,e=t[6],t[6]=t[9],t[9]=e,e=t[3],t[3]=t[12],t[12]=e,e=t[7],t[7]=t[13],t[13]=e,e=t[11],t[11]=t[14],t[14]=e,this}setPosition(t,e,n){let s=this.elements;return t.isVector3?(s[12]=t.x,s[13]=t.y,s[14]=t.z):(s[12]=t,s[13]=e,s[14]=n),this}invert(){let t=this.elements,e=t[0],n=t[1],s=t[2],r=t[3],o=t[4],a=t[5],l=t[6],c=t[7],u=t[8],d=t[9],h=t[10],p=t[11],g=t[12],v=t[13],m=t[14],f=t[15],T=d*m*c-v*h*c+v*l*p-a*m*p-d*l*f+a*h*f,b=g*h*c-u*m*c-g*l*p+o*m*p+u*l*f-o*h*f,A=u*v*c-g*d*c+g*a*p-o*v*p-u*a*f+o*d*f,N=g*d*l-u*v*l-g*a*h+o*v*h+u*a*m-o*d*m,L=e*T+n*b+s*A+r*N;if(L===0)return this.set(0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0);let C=1/L;return t[0]=T*C,t[1]=(v*h*r-d*m*r-v*s*p+n*m*p+d*s*f-n*h*f)*C,t[2]=(a*m*r-v*l*r+v*s*c-n*m*c-a*s*f+n*l*f)*C,t[3]=(d*l*r-a*h*r-d*s*c+n*h*c+a*s*p-n*l*p)*C,t[4]=b*C,t[5]=(u*m*r-g*h*r+g*s*p-e*m*p-u*s*f+e*h*f)*C,t[6]=(g*l*r-o*m*r-g*s*c+e*m*c+o*s*f-e*l*f)*C,t[7]=(o*h*r-u*l*r+u*s*c-e*h*c-o*s*p+e*l*p)*C,t[8]=A*C,t[9]=(g*d*r-u*v*r-g*n*p+e*v*p+u*n*f-e*d*f)*C,t[10]=(o*v*r-g*a*r+g*n*c-e*v*c-o*n*f+e*a*f)*C,t[11]=(u*a*r-o*d*r-u*n*c+e*d*c+o*n*p-e*a*p)*C,t[12]=N*C,t[13]=(u*v*s-g*d*s+g*n*h-e*v*h-u*n*m+e*d*m)*C,t[14]=(g*a*s-o*v*s-g*n*l+e*v*l+o*n*m-e*a*m)*C,t[15]=(o*d*s-u*a*s+u*n*l-e*d*l-o*n*h+e*a*h)*C,this}scale(t){let e=this.elements,n=t.x,s=t.y,r=t.z;return e[0]*=n,e[4]*=s,e[8]*=r,e[1]*=n,e[5]*=s,e[9]*=r,e[2]*=n,e[6]*=s,e[10]*=r,e[3]*=n,e[7]*=s,e[11]*=r,this}getMaxScaleOnAxis(){let t=this.elements,e=t[0]*t[0]+t[1]*t[1]+t[2]*t[2],n=t[4]*t[4]+t[5]*t[5]+t[6]*t[6],s=t[8]*t[8]+t[9]*t[9]+t[10]*t[10];return Math.sqrt(Math.max(e,n,s))}makeTranslation(t,e,n){return t.isVector3?this.set(1,0,0,t.x,0,1,0,t.y,0,0,1,t.z,0,0,0,1):this.set(1,0,0,t,0,1,0,e,0,0,1,n,0,0,0,1),this}makeRotationX(t){let e=Math.cos(t),n=Math.sin(t);return this.set(1,0,0,0,0,e,-n,0,0,n,e,0,0,0,0,1),this}makeRotationY(t){let e=Math.cos(t),n=Math.sin(t);return this.set(e,0,n,0,0,1,0,0,-n,0,e,0,0,0,0,1),this}makeRotationZ(t){let e=Math.cos(t),n=Math.sin(t);return this.set(e,-n,0,0,n,e,0,0,0,0,1,0,0,0,0,1),this}makeRotationAxis(t,e){let n=Math.cos(e),s=Math.sin(e),r=1-n,o=t.x,a=t.y,l=t.z,c=r*o,u=r*a;return this.set(c*o+n,c*a-s*l,c*l+s*a,0,c*a+s*l,u*a+n,u*l-s*o,0,c*l-s*a,u*l+s*o,r*l*l+n,0,0,0,0,1),this}makeScale(t,e,n){return this.set(t,0,0,0,0,e,0,0,0,0,n,0,0,0,0,1),this}makeShear(t,e,n,s,r,o){return this.set(1,n,r,0,t,1,o,0,e,s,1,0,0,0,0,1),this}compose(t,e,n){let s=this.elements,r=e._x,o=e._y,a=e._z,l=e._w,c=r+r,u=o+o,d=a+a,h=r*c,p=r*u,g=r*d,v=o*u,m=o*d,f=a*d,T=l*c,b=l*u,A=l*d,N=n.x,L=n.y,C=n.z;return s[0]=(1-(v+f))*N,s[1]=(p+A)*N,s[2]=(g-b)*N,s[3]=0,s[4]=(p-A)*L,s[5]=(1-(h+f))*L,s[6]=(m+T)*L,s[7]=0,s[8]=(g+b)*C,s[9]=(m-T)*C,s[10]=(1-(h+v))*C,s[11]=0,s[12]=t.x,s[13]=t.y,s[14]=t.z,s[15]=1,this}decompose(t,e,n){let s=this.elements,r=ir.set(s[0],s[1],s[2]).length(),o=ir.set(s[4],s[5],s[6]).length(),a=ir.set(s[8],s[9],s[10]).length();this.determinant()<0&&(r=-r),t.x=s[12],t.y=s[13],t.z=s[14],si.copy(this);let c=1/r,u=1/o,d=1/a;return si.elements[0]*=c,si.elements[1]*=c,si.elements[2]*=c,si.elements[4]*=u,si.elements[5]*=u,si.elements[6]*=u,si.elements[8]*=d,si.elements[9]*=d,si.elements[10]*=d,e.setFromRotationMatrix(si),n.x=r,n.y=o,n.z=a,this}makePerspective(t,e,n,s,r,o,a=Fi){let l=this.elements,c=2*r/(e-t),u=2*r/(n-s),d=(e+t)/(e-t),h=(n+s)/(n-s),p,g;if(a===Fi)p=-(o+r)/(o-r),g=-2*o*r/(o-r);else if(a===La)p=-o/(o-r),g=-o*r/(o-r);else throw new Error("THREE.Matrix4.makePerspective(): Invalid coordinate system: "+a);return l[0]=c,l[4]=0,l[8]=d,l[12]=0,l[1]=0,l[5]=u,l[9]=h,l[13]=0,l[2]=0,l[6]=0,l[10]=p,l[14]=g,l[3]=0,l[7]=0,l[11]=-1,l[15]=0,this}makeOrthographic(t,e,n,s,r,o,a=Fi){let l=this.elements,c=1/(e-t),u=1/(n-s),d=1/(o-r),h=(e+t)*c,p=(n+s)*u,g,v;if(a===Fi)g=(o+r)*d,v=-2*d;else if(a===La)g=r*d,v=-1*d;else throw new Error("THREE.Matrix4.makeOrthographic(): Invalid coordinate system: "+a);return l[0]=2*c,l[4]=0,l[8]=0,l[12]=-h,l[1]=0,l[5]=2*u,l[9]=0,l[13]=-p,l[2]=0,l[6]=0,l[10]=v,l[14]=-g,l[3]=0,l[7]=0,l[11]=0,l[15]=1,this}equals(t){let e=this.elements,n=t.elements;for(let s=0;s<16;s++)if(e[s]!==n[s])return!1;return!0}fromArray(t,e=0){for(let n=0;n<16;n++)this.elements[n]=t[n+e];return this}toArray(t=[],e=0){let n=this.elements;return t[e]=n[0],t[e+1]=n[1],t[e+2]=n[2],t[e+3]=n[3],t[e+4]=n[4],t[e+5]=n[5],t[e+6]=n[6],t[e+7]=n[7],t[e+8]=n[8],t[e+9]=n[9],t[e+10]=n[10],t[e+11]=n[11],t[e+12]=n[12],t[e+13]=n[13],t[e+14]=n[14],t[e+15]=n[15],t}},ir=new V,si=new ve,G0=new V(0,0,0),W0=new V(1,1,1),ji=new V,oa=new V,kn=new V,Cd=new ve,Rd=new On,Kn=class{constructor(t=0,e=0,n=0,s=Kn.DEFAULT_ORDER){this.isEuler=!0,this._x=t,this._y=e,this._z=n,this._order=s}get x(){return this._x}set x(t){this._x=t,this._onChangeCallback()}get y(){return this._y}set y(t){this._y=t,this._onChangeCallback()}get z(){return this._z}set z(t){this._z=t,this._onChangeCallback()}get order(){return this._order}set order(t){this._order=t,this._onChangeCallback()}set(t,e,n,s=this._order){return this._x=t,this._y=e,this._z=n,this._order=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._order)}copy(t){return this._x=t._x,this._y=t._y,this._z=t._z,this._order=t._order,this._onChangeCallback(),this}setFromRotationMatrix(t,e=this._order,n=!0){let s=t.elements,r=s[0],o=s[4],a=s[8],l=s[1],c=s[5],u=s[9],d=s[2],h=s[6],p=s[10];switch(e){case"XYZ":this._y=Math.asin(vn(a,-1,1)),Math.abs(a)<.9999999?(this._x=Math.atan2(-u,p),this._z=Math.atan2(-o,r)):(this._x=Math.atan2(h,c),this._z=0);break;case"YXZ":this._x=Math.asin(-vn(u,-1,1)),Math.abs(u)<.9999999?(this._y=Math.atan2(a,p),this._z=Math.atan2(l,c)):(this._y=Math.atan2(-d,r),this._z=0);break;case"ZXY":this._x=Math.asin(vn(h,-1,1)),Math.abs(h)<.9999999?(this._y=Math.atan2(-d,p),this._z=Math.atan2(-o,c)):(this._y=0,this._z=Math.atan2(l,r));break;case"ZYX":this._y=Math.asin(-vn(d,-1,1)),Math.abs(d)<.9999999?(this._x=Math.atan2(h,p),this._z=Math.atan2(l,r)):(this._x=0,this._z=Math.atan2(-o,c));break;case"YZX":this._z=Math.asin(vn(l,-1,1)),Math.abs(l)<.9999999?(this._x=Math.atan2(-u,c),this._y=Math.atan2(-d,r)):(this._x=0,this._y=Math.atan2(a,p));break;case"XZY":this._z=Math.asin(-vn(o,-1,1)),Math.abs(o)<.9999999?(this._x=Math.atan2(h,c),this._y=Math.atan2(a,r)):(this._x=Math.atan2(-u,p),this._y=0);break;default:console.warn("THREE.Euler: .setFromRotationMatrix() encountered an unknown order: "+e)}return this._order=e,n===!0&&this._onChangeCallback(),this}setFromQuaternion(t,e,n){return Cd.makeRotationFromQuaternion(t),this.setFromRotationMatrix(Cd,e,n)}setFromVector3(t,e=this._order){return this.set(t.x,t.y,t.z,e)}reorder(t){return Rd.setFromEuler(this),this.setFromQuaternion(Rd,t)}equals(t){return t._x===this._x&&t._y===this._y&&t._z===this._z&&t._order===this._order}fromArray(t){return this._x=t[0],this._y=t[1],this._z=t[2],t[3]!==void 0&&(this._order=t[3]),this._onChangeCallback(),this}toArray(t=[],e=0){return t[e]=this._x,t[e+1]=this._y,t[e+2]=this._z,t[e+3]=this._order,t}_onChange(t){return this._onChangeCallback=t,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._order}};Kn.DEFAULT_ORDER="XYZ";var Ua=class{constructor(){this.mask=1}set(t){this.mask=(1<<t|0)>>>0}enable(t){this.mask|=1<<t|0}enableAll(){this.mask=-1}toggle(t){this.mask^=1<<t|0}disable(t){this.mask&=~(1<<t|0)}disableAll(){this.mask=0}test(t){return(this.mask&t.mask)!==0}isEnabled(t){return(this.mask&(1<<t|0))!==0}},X0=0,Pd=new V,sr=new On,Li=new ve,aa=new V,uo=new V,$0=new V,q0=new On,Ld=new V(1,0,0),Id=new V(0,1,0),Dd=new V(0,0,1),Nd={type:"added"},Y0={type:"removed"},rr={type:"childadded",child:null},uc={type:"childremoved",child:null},Je=class extends bi{constructor(){super(),this.isObject3D=!0,Object.defineProperty(this,"id",{value:X0++}),this.uuid=Ur(),this.name="",this.type="Object3D",this.parent=null,this.children=[],this.up=Je.DEFAULT_UP.clone();let t=new V,e=new Kn,n=new On,s=new V(1,1,1);function r(){n.setFromEuler(e,!1)}function o(){e.setFromQuaternion(n,void 0,!1)}e._onChange(r),n._onChange(o),Object.defineProperties(this,{position:{configurable:!0,enumerable:!0,value:t},rotation:{configurable:!0,enumerable:!0,value:e},quaternion:{configurable:!0,enumerable:!0,value:n},scale:{configurable:!0,enumerable:!0,value:s},modelViewMatrix:{value:new ve},normalMatrix:{value:new ie}}),this.matrix=new ve,this.matrixWorld=new ve,this.matrixAutoUpdate=Je.DEFAULT_MATRIX_AUTO_UPDATE,this.matrixWorldAutoUpdate=Je.DEFAULT_MATRIX_WORLD_AUTO_UPDATE,this.matrixWorldNeedsUpdate=!1,this.layers=new Ua,this.visible=!0,this.castShadow=!1,this.receiveShadow=!1,this.frustumCulled=!0,this.renderOrder=0,this.animations=[],this.userData={}}onBeforeShadow(){}onAfterShadow(){}onBeforeRender(){}onAfterRender(){}applyMatrix4(t){this.matrixAutoUpdate&&this.updateMatrix(),this.matrix.premultiply(t),this.matrix.decompose(this.position,this.quaternion,this.scale)}applyQuaternion(t){return this.quaternion.premultiply(t),this}setRotationFromAxisAngle(t,e){this.quaternion.setFromAxisAngle(t,e)}setRotationFromEuler(t){this.quaternion.setFromEuler(t,!0)}setRotationFromMatrix(t){this.quaternion.setFromRotationMatrix(t)}setRotationFromQuaternion(t){this.quaternion.copy(t)}rotateOnAxis(t,e){return sr.setFromAxisAngle(t,e),this.quaternion.multiply(sr),this}rotateOnWorldAxis(t,e){return sr.setFromAxisAngle(t,e),this.quaternion.premultiply(sr),this}rotateX(t){return this.rotateOnAxis(Ld,t)}rotateY(t){return this.rotateOnAxis(Id,t)}rotateZ(t){return this.rotateOnAxis(Dd,t)}translateOnAxis(t,e){return Pd.copy(t).applyQuaternion(this.quaternion),this.position.add(Pd.multiplyScalar(e)),this}translateX(t){return this.translateOnAxis(Ld,t)}translateY(t){return this.translateOnAxis(Id,t)}translateZ(t){return this.translateOnAxis(Dd,t)}localToWorld(t){return this.updateWorldMatrix(!0,!1),t.applyMatrix4(this.matrixWorld)}worldToLocal(t){return this.updateWorldMatrix(!0,!1),t.applyMatrix4(Li.copy(this.matrixWorld).invert())}lookAt(t,e,n){t.isVector3?aa.copy(t):aa.set(t,e,n);let s=this.parent;this.updateWorldMatrix(!0,!1),uo.setFromMatrixPosition(this.matrixWorld),this.isCamera||this.isLight?Li.lookAt(uo,aa,this.up):Li.lookAt(aa,uo,this.up),this.quaternion.setFromRotationMatrix(Li),s&&(Li.extractRotation(s.matrixWorld),sr.setFromRotationMatrix(Li),this.quaternion.premultiply(sr.invert()))}add(t){if(arguments.length>1){for(let e=0;e<arguments.length;e++)this.add(arguments[e]);return this}return t===this?(console.error("THREE.Object3D.add: object can't be added as a child of itself.",t),this):(t&&t.isObject3D?(t.removeFromParent(),t.parent=this,this.children.push(t),t.dispatchEvent(Nd),rr.child=t,this.dispatchEvent(rr),rr.child=null):console.error("THREE.Object3D.add: object not an instance of THREE.Object3D.",t),this)}remove(t){if(arguments.length>1){for(let n=0;n<arguments.length;n++)this.remove(arguments[n]);return this}let e=this.children.indexOf(t);return e!==-1&&(t.parent=null,this.children.splice(e,1),t.dispatchEvent(Y0),uc.child=t,this.dispatchEvent(uc),uc.child=null),this}removeFromParent(){let t=this.parent;return t!==null&&t.remove(this),this}clear(){return this.remove(...this.children)}attach(t){return this.updateWorldMatrix(!0,!1),Li.copy(this.matrixWorld).invert(),t.parent!==null&&(t.parent.updateWorldMatrix(!0,!1),Li.multiply(t.parent.matrixWorld)),t.applyMatrix4(Li),t.removeFromParent(),t.parent=this,this.children.push(t),t.updateWorldMatrix(!1,!0),t.dispatchEvent(Nd),rr.child=t,this.dispatchEvent(rr),rr.child=null,this}getObjectById(t){return this.getObjectByProperty("id",t)}getObjectByName(t){return this.getObjectByProperty("name",t)}getObjectByProperty(t,e){if(this[t]===e)return this;for(let n=0,s=this.children.length;n<s;n++){let o=this.children[n].getObjectByProperty(t,e);if(o!==void 0)return o}}getObjectsByProperty(t,e,n=[]){this[t]===e&&n.push(this);let s=this.children;for(let r=0,o=s.length;r<o;r++)s[r].getObjectsByProperty(t,e,n);return n}getWorldPosition(t){return this.updateWorldMatrix(!0,!1),t.setFromMatrixPosition(this.matrixWorld)}getWorldQuaternion(t){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(uo,t,$0),t}getWorldScale(t){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(uo,q0,t),t}getWorldDirection(t){this.updateWorldMatrix(!0,!1);let e=this.matrixWorld.elements;return t.set(e[8],e[9],e[10]).normalize()}raycast(){}traverse(t){t(this);let e=this.children;for(let n=0,s=e.length;n<s;n++)e[n].traverse(t)}traverseVisible(t){if(this.visible===!1)return;t(this);let e=this.children;for(let n=0,s=e.length;n<s;n++)e[n].traverseVisible(t)}traverseAncestors(t){let e=this.parent;e!==null&&(t(e),e.traverseAncestors(t))}updateMatrix(){this.matrix.compose(this.position,this.quaternion,this.scale),this.matrixWorldNeedsUpdate=!0}updateMatrixWorld(t){this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||t)&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix),this.matrixWorldNeedsUpdate=!1,t=!0);let e=this.children;for(let n=0,s=e.length;n<s;n++){let r=e[n];(r.matrixWorldAutoUpdate===!0||t===!0)&&r.updateMatrixWorld(t)}}updateWorldMatrix(t,e){let n=this.parent;if(t===!0&&n!==null&&n.matrixWorldAutoUpdate===!0&&n.updateWorldMatrix(!0,!1),this.matrixAutoUpdate&&this.updateMatrix(),this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix),e===!0){let s=this.children;for(let r=0,o=s.length;r<o;r++){let a=s[r];a.matrixWorldAutoUpdate===!0&&a.updateWorldMatrix(!1,!0)}}}toJSON(t){let e=t===void 0||typeof t=="string",n={};e&&(t={geometries:{},materials:{},textures:{},images:{},shapes:{},skeletons:{},animations:{},nodes:{}},n.metadata={version:4.6,type:"Object",generator:"Object3D.toJSON"});let s={};s.uuid=this.uuid,s.type=this.type,this.name!==""&&(s.name=this.name),this.castShadow===!0&&(s.castShadow=!0),this.receiveShadow===!0&&(s.receiveShadow=!0),this.visible===!1&&(s.visible=!1),this.frustumCulled===!1&&(s.frustumCulled=!1),this.renderOrder!==0&&(s.renderOrder=this.renderOrder),Object.keys(this.userData).length>0&&(s.userData=this.userData),s.layers=this.layers.mask,s.matrix=this.matrix.toArray(),s.up=this.up.toArray(),this.matrixAutoUpdate===!1&&(s.matrixAutoUpdate=!1),this.isInstancedMesh&&(s.type="InstancedMesh",s.count=this.count,s.instanceMatrix=this.instanceMatrix.toJSON(),this.instanceColor!==null&&(s.instanceColor=this.instanceColor.toJSON())),this.isBatchedMesh&&(s.type="BatchedMesh",s.perObjectFrustumCulled=this.perObjectFrustumCulled,s.sortObjects=this.sortObjects,s.drawRanges=this._drawRanges,s.reservedRanges=this._reservedRanges,s.visibility=this._visibility,s.active=this._active,s.bounds=this._bounds.map(a=>({boxInitialized:a.boxInitialized,boxMin:a.box.min.toArray(),boxMax:a.box.max.toArray(),sphereInitialized:a.sphereInitialized,sphereRadius:a.sphere.radius,sphereCenter:a.sphere.center.toArray()})),s.maxGeometryCount=this._maxGeometryCount,s.maxVertexCount=this._maxVertexCount,s.maxIndexCount=this._maxIndexCount,s.geometryInitialized=this._geometryInitialized,s.geometryCount=this._geometryCount,s.matricesTexture=this._matricesTexture.toJSON(t),this._colorsTexture!==null&&(s.colorsTexture=this._colorsTexture.toJSON(t)),this.boundingSphere!==null&&(s.boundingSphere={center:s.boundingSphere.center.toArray(),radius:s.boundingSphere.radius}),this.boundingBox!==null&&(s.boundingBox={min:s.boundingBox.min.toArray(),max:s.boundingBox.max.toArray()}));function r(a,l){return a[l.uuid]===void 0&&(a[l.uuid]=l.toJSON(t)),l.uuid}if(this.isScene)this.background&&(this.background.isColor?s.background=this.background.toJSON():this.background.isTexture&&(s.background=this.background.toJSON(t).uuid)),this.environment&&this.environment.isTexture&&this.environment.isRenderTargetTexture!==!0&&(s.environment=this.environment.toJSON(t).uuid);else if(this.isMesh||this.isLine||this.isPoints){s.geometry=r(t.geometries,this.geometry);let a=this.geometry.parameters;if(a!==void 0&&a.shapes!==void 0){let l=a.shapes;if(Array.isArray(l))for(let c=0,u=l.length;c<u;c++){let d=l[c];r(t.shapes,d)}else r(t.shapes,l)}}if(this.isSkinnedMesh&&(s.bindMode=this.bindMode,s.bindMatrix=this.bindMatrix.toArray(),this.skeleton!==void 0&&(r(t.skeletons,this.skeleton),s.skeleton=this.skeleton.uuid)),this.material!==void 0)if(Array.isArray(this.material)){let a=[];for(let l=0,c=this.material.length;l<c;l++)a.push(r(t.materials,this.material[l]));s.material=a}else s.material=r(t.materials,this.material);if(this.children.length>0){s.children=[];for(let a=0;a<this.children.length;a++)s.children.push(this.children[a].toJSON(t).object)}if(this.animations.length>0){s.animations=[];for(let a=0;a<this.animations.length;a++){let l=this.animations[a];s.animations.push(r(t.animations,l))}}if(e){let a=o(t.geometries),l=o(t.materials),c=o(t.textures),u=o(t.images),d=o(t.shapes),h=o(t.skeletons),p=o(t.animations),g=o(t.nodes);a.length>0&&(n.geometries=a),l.length>0&&(n.materials=l),c.length>0&&(n.textures=c),u.length>0&&(n.images=u),d.length>0&&(n.shapes=d),h.length>0&&(n.skeletons=h),p.length>0&&(n.animations=p),g.length>0&&(n.nodes=g)}return n.object=s,n;function o(a){let l=[];for(let c in a){let u=a[c];delete u.metadata,l.push(u)}return l}}clone(t){return new this.constructor().copy(this,t)}copy(t,e=!0){if(this.name=t.name,this.up.copy(t.up),this.position.copy(t.position),this.rotation.order=t.rotation.order,this.quaternion.copy(t.quaternion),this.scale.copy(t.scale),this.matrix.copy(t.matrix),this.matrixWorld.copy(t.matrixWorld),this.matrixAutoUpdate=t.matrixAutoUpdate,this.matrixWorldAutoUpdate=t.matrixWorldAutoUpdate,this.matrixWorldNeedsUpdate=t.matrixWorldNeedsUpdate,this.layers.mask=t.layers.mask,this.visible=t.visible,this.castShadow=t.castShadow,this.receiveShadow=t.receiveShadow,this.frustumCulled=t.frustumCulled,this.renderOrder=t.renderOrder,this.animations=t.animations.slice(),this.userData=JSON.parse(JSON.stringify(t.userData)),e===!0)for(let n=0;n<t.children.length;n++){let s=t.children[n];this.add(s.clone())}return this}};Je.DEFAULT_UP=new V(0,1,0);Je.DEFAULT_MATRIX_AUTO_UPDATE=!0;Je.DEFAULT_MATRIX_WORLD_AUTO_UPDATE=!0;var ri=new V,Ii=new V,dc=new V,Di=new V,or=new V,ar=new V,Ud=new V,fc=new V,pc=new V,mc=new V,Zn=class{constructor(t=new V,e=new V,n=new V){this.a=t,this.b=e,this.c=n}static getNormal(t,e,n,s){s.subVectors(n,e),ri.subVectors(t,e),s.cross(ri);let r=s.lengthSq();return r>0?s.multiplyScalar(1/Math.sqrt(r)):s.set(0,0,0)}static getBarycoord(t,e,n,s,r){ri.subVectors(s,e),Ii.subVectors(n,e),dc.subVectors(t,e);let o=ri.dot(ri),a=ri.dot(Ii),l=ri.dot(dc),c=Ii.dot(Ii),u=Ii.dot(dc),d=o*c-a*a;if(d===0)return r.set(0,0,0),null;let h=1/d,p=(c*l-a*u)*h,g=(o*u-a*l)*h;return r.set(1-p-g,g,p)}static containsPoint(t,e,n,s){return this.getBarycoord(t,e,n,s,Di)===null?!1:Di.x>=0&&Di.y>=0&&Di.x+Di.y<=1}static getInterpolation(t,e,n,s,r,o,a,l){return this.getBarycoord(t,e,n,s,Di)===null?(l.x=0,l.y=0,"z"in l&&(l.z=0),"w"in l&&(l.w=0),null):(l.setScalar(0),l.addScaledVector(r,Di.x),l.addScaledVector(o,Di.y),l.addScaledVector(a,Di.z),l)}static isFrontFacing(t,e,n,s){return ri.subVectors(n,e),Ii.subVectors(t,e),ri.cross(Ii).dot(s)<0}set(t,e,n){return this.a.copy(t),this.b.copy(e),this.c.copy(n),this}setFromPointsAndIndices(t,e,n,s){return this.a.copy(t[e]),this.b.copy(t[n]),this.c.copy(t[s]),this}setFromAttributeAndIndices(t,e,n,s){return this.a.fromBufferAttribute(t,e),this.b.fromBufferAttribute(t,n),this.c.fromBufferAttribute(t,s),this}clone(){return new this.constructor().copy(this)}copy(t){return this.a.copy(t.a),this.b.copy(t.b),this.c.copy(t.c),this}getArea(){return ri.subVectors(this.c,this.b),Ii.subVectors(this.a,this.b),ri.cross(Ii).length()*.5}getMidpoint(t){return t.addVectors(this.a,this.b).add(this.c).multiplyScalar(1/3)}getNormal(t){return Zn.getNormal(this.a,this.b,this.c,t)}getPlane(t){return t.setFromCoplanarPoints(this.a,this.b,this.c)}getBarycoord(t,e){return Zn.getBarycoord(t,this.a,this.b,this.c,e)}getInterpolation(t,e,n,s,r){return Zn.getInterpolation(t,this.a,this.b,this.c,e,n,s,r)}containsPoint(t){return Zn.containsPoint(t,this.a,this.b,this.c)}isFrontFacing(t){return Zn.isFrontFacing(this.a,this.b,this.c,t)}intersectsBox(t){return t.intersectsTriangle(this)}closestPointToPoint(t,e){let n=this.a,s=this.b,r=this.c,o,a;or.subVectors(s,n),ar.subVectors(r,n),fc.subVectors(t,n);let l=or.dot(fc),c=ar.dot(fc);if(l<=0&&c<=0)return e.copy(n);pc.subVectors(t,s);let u=or.dot(pc),d=ar.dot(pc);if(u>=0&&d<=u)return e.copy(s);let h=l*d-u*c;if(h<=0&&l>=0&&u<=0)return o=l/(l-u),e.copy(n).addScaledVector(or,o);mc.subVectors(t,r);let p=or.dot(mc),g=ar.dot(mc);if(g>=0&&p<=g)return e.copy(r);let v=p*c-l*g;if(v<=0&&c>=0&&g<=0)return a=c/(c-g),e.copy(n).addScaledVector(ar,a);let m=u*g-p*d;if(m<=0&&d-u>=0&&p-g>=0)return Ud.subVectors(r,s),a=(d-u)/(d-u+(p-g)),e.copy(s).addScaledVector(Ud,a);let f=1/(m+v+h);return o=v*f,a=h*f,e.copy(n).addScaledVector(or,o).addScaledVector(ar,a)}equals(t){return t.a.equals(this.a)&&t.b.equals(this.b)&&t.c.equals(this.c)}},Df={aliceblue:15792383,antiquewhite:16444375,aqua:65535,aquamarine:8388564,azure:15794175,beige:16119260,bisque:16770244,black:0,blanchedalmond:16772045,blue:255,blueviolet:9055202,brown:10824234,burlywood:14596231,cadetblue:6266528,chartreuse:8388352,chocolate:13789470,coral:16744272,cornflowerblue:6591981,cornsilk:16775388,crimson:14423100,cyan:65535,darkblue:139,darkcyan:35723,darkgoldenrod:12092939,darkgray:11119017,darkgreen:25600,darkgrey:11119017,darkkhaki:12433259,darkmagenta:9109643,darkolivegreen:5597999,darkorange:16747520,darkorchid:10040012,darkred:9109504,darksalmon:15308410,darkseagreen:9419919,darkslateblue:4734347,darkslategray:3100495,darkslategrey:3100495,darkturquoise:52945,darkviolet:9699539,deeppink:16716947,deepskyblue:49151,dimgray:6908265,dimgrey:6908265,dodgerblue:2003199,firebrick:11674146,floralwhite:16775920,forestgreen:2263842,fuchsia:16711935,gainsboro:14474460,ghostwhite:16316671,gold:16766720,goldenrod:14329120,gray:8421504,green:32768,greenyellow:11403055,grey:8421504,honeydew:15794160,hotpink:16738740,indianred:13458524,indigo:4915330,ivory:16777200,khaki:15787660,lavender:15132410,lavenderblush:16773365,lawngreen:8190976,lemonchiffon:16775885,lightblue:11393254,lightcoral:15761536,lightcyan:14745599,lightgoldenrodyellow:16448210,lightgray:13882323,lightgreen:9498256,lightgrey:13882323,lightpink:16758465,lightsalmon:16752762,lightseagreen:2142890,lightskyblue:8900346,lightslategray:7833753,lightslategrey:7833753,lightsteelblue:11584734,lightyellow:16777184,lime:65280,limegreen:3329330,linen:16445670,magenta:16711935,maroon:8388608,mediumaquamarine:6737322,mediumblue:205,mediumorchid:12211667,mediumpurple:9662683,mediumseagreen:3978097,mediumslateblue:8087790,mediumspringgreen:64154,mediumturquoise:4772300,mediumvioletred:13047173,midnightblue:1644912,mintcream:16121850,mistyrose:16770273,moccasin:16770229,navajowhite:16768685,navy:128,oldlace:16643558,olive:8421376,olivedrab:7048739,orange:16753920,orangered:16729344,orchid:14315734,palegoldenrod:15657130,palegreen:10025880,paleturquoise:11529966,palevioletred:14381203,papayawhip:16773077,peachpuff:16767673,peru:13468991,pink:16761035,plum:14524637,powderblue:11591910,purple:8388736,rebeccapurple:6697881,red:16711680,rosybrown:12357519,royalblue:4286945,saddlebrown:9127187,salmon:16416882,sandybrown:16032864,seagreen:3050327,seashell:16774638,sienna:10506797,silver:12632256,skyblue:8900331,slateblue:6970061,slategray:7372944,slategrey:7372944,snow:16775930,springgreen:65407,steelblue:4620980,tan:13808780,teal:32896,thistle:14204888,tomato:16737095,turquoise:4251856,violet:15631086,wheat:16113331,white:16777215,whitesmoke:16119285,yellow:16776960,yellowgreen:10145074},Qi={h:0,s:0,l:0},la={h:0,s:0,l:0};function gc(i,t,e){return e<0&&(e+=1),e>1&&(e-=1),e<1/6?i+(t-i)*6*e:e<1/2?t:e<2/3?i+(t-i)*6*(2/3-e):i}var ce=class{constructor(t,e,n){return this.isColor=!0,this.r=1,this.g=1,this.b=1,this.set(t,e,n)}set(t,e,n){if(e===void 0&&n===void 0){let s=t;s&&s.isColor?this.copy(s):typeof s=="number"?this.setHex(s):typeof s=="string"&&this.setStyle(s)}else this.setRGB(t,e,n);return this}setScalar(t){return this.r=t,this.g=t,this.b=t,this}setHex(t,e=vi){return t=Math.floor(t),this.r=(t>>16&255)/255,this.g=(t>>8&255)/255,this.b=(t&255)/255,we.toWorkingColorSpace(this,e),this}setRGB(t,e,n,s=we.workingColorSpace){return this.r=t,this.g=e,this.b=n,we.toWorkingColorSpace(this,s),this}setHSL(t,e,n,s=we.workingColorSpace){if(t=ph(t,1),e=vn(e,0,1),n=vn(n,0,1),e===0)this.r=this.g=this.b=n;else{let r=n<=.5?n*(1+e):n+e-n*e,o=2*n-r;this.r=gc(o,r,t+1/3),this.g=gc(o,r,t),this.b=gc(o,r,t-1/3)}return we.toWorkingColorSpace(this,s),this}setStyle(t,e=vi){function n(r){r!==void 0&&parseFloat(r)<1&&console.warn("THREE.Color: Alpha component of "+t+" will be ignored.")}let s;if(s=/^(\w+)\(([^\)]*)\)/.exec(t)){let r,o=s[1],a=s[2];switch(o){case"rgb":case"rgba":if(r=/^\s*(\d+)\s*,\s*(\d+)\s*,\s*(\d+)\s*(?:,\s*(\d*\.?\d+)\s*)?$/.exec(a))return n(r[4]),this.setRGB(Math.min(255,parseInt(r[1],10))/255,Math.min(255,parseInt(r[2],10))/255,Math.min(255,parseInt(r[3],10))/255,e);if(r=/^\s*(\d+)\%\s*,\s*(\d+)\%\s*,\s*(\d+)\%\s*(?:,\s*(\d*\.?\d+)\s*)?$/.exec(a))return n(r[4]),this.setRGB(Math.min(100,parseInt(r[1],10))/100,Math.min(100,parseInt(r[2],10))/100,Math.min(100,parseInt(r[3],10))/100,e);break;case"hsl":case"hsla":if(r=/^\s*(\d*\.?\d+)\s*,\s*(\d*\.?\d+)\%\s*,\s*(\d*\.?\d+)\%\s*(?:,\s*(\d*\.?\d+)\s*)?$/.exec(a))return n(r[4]),this.setHSL(parseFloat(r[1])/360,parseFloat(r[2])/100,parseFloat(r[3])/100,e);break;default:console.warn("THREE.Color: Unknown color model "+t)}}else if(s=/^\#([A-Fa-f\d]+)$/.exec(t)){let r=s[1],o=r.length;if(o===3)return this.setRGB(parseInt(r.charAt(0),16)/15,parseInt(r.charAt(1),16)/15,parseInt(r.charAt(2),16)/15,e);if(o===6)return this.setHex(parseInt(r,16),e);console.warn("THREE.Color: Invalid hex color "+t)}else if(t&&t.length>0)return this.setColorName(t,e);return this}setColorName(t,e=vi){let n=Df[t.toLowerCase()];return n!==void 0?this.setHex(n,e):console.warn("THREE.Color: Unknown color "+t),this}clone(){return new this.constructor(this.r,this.g,this.b)}copy(t){return this.r=t.r,this.g=t.g,this.b=t.b,this}copySRGBToLinear(t){return this.r=xr(t.r),this.g=xr(t.g),this.b=xr(t.b),this}copyLinearToSRGB(t){return this.r=ic(t.r),this.g=ic(t.g),this.b=ic(t.b),this}convertSRGBToLinear(){return this.copySRGBToLinear(this),this}convertLinearToSRGB(){return this.copyLinearToSRGB(this),this}getHex(t=vi){return we.fromWorkingColorSpace(_n.copy(this),t),Math.round(vn(_n.r*255,0,255))*65536+Math.round(vn(_n.g*255,0,255))*256+Math.round(vn(_n.b*255,0,255))}getHexString(t=vi){return("000000"+this.getHex(t).toString(16)).slice(-6)}getHSL(t,e=we.workingColorSpace){we.fromWorkingColorSpace(_n.copy(this),e);let n=_n.r,s=_n.g,r=_n.b,o=Math.max(n,s,r),a=Math.min(n,s,r),l,c,u=(a+o)/2;if(a===o)l=0,c=0;else{let d=o-a;switch(c=u<=.5?d/(o+a):d/(2-o-a),o){case n:l=(s-r)/d+(s<r?6:0);break;case s:l=(r-n)/d+2;break;case r:l=(n-s)/d+4;break}l/=6}return t.h=l,t.s=c,t.l=u,t}getRGB(t,e=we.workingColorSpace){return we.fromWorkingColorSpace(_n.copy(this),e),t.r=_n.r,t.g=_n.g,t.b=_n.b,t}getStyle(t=vi){we.fromWorkingColorSpace(_n.copy(this),t);let e=_n.r,n=_n.g,s=_n.b;return t!==vi?`color(${t} ${e.toFixed(3)} ${n.toFixed(3)} ${s.toFixed(3)})`:`rgb(${Math.round(e*255)},${Math.round(n*255)},${Math.round(s*255)})`}offsetHSL(t,e,n){return this.getHSL(Qi),this.setHSL(Qi.h+t,Qi.s+e,Qi.l+n)}add(t){return this.r+=t.r,this.g+=t.g,this.b+=t.b,this}addColors(t,e){return this.r=t.r+e.r,this.g=t.g+e.g,this.b=t.b+e.b,this}addScalar(t){return this.r+=t,this.g+=t,this.b+=t,this}sub(t){return this.r=Math.max(0,this.r-t.r),this.g=Math.max(0,this.g-t.g),this.b=Math.max(0,this.b-t.b),this}multiply(t){return this.r*=t.r,this.g*=t.g,this.b*=t.b,this}multiplyScalar(t){return this.r*=t,this.g*=t,this.b*=t,this}lerp(t,e){return this.r+=(t.r-this.r)*e,this.g+=(t.g-this.g)*e,this.b+=(t.b-this.b)*e,this}lerpColors(t,e,n){return this.r=t.r+(e.r-t.r)*n,this.g=t.g+(e.g-t.g)*n,this.b=t.b+(e.b-t.b)*n,this}lerpHSL(t,e){this.getHSL(Qi),t.getHSL(la);let n=yo(Qi.h,la.h,e),s=yo(Qi.s,la.s,e),r=yo(Qi.l,la.l,e);return this.setHSL(n,s,r),this}setFromVector3(t){return this.r=t.x,this.g=t.y,this.b=t.z,this}applyMatrix3(t){let e=this.r,n=this.g,s=this.b,r=t.elements;return this.r=r[0]*e+r[3]*n+r[6]*s,this.g=r[1]*e+r[4]*n+r[7]*s,this.b=r[2]*e+r[5]*n+r[8]*s,this}equals(t){return t.r===this.r&&t.g===this.g&&t.b===this.b}fromArray(t,e=0){return this.r=t[e],this.g=t[e+1],this.b=t[e+2],this}toArray(t=[],e=0){return t[e]=this.r,t[e+1]=this.g,t[e+2]=this.b,t}fromBufferAttribute(t,e){return this.r=t.getX(e),this.g=t.getY(e),this.b=t.getZ(e),this}toJSON(){return this.getHex()}*[Symbol.iterator](){yield this.r,yield this.g,yield this.b}},_n=new ce;ce.NAMES=Df;var Z0=0,os=class extends bi{constructor(){super(),this.isMaterial=!0,Object.defineProperty(this,"id",{value:Z0++}),this.uuid=Ur(),this.name="",this.type="Material",this.blending=vr,this.side=ss,this.vertexColors=!1,this.opacity=1,this.transparent=!1,this.alphaHash=!1,this.blendSrc=Cc,this.blendDst=Rc,this.blendEquation=ws,this.blendSrcAlpha=null,this.blendDstAlpha=null,this.blendEquationAlpha=null,this.blendColor=new ce(0,0,0),this.blendAlpha=0,this.depthFunc=Ea,this.depthTest=!0,this.depthWrite=!0,this.stencilWriteMask=255,this.stencilFunc=xd,this.stencilRef=0,this.stencilFuncMask=255,this.stencilFail=js,this.stencilZFail=js,this.stencilZPass=js,this.stencilWrite=!1,this.clippingPlanes=null,this.clipIntersection=!1,this.clipShadows=!1,this.shadowSide=null,this.colorWrite=!0,this.precision=null,this.polygonOffset=!1,this.polygonOffsetFactor=0,this.polygonOffsetUnits=0,this.dithering=!1,this.alphaToCoverage=!1,this.premultipliedAlpha=!1,this.forceSinglePass=!1,this.visible=!0,this.toneMapped=!0,this.userData={},this.version=0,this._alphaTest=0}get alphaTest(){return this._alphaTest}set alphaTest(t){this._alphaTest>0!=t>0&&this.version++,this._alphaTest=t}onBuild(){}onBeforeRender(){}onBeforeCompile(){}customProgramCacheKey(){return this.onBeforeCompile.toString()}setValues(t){if(t!==void 0)for(let e in t){let n=t[e];if(n===void 0){console.warn(`THREE.Material: parameter '${e}' has value of undefined.`);continue}let s=this[e];if(s===void 0){console.warn(`THREE.Material: '${e}' is not a property of THREE.${this.type}.`);continue}s&&s.isColor?s.set(n):s&&s.isVector3&&n&&n.isVector3?s.copy(n):this[e]=n}}toJSON(t){let e=t===void 0||typeof t=="string";e&&(t={textures:{},images:{}});let n={metadata:{version:4.6,type:"Material",generator:"Material.toJSON"}};n.uuid=this.uuid,n.type=this.type,this.name!==""&&(n.name=this.name),this.color&&this.color.isColor&&(n.color=this.color.getHex()),this.roughness!==void 0&&(n.roughness=this.roughness),this.metalness!==void 0&&(n.metalness=this.metalness),this.sheen!==void 0&&(n.sheen=this.sheen),this.sheenColor&&this.sheenColor.isColor&&(n.sheenColor=this.sheenColor.getHex()),this.sheenRoughness!==void 0&&(n.sheenRoughness=this.sheenRoughness),this.emissive&&this.emissive.isColor&&(n.emissive=this.emissive.getHex()),this.emissiveIntensity!==void 0&&this.emissiveIntensity!==1&&(n.emissiveIntensity=this.emissiveIntensity),this.specular&&this.specular.isColor&&(n.specular=this.specular.getHex()),this.specularIntensity!==void 0&&(n.specularIntensity=this.specularIntensity),this.specularColor&&this.specularColor.isColor&&(n.specularColor=this.specularColor.getHex()),this.shininess!==void 0&&(n.shininess=this.shininess),this.clearcoat!==void 0&&(n.clearcoat=this.clearcoat),this.clearcoatRoughness!==void 0&&(n.clearcoatRoughness=this.clearcoatRoughness),this.clearcoatMap&&this.clearcoatMap.isTexture&&(n.clearcoatMap=this.clearcoatMap.toJSON(t).uuid),this.clearcoatRoughnessMap&&this.clearcoatRoughnessMap.isTexture&&(n.clearcoatRoughnessMap=this.clearcoatRoughnessMap.toJSON(t).uuid),this.clearcoatNormalMap&&this.clearcoatNormalMap.isTexture&&(n.clearcoatNormalMap=this.clearcoatNormalMap.toJSON(t).uuid,n.clearcoatNormalScale=this.clearcoatNormalScale.toArray()),this.dispersion!==void 0&&(n.dispersion=this.dispersion),this.iridescence!==void 0&&(n.iridescence=this.iridescence),this.iridescenceIOR!==void 0&&(n.iridescenceIOR=this.iridescenceIOR),this.iridescenceThicknessRange!==void 0&&(n.iridescenceThicknessRange=this.iridescenceThicknessRange),this.iridescenceMap&&this.iridescenceMap.isTexture&&(n.iridescenceMap=this.iridescenceMap.toJSON(t).uuid),this.iridescenceThicknessMap&&this.iridescenceThicknessMap.isTexture&&(n.iridescenceThicknessMap=this.iridescenceThicknessMap.toJSON(t).uuid),this.anisotropy!==void 0&&(n.anisotropy=this.anisotropy),this.anisotropyRotation!==void 0&&(n.anisotropyRotation=this.anisotropyRotation),this.anisotropyMap&&this.anisotropyMap.isTexture&&(n.anisotropyMap=this.anisotropyMap.toJSON(t).uuid),this.map&&this.map.isTexture&&(n.map=this.map.toJSON(t).uuid),this.matcap&&this.matcap.isTexture&&(n.matcap=this.matcap.toJSON(t).uuid),this.alphaMap&&this.alphaMap.isTexture&&(n.alphaMap=this.alphaMap.toJSON(t).uuid),this.lightMap&&this.lightMap.isTexture&&(n.lightMap=this.lightMap.toJSON(t).uuid,n.lightMapIntensity=this.lightMapIntensity),this.aoMap&&this.aoMap.isTexture&&(n.aoMap=this.aoMap.toJSON(t).uuid,n.aoMapIntensity=this.aoMapIntensity),this.bumpMap&&this.bumpMap.isTexture&&(n.bumpMap=this.bumpMap.toJSON(t).uuid,n.bumpScale=this.bumpScale),this.normalMap&&this.normalMap.isTexture&&(n.normalMap=this.normalMap.toJSON(t).uuid,n.normalMapType=this.normalMapType,n.normalScale=this.normalScale.toArray()),this.displacementMap&&this.displacementMap.isTexture&&(n.displacementMap=this.displacementMap.toJSON(t).uuid,n.displacementScale=this.displacementScale,n.displacementBias=this.displacementBias),this.roughnessMap&&this.roughnessMap.isTexture&&(n.roughnessMap=this.roughnessMap.toJSON(t).uuid),this.metalnessMap&&this.metalnessMap.isTexture&&(n.metalnessMap=this.metalnessMap.toJSON(t).uuid),this.emissiveMap&&this.emissiveMap.isTexture&&(n.emissiveMap=this.emissiveMap.toJSON(t).uuid),this.specularMap&&this.specularMap.isTexture&&(n.specularMap=this.specularMap.toJSON(t).uuid),this.specularIntensityMap&&this.specularIntensityMap.isTexture&&(n.specularIntensityMap=this.specularIntensityMap.toJSON(t).uuid),this.specularColorMap&&this.specularColorMap.isTexture&&(n.specularColorMap=this.specularColorMap.toJSON(t).uuid),this.envMap&&this.envMap.isTexture&&(n.envMap=this.envMap.toJSON(t).uuid,this.combine!==void 0&&(n.combine=this.combine)),this.envMapRotation!==void 0&&(n.envMapRotation=this.envMapRotation.toArray()),this.envMapIntensity!==void 0&&(n.envMapIntensity=this.envMapIntensity),this.reflectivity!==void 0&&(n.reflectivity=this.reflectivity),this.refractionRatio!==void 0&&(n.refractionRatio=this.refractionRatio),this.gradientMap&&this.gradientMap.isTexture&&(n.gradientMap=this.gradientMap.toJSON(t).uuid),this.transmission!==void 0&&(n.transmission=this.transmission),this.transmissionMap&&this.transmissionMap.isTexture&&(n.transmissionMap=this.transmissionMap.toJSON(t).uuid),this.thickness!==void 0&&(n.thickness=this.thickness),this.thicknessMap&&this.thicknessMap.isTexture&&(n.thicknessMap=this.thicknessMap.toJSON(t).uuid),this.attenuationDistance!==void 0&&this.attenuationDistance!==1/0&&(n.attenuationDistance=this.attenuationDistance),this.attenuationColor!==void 0&&(n.attenuationColor=this.attenuationColor.getHex()),this.size!==void 0&&(n.size=this.size),this.shadowSide!==null&&(n.shadowSide=this.shadowSide),this.sizeAttenuation!==void 0&&(n.sizeAttenuation=this.sizeAttenuation),this.blending!==vr&&(n.blending=this.blending),this.side!==ss&&(n.side=this.side),this.vertexColors===!0&&(n.vertexColors=!0),this.opacity<1&&(n.opacity=this.opacity),this.transparent===!0&&(n.transparent=!0),this.blendSrc!==Cc&&(n.blendSrc=this.blendSrc),this.blendDst!==Rc&&(n.blendDst=this.blendDst),this.blendEquation!==ws&&(n.blendEquation=this.blendEquation),this.blendSrcAlpha!==null&&(n.blendSrcAlpha=this.blendSrcAlpha),this.blendDstAlpha!==null&&(n.blendDstAlpha=this.blendDstAlpha),this.blendEquationAlpha!==null&&(n.blendEquationAlpha=this.blendEquationAlpha),this.blendColor&&this.blendColor.isColor&&(n.blendColor=this.blendColor.getHex()),this.blendAlpha!==0&&(n.blendAlpha=this.blendAlpha),this.depthFunc!==Ea&&(n.depthFunc=this.depthFunc),this.depthTest===!1&&(n.depthTest=this.depthTest),this.depthWrite===!1&&(n.depthWrite=this.depthWrite),this.colorWrite===!1&&(n.colorWrite=this.colorWrite),this.stencilWriteMask!==255&&(n.stencilWriteMask=this.stencilWriteMask),this.stencilFunc!==xd&&(n.stencilFunc=this.stencilFunc),this.stencilRef!==0&&(n.stencilRef=this.stencilRef),this.stencilFuncMask!==255&&(n.stencilFuncMask=this.stencilFuncMask),this.stencilFail!==js&&(n.stencilFail=this.stencilFail),this.stencilZFail!==js&&(n.stencilZFail=this.stencilZFail),this.stencilZPass!==js&&(n.stencilZPass=this.stencilZPass),this.stencilWrite===!0&&(n.stencilWrite=this.stencilWrite),this.rotation!==void 0&&this.rotation!==0&&(n.rotation=this.rotation),this.polygonOffset===!0&&(n.polygonOffset=!0),this.polygonOffsetFactor!==0&&(n.polygonOffsetFactor=this.polygonOffsetFactor),this.polygonOffsetUnits!==0&&(n.polygonOffsetUnits=this.polygonOffsetUnits),this.linewidth!==void 0&&this.linewidth!==1&&(n.linewidth=this.linewidth),this.dashSize!==void 0&&(n.dashSize=this.dashSize),this.gapSize!==void 0&&(n.gapSize=this.gapSize),this.scale!==void 0&&(n.scale=this.scale),this.dithering===!0&&(n.dithering=!0),this.alphaTest>0&&(n.alphaTest=this.alphaTest),this.alphaHash===!0&&(n.alphaHash=!0),this.alphaToCoverage===!0&&(n.alphaToCoverage=!0),this.premultipliedAlpha===!0&&(n.premultipliedAlpha=!0),this.forceSinglePass===!0&&(n.forceSinglePass=!0),this.wireframe===!0&&(n.wireframe=!0),this.wireframeLinewidth>1&&(n.wireframeLinewidth=this.wireframeLinewidth),this.wireframeLinecap!=="round"&&(n.wireframeLinecap=this.wireframeLinecap),this.wireframeLinejoin!=="round"&&(n.wireframeLinejoin=this.wireframeLinejoin),this.flatShading===!0&&(n.flatShading=!0),this.visible===!1&&(n.visible=!1),this.toneMapped===!1&&(n.toneMapped=!1),this.fog===!1&&(n.fog=!1),Object.keys(this.userData).length>0&&(n.userData=this.userData);function s(r){let o=[];for(let a in r){let l=r[a];delete l.metadata,o.push(l)}return o}if(e){let r=s(t.textures),o=s(t.images);r.length>0&&(n.textures=r),o.length>0&&(n.images=o)}return n}clone(){return new this.constructor().copy(this)}copy(t){this.name=t.name,this.blending=t.blending,this.side=t.side,this.vertexColors=t.vertexColors,this.opacity=t.opacity,this.transparent=t.transparent,this.blendSrc=t.blendSrc,this.blendDst=t.blendDst,this.blendEquation=t.blendEquation,this.blendSrcAlpha=t.blendSrcAlpha,this.blendDstAlpha=t.blendDstAlpha,this.blendEquationAlpha=t.blendEquationAlpha,this.blendColor.copy(t.blendColor),this.blendAlpha=t.blendAlpha,this.depthFunc=t.depthFunc,this.depthTest=t.depthTest,this.depthWrite=t.depthWrite,this.stencilWriteMask=t.stencilWriteMask,this.stencilFunc=t.stencilFunc,this.stencilRef=t.stencilRef,this.stencilFuncMask=t.stencilFuncMask,this.stencilFail=t.stencilFail,this.stencilZFail=t.stencilZFail,this.stencilZPass=t.stencilZPass,this.stencilWrite=t.stencilWrite;let e=t.clippingPlanes,n=null;if(e!==null){let s=e.length;n=new Array(s);for(let r=0;r!==s;++r)n[r]=e[r].clone()}return this.clippingPlanes=n,this.clipIntersection=t.clipIntersection,this.clipShadows=t.clipShadows,this.shadowSide=t.shadowSide,this.colorWrite=t.colorWrite,this.precision=t.precision,this.polygonOffset=t.polygonOffset,this.polygonOffsetFactor=t.polygonOffsetFactor,this.polygonOffsetUnits=t.polygonOffsetUnits,this.dithering=t.dithering,this.alphaTest=t.alphaTest,this.alphaHash=t.alphaHash,this.alphaToCoverage=t.alphaToCoverage,this.premultipliedAlpha=t.premultipliedAlpha,this.forceSinglePass=t.forceSinglePass,this.visible=t.visible,this.toneMapped=t.toneMapped,this.userData=JSON.parse(JSON.stringify(t.userData)),this}dispose(){this.dispatchEvent({type:"dispose"})}set needsUpdate(t){t===!0&&this.version++}},Cr=class extends os{constructor(t){super(),this.isMeshBasicMaterial=!0,this.type="MeshBasicMaterial",this.color=new ce(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new Kn,this.combine=dh,this.reflectivity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.lightMap=t.lightMap,this.lightMapIntensity=t.lightMapIntensity,this.aoMap=t.aoMap,this.aoMapIntensity=t.aoMapIntensity,this.specularMap=t.specularMap,this.alphaMap=t.alphaMap,this.envMap=t.envMap,this.envMapRotation.copy(t.envMapRotation),this.combine=t.combine,this.reflectivity=t.reflectivity,this.refractionRatio=t.refractionRatio,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.wireframeLinecap=t.wireframeLinecap,this.wireframeLinejoin=t.wireframeLinejoin,this.fog=t.fog,this}};var Ye=new V,ca=new Jt,Vn=class{constructor(t,e,n=!1){if(Array.isArray(t))throw new TypeError("THREE.BufferAttribute: array should be a Typed Array.");this.isBufferAttribute=!0,this.name="",this.array=t,this.itemSize=e,this.count=t!==void 0?t.length/e:0,this.normalized=n,this.usage=Md,this._updateRange={offset:0,count:-1},this.updateRanges=[],this.gpuType=Oi,this.version=0}onUploadCallback(){}set needsUpdate(t){t===!0&&this.version++}get updateRange(){return If("THREE.BufferAttribute: updateRange() is deprecated and will be removed in r169. Use addUpdateRange() instead."),this._updateRange}setUsage(t){return this.usage=t,this}addUpdateRange(t,e){this.updateRanges.push({start:t,count:e})}clearUpdateRanges(){this.updateRanges.length=0}copy(t){return this.name=t.name,this.array=new t.array.constructor(t.array),this.itemSize=t.itemSize,this.count=t.count,this.normalized=t.normalized,this.usage=t.usage,this.gpuType=t.gpuType,this}copyAt(t,e,n){t*=this.itemSize,n*=e.itemSize;for(let s=0,r=this.itemSize;s<r;s++)this.array[t+s]=e.array[n+s];return this}copyArray(t){return this.array.set(t),this}applyMatrix3(t){if(this.itemSize===2)for(let e=0,n=this.count;e<n;e++)ca.fromBufferAttribute(this,e),ca.applyMatrix3(t),this.setXY(e,ca.x,ca.y);else if(this.itemSize===3)for(let e=0,n=this.count;e<n;e++)Ye.fromBufferAttribute(this,e),Ye.applyMatrix3(t),this.setXYZ(e,Ye.x,Ye.y,Ye.z);return this}applyMatrix4(t){for(let e=0,n=this.count;e<n;e++)Ye.fromBufferAttribute(this,e),Ye.applyMatrix4(t),this.setXYZ(e,Ye.x,Ye.y,Ye.z);return this}applyNormalMatrix(t){for(let e=0,n=this.count;e<n;e++)Ye.fromBufferAttribute(this,e),Ye.applyNormalMatrix(t),this.setXYZ(e,Ye.x,Ye.y,Ye.z);return this}transformDirection(t){for(let e=0,n=this.count;e<n;e++)Ye.fromBufferAttribute(this,e),Ye.transformDirection(t),this.setXYZ(e,Ye.x,Ye.y,Ye.z);return this}set(t,e=0){return this.array.set(t,e),this}getComponent(t,e){let n=this.array[t*this.itemSize+e];return this.normalized&&(n=gr(n,this.array)),n}setComponent(t,e,n){return this.normalized&&(n=En(n,this.array)),this.array[t*this.itemSize+e]=n,this}getX(t){let e=this.array[t*this.itemSize];return this.normalized&&(e=gr(e,this.array)),e}setX(t,e){return this.normalized&&(e=En(e,this.array)),this.array[t*this.itemSize]=e,this}getY(t){let e=this.array[t*this.itemSize+1];return this.normalized&&(e=gr(e,this.array)),e}setY(t,e){return this.normalized&&(e=En(e,this.array)),this.array[t*this.itemSize+1]=e,this}getZ(t){let e=this.array[t*this.itemSize+2];return this.normalized&&(e=gr(e,this.array)),e}setZ(t,e){return this.normalized&&(e=En(e,this.array)),this.array[t*this.itemSize+2]=e,this}getW(t){let e=this.array[t*this.itemSize+3];return this.normalized&&(e=gr(e,this.array)),e}setW(t,e){return this.normalized&&(e=En(e,this.array)),this.array[t*this.itemSize+3]=e,this}setXY(t,e,n){return t*=this.itemSize,this.normalized&&(e=En(e,this.array),n=En(n,this.array)),this.array[t+0]=e,this.array[t+1]=n,this}setXYZ(t,e,n,s){return t*=this.itemSize,this.normalized&&(e=En(e,this.array),n=En(n,this.array),s=En(s,this.array)),this.array[t+0]=e,this.array[t+1]=n,this.array[t+2]=s,this}setXYZW(t,e,n,s,r){return t*=this.itemSize,this.normalized&&(e=En(e,this.array),n=En(n,this.array),s=En(s,this.array),r=En(r,this.array)),this.array[t+0]=e,this.array[t+1]=n,this.array[t+2]=s,this.array[t+3]=r,this}onUpload(t){return this.onUploadCallback=t,this}clone(){return new this.constructor(this.array,this.itemSize).copy(this)}toJSON(){let t={itemSize:this.itemSize,type:this.array.constructor.name,array:Array.from(this.array),normalized:this.normalized};return this.name!==""&&(t.name=this.name),this.usage!==Md&&(t.usage=this.usage),t}};var Oa=class extends Vn{constructor(t,e,n){super(new Uint16Array(t),e,n)}};var Fa=class extends Vn{constructor(t,e,n){super(new Uint32Array(t),e,n)}};var en=class extends Vn{constructor(t,e,n){super(new Float32Array(t),e,n)}},J0=0,Yn=new ve,_c=new Je,lr=new V,Bn=new Jn,fo=new Jn,dn=new V,Cn=class extends bi{constructor(){super(),this.isBufferGeometry=!0,Object.defineProperty(this,"id",{value:J0++}),this.uuid=Ur(),this.name="",this.type="BufferGeometry",this.index=null,this.attributes={},this.morphAttributes={},this.morphTargetsRelative=!1,this.groups=[],this.boundingBox=null,this.boundingSphere=null,this.drawRange={start:0,count:1/0},this.userData={}}getIndex(){return this.index}setIndex(t){return Array.isArray(t)?this.index=new(Lf(t)?Fa:Oa)(t,1):this.index=t,this}getAttribute(t){return this.attributes[t]}setAttribute(t,e){return this.attributes[t]=e,this}deleteAttribute(t){return delete this.attributes[t],this}hasAttribute(t){return this.attributes[t]!==void 0}addGroup(t,e,n=0){this.groups.push({start:t,count:e,materialIndex:n})}clearGroups(){this.groups=[]}setDrawRange(t,e){this.drawRange.start=t,this.drawRange.count=e}applyMatrix4(t){let e=this.attributes.position;e!==void 0&&(e.applyMatrix4(t),e.needsUpdate=!0);let n=this.attributes.normal;if(n!==void 0){let r=new ie().getNormalMatrix(t);n.applyNormalMatrix(r),n.needsUpdate=!0}let s=this.attributes.tangent;return s!==void 0&&(s.transformDirection(t),s.needsUpdate=!0),this.boundingBox!==null&&this.computeBoundingBox(),this.boundingSphere!==null&&this.computeBoundingSphere(),this}applyQuaternion(t){return Yn.makeRotationFromQuaternion(t),this.applyMatrix4(Yn),this}rotateX(t){return Yn.makeRotationX(t),this.applyMatrix4(Yn),this}rotateY(t){return Yn.makeRotationY(t),this.applyMatrix4(Yn),this}rotateZ(t){return Yn.makeRotationZ(t),this.applyMatrix4(Yn),this}translate(t,e,n){return Yn.makeTranslation(t,e,n),this.applyMatrix4(Yn),this}scale(t,e,n){return Yn.makeScale(t,e,n),this.applyMatrix4(Yn),this}lookAt(t){return _c.lookAt(t),_c.updateMatrix(),this.applyMatrix4(_c.matrix),this}center(){return this.computeBoundingBox(),this.boundingBox.getCenter(lr).negate(),this.translate(lr.x,lr.y,lr.z),this}setFromPoints(t){let e=[];for(let n=0,s=t.length;n<s;n++){let r=t[n];e.push(r.x,r.y,r.z||0)}return this.setAttribute("position",new en(e,3)),this}computeBoundingBox(){this.boundingBox===null&&(this.boundingBox=new Jn);let t=this.attributes.position,e=this.morphAttributes.position;if(t&&t.isGLBufferAttribute){console.error("THREE.BufferGeometry.computeBoundingBox(): GLBufferAttribute requires a manual bounding box.",this),this.boundingBox.set(new V(-1/0,-1/0,-1/0),new V(1/0,1/0,1/0));return}if(t!==void 0){if(this.boundingBox.setFromBufferAttribute(t),e)for(let n=0,s=e.length;n<s;n++){let r=e[n];Bn.setFromBufferAttribute(r),this.morphTargetsRelative?(dn.addVectors(this.boundingBox.min,Bn.min),this.boundingBox.expandByPoint(dn),dn.addVectors(this.boundingBox.max,Bn.max),this.boundingBox.expandByPoint(dn)):(this.boundingBox.expandByPoint(Bn.min),this.boundingBox.expandByPoint(Bn.max))}}else this.boundingBox.makeEmpty();(isNaN(this.boundingBox.min.x)||isNaN(this.boundingBox.min.y)||isNaN(this.boundingBox.min.z))&&console.error('THREE.BufferGeometry.computeBoundingBox(): Computed min/max have NaN values. The "position" attribute is likely to have NaN values.',this)}computeBoundingSphere(){this.boundingSphere===null&&(this.boundingSphere=new li);let t=this.attributes.position,e=this.morphAttributes.position;if(t&&t.isGLBufferAttribute){console.error("THREE.BufferGeometry.computeBoundingSphere(): GLBufferAttribute requires a manual bounding sphere.",this),this.boundingSphere.set(new V,1/0);return}if(t){let n=this.boundingSphere.center;if(Bn.setFromBufferAttribute(t),e)for(let r=0,o=e.length;r<o;r++){let a=e[r];fo.setFromBufferAttribute(a),this.morphTargetsRelative?(dn.addVectors(Bn.min,fo.min),Bn.expandByPoint(dn),dn.addVectors(Bn.max,fo.max),Bn.expandByPoint(dn)):(Bn.expandByPoint(fo.min),Bn.expandByPoint(fo.max))}Bn.getCenter(n);let s=0;for(let r=0,o=t.count;r<o;r++)dn.fromBufferAttribute(t,r),s=Math.max(s,n.distanceToSquared(dn));if(e)for(let r=0,o=e.length;r<o;r++){let a=e[r],l=this.morphTargetsRelative;for(let c=0,u=a.count;c<u;c++)dn.fromBufferAttribute(a,c),l&&(lr.fromBufferAttribute(t,c),dn.add(lr)),s=Math.max(s,n.distanceToSquared(dn))}this.boundingSphere.radius=Math.sqrt(s),isNaN(this.boundingSphere.radius)&&console.error('THREE.BufferGeometry.computeBoundingSphere(): Computed radius is NaN. The "position" attribute is likely to have NaN values.',this)}}computeTangents(){let t=this.index,e=this.attributes;if(t===null||e.position===void 0||e.normal===void 0||e.uv===void 0){console.error("THREE.BufferGeometry: .computeTangents() failed. Missing required attributes (index, position, normal or uv)");return}let n=e.position,s=e.normal,r=e.uv;this.hasAttribute("tangent")===!1&&this.setAttribute("tangent",new Vn(new Float32Array(4*n.count),4));let o=this.getAttribute("tangent"),a=[],l=[];for(let F=0;F<n.count;F++)a[F]=new V,l[F]=new V;let c=new V,u=new V,d=new V,h=new Jt,p=new Jt,g=new Jt,v=new V,m=new V;function f(F,S,x){c.fromBufferAttribute(n,F),u.fromBufferAttribute(n,S),d.fromBufferAttribute(n,x),h.fromBufferAttribute(r,F),p.fromBufferAttribute(r,S),g.fromBufferAttribute(r,x),u.sub(c),d.sub(c),p.sub(h),g.sub(h);let R=1/(p.x*g.y-g.x*p.y);isFinite(R)&&(v.copy(u).multiplyScalar(g.y).addScaledVector(d,-p.y).multiplyScalar(R),m.copy(d).multiplyScalar(p.x).addScaledVector(u,-g.x).multiplyScalar(R),a[F].add(v),a[S].add(v),a[x].add(v),l[F].add(m),l[S].add(m),l[x].add(m))}let T=this.groups;T.length===0&&(T=[{start:0,count:t.count}]);for(let F=0,S=T.length;F<S;++F){let x=T[F],R=x.start,z=x.count;for(let B=R,X=R+z;B<X;B+=3)f(t.getX(B+0),t.getX(B+1),t.getX(B+2))}let b=new V,A=new V,N=new V,L=new V;function C(F){N.fromBufferAttribute(s,F),L.copy(N);let S=a[F];b.copy(S),b.sub(N.multiplyScalar(N.dot(S))).normalize(),A.crossVectors(L,S);let R=A.dot(l[F])<0?-1:1;o.setXYZW(F,b.x,b.y,b.z,R)}for(let F=0,S=T.length;F<S;++F){let x=T[F],R=x.start,z=x.count;for(let B=R,X=R+z;B<X;B+=3)C(t.getX(B+0)),C(t.getX(B+1)),C(t.getX(B+2))}}computeVertexNormals(){let t=this.index,e=this.getAttribute("position");if(e!==void 0){let n=this.getAttribute("normal");if(n===void 0)n=new Vn(new Float32Array(e.count*3),3),this.setAttribute("normal",n);else for(let h=0,p=n.count;h<p;h++)n.setXYZ(h,0,0,0);let s=new V,r=new V,o=new V,a=new V,l=new V,c=new V,u=new V,d=new V;if(t)for(let h=0,p=t.count;h<p;h+=3){let g=t.getX(h+0),v=t.getX(h+1),m=t.getX(h+2);s.fromBufferAttribute(e,g),r.fromBufferAttribute(e,v),o.fromBufferAttribute(e,m),u.subVectors(o,r),d.subVectors(s,r),u.cross(d),a.fromBufferAttribute(n,g),l.fromBufferAttribute(n,v),c.fromBufferAttribute(n,m),a.add(u),l.add(u),c.add(u),n.setXYZ(g,a.x,a.y,a.z),n.setXYZ(v,l.x,l.y,l.z),n.setXYZ(m,c.x,c.y,c.z)}else for(let h=0,p=e.count;h<p;h+=3)s.fromBufferAttribute(e,h+0),r.fromBufferAttribute(e,h+1),o.fromBufferAttribute(e,h+2),u.subVectors(o,r),d.subVectors(s,r),u.cross(d),n.setXYZ(h+0,u.x,u.y,u.z),n.setXYZ(h+1,u.x,u.y,u.z),n.setXYZ(h+2,u.x,u.y,u.z);this.normalizeNormals(),n.needsUpdate=!0}}normalizeNormals(){let t=this.attributes.normal;for(let e=0,n=t.count;e<n;e++)dn.fromBufferAttribute(t,e),dn.normalize(),t.setXYZ(e,dn.x,dn.y,dn.z)}toNonIndexed(){function t(a,l){let c=a.array,u=a.itemSize,d=a.normalized,h=new c.constructor(l.length*u),p=0,g=0;for(let v=0,m=l.length;v<m;v++){a.isInterleavedBufferAttribute?p=l[v]*a.data.stride+a.offset:p=l[v]*u;for(let f=0;f<u;f++)h[g++]=c[p++]}return new Vn(h,u,d)}if(this.index===null)return console.warn("THREE.BufferGeometry.toNonIndexed(): BufferGeometry is already non-indexed."),this;let e=new Cn,n=this.index.array,s=this.attributes;for(let a in s){let l=s[a],c=t(l,n);e.setAttribute(a,c)}let r=this.morphAttributes;for(let a in r){let l=[],c=r[a];for(let u=0,d=c.length;u<d;u++){let h=c[u],p=t(h,n);l.push(p)}e.morphAttributes[a]=l}e.morphTargetsRelative=this.morphTargetsRelative;let o=this.groups;for(let a=0,l=o.length;a<l;a++){let c=o[a];e.addGroup(c.start,c.count,c.materialIndex)}return e}toJSON(){let t={metadata:{version:4.6,type:"BufferGeometry",generator:"BufferGeometry.toJSON"}};if(t.uuid=this.uuid,t.type=this.type,this.name!==""&&(t.name=this.name),Object.keys(this.userData).length>0&&(t.userData=this.userData),this.parameters!==void 0){let l=this.parameters;for(let c in l)l[c]!==void 0&&(t[c]=l[c]);return t}t.data={attributes:{}};let e=this.index;e!==null&&(t.data.index={type:e.array.constructor.name,array:Array.prototype.slice.call(e.array)});let n=this.attributes;for(let l in n){let c=n[l];t.data.attributes[l]=c.toJSON(t.data)}let s={},r=!1;for(let l in this.morphAttributes){let c=this.morphAttributes[l],u=[];for(let d=0,h=c.length;d<h;d++){let p=c[d];u.push(p.toJSON(t.data))}u.length>0&&(s[l]=u,r=!0)}r&&(t.data.morphAttributes=s,t.data.morphTargetsRelative=this.morphTargetsRelative);let o=this.groups;o.length>0&&(t.data.groups=JSON.parse(JSON.stringify(o)));let a=this.boundingSphere;return a!==null&&(t.data.boundingSphere={center:a.center.toArray(),radius:a.radius}),t}clone(){return new this.constructor().copy(this)}copy(t){this.index=null,this.attributes={},this.morphAttributes={},this.groups=[],this.boundingBox=null,this.boundingSphere=null;let e={};this.name=t.name;let n=t.index;n!==null&&this.setIndex(n.clone(e));let s=t.attributes;for(let c in s){let u=s[c];this.setAttribute(c,u.clone(e))}let r=t.morphAttributes;for(let c in r){let u=[],d=r[c];for(let h=0,p=d.length;h<p;h++)u.push(d[h].clone(e));this.morphAttributes[c]=u}this.morphTargetsRelative=t.morphTargetsRelative;let o=t.groups;for(let c=0,u=o.length;c<u;c++){let d=o[c];this.addGroup(d.start,d.count,d.materialIndex)}let a=t.boundingBox;a!==null&&(this.boundingBox=a.clone());let l=t.boundingSphere;return l!==null&&(this.boundingSphere=l.clone()),this.drawRange.start=t.drawRange.start,this.drawRange.count=t.drawRange.count,this.userData=t.userData,this}dispose(){this.dispatchEvent({type:"dispose"})}},Od=new ve,vs=new Ar,ha=new li,Fd=new V,cr=new V,hr=new V,ur=new V,vc=new V,ua=new V,da=new Jt,fa=new Jt,pa=new Jt,kd=new V,Bd=new V,zd=new V,ma=new V,ga=new V,zn=class extends Je{constructor(t=new Cn,e=new Cr){super(),this.isMesh=!0,this.type="Mesh",this.geometry=t,this.material=e,this.updateMorphTargets()}copy(t,e){return super.copy(t,e),t.morphTargetInfluences!==void 0&&(this.morphTargetInfluences=t.morphTargetInfluences.slice()),t.morphTargetDictionary!==void 0&&(this.morphTargetDictionary=Object.assign({},t.morphTargetDictionary)),this.material=Array.isArray(t.material)?t.material.slice():t.material,this.geometry=t.geometry,this}updateMorphTargets(){let e=this.geometry.morphAttributes,n=Object.keys(e);if(n.length>0){let s=e[n[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}getVertexPosition(t,e){let n=this.geometry,s=n.attributes.position,r=n.morphAttributes.position,o=n.morphTargetsRelative;e.fromBufferAttribute(s,t);let a=this.morphTargetInfluences;if(r&&a){ua.set(0,0,0);for(let l=0,c=r.length;l<c;l++){let u=a[l],d=r[l];u!==0&&(vc.fromBufferAttribute(d,t),o?ua.addScaledVector(vc,u):ua.addScaledVector(vc.sub(e),u))}e.add(ua)}return e}raycast(t,e){let n=this.geometry,s=this.material,r=this.matrixWorld;s!==void 0&&(n.boundingSphere===null&&n.computeBoundingSphere(),ha.copy(n.boundingSphere),ha.applyMatrix4(r),vs.copy(t.ray).recast(t.near),!(ha.containsPoint(vs.origin)===!1&&(vs.intersectSphere(ha,Fd)===null||vs.origin.distanceToSquared(Fd)>(t.far-t.near)**2))&&(Od.copy(r).invert(),vs.copy(t.ray).applyMatrix4(Od),!(n.boundingBox!==null&&vs.intersectsBox(n.boundingBox)===!1)&&this._computeIntersections(t,e,vs)))}_computeIntersections(t,e,n){let s,r=this.geometry,o=this.material,a=r.index,l=r.attributes.position,c=r.attributes.uv,u=r.attributes.uv1,d=r.attributes.normal,h=r.groups,p=r.drawRange;if(a!==null)if(Array.isArray(o))for(let g=0,v=h.length;g<v;g++){let m=h[g],f=o[m.materialIndex],T=Math.max(m.start,p.start),b=Math.min(a.count,Math.min(m.start+m.count,p.start+p.count));for(let A=T,N=b;A<N;A+=3){let L=a.getX(A),C=a.getX(A+1),F=a.getX(A+2);s=_a(this,f,t,n,c,u,d,L,C,F),s&&(s.faceIndex=Math.floor(A/3),s.face.materialIndex=m.materialIndex,e.push(s))}}else{let g=Math.max(0,p.start),v=Math.min(a.count,p.start+p.count);for(let m=g,f=v;m<f;m+=3){let T=a.getX(m),b=a.getX(m+1),A=a.getX(m+2);s=_a(this,o,t,n,c,u,d,T,b,A),s&&(s.faceIndex=Math.floor(m/3),e.push(s))}}else if(l!==void 0)if(Array.isArray(o))for(let g=0,v=h.length;g<v;g++){let m=h[g],f=o[m.materialIndex],T=Math.max(m.start,p.start),b=Math.min(l.count,Math.min(m.start+m.count,p.start+p.count));for(let A=T,N=b;A<N;A+=3){let L=A,C=A+1,F=A+2;s=_a(this,f,t,n,c,u,d,L,C,F),s&&(s.faceIndex=Math.floor(A/3),s.face.materialIndex=m.materialIndex,e.push(s))}}else{let g=Math.max(0,p.start),v=Math.min(l.count,p.start+p.count);for(let m=g,f=v;m<f;m+=3){let T=m,b=m+1,A=m+2;s=_a(this,o,t,n,c,u,d,T,b,A),s&&(s.faceIndex=Math.floor(m/3),e.push(s))}}}};function K0(i,t,e,n,s,r,o,a){let l;if(t.side===Un?l=n.intersectTriangle(o,r,s,!0,a):l=n.intersectTriangle(s,r,o,t.side===ss,a),l===null)return null;ga.copy(a),ga.applyMatrix4(i.matrixWorld);let c=e.ray.origin.distanceTo(ga);return c<e.near||c>e.far?null:{distance:c,point:ga.clone(),object:i}}function _a(i,t,e,n,s,r,o,a,l,c){i.getVertexPosition(a,cr),i.getVertexPosition(l,hr),i.getVertexPosition(c,ur);let u=K0(i,t,e,n,cr,hr,ur,ma);if(u){s&&(da.fromBufferAttribute(s,a),fa.fromBufferAttribute(s,l),pa.fromBufferAttribute(s,c),u.uv=Zn.getInterpolation(ma,cr,hr,ur,da,fa,pa,new Jt)),r&&(da.fromBufferAttribute(r,a),fa.fromBufferAttribute(r,l),pa.fromBufferAttribute(r,c),u.uv1=Zn.getInterpolation(ma,cr,hr,ur,da,fa,pa,new Jt)),o&&(kd.fromBufferAttribute(o,a),Bd.fromBufferAttribute(o,l),zd.fromBufferAttribute(o,c),u.normal=Zn.getInterpolation(ma,cr,hr,ur,kd,Bd,zd,new V),u.normal.dot(n.direction)>0&&u.normal.multiplyScalar(-1));let d={a,b:l,c,normal:new V,materialIndex:0};Zn.getNormal(cr,hr,ur,d.normal),u.face=d}return u}var As=class extends Cn{constructor(t=1,e=1,n=1,s=1,r=1,o=1){super(),this.type="BoxGeometry",this.parameters={width:t,height:e,depth:n,widthSegments:s,heightSegments:r,depthSegments:o};let a=this;s=Math.floor(s),r=Math.floor(r),o=Math.floor(o);let l=[],c=[],u=[],d=[],h=0,p=0;g("z","y","x",-1,-1,n,e,t,o,r,0),g("z","y","x",1,-1,n,e,-t,o,r,1),g("x","z","y",1,1,t,n,e,s,o,2),g("x","z","y",1,-1,t,n,-e,s,o,3),g("x","y","z",1,-1,t,e,n,s,r,4),g("x","y","z",-1,-1,t,e,-n,s,r,5),this.setIndex(l),this.setAttribute("position",new en(c,3)),this.setAttribute("normal",new en(u,3)),this.setAttribute("uv",new en(d,2));function g(v,m,f,T,b,A,N,L,C,F,S){let x=A/C,R=N/F,z=A/2,B=N/2,X=L/2,J=C+1,q=F+1,st=0,nt=0,gt=new V;for(let dt=0;dt<q;dt++){let pt=dt*R-B;for(let mt=0;mt<J;mt++){let kt=mt*x-z;gt[v]=kt*T,gt[m]=pt*b,gt[f]=X,c.push(gt.x,gt.y,gt.z),gt[v]=0,gt[m]=0,gt[f]=L>0?1:-1,u.push(gt.x,gt.y,gt.z),d.push(mt/C),d.push(1-dt/F),st+=1}}for(let dt=0;dt<F;dt++)for(let pt=0;pt<C;pt++){let mt=h+pt+J*dt,kt=h+pt+J*(dt+1),Q=h+(pt+1)+J*(dt+1),ct=h+(pt+1)+J*dt;l.push(mt,kt,ct),l.push(kt,Q,ct),nt+=6}a.addGroup(p,nt,S),p+=nt,h+=st}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new As(t.width,t.height,t.depth,t.widthSegments,t.heightSegments,t.depthSegments)}};function Rr(i){let t={};for(let e in i){t[e]={};for(let n in i[e]){let s=i[e][n];s&&(s.isColor||s.isMatrix3||s.isMatrix4||s.isVector2||s.isVector3||s.isVector4||s.isTexture||s.isQuaternion)?s.isRenderTargetTexture?(console.warn("UniformsUtils: Textures of render targets cannot be cloned via cloneUniforms() or mergeUniforms()."),t[e][n]=null):t[e][n]=s.clone():Array.isArray(s)?t[e][n]=s.slice():t[e][n]=s}}return t}function Tn(i){let t={};for(let e=0;e<i.length;e++){let n=Rr(i[e]);for(let s in n)t[s]=n[s]}return t}function j0(i){let t=[];for(let e=0;e<i.length;e++)t.push(i[e].clone());return t}function Nf(i){let t=i.getRenderTarget();return t===null?i.outputColorSpace:t.isXRRenderTarget===!0?t.texture.colorSpace:we.workingColorSpace}var Q0={clone:Rr,merge:Tn},t_=`void main() {
	gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
}`,e_=`void main() {
	gl_FragColor = vec4( 1.0, 0.0, 0.0, 1.0 );
}`,wi=class extends os{constructor(t){super(),this.isShaderMaterial=!0,this.type="ShaderMaterial",this.defines={},this.uniforms={},this.uniformsGroups=[],this.vertexShader=t_,this.fragmentShader=e_,this.linewidth=1,this.wireframe=!1,this.wireframeLinewidth=1,this.fog=!1,this.lights=!1,this.clipping=!1,this.forceSinglePass=!0,this.extensions={clipCullDistance:!1,multiDraw:!1},this.defaultAttributeValues={color:[1,1,1],uv:[0,0],uv1:[0,0]},this.index0AttributeName=void 0,this.uniformsNeedUpdate=!1,this.glslVersion=null,t!==void 0&&this.setValues(t)}copy(t){return super.copy(t),this.fragmentShader=t.fragmentShader,this.vertexShader=t.vertexShader,this.uniforms=Rr(t.uniforms),this.uniformsGroups=j0(t.uniformsGroups),this.defines=Object.assign({},t.defines),this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.fog=t.fog,this.lights=t.lights,this.clipping=t.clipping,this.extensions=Object.assign({},t.extensions),this.glslVersion=t.glslVersion,this}toJSON(t){let e=super.toJSON(t);e.glslVersion=this.glslVersion,e.uniforms={};for(let s in this.uniforms){let o=this.uniforms[s].value;o&&o.isTexture?e.uniforms[s]={type:"t",value:o.toJSON(t).uuid}:o&&o.isColor?e.uniforms[s]={type:"c",value:o.getHex()}:o&&o.isVector2?e.uniforms[s]={type:"v2",value:o.toArray()}:o&&o.isVector3?e.uniforms[s]={type:"v3",value:o.toArray()}:o&&o.isVector4?e.uniforms[s]={type:"v4",value:o.toArray()}:o&&o.isMatrix3?e.uniforms[s]={type:"m3",value:o.toArray()}:o&&o.isMatrix4?e.uniforms[s]={type:"m4",value:o.toArray()}:e.uniforms[s]={value:o}}Object.keys(this.defines).length>0&&(e.defines=this.defines),e.vertexShader=this.vertexShader,e.fragmentShader=this.fragmentShader,e.lights=this.lights,e.clipping=this.clipping;let n={};for(let s in this.extensions)this.extensions[s]===!0&&(n[s]=!0);return Object.keys(n).length>0&&(e.extensions=n),e}},ka=class extends Je{constructor(){super(),this.isCamera=!0,this.type="Camera",this.matrixWorldInverse=new ve,this.projectionMatrix=new ve,this.projectionMatrixInverse=new ve,this.coordinateSystem=Fi}copy(t,e){return super.copy(t,e),this.matrixWorldInverse.copy(t.matrixWorldInverse),this.projectionMatrix.copy(t.projectionMatrix),this.projectionMatrixInverse.copy(t.projectionMatrixInverse),this.coordinateSystem=t.coordinateSystem,this}getWorldDirection(t){return super.getWorldDirection(t).negate()}updateMatrixWorld(t){super.updateMatrixWorld(t),this.matrixWorldInverse.copy(this.matrixWorld).invert()}updateWorldMatrix(t,e){super.updateWorldMatrix(t,e),this.matrixWorldInverse.copy(this.matrixWorld).invert()}clone(){return new this.constructor().copy(this)}},ts=new V,Vd=new Jt,Hd=new Jt,An=class extends ka{constructor(t=50,e=1,n=.1,s=2e3){super(),this.isPerspectiveCamera=!0,this.type="PerspectiveCamera",this.fov=t,this.zoom=1,this.near=n,this.far=s,this.focus=10,this.aspect=e,this.view=null,this.filmGauge=35,this.filmOffset=0,this.updateProjectionMatrix()}copy(t,e){return super.copy(t,e),this.fov=t.fov,this.zoom=t.zoom,this.near=t.near,this.far=t.far,this.focus=t.focus,this.aspect=t.aspect,this.view=t.view===null?null:Object.assign({},t.view),this.filmGauge=t.filmGauge,this.filmOffset=t.filmOffset,this}setFocalLength(t){let e=.5*this.getFilmHeight()/t;this.fov=Mo*2*Math.atan(e),this.updateProjectionMatrix()}getFocalLength(){let t=Math.tan(vo*.5*this.fov);return .5*this.getFilmHeight()/t}getEffectiveFOV(){return Mo*2*Math.atan(Math.tan(vo*.5*this.fov)/this.zoom)}getFilmWidth(){return this.filmGauge*Math.min(this.aspect,1)}getFilmHeight(){return this.filmGauge/Math.max(this.aspect,1)}getViewBounds(t,e,n){ts.set(-1,-1,.5).applyMatrix4(this.projectionMatrixInverse),e.set(ts.x,ts.y).multiplyScalar(-t/ts.z),ts.set(1,1,.5).applyMatrix4(this.projectionMatrixInverse),n.set(ts.x,ts.y).multiplyScalar(-t/ts.z)}getViewSize(t,e){return this.getViewBounds(t,Vd,Hd),e.subVectors(Hd,Vd)}setViewOffset(t,e,n,s,r,o){this.aspect=t/e,this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=t,this.view.fullHeight=e,this.view.offsetX=n,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let t=this.near,e=t*Math.tan(vo*.5*this.fov)/this.zoom,n=2*e,s=this.aspect*n,r=-.5*s,o=this.view;if(this.view!==null&&this.view.enabled){let l=o.fullWidth,c=o.fullHeight;r+=o.offsetX*s/l,e-=o.offsetY*n/c,s*=o.width/l,n*=o.height/c}let a=this.filmOffset;a!==0&&(r+=t*a/this.getFilmWidth()),this.projectionMatrix.makePerspective(r,r+s,e,e-n,t,this.far,this.coordinateSystem),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(t){let e=super.toJSON(t);return e.object.fov=this.fov,e.object.zoom=this.zoom,e.object.near=this.near,e.object.far=this.far,e.object.focus=this.focus,e.object.aspect=this.aspect,this.view!==null&&(e.object.view=Object.assign({},this.view)),e.object.filmGauge=this.filmGauge,e.object.filmOffset=this.filmOffset,e}},dr=-90,fr=1,kc=class extends Je{constructor(t,e,n){super(),this.type="CubeCamera",this.renderTarget=n,this.coordinateSystem=null,this.activeMipmapLevel=0;let s=new An(dr,fr,t,e);s.layers=this.layers,this.add(s);let r=new An(dr,fr,t,e);r.layers=this.layers,this.add(r);let o=new An(dr,fr,t,e);o.layers=this.layers,this.add(o);let a=new An(dr,fr,t,e);a.layers=this.layers,this.add(a);let l=new An(dr,fr,t,e);l.layers=this.layers,this.add(l);let c=new An(dr,fr,t,e);c.layers=this.layers,this.add(c)}updateCoordinateSystem(){let t=this.coordinateSystem,e=this.children.concat(),[n,s,r,o,a,l]=e;for(let c of e)this.remove(c);if(t===Fi)n.up.set(0,1,0),n.lookAt(1,0,0),s.up.set(0,1,0),s.lookAt(-1,0,0),r.up.set(0,0,-1),r.lookAt(0,1,0),o.up.set(0,0,1),o.lookAt(0,-1,0),a.up.set(0,1,0),a.lookAt(0,0,1),l.up.set(0,1,0),l.lookAt(0,0,-1);else if(t===La)n.up.set(0,-1,0),n.lookAt(-1,0,0),s.up.set(0,-1,0),s.lookAt(1,0,0),r.up.set(0,0,1),r.lookAt(0,1,0),o.up.set(0,0,-1),o.lookAt(0,-1,0),a.up.set(0,-1,0),a.lookAt(0,0,1),l.up.set(0,-1,0),l.lookAt(0,0,-1);else throw new Error("THREE.CubeCamera.updateCoordinateSystem(): Invalid coordinate system: "+t);for(let c of e)this.add(c),c.updateMatrixWorld()}update(t,e){this.parent===null&&this.updateMatrixWorld();let{renderTarget:n,activeMipmapLevel:s}=this;this.coordinateSystem!==t.coordinateSystem&&(this.coordinateSystem=t.coordinateSystem,this.updateCoordinateSystem());let[r,o,a,l,c,u]=this.children,d=t.getRenderTarget(),h=t.getActiveCubeFace(),p=t.getActiveMipmapLevel(),g=t.xr.enabled;t.xr.enabled=!1;let v=n.texture.generateMipmaps;n.texture.generateMipmaps=!1,t.setRenderTarget(n,0,s),t.render(e,r),t.setRenderTarget(n,1,s),t.render(e,o),t.setRenderTarget(n,2,s),t.render(e,a),t.setRenderTarget(n,3,s),t.render(e,l),t.setRenderTarget(n,4,s),t.render(e,c),n.texture.generateMipmaps=v,t.setRenderTarget(n,5,s),t.render(e,u),t.setRenderTarget(d,h,p),t.xr.enabled=g,n.texture.needsPMREMUpdate=!0}},Ba=class extends mn{constructor(t,e,n,s,r,o,a,l,c,u){t=t!==void 0?t:[],e=e!==void 0?e:br,super(t,e,n,s,r,o,a,l,c,u),this.isCubeTexture=!0,this.flipY=!1}get images(){return this.image}set images(t){this.image=t}},Bc=class extends ki{constructor(t=1,e={}){super(t,t,e),this.isWebGLCubeRenderTarget=!0;let n={width:t,height:t,depth:1},s=[n,n,n,n,n,n];this.texture=new Ba(s,e.mapping,e.wrapS,e.wrapT,e.magFilter,e.minFilter,e.format,e.type,e.anisotropy,e.colorSpace),this.texture.isRenderTargetTexture=!0,this.texture.generateMipmaps=e.generateMipmaps!==void 0?e.generateMipmaps:!1,this.texture.minFilter=e.minFilter!==void 0?e.minFilter:ai}fromEquirectangularTexture(t,e){this.texture.type=e.type,this.texture.colorSpace=e.colorSpace,this.texture.generateMipmaps=e.generateMipmaps,this.texture.minFilter=e.minFilter,this.texture.magFilter=e.magFilter;let n={uniforms:{tEquirect:{value:null}},vertexShader:`

				varying vec3 vWorldDirection;

				vec3 transformDirection( in vec3 dir, in mat4 matrix ) {

					return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );

				}

				void main() {

					vWorldDirection = transformDirection( position, modelMatrix );

					#include <begin_vertex>
					#include <project_vertex>

				}
			`,fragmentShader:`

				uniform sampler2D tEquirect;

				varying vec3 vWorldDirection;

				#include <common>

				void main() {

					vec3 direction = normalize( vWorldDirection );

					vec2 sampleUV = equirectUv( direction );

					gl_FragColor = texture2D( tEquirect, sampleUV );

				}
			`},s=new As(5,5,5),r=new wi({name:"CubemapFromEquirect",uniforms:Rr(n.uniforms),vertexShader:n.vertexShader,fragmentShader:n.fragmentShader,side:Un,blending:ns});r.uniforms.tEquirect.value=e;let o=new zn(s,r),a=e.minFilter;return e.minFilter===Ts&&(e.minFilter=ai),new kc(1,10,this).update(t,o),e.minFilter=a,o.geometry.dispose(),o.material.dispose(),this}clear(t,e,n,s){let r=t.getRenderTarget();for(let o=0;o<6;o++)t.setRenderTarget(this,o),t.clear(e,n,s);t.setRenderTarget(r)}},yc=new V,n_=new V,i_=new ie,oi=class{constructor(t=new V(1,0,0),e=0){this.isPlane=!0,this.normal=t,this.constant=e}set(t,e){return this.normal.copy(t),this.constant=e,this}setComponents(t,e,n,s){return this.normal.set(t,e,n),this.constant=s,this}setFromNormalAndCoplanarPoint(t,e){return this.normal.copy(t),this.constant=-e.dot(this.normal),this}setFromCoplanarPoints(t,e,n){let s=yc.subVectors(n,e).cross(n_.subVectors(t,e)).normalize();return this.setFromNormalAndCoplanarPoint(s,t),this}copy(t){return this.normal.copy(t.normal),this.constant=t.constant,this}normalize(){let t=1/this.normal.length();return this.normal.multiplyScalar(t),this.constant*=t,this}negate(){return this.constant*=-1,this.normal.negate(),this}distanceToPoint(t){return this.normal.dot(t)+this.constant}distanceToSphere(t){return this.distanceToPoint(t.center)-t.radius}projectPoint(t,e){return e.copy(t).addScaledVector(this.normal,-this.distanceToPoint(t))}intersectLine(t,e){let n=t.delta(yc),s=this.normal.dot(n);if(s===0)return this.distanceToPoint(t.start)===0?e.copy(t.start):null;let r=-(t.start.dot(this.normal)+this.constant)/s;return r<0||r>1?null:e.copy(t.start).addScaledVector(n,r)}intersectsLine(t){let e=this.distanceToPoint(t.start),n=this.distanceToPoint(t.end);return e<0&&n>0||n<0&&e>0}intersectsBox(t){return t.intersectsPlane(this)}intersectsSphere(t){return t.intersectsPlane(this)}coplanarPoint(t){return t.copy(this.normal).multiplyScalar(-this.constant)}applyMatrix4(t,e){let n=e||i_.getNormalMatrix(t),s=this.coplanarPoint(yc).applyMatrix4(t),r=this.normal.applyMatrix3(n).normalize();return this.constant=-s.dot(r),this}translate(t){return this.constant-=t.dot(this.normal),this}equals(t){return t.normal.equals(this.normal)&&t.constant===this.constant}clone(){return new this.constructor().copy(this)}},ys=new li,va=new V,bo=class{constructor(t=new oi,e=new oi,n=new oi,s=new oi,r=new oi,o=new oi){this.planes=[t,e,n,s,r,o]}set(t,e,n,s,r,o){let a=this.planes;return a[0].copy(t),a[1].copy(e),a[2].copy(n),a[3].copy(s),a[4].copy(r),a[5].copy(o),this}copy(t){let e=this.planes;for(let n=0;n<6;n++)e[n].copy(t.planes[n]);return this}setFromProjectionMatrix(t,e=Fi){let n=this.planes,s=t.elements,r=s[0],o=s[1],a=s[2],l=s[3],c=s[4],u=s[5],d=s[6],h=s[7],p=s[8],g=s[9],v=s[10],m=s[11],f=s[12],T=s[13],b=s[14],A=s[15];if(n[0].setComponents(l-r,h-c,m-p,A-f).normalize(),n[1].setComponents(l+r,h+c,m+p,A+f).normalize(),n[2].setComponents(l+o,h+u,m+g,A+T).normalize(),n[3].setComponents(l-o,h-u,m-g,A-T).normalize(),n[4].setComponents(l-a,h-d,m-v,A-b).normalize(),e===Fi)n[5].setComponents(l+a,h+d,m+v,A+b).normalize();else if(e===La)n[5].setComponents(a,d,v,b).normalize();else throw new Error("THREE.Frustum.setFromProjectionMatrix(): Invalid coordinate system: "+e);return this}intersectsObject(t){if(t.boundingSphere!==void 0)t.boundingSphere===null&&t.computeBoundingSphere(),ys.copy(t.boundingSphere).applyMatrix4(t.matrixWorld);else{let e=t.geometry;e.boundingSphere===null&&e.computeBoundingSphere(),ys.copy(e.boundingSphere).applyMatrix4(t.matrixWorld)}return this.intersectsSphere(ys)}intersectsSprite(t){return ys.center.set(0,0,0),ys.radius=.7071067811865476,ys.applyMatrix4(t.matrixWorld),this.intersectsSphere(ys)}intersectsSphere(t){let e=this.planes,n=t.center,s=-t.radius;for(let r=0;r<6;r++)if(e[r].distanceToPoint(n)<s)return!1;return!0}intersectsBox(t){let e=this.planes;for(let n=0;n<6;n++){let s=e[n];if(va.x=s.normal.x>0?t.max.x:t.min.x,va.y=s.normal.y>0?t.max.y:t.min.y,va.z=s.normal.z>0?t.max.z:t.min.z,s.distanceToPoint(va)<0)return!1}return!0}containsPoint(t){let e=this.planes;for(let n=0;n<6;n++)if(e[n].distanceToPoint(t)<0)return!1;return!0}clone(){return new this.constructor().copy(this)}};function Uf(){let i=null,t=!1,e=null,n=null;function s(r,o){e(r,o),n=i.requestAnimationFrame(s)}return{start:function(){t!==!0&&e!==null&&(n=i.requestAnimationFrame(s),t=!0)},stop:function(){i.cancelAnimationFrame(n),t=!1},setAnimationLoop:function(r){e=r},setContext:function(r){i=r}}}function s_(i){let t=new WeakMap;function e(a,l){let c=a.array,u=a.usage,d=c.byteLength,h=i.createBuffer();i.bindBuffer(l,h),i.bufferData(l,c,u),a.onUploadCallback();let p;if(c instanceof Float32Array)p=i.FLOAT;else if(c instanceof Uint16Array)a.isFloat16BufferAttribute?p=i.HALF_FLOAT:p=i.UNSIGNED_SHORT;else if(c instanceof Int16Array)p=i.SHORT;else if(c instanceof Uint32Array)p=i.UNSIGNED_INT;else if(c instanceof Int32Array)p=i.INT;else if(c instanceof Int8Array)p=i.BYTE;else if(c instanceof Uint8Array)p=i.UNSIGNED_BYTE;else if(c instanceof Uint8ClampedArray)p=i.UNSIGNED_BYTE;else throw new Error("THREE.WebGLAttributes: Unsupported buffer data format: "+c);return{buffer:h,type:p,bytesPerElement:c.BYTES_PER_ELEMENT,version:a.version,size:d}}function n(a,l,c){let u=l.array,d=l._updateRange,h=l.updateRanges;if(i.bindBuffer(c,a),d.count===-1&&h.length===0&&i.bufferSubData(c,0,u),h.length!==0){for(let p=0,g=h.length;p<g;p++){let v=h[p];i.bufferSubData(c,v.start*u.BYTES_PER_ELEMENT,u,v.start,v.count)}l.clearUpdateRanges()}d.count!==-1&&(i.bufferSubData(c,d.offset*u.BYTES_PER_ELEMENT,u,d.offset,d.count),d.count=-1),l.onUploadCallback()}function s(a){return a.isInterleavedBufferAttribute&&(a=a.data),t.get(a)}function r(a){a.isInterleavedBufferAttribute&&(a=a.data);let l=t.get(a);l&&(i.deleteBuffer(l.buffer),t.delete(a))}function o(a,l){if(a.isGLBufferAttribute){let u=t.get(a);(!u||u.version<a.version)&&t.set(a,{buffer:a.buffer,type:a.type,bytesPerElement:a.elementSize,version:a.version});return}a.isInterleavedBufferAttribute&&(a=a.data);let c=t.get(a);if(c===void 0)t.set(a,e(a,l));else if(c.version<a.version){if(c.size!==a.array.byteLength)throw new Error("THREE.WebGLAttributes: The size of the buffer attribute's array buffer does not match the original size. Resizing buffer attributes is not supported.");n(c.buffer,a,l),c.version=a.version}}return{get:s,remove:r,update:o}}var Pr=class extends Cn{constructor(t=1,e=1,n=1,s=1){super(),this.type="PlaneGeometry",this.parameters={width:t,height:e,widthSegments:n,heightSegments:s};let r=t/2,o=e/2,a=Math.floor(n),l=Math.floor(s),c=a+1,u=l+1,d=t/a,h=e/l,p=[],g=[],v=[],m=[];for(let f=0;f<u;f++){let T=f*h-o;for(let b=0;b<c;b++){let A=b*d-r;g.push(A,-T,0),v.push(0,0,1),m.push(b/a),m.push(1-f/l)}}for(let f=0;f<l;f++)for(let T=0;T<a;T++){let b=T+c*f,A=T+c*(f+1),N=T+1+c*(f+1),L=T+1+c*f;p.push(b,A,L),p.push(A,N,L)}this.setIndex(p),this.setAttribute("position",new en(g,3)),this.setAttribute("normal",new en(v,3)),this.setAttribute("uv",new en(m,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new Pr(t.width,t.height,t.widthSegments,t.heightSegments)}},r_=`#ifdef USE_ALPHAHASH
	if ( diffuseColor.a < getAlphaHashThreshold( vPosition ) ) discard;
#endif`,o_=`#ifdef USE_ALPHAHASH
	const float ALPHA_HASH_SCALE = 0.05;
	float hash2D( vec2 value ) {
		return fract( 1.0e4 * sin( 17.0 * value.x + 0.1 * value.y ) * ( 0.1 + abs( sin( 13.0 * value.y + value.x ) ) ) );
	}
	float hash3D( vec3 value ) {
		return hash2D( vec2( hash2D( value.xy ), value.z ) );
	}
	float getAlphaHashThreshold( vec3 position ) {
		float maxDeriv = max(
			length( dFdx( position.xyz ) ),
			length( dFdy( position.xyz ) )
		);
		float pixScale = 1.0 / ( ALPHA_HASH_SCALE * maxDeriv );
		vec2 pixScales = vec2(
			exp2( floor( log2( pixScale ) ) ),
			exp2( ceil( log2( pixScale ) ) )
		);
		vec2 alpha = vec2(
			hash3D( floor( pixScales.x * position.xyz ) ),
			hash3D( floor( pixScales.y * position.xyz ) )
		);
		float lerpFactor = fract( log2( pixScale ) );
		float x = ( 1.0 - lerpFactor ) * alpha.x + lerpFactor * alpha.y;
		float a = min( lerpFactor, 1.0 - lerpFactor );
		vec3 cases = vec3(
			x * x / ( 2.0 * a * ( 1.0 - a ) ),
			( x - 0.5 * a ) / ( 1.0 - a ),
			1.0 - ( ( 1.0 - x ) * ( 1.0 - x ) / ( 2.0 * a * ( 1.0 - a ) ) )
		);
		float threshold = ( x < ( 1.0 - a ) )
			? ( ( x < a ) ? cases.x : cases.y )
			: cases.z;
		return clamp( threshold , 1.0e-6, 1.0 );
	}
#endif`,a_=`#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, vAlphaMapUv ).g;
#endif`,l_=`#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,c_=`#ifdef USE_ALPHATEST
	#ifdef ALPHA_TO_COVERAGE
	diffuseColor.a = smoothstep( alphaTest, alphaTest + fwidth( diffuseColor.a ), diffuseColor.a );
	if ( diffuseColor.a == 0.0 ) discard;
	#else
	if ( diffuseColor.a < alphaTest ) discard;
	#endif
#endif`,h_=`#ifdef USE_ALPHATEST
	uniform float alphaTest;
#endif`,u_=`#ifdef USE_AOMAP
	float ambientOcclusion = ( texture2D( aoMap, vAoMapUv ).r - 1.0 ) * aoMapIntensity + 1.0;
	reflectedLight.indirectDiffuse *= ambientOcclusion;
	#if defined( USE_CLEARCOAT ) 
		clearcoatSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_SHEEN ) 
		sheenSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_ENVMAP ) && defined( STANDARD )
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		reflectedLight.indirectSpecular *= computeSpecularOcclusion( dotNV, ambientOcclusion, material.roughness );
	#endif
#endif`,d_=`#ifdef USE_AOMAP
	uniform sampler2D aoMap;
	uniform float aoMapIntensity;
#endif`,f_=`#ifdef USE_BATCHING
	attribute float batchId;
	uniform highp sampler2D batchingTexture;
	mat4 getBatchingMatrix( const in float i ) {
		int size = textureSize( batchingTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( batchingTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( batchingTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( batchingTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( batchingTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
#endif
#ifdef USE_BATCHING_COLOR
	uniform sampler2D batchingColorTexture;
	vec3 getBatchingColor( const in float i ) {
		int size = textureSize( batchingColorTexture, 0 ).x;
		int j = int( i );
		int x = j % size;
		int y = j / size;
		return texelFetch( batchingColorTexture, ivec2( x, y ), 0 ).rgb;
	}
#endif`,p_=`#ifdef USE_BATCHING
	mat4 batchingMatrix = getBatchingMatrix( batchId );
#endif`,m_=`vec3 transformed = vec3( position );
#ifdef USE_ALPHAHASH
	vPosition = vec3( position );
#endif`,g_=`vec3 objectNormal = vec3( normal );
#ifdef USE_TANGENT
	vec3 objectTangent = vec3( tangent.xyz );
#endif`,__=`float G_BlinnPhong_Implicit( ) {
	return 0.25;
}
float D_BlinnPhong( const in float shininess, const in float dotNH ) {
	return RECIPROCAL_PI * ( shininess * 0.5 + 1.0 ) * pow( dotNH, shininess );
}
vec3 BRDF_BlinnPhong( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 specularColor, const in float shininess ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( specularColor, 1.0, dotVH );
	float G = G_BlinnPhong_Implicit( );
	float D = D_BlinnPhong( shininess, dotNH );
	return F * ( G * D );
} // validated`,v_=`#ifdef USE_IRIDESCENCE
	const mat3 XYZ_TO_REC709 = mat3(
		 3.2404542, -0.9692660,  0.0556434,
		-1.5371385,  1.8760108, -0.2040259,
		-0.4985314,  0.0415560,  1.0572252
	);
	vec3 Fresnel0ToIor( vec3 fresnel0 ) {
		vec3 sqrtF0 = sqrt( fresnel0 );
		return ( vec3( 1.0 ) + sqrtF0 ) / ( vec3( 1.0 ) - sqrtF0 );
	}
	vec3 IorToFresnel0( vec3 transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - vec3( incidentIor ) ) / ( transmittedIor + vec3( incidentIor ) ) );
	}
	float IorToFresnel0( float transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - incidentIor ) / ( transmittedIor + incidentIor ));
	}
	vec3 evalSensitivity( float OPD, vec3 shift ) {
		float phase = 2.0 * PI * OPD * 1.0e-9;
		vec3 val = vec3( 5.4856e-13, 4.4201e-13, 5.2481e-13 );
		vec3 pos = vec3( 1.6810e+06, 1.7953e+06, 2.2084e+06 );
		vec3 var = vec3( 4.3278e+09, 9.3046e+09, 6.6121e+09 );
		vec3 xyz = val * sqrt( 2.0 * PI * var ) * cos( pos * phase + shift ) * exp( - pow2( phase ) * var );
		xyz.x += 9.7470e-14 * sqrt( 2.0 * PI * 4.5282e+09 ) * cos( 2.2399e+06 * phase + shift[ 0 ] ) * exp( - 4.5282e+09 * pow2( phase ) );
		xyz /= 1.0685e-7;
		vec3 rgb = XYZ_TO_REC709 * xyz;
		return rgb;
	}
	vec3 evalIridescence( float outsideIOR, float eta2, float cosTheta1, float thinFilmThickness, vec3 baseF0 ) {
		vec3 I;
		float iridescenceIOR = mix( outsideIOR, eta2, smoothstep( 0.0, 0.03, thinFilmThickness ) );
		float sinTheta2Sq = pow2( outsideIOR / iridescenceIOR ) * ( 1.0 - pow2( cosTheta1 ) );
		float cosTheta2Sq = 1.0 - sinTheta2Sq;
		if ( cosTheta2Sq < 0.0 ) {
			return vec3( 1.0 );
		}
		float cosTheta2 = sqrt( cosTheta2Sq );
		float R0 = IorToFresnel0( iridescenceIOR, outsideIOR );
		float R12 = F_Schlick( R0, 1.0, cosTheta1 );
		float T121 = 1.0 - R12;
		float phi12 = 0.0;
		if ( iridescenceIOR < outsideIOR ) phi12 = PI;
		float phi21 = PI - phi12;
		vec3 baseIOR = Fresnel0ToIor( clamp( baseF0, 0.0, 0.9999 ) );		vec3 R1 = IorToFresnel0( baseIOR, iridescenceIOR );
		vec3 R23 = F_Schlick( R1, 1.0, cosTheta2 );
		vec3 phi23 = vec3( 0.0 );
		if ( baseIOR[ 0 ] < iridescenceIOR ) phi23[ 0 ] = PI;
		if ( baseIOR[ 1 ] < iridescenceIOR ) phi23[ 1 ] = PI;
		if ( baseIOR[ 2 ] < iridescenceIOR ) phi23[ 2 ] = PI;
		float OPD = 2.0 * iridescenceIOR * thinFilmThickness * cosTheta2;
		vec3 phi = vec3( phi21 ) + phi23;
		vec3 R123 = clamp( R12 * R23, 1e-5, 0.9999 );
		vec3 r123 = sqrt( R123 );
		vec3 Rs = pow2( T121 ) * R23 / ( vec3( 1.0 ) - R123 );
		vec3 C0 = R12 + Rs;
		I = C0;
		vec3 Cm = Rs - T121;
		for ( int m = 1; m <= 2; ++ m ) {
			Cm *= r123;
			vec3 Sm = 2.0 * evalSensitivity( float( m ) * OPD, float( m ) * phi );
			I += Cm * Sm;
		}
		return max( I, vec3( 0.0 ) );
	}
#endif`,y_=`#ifdef USE_BUMPMAP
	uniform sampler2D bumpMap;
	uniform float bumpScale;
	vec2 dHdxy_fwd() {
		vec2 dSTdx = dFdx( vBumpMapUv );
		vec2 dSTdy = dFdy( vBumpMapUv );
		float Hll = bumpScale * texture2D( bumpMap, vBumpMapUv ).x;
		float dBx = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdx ).x - Hll;
		float dBy = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdy ).x - Hll;
		return vec2( dBx, dBy );
	}
	vec3 perturbNormalArb( vec3 surf_pos, vec3 surf_norm, vec2 dHdxy, float faceDirection ) {
		vec3 vSigmaX = normalize( dFdx( surf_pos.xyz ) );
		vec3 vSigmaY = normalize( dFdy( surf_pos.xyz ) );
		vec3 vN = surf_norm;
		vec3 R1 = cross( vSigmaY, vN );
		vec3 R2 = cross( vN, vSigmaX );
		float fDet = dot( vSigmaX, R1 ) * faceDirection;
		vec3 vGrad = sign( fDet ) * ( dHdxy.x * R1 + dHdxy.y * R2 );
		return normalize( abs( fDet ) * surf_norm - vGrad );
	}
#endif`,x_=`#if NUM_CLIPPING_PLANES > 0
	vec4 plane;
	#ifdef ALPHA_TO_COVERAGE
		float distanceToPlane, distanceGradient;
		float clipOpacity = 1.0;
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
			distanceGradient = fwidth( distanceToPlane ) / 2.0;
			clipOpacity *= smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			if ( clipOpacity == 0.0 ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			float unionClipOpacity = 1.0;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
				distanceGradient = fwidth( distanceToPlane ) / 2.0;
				unionClipOpacity *= 1.0 - smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			}
			#pragma unroll_loop_end
			clipOpacity *= 1.0 - unionClipOpacity;
		#endif
		diffuseColor.a *= clipOpacity;
		if ( diffuseColor.a == 0.0 ) discard;
	#else
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			if ( dot( vClipPosition, plane.xyz ) > plane.w ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			bool clipped = true;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				clipped = ( dot( vClipPosition, plane.xyz ) > plane.w ) && clipped;
			}
			#pragma unroll_loop_end
			if ( clipped ) discard;
		#endif
	#endif
#endif`,M_=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
	uniform vec4 clippingPlanes[ NUM_CLIPPING_PLANES ];
#endif`,b_=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
#endif`,w_=`#if NUM_CLIPPING_PLANES > 0
	vClipPosition = - mvPosition.xyz;
#endif`,S_=`#if defined( USE_COLOR_ALPHA )
	diffuseColor *= vColor;
#elif defined( USE_COLOR )
	diffuseColor.rgb *= vColor;
#endif`,E_=`#if defined( USE_COLOR_ALPHA )
	varying vec4 vColor;
#elif defined( USE_COLOR )
	varying vec3 vColor;
#endif`,T_=`#if defined( USE_COLOR_ALPHA )
	varying vec4 vColor;
#elif defined( USE_COLOR ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	varying vec3 vColor;
#endif`,A_=`#if defined( USE_COLOR_ALPHA )
	vColor = vec4( 1.0 );
#elif defined( USE_COLOR ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	vColor = vec3( 1.0 );
#endif
#ifdef USE_COLOR
	vColor *= color;
#endif
#ifdef USE_INSTANCING_COLOR
	vColor.xyz *= instanceColor.xyz;
#endif
#ifdef USE_BATCHING_COLOR
	vec3 batchingColor = getBatchingColor( batchId );
	vColor.xyz *= batchingColor.xyz;
#endif`,C_=`#define PI 3.141592653589793
#define PI2 6.283185307179586
#define PI_HALF 1.5707963267948966
#define RECIPROCAL_PI 0.3183098861837907
#define RECIPROCAL_PI2 0.15915494309189535
#define EPSILON 1e-6
#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
#define whiteComplement( a ) ( 1.0 - saturate( a ) )
float pow2( const in float x ) { return x*x; }
vec3 pow2( const in vec3 x ) { return x*x; }
float pow3( const in float x ) { return x*x*x; }
float pow4( const in float x ) { float x2 = x*x; return x2*x2; }
float max3( const in vec3 v ) { return max( max( v.x, v.y ), v.z ); }
float average( const in vec3 v ) { return dot( v, vec3( 0.3333333 ) ); }
highp float rand( const in vec2 uv ) {
	const highp float a = 12.9898, b = 78.233, c = 43758.5453;
	highp float dt = dot( uv.xy, vec2( a,b ) ), sn = mod( dt, PI );
	return fract( sin( sn ) * c );
}
#ifdef HIGH_PRECISION
	float precisionSafeLength( vec3 v ) { return length( v ); }
#else
	float precisionSafeLength( vec3 v ) {
		float maxComponent = max3( abs( v ) );
		return length( v / maxComponent ) * maxComponent;
	}
#endif
struct IncidentLight {
	vec3 color;
	vec3 direction;
	bool visible;
};
struct ReflectedLight {
	vec3 directDiffuse;
	vec3 directSpecular;
	vec3 indirectDiffuse;
	vec3 indirectSpecular;
};
#ifdef USE_ALPHAHASH
	varying vec3 vPosition;
#endif
vec3 transformDirection( in vec3 dir, in mat4 matrix ) {
	return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );
}
vec3 inverseTransformDirection( in vec3 dir, in mat4 matrix ) {
	return normalize( ( vec4( dir, 0.0 ) * matrix ).xyz );
}
mat3 transposeMat3( const in mat3 m ) {
	mat3 tmp;
	tmp[ 0 ] = vec3( m[ 0 ].x, m[ 1 ].x, m[ 2 ].x );
	tmp[ 1 ] = vec3( m[ 0 ].y, m[ 1 ].y, m[ 2 ].y );
	tmp[ 2 ] = vec3( m[ 0 ].z, m[ 1 ].z, m[ 2 ].z );
	return tmp;
}
float luminance( const in vec3 rgb ) {
	const vec3 weights = vec3( 0.2126729, 0.7151522, 0.0721750 );
	return dot( weights, rgb );
}
bool isPerspectiveMatrix( mat4 m ) {
	return m[ 2 ][ 3 ] == - 1.0;
}
vec2 equirectUv( in vec3 dir ) {
	float u = atan( dir.z, dir.x ) * RECIPROCAL_PI2 + 0.5;
	float v = asin( clamp( dir.y, - 1.0, 1.0 ) ) * RECIPROCAL_PI + 0.5;
	return vec2( u, v );
}
vec3 BRDF_Lambert( const in vec3 diffuseColor ) {
	return RECIPROCAL_PI * diffuseColor;
}
vec3 F_Schlick( const in vec3 f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
}
float F_Schlick( const in float f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
} // validated`,R_=`#ifdef ENVMAP_TYPE_CUBE_UV
	#define cubeUV_minMipLevel 4.0
	#define cubeUV_minTileSize 16.0
	float getFace( vec3 direction ) {
		vec3 absDirection = abs( direction );
		float face = - 1.0;
		if ( absDirection.x > absDirection.z ) {
			if ( absDirection.x > absDirection.y )
				face = direction.x > 0.0 ? 0.0 : 3.0;
			else
				face = direction.y > 0.0 ? 1.0 : 4.0;
		} else {
			if ( absDirection.z > absDirection.y )
				face = direction.z > 0.0 ? 2.0 : 5.0;
			else
				face = direction.y > 0.0 ? 1.0 : 4.0;
		}
		return face;
	}
	vec2 getUV( vec3 direction, float face ) {
		vec2 uv;
		if ( face == 0.0 ) {
			uv = vec2( direction.z, direction.y ) / abs( direction.x );
		} else if ( face == 1.0 ) {
			uv = vec2( - direction.x, - direction.z ) / abs( direction.y );
		} else if ( face == 2.0 ) {
			uv = vec2( - direction.x, direction.y ) / abs( direction.z );
		} else if ( face == 3.0 ) {
			uv = vec2( - direction.z, direction.y ) / abs( direction.x );
		} else if ( face == 4.0 ) {
			uv = vec2( - direction.x, direction.z ) / abs( direction.y );
		} else {
			uv = vec2( direction.x, direction.y ) / abs( direction.z );
		}
		return 0.5 * ( uv + 1.0 );
	}
	vec3 bilinearCubeUV( sampler2D envMap, vec3 direction, float mipInt ) {
		float face = getFace( direction );
		float filterInt = max( cubeUV_minMipLevel - mipInt, 0.0 );
		mipInt = max( mipInt, cubeUV_minMipLevel );
		float faceSize = exp2( mipInt );
		highp vec2 uv = getUV( direction, face ) * ( faceSize - 2.0 ) + 1.0;
		if ( face > 2.0 ) {
			uv.y += faceSize;
			face -= 3.0;
		}
		uv.x += face * faceSize;
		uv.x += filterInt * 3.0 * cubeUV_minTileSize;
		uv.y += 4.0 * ( exp2( CUBEUV_MAX_MIP ) - faceSize );
		uv.x *= CUBEUV_TEXEL_WIDTH;
		uv.y *= CUBEUV_TEXEL_HEIGHT;
		#ifdef texture2DGradEXT
			return texture2DGradEXT( envMap, uv, vec2( 0.0 ), vec2( 0.0 ) ).rgb;
		#else
			return texture2D( envMap, uv ).rgb;
		#endif
	}
	#define cubeUV_r0 1.0
	#define cubeUV_m0 - 2.0
	#define cubeUV_r1 0.8
	#define cubeUV_m1 - 1.0
	#define cubeUV_r4 0.4
	#define cubeUV_m4 2.0
	#define cubeUV_r5 0.305
	#define cubeUV_m5 3.0
	#define cubeUV_r6 0.21
	#define cubeUV_m6 4.0
	float roughnessToMip( float roughness ) {
		float mip = 0.0;
		if ( roughness >= cubeUV_r1 ) {
			mip = ( cubeUV_r0 - roughness ) * ( cubeUV_m1 - cubeUV_m0 ) / ( cubeUV_r0 - cubeUV_r1 ) + cubeUV_m0;
		} else if ( roughness >= cubeUV_r4 ) {
			mip = ( cubeUV_r1 - roughness ) * ( cubeUV_m4 - cubeUV_m1 ) / ( cubeUV_r1 - cubeUV_r4 ) + cubeUV_m1;
		} else if ( roughness >= cubeUV_r5 ) {
			mip = ( cubeUV_r4 - roughness ) * ( cubeUV_m5 - cubeUV_m4 ) / ( cubeUV_r4 - cubeUV_r5 ) + cubeUV_m4;
		} else if ( roughness >= cubeUV_r6 ) {
			mip = ( cubeUV_r5 - roughness ) * ( cubeUV_m6 - cubeUV_m5 ) / ( cubeUV_r5 - cubeUV_r6 ) + cubeUV_m5;
		} else {
			mip = - 2.0 * log2( 1.16 * roughness );		}
		return mip;
	}
	vec4 textureCubeUV( sampler2D envMap, vec3 sampleDir, float roughness ) {
		float mip = clamp( roughnessToMip( roughness ), cubeUV_m0, CUBEUV_MAX_MIP );
		float mipF = fract( mip );
		float mipInt = floor( mip );
		vec3 color0 = bilinearCubeUV( envMap, sampleDir, mipInt );
		if ( mipF == 0.0 ) {
			return vec4( color0, 1.0 );
		} else {
			vec3 color1 = bilinearCubeUV( envMap, sampleDir, mipInt + 1.0 );
			return vec4( mix( color0, color1, mipF ), 1.0 );
		}
	}
#endif`,P_=`vec3 transformedNormal = objectNormal;
#ifdef USE_TANGENT
	vec3 transformedTangent = objectTangent;
#endif
#ifdef USE_BATCHING
	mat3 bm = mat3( batchingMatrix );
	transformedNormal /= vec3( dot( bm[ 0 ], bm[ 0 ] ), dot( bm[ 1 ], bm[ 1 ] ), dot( bm[ 2 ], bm[ 2 ] ) );
	transformedNormal = bm * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = bm * transformedTangent;
	#endif
#endif
#ifdef USE_INSTANCING
	mat3 im = mat3( instanceMatrix );
	transformedNormal /= vec3( dot( im[ 0 ], im[ 0 ] ), dot( im[ 1 ], im[ 1 ] ), dot( im[ 2 ], im[ 2 ] ) );
	transformedNormal = im * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = im * transformedTangent;
	#endif
#endif
transformedNormal = normalMatrix * transformedNormal;
#ifdef FLIP_SIDED
	transformedNormal = - transformedNormal;
#endif
#ifdef USE_TANGENT
	transformedTangent = ( modelViewMatrix * vec4( transformedTangent, 0.0 ) ).xyz;
	#ifdef FLIP_SIDED
		transformedTangent = - transformedTangent;
	#endif
#endif`,L_=`#ifdef USE_DISPLACEMENTMAP
	uniform sampler2D displacementMap;
	uniform float displacementScale;
	uniform float displacementBias;
#endif`,I_=`#ifdef USE_DISPLACEMENTMAP
	transformed += normalize( objectNormal ) * ( texture2D( displacementMap, vDisplacementMapUv ).x * displacementScale + displacementBias );
#endif`,D_=`#ifdef USE_EMISSIVEMAP
	vec4 emissiveColor = texture2D( emissiveMap, vEmissiveMapUv );
	totalEmissiveRadiance *= emissiveColor.rgb;
#endif`,N_=`#ifdef USE_EMISSIVEMAP
	uniform sampler2D emissiveMap;
#endif`,U_="gl_FragColor = linearToOutputTexel( gl_FragColor );",O_=`
const mat3 LINEAR_SRGB_TO_LINEAR_DISPLAY_P3 = mat3(
	vec3( 0.8224621, 0.177538, 0.0 ),
	vec3( 0.0331941, 0.9668058, 0.0 ),
	vec3( 0.0170827, 0.0723974, 0.9105199 )
);
const mat3 LINEAR_DISPLAY_P3_TO_LINEAR_SRGB = mat3(
	vec3( 1.2249401, - 0.2249404, 0.0 ),
	vec3( - 0.0420569, 1.0420571, 0.0 ),
	vec3( - 0.0196376, - 0.0786361, 1.0982735 )
);
vec4 LinearSRGBToLinearDisplayP3( in vec4 value ) {
	return vec4( value.rgb * LINEAR_SRGB_TO_LINEAR_DISPLAY_P3, value.a );
}
vec4 LinearDisplayP3ToLinearSRGB( in vec4 value ) {
	return vec4( value.rgb * LINEAR_DISPLAY_P3_TO_LINEAR_SRGB, value.a );
}
vec4 LinearTransferOETF( in vec4 value ) {
	return value;
}
vec4 sRGBTransferOETF( in vec4 value ) {
	return vec4( mix( pow( value.rgb, vec3( 0.41666 ) ) * 1.055 - vec3( 0.055 ), value.rgb * 12.92, vec3( lessThanEqual( value.rgb, vec3( 0.0031308 ) ) ) ), value.a );
}
vec4 LinearToLinear( in vec4 value ) {
	return value;
}
vec4 LinearTosRGB( in vec4 value ) {
	return sRGBTransferOETF( value );
}`,F_=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vec3 cameraToFrag;
		if ( isOrthographic ) {
			cameraToFrag = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToFrag = normalize( vWorldPosition - cameraPosition );
		}
		vec3 worldNormal = inverseTransformDirection( normal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vec3 reflectVec = reflect( cameraToFrag, worldNormal );
		#else
			vec3 reflectVec = refract( cameraToFrag, worldNormal, refractionRatio );
		#endif
	#else
		vec3 reflectVec = vReflect;
	#endif
	#ifdef ENVMAP_TYPE_CUBE
		vec4 envColor = textureCube( envMap, envMapRotation * vec3( flipEnvMap * reflectVec.x, reflectVec.yz ) );
	#else
		vec4 envColor = vec4( 0.0 );
	#endif
	#ifdef ENVMAP_BLENDING_MULTIPLY
		outgoingLight = mix( outgoingLight, outgoingLight * envColor.xyz, specularStrength * reflectivity );
	#elif defined( ENVMAP_BLENDING_MIX )
		outgoingLight = mix( outgoingLight, envColor.xyz, specularStrength * reflectivity );
	#elif defined( ENVMAP_BLENDING_ADD )
		outgoingLight += envColor.xyz * specularStrength * reflectivity;
	#endif
#endif`,k_=`#ifdef USE_ENVMAP
	uniform float envMapIntensity;
	uniform float flipEnvMap;
	uniform mat3 envMapRotation;
	#ifdef ENVMAP_TYPE_CUBE
		uniform samplerCube envMap;
	#else
		uniform sampler2D envMap;
	#endif
	
#endif`,B_=`#ifdef USE_ENVMAP
	uniform float reflectivity;
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		varying vec3 vWorldPosition;
		uniform float refractionRatio;
	#else
		varying vec3 vReflect;
	#endif
#endif`,z_=`#ifdef USE_ENVMAP
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		
		varying vec3 vWorldPosition;
	#else
		varying vec3 vReflect;
		uniform float refractionRatio;
	#endif
#endif`,V_=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vWorldPosition = worldPosition.xyz;
	#else
		vec3 cameraToVertex;
		if ( isOrthographic ) {
			cameraToVertex = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToVertex = normalize( worldPosition.xyz - cameraPosition );
		}
		vec3 worldNormal = inverseTransformDirection( transformedNormal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vReflect = reflect( cameraToVertex, worldNormal );
		#else
			vReflect = refract( cameraToVertex, worldNormal, refractionRatio );
		#endif
	#endif
#endif`,H_=`#ifdef USE_FOG
	vFogDepth = - mvPosition.z;
#endif`,G_=`#ifdef USE_FOG
	varying float vFogDepth;
#endif`,W_=`#ifdef USE_FOG
	#ifdef FOG_EXP2
		float fogFactor = 1.0 - exp( - fogDensity * fogDensity * vFogDepth * vFogDepth );
	#else
		float fogFactor = smoothstep( fogNear, fogFar, vFogDepth );
	#endif
	gl_FragColor.rgb = mix( gl_FragColor.rgb, fogColor, fogFactor );
#endif`,X_=`#ifdef USE_FOG
	uniform vec3 fogColor;
	varying float vFogDepth;
	#ifdef FOG_EXP2
		uniform float fogDensity;
	#else
		uniform float fogNear;
		uniform float fogFar;
	#endif
#endif`,$_=`#ifdef USE_GRADIENTMAP
	uniform sampler2D gradientMap;
#endif
vec3 getGradientIrradiance( vec3 normal, vec3 lightDirection ) {
	float dotNL = dot( normal, lightDirection );
	vec2 coord = vec2( dotNL * 0.5 + 0.5, 0.0 );
	#ifdef USE_GRADIENTMAP
		return vec3( texture2D( gradientMap, coord ).r );
	#else
		vec2 fw = fwidth( coord ) * 0.5;
		return mix( vec3( 0.7 ), vec3( 1.0 ), smoothstep( 0.7 - fw.x, 0.7 + fw.x, coord.x ) );
	#endif
}`,q_=`#ifdef USE_LIGHTMAP
	uniform sampler2D lightMap;
	uniform float lightMapIntensity;
#endif`,Y_=`LambertMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularStrength = specularStrength;`,Z_=`varying vec3 vViewPosition;
struct LambertMaterial {
	vec3 diffuseColor;
	float specularStrength;
};
void RE_Direct_Lambert( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Lambert( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Lambert
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Lambert`,J_=`uniform bool receiveShadow;
uniform vec3 ambientLightColor;
#if defined( USE_LIGHT_PROBES )
	uniform vec3 lightProbe[ 9 ];
#endif
vec3 shGetIrradianceAt( in vec3 normal, in vec3 shCoefficients[ 9 ] ) {
	float x = normal.x, y = normal.y, z = normal.z;
	vec3 result = shCoefficients[ 0 ] * 0.886227;
	result += shCoefficients[ 1 ] * 2.0 * 0.511664 * y;
	result += shCoefficients[ 2 ] * 2.0 * 0.511664 * z;
	result += shCoefficients[ 3 ] * 2.0 * 0.511664 * x;
	result += shCoefficients[ 4 ] * 2.0 * 0.429043 * x * y;
	result += shCoefficients[ 5 ] * 2.0 * 0.429043 * y * z;
	result += shCoefficients[ 6 ] * ( 0.743125 * z * z - 0.247708 );
	result += shCoefficients[ 7 ] * 2.0 * 0.429043 * x * z;
	result += shCoefficients[ 8 ] * 0.429043 * ( x * x - y * y );
	return result;
}
vec3 getLightProbeIrradiance( const in vec3 lightProbe[ 9 ], const in vec3 normal ) {
	vec3 worldNormal = inverseTransformDirection( normal, viewMatrix );
	vec3 irradiance = shGetIrradianceAt( worldNormal, lightProbe );
	return irradiance;
}
vec3 getAmbientLightIrradiance( const in vec3 ambientLightColor ) {
	vec3 irradiance = ambientLightColor;
	return irradiance;
}
float getDistanceAttenuation( const in float lightDistance, const in float cutoffDistance, const in float decayExponent ) {
	float distanceFalloff = 1.0 / max( pow( lightDistance, decayExponent ), 0.01 );
	if ( cutoffDistance > 0.0 ) {
		distanceFalloff *= pow2( saturate( 1.0 - pow4( lightDistance / cutoffDistance ) ) );
	}
	return distanceFalloff;
}
float getSpotAttenuation( const in float coneCosine, const in float penumbraCosine, const in float angleCosine ) {
	return smoothstep( coneCosine, penumbraCosine, angleCosine );
}
#if NUM_DIR_LIGHTS > 0
	struct DirectionalLight {
		vec3 direction;
		vec3 color;
	};
	uniform DirectionalLight directionalLights[ NUM_DIR_LIGHTS ];
	void getDirectionalLightInfo( const in DirectionalLight directionalLight, out IncidentLight light ) {
		light.color = directionalLight.color;
		light.direction = directionalLight.direction;
		light.visible = true;
	}
#endif
#if NUM_POINT_LIGHTS > 0
	struct PointLight {
		vec3 position;
		vec3 color;
		float distance;
		float decay;
	};
	uniform PointLight pointLights[ NUM_POINT_LIGHTS ];
	void getPointLightInfo( const in PointLight pointLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = pointLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float lightDistance = length( lVector );
		light.color = pointLight.color;
		light.color *= getDistanceAttenuation( lightDistance, pointLight.distance, pointLight.decay );
		light.visible = ( light.color != vec3( 0.0 ) );
	}
#endif
#if NUM_SPOT_LIGHTS > 0
	struct SpotLight {
		vec3 position;
		vec3 direction;
		vec3 color;
		float distance;
		float decay;
		float coneCos;
		float penumbraCos;
	};
	uniform SpotLight spotLights[ NUM_SPOT_LIGHTS ];
	void getSpotLightInfo( const in SpotLight spotLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = spotLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float angleCos = dot( light.direction, spotLight.direction );
		float spotAttenuation = getSpotAttenuation( spotLight.coneCos, spotLight.penumbraCos, angleCos );
		if ( spotAttenuation > 0.0 ) {
			float lightDistance = length( lVector );
			light.color = spotLight.color * spotAttenuation;
			light.color *= getDistanceAttenuation( lightDistance, spotLight.distance, spotLight.decay );
			light.visible = ( light.color != vec3( 0.0 ) );
		} else {
			light.color = vec3( 0.0 );
			light.visible = false;
		}
	}
#endif
#if NUM_RECT_AREA_LIGHTS > 0
	struct RectAreaLight {
		vec3 color;
		vec3 position;
		vec3 halfWidth;
		vec3 halfHeight;
	};
	uniform sampler2D ltc_1;	uniform sampler2D ltc_2;
	uniform RectAreaLight rectAreaLights[ NUM_RECT_AREA_LIGHTS ];
#endif
#if NUM_HEMI_LIGHTS > 0
	struct HemisphereLight {
		vec3 direction;
		vec3 skyColor;
		vec3 groundColor;
	};
	uniform HemisphereLight hemisphereLights[ NUM_HEMI_LIGHTS ];
	vec3 getHemisphereLightIrradiance( const in HemisphereLight hemiLight, const in vec3 normal ) {
		float dotNL = dot( normal, hemiLight.direction );
		float hemiDiffuseWeight = 0.5 * dotNL + 0.5;
		vec3 irradiance = mix( hemiLight.groundColor, hemiLight.skyColor, hemiDiffuseWeight );
		return irradiance;
	}
#endif`,K_=`#ifdef USE_ENVMAP
	vec3 getIBLIrradiance( const in vec3 normal ) {
		#ifdef ENVMAP_TYPE_CUBE_UV
			vec3 worldNormal = inverseTransformDirection( normal, viewMatrix );
			vec4 envMapColor = textureCubeUV( envMap, envMapRotation * worldNormal, 1.0 );
			return PI * envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	vec3 getIBLRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
		#ifdef ENVMAP_TYPE_CUBE_UV
			vec3 reflectVec = reflect( - viewDir, normal );
			reflectVec = normalize( mix( reflectVec, normal, roughness * roughness) );
			reflectVec = inverseTransformDirection( reflectVec, viewMatrix );
			vec4 envMapColor = textureCubeUV( envMap, envMapRotation * reflectVec, roughness );
			return envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	#ifdef USE_ANISOTROPY
		vec3 getIBLAnisotropyRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
			#ifdef ENVMAP_TYPE_CUBE_UV
				vec3 bentNormal = cross( bitangent, viewDir );
				bentNormal = normalize( cross( bentNormal, bitangent ) );
				bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
				return getIBLRadiance( viewDir, bentNormal, roughness );
			#else
				return vec3( 0.0 );
			#endif
		}
	#endif
#endif`,j_=`ToonMaterial material;
material.diffuseColor = diffuseColor.rgb;`,Q_=`varying vec3 vViewPosition;
struct ToonMaterial {
	vec3 diffuseColor;
};
void RE_Direct_Toon( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 irradiance = getGradientIrradiance( geometryNormal, directLight.direction ) * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Toon( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Toon
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Toon`,tv=`BlinnPhongMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularColor = specular;
material.specularShininess = shininess;
material.specularStrength = specularStrength;`,ev=`varying vec3 vViewPosition;
struct BlinnPhongMaterial {
	vec3 diffuseColor;
	vec3 specularColor;
	float specularShininess;
	float specularStrength;
};
void RE_Direct_BlinnPhong( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
	reflectedLight.directSpecular += irradiance * BRDF_BlinnPhong( directLight.direction, geometryViewDir, geometryNormal, material.specularColor, material.specularShininess ) * material.specularStrength;
}
void RE_IndirectDiffuse_BlinnPhong( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_BlinnPhong
#define RE_IndirectDiffuse		RE_IndirectDiffuse_BlinnPhong`,nv=`PhysicalMaterial material;
material.diffuseColor = diffuseColor.rgb * ( 1.0 - metalnessFactor );
vec3 dxy = max( abs( dFdx( nonPerturbedNormal ) ), abs( dFdy( nonPerturbedNormal ) ) );
float geometryRoughness = max( max( dxy.x, dxy.y ), dxy.z );
material.roughness = max( roughnessFactor, 0.0525 );material.roughness += geometryRoughness;
material.roughness = min( material.roughness, 1.0 );
#ifdef IOR
	material.ior = ior;
	#ifdef USE_SPECULAR
		float specularIntensityFactor = specularIntensity;
		vec3 specularColorFactor = specularColor;
		#ifdef USE_SPECULAR_COLORMAP
			specularColorFactor *= texture2D( specularColorMap, vSpecularColorMapUv ).rgb;
		#endif
		#ifdef USE_SPECULAR_INTENSITYMAP
			specularIntensityFactor *= texture2D( specularIntensityMap, vSpecularIntensityMapUv ).a;
		#endif
		material.specularF90 = mix( specularIntensityFactor, 1.0, metalnessFactor );
	#else
		float specularIntensityFactor = 1.0;
		vec3 specularColorFactor = vec3( 1.0 );
		material.specularF90 = 1.0;
	#endif
	material.specularColor = mix( min( pow2( ( material.ior - 1.0 ) / ( material.ior + 1.0 ) ) * specularColorFactor, vec3( 1.0 ) ) * specularIntensityFactor, diffuseColor.rgb, metalnessFactor );
#else
	material.specularColor = mix( vec3( 0.04 ), diffuseColor.rgb, metalnessFactor );
	material.specularF90 = 1.0;
#endif
#ifdef USE_CLEARCOAT
	material.clearcoat = clearcoat;
	material.clearcoatRoughness = clearcoatRoughness;
	material.clearcoatF0 = vec3( 0.04 );
	material.clearcoatF90 = 1.0;
	#ifdef USE_CLEARCOATMAP
		material.clearcoat *= texture2D( clearcoatMap, vClearcoatMapUv ).x;
	#endif
	#ifdef USE_CLEARCOAT_ROUGHNESSMAP
		material.clearcoatRoughness *= texture2D( clearcoatRoughnessMap, vClearcoatRoughnessMapUv ).y;
	#endif
	material.clearcoat = saturate( material.clearcoat );	material.clearcoatRoughness = max( material.clearcoatRoughness, 0.0525 );
	material.clearcoatRoughness += geometryRoughness;
	material.clearcoatRoughness = min( material.clearcoatRoughness, 1.0 );
#endif
#ifdef USE_DISPERSION
	material.dispersion = dispersion;
#endif
#ifdef USE_IRIDESCENCE
	material.iridescence = iridescence;
	material.iridescenceIOR = iridescenceIOR;
	#ifdef USE_IRIDESCENCEMAP
		material.iridescence *= texture2D( iridescenceMap, vIridescenceMapUv ).r;
	#endif
	#ifdef USE_IRIDESCENCE_THICKNESSMAP
		material.iridescenceThickness = (iridescenceThicknessMaximum - iridescenceThicknessMinimum) * texture2D( iridescenceThicknessMap, vIridescenceThicknessMapUv ).g + iridescenceThicknessMinimum;
	#else
		material.iridescenceThickness = iridescenceThicknessMaximum;
	#endif
#endif
#ifdef USE_SHEEN
	material.sheenColor = sheenColor;
	#ifdef USE_SHEEN_COLORMAP
		material.sheenColor *= texture2D( sheenColorMap, vSheenColorMapUv ).rgb;
	#endif
	material.sheenRoughness = clamp( sheenRoughness, 0.07, 1.0 );
	#ifdef USE_SHEEN_ROUGHNESSMAP
		material.sheenRoughness *= texture2D( sheenRoughnessMap, vSheenRoughnessMapUv ).a;
	#endif
#endif
#ifdef USE_ANISOTROPY
	#ifdef USE_ANISOTROPYMAP
		mat2 anisotropyMat = mat2( anisotropyVector.x, anisotropyVector.y, - anisotropyVector.y, anisotropyVector.x );
		vec3 anisotropyPolar = texture2D( anisotropyMap, vAnisotropyMapUv ).rgb;
		vec2 anisotropyV = anisotropyMat * normalize( 2.0 * anisotropyPolar.rg - vec2( 1.0 ) ) * anisotropyPolar.b;
	#else
		vec2 anisotropyV = anisotropyVector;
	#endif
	material.anisotropy = length( anisotropyV );
	if( material.anisotropy == 0.0 ) {
		anisotropyV = vec2( 1.0, 0.0 );
	} else {
		anisotropyV /= material.anisotropy;
		material.anisotropy = saturate( material.anisotropy );
	}
	material.alphaT = mix( pow2( material.roughness ), 1.0, pow2( material.anisotropy ) );
	material.anisotropyT = tbn[ 0 ] * anisotropyV.x + tbn[ 1 ] * anisotropyV.y;
	material.anisotropyB = tbn[ 1 ] * anisotropyV.x - tbn[ 0 ] * anisotropyV.y;
#endif`,iv=`struct PhysicalMaterial {
	vec3 diffuseColor;
	float roughness;
	vec3 specularColor;
	float specularF90;
	float dispersion;
	#ifdef USE_CLEARCOAT
		float clearcoat;
		float clearcoatRoughness;
		vec3 clearcoatF0;
		float clearcoatF90;
	#endif
	#ifdef USE_IRIDESCENCE
		float iridescence;
		float iridescenceIOR;
		float iridescenceThickness;
		vec3 iridescenceFresnel;
		vec3 iridescenceF0;
	#endif
	#ifdef USE_SHEEN
		vec3 sheenColor;
		float sheenRoughness;
	#endif
	#ifdef IOR
		float ior;
	#endif
	#ifdef USE_TRANSMISSION
		float transmission;
		float transmissionAlpha;
		float thickness;
		float attenuationDistance;
		vec3 attenuationColor;
	#endif
	#ifdef USE_ANISOTROPY
		float anisotropy;
		float alphaT;
		vec3 anisotropyT;
		vec3 anisotropyB;
	#endif
};
vec3 clearcoatSpecularDirect = vec3( 0.0 );
vec3 clearcoatSpecularIndirect = vec3( 0.0 );
vec3 sheenSpecularDirect = vec3( 0.0 );
vec3 sheenSpecularIndirect = vec3(0.0 );
vec3 Schlick_to_F0( const in vec3 f, const in float f90, const in float dotVH ) {
    float x = clamp( 1.0 - dotVH, 0.0, 1.0 );
    float x2 = x * x;
    float x5 = clamp( x * x2 * x2, 0.0, 0.9999 );
    return ( f - vec3( f90 ) * x5 ) / ( 1.0 - x5 );
}
float V_GGX_SmithCorrelated( const in float alpha, const in float dotNL, const in float dotNV ) {
	float a2 = pow2( alpha );
	float gv = dotNL * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNV ) );
	float gl = dotNV * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNL ) );
	return 0.5 / max( gv + gl, EPSILON );
}
float D_GGX( const in float alpha, const in float dotNH ) {
	float a2 = pow2( alpha );
	float denom = pow2( dotNH ) * ( a2 - 1.0 ) + 1.0;
	return RECIPROCAL_PI * a2 / pow2( denom );
}
#ifdef USE_ANISOTROPY
	float V_GGX_SmithCorrelated_Anisotropic( const in float alphaT, const in float alphaB, const in float dotTV, const in float dotBV, const in float dotTL, const in float dotBL, const in float dotNV, const in float dotNL ) {
		float gv = dotNL * length( vec3( alphaT * dotTV, alphaB * dotBV, dotNV ) );
		float gl = dotNV * length( vec3( alphaT * dotTL, alphaB * dotBL, dotNL ) );
		float v = 0.5 / ( gv + gl );
		return saturate(v);
	}
	float D_GGX_Anisotropic( const in float alphaT, const in float alphaB, const in float dotNH, const in float dotTH, const in float dotBH ) {
		float a2 = alphaT * alphaB;
		highp vec3 v = vec3( alphaB * dotTH, alphaT * dotBH, a2 * dotNH );
		highp float v2 = dot( v, v );
		float w2 = a2 / v2;
		return RECIPROCAL_PI * a2 * pow2 ( w2 );
	}
#endif
#ifdef USE_CLEARCOAT
	vec3 BRDF_GGX_Clearcoat( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material) {
		vec3 f0 = material.clearcoatF0;
		float f90 = material.clearcoatF90;
		float roughness = material.clearcoatRoughness;
		float alpha = pow2( roughness );
		vec3 halfDir = normalize( lightDir + viewDir );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float dotNH = saturate( dot( normal, halfDir ) );
		float dotVH = saturate( dot( viewDir, halfDir ) );
		vec3 F = F_Schlick( f0, f90, dotVH );
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
		return F * ( V * D );
	}
#endif
vec3 BRDF_GGX( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material ) {
	vec3 f0 = material.specularColor;
	float f90 = material.specularF90;
	float roughness = material.roughness;
	float alpha = pow2( roughness );
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( f0, f90, dotVH );
	#ifdef USE_IRIDESCENCE
		F = mix( F, material.iridescenceFresnel, material.iridescence );
	#endif
	#ifdef USE_ANISOTROPY
		float dotTL = dot( material.anisotropyT, lightDir );
		float dotTV = dot( material.anisotropyT, viewDir );
		float dotTH = dot( material.anisotropyT, halfDir );
		float dotBL = dot( material.anisotropyB, lightDir );
		float dotBV = dot( material.anisotropyB, viewDir );
		float dotBH = dot( material.anisotropyB, halfDir );
		float V = V_GGX_SmithCorrelated_Anisotropic( material.alphaT, alpha, dotTV, dotBV, dotTL, dotBL, dotNV, dotNL );
		float D = D_GGX_Anisotropic( material.alphaT, alpha, dotNH, dotTH, dotBH );
	#else
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
	#endif
	return F * ( V * D );
}
vec2 LTC_Uv( const in vec3 N, const in vec3 V, const in float roughness ) {
	const float LUT_SIZE = 64.0;
	const float LUT_SCALE = ( LUT_SIZE - 1.0 ) / LUT_SIZE;
	const float LUT_BIAS = 0.5 / LUT_SIZE;
	float dotNV = saturate( dot( N, V ) );
	vec2 uv = vec2( roughness, sqrt( 1.0 - dotNV ) );
	uv = uv * LUT_SCALE + LUT_BIAS;
	return uv;
}
float LTC_ClippedSphereFormFactor( const in vec3 f ) {
	float l = length( f );
	return max( ( l * l + f.z ) / ( l + 1.0 ), 0.0 );
}
vec3 LTC_EdgeVectorFormFactor( const in vec3 v1, const in vec3 v2 ) {
	float x = dot( v1, v2 );
	float y = abs( x );
	float a = 0.8543985 + ( 0.4965155 + 0.0145206 * y ) * y;
	float b = 3.4175940 + ( 4.1616724 + y ) * y;
	float v = a / b;
	float theta_sintheta = ( x > 0.0 ) ? v : 0.5 * inversesqrt( max( 1.0 - x * x, 1e-7 ) ) - v;
	return cross( v1, v2 ) * theta_sintheta;
}
vec3 LTC_Evaluate( const in vec3 N, const in vec3 V, const in vec3 P, const in mat3 mInv, const in vec3 rectCoords[ 4 ] ) {
	vec3 v1 = rectCoords[ 1 ] - rectCoords[ 0 ];
	vec3 v2 = rectCoords[ 3 ] - rectCoords[ 0 ];
	vec3 lightNormal = cross( v1, v2 );
	if( dot( lightNormal, P - rectCoords[ 0 ] ) < 0.0 ) return vec3( 0.0 );
	vec3 T1, T2;
	T1 = normalize( V - N * dot( V, N ) );
	T2 = - cross( N, T1 );
	mat3 mat = mInv * transposeMat3( mat3( T1, T2, N ) );
	vec3 coords[ 4 ];
	coords[ 0 ] = mat * ( rectCoords[ 0 ] - P );
	coords[ 1 ] = mat * ( rectCoords[ 1 ] - P );
	coords[ 2 ] = mat * ( rectCoords[ 2 ] - P );
	coords[ 3 ] = mat * ( rectCoords[ 3 ] - P );
	coords[ 0 ] = normalize( coords[ 0 ] );
	coords[ 1 ] = normalize( coords[ 1 ] );
	coords[ 2 ] = normalize( coords[ 2 ] );
	coords[ 3 ] = normalize( coords[ 3 ] );
	vec3 vectorFormFactor = vec3( 0.0 );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 0 ], coords[ 1 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 1 ], coords[ 2 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 2 ], coords[ 3 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 3 ], coords[ 0 ] );
	float result = LTC_ClippedSphereFormFactor( vectorFormFactor );
	return vec3( result );
}
#if defined( USE_SHEEN )
float D_Charlie( float roughness, float dotNH ) {
	float alpha = pow2( roughness );
	float invAlpha = 1.0 / alpha;
	float cos2h = dotNH * dotNH;
	float sin2h = max( 1.0 - cos2h, 0.0078125 );
	return ( 2.0 + invAlpha ) * pow( sin2h, invAlpha * 0.5 ) / ( 2.0 * PI );
}
float V_Neubelt( float dotNV, float dotNL ) {
	return saturate( 1.0 / ( 4.0 * ( dotNL + dotNV - dotNL * dotNV ) ) );
}
vec3 BRDF_Sheen( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, vec3 sheenColor, const in float sheenRoughness ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float D = D_Charlie( sheenRoughness, dotNH );
	float V = V_Neubelt( dotNV, dotNL );
	return sheenColor * ( D * V );
}
#endif
float IBLSheenBRDF( const in vec3 normal, const in vec3 viewDir, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	float r2 = roughness * roughness;
	float a = roughness < 0.25 ? -339.2 * r2 + 161.4 * roughness - 25.9 : -8.48 * r2 + 14.3 * roughness - 9.95;
	float b = roughness < 0.25 ? 44.0 * r2 - 23.7 * roughness + 3.26 : 1.97 * r2 - 3.27 * roughness + 0.72;
	float DG = exp( a * dotNV + b ) + ( roughness < 0.25 ? 0.0 : 0.1 * ( roughness - 0.25 ) );
	return saturate( DG * RECIPROCAL_PI );
}
vec2 DFGApprox( const in vec3 normal, const in vec3 viewDir, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	const vec4 c0 = vec4( - 1, - 0.0275, - 0.572, 0.022 );
	const vec4 c1 = vec4( 1, 0.0425, 1.04, - 0.04 );
	vec4 r = roughness * c0 + c1;
	float a004 = min( r.x * r.x, exp2( - 9.28 * dotNV ) ) * r.x + r.y;
	vec2 fab = vec2( - 1.04, 1.04 ) * a004 + r.zw;
	return fab;
}
vec3 EnvironmentBRDF( const in vec3 normal, const in vec3 viewDir, const in vec3 specularColor, const in float specularF90, const in float roughness ) {
	vec2 fab = DFGApprox( normal, viewDir, roughness );
	return specularColor * fab.x + specularF90 * fab.y;
}
#ifdef USE_IRIDESCENCE
void computeMultiscatteringIridescence( const in vec3 normal, const in vec3 viewDir, const in vec3 specularColor, const in float specularF90, const in float iridescence, const in vec3 iridescenceF0, const in float roughness, inout vec3 singleScatter, inout vec3 multiScatter ) {
#else
void computeMultiscattering( const in vec3 normal, const in vec3 viewDir, const in vec3 specularColor, const in float specularF90, const in float roughness, inout vec3 singleScatter, inout vec3 multiScatter ) {
#endif
	vec2 fab = DFGApprox( normal, viewDir, roughness );
	#ifdef USE_IRIDESCENCE
		vec3 Fr = mix( specularColor, iridescenceF0, iridescence );
	#else
		vec3 Fr = specularColor;
	#endif
	vec3 FssEss = Fr * fab.x + specularF90 * fab.y;
	float Ess = fab.x + fab.y;
	float Ems = 1.0 - Ess;
	vec3 Favg = Fr + ( 1.0 - Fr ) * 0.047619;	vec3 Fms = FssEss * Favg / ( 1.0 - Ems * Favg );
	singleScatter += FssEss;
	multiScatter += Fms * Ems;
}
#if NUM_RECT_AREA_LIGHTS > 0
	void RE_Direct_RectArea_Physical( const in RectAreaLight rectAreaLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
		vec3 normal = geometryNormal;
		vec3 viewDir = geometryViewDir;
		vec3 position = geometryPosition;
		vec3 lightPos = rectAreaLight.position;
		vec3 halfWidth = rectAreaLight.halfWidth;
		vec3 halfHeight = rectAreaLight.halfHeight;
		vec3 lightColor = rectAreaLight.color;
		float roughness = material.roughness;
		vec3 rectCoords[ 4 ];
		rectCoords[ 0 ] = lightPos + halfWidth - halfHeight;		rectCoords[ 1 ] = lightPos - halfWidth - halfHeight;
		rectCoords[ 2 ] = lightPos - halfWidth + halfHeight;
		rectCoords[ 3 ] = lightPos + halfWidth + halfHeight;
		vec2 uv = LTC_Uv( normal, viewDir, roughness );
		vec4 t1 = texture2D( ltc_1, uv );
		vec4 t2 = texture2D( ltc_2, uv );
		mat3 mInv = mat3(
			vec3( t1.x, 0, t1.y ),
			vec3(    0, 1,    0 ),
			vec3( t1.z, 0, t1.w )
		);
		vec3 fresnel = ( material.specularColor * t2.x + ( vec3( 1.0 ) - material.specularColor ) * t2.y );
		reflectedLight.directSpecular += lightColor * fresnel * LTC_Evaluate( normal, viewDir, position, mInv, rectCoords );
		reflectedLight.directDiffuse += lightColor * material.diffuseColor * LTC_Evaluate( normal, viewDir, position, mat3( 1.0 ), rectCoords );
	}
#endif
void RE_Direct_Physical( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	#ifdef USE_CLEARCOAT
		float dotNLcc = saturate( dot( geometryClearcoatNormal, directLight.direction ) );
		vec3 ccIrradiance = dotNLcc * directLight.color;
		clearcoatSpecularDirect += ccIrradiance * BRDF_GGX_Clearcoat( directLight.direction, geometryViewDir, geometryClearcoatNormal, material );
	#endif
	#ifdef USE_SHEEN
		sheenSpecularDirect += irradiance * BRDF_Sheen( directLight.direction, geometryViewDir, geometryNormal, material.sheenColor, material.sheenRoughness );
	#endif
	reflectedLight.directSpecular += irradiance * BRDF_GGX( directLight.direction, geometryViewDir, geometryNormal, material );
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Physical( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectSpecular_Physical( const in vec3 radiance, const in vec3 irradiance, const in vec3 clearcoatRadiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight) {
	#ifdef USE_CLEARCOAT
		clearcoatSpecularIndirect += clearcoatRadiance * EnvironmentBRDF( geometryClearcoatNormal, geometryViewDir, material.clearcoatF0, material.clearcoatF90, material.clearcoatRoughness );
	#endif
	#ifdef USE_SHEEN
		sheenSpecularIndirect += irradiance * material.sheenColor * IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
	#endif
	vec3 singleScattering = vec3( 0.0 );
	vec3 multiScattering = vec3( 0.0 );
	vec3 cosineWeightedIrradiance = irradiance * RECIPROCAL_PI;
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( geometryNormal, geometryViewDir, material.specularColor, material.specularF90, material.iridescence, material.iridescenceFresnel, material.roughness, singleScattering, multiScattering );
	#else
		computeMultiscattering( geometryNormal, geometryViewDir, material.specularColor, material.specularF90, material.roughness, singleScattering, multiScattering );
	#endif
	vec3 totalScattering = singleScattering + multiScattering;
	vec3 diffuse = material.diffuseColor * ( 1.0 - max( max( totalScattering.r, totalScattering.g ), totalScattering.b ) );
	reflectedLight.indirectSpecular += radiance * singleScattering;
	reflectedLight.indirectSpecular += multiScattering * cosineWeightedIrradiance;
	reflectedLight.indirectDiffuse += diffuse * cosineWeightedIrradiance;
}
#define RE_Direct				RE_Direct_Physical
#define RE_Direct_RectArea		RE_Direct_RectArea_Physical
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Physical
#define RE_IndirectSpecular		RE_IndirectSpecular_Physical
float computeSpecularOcclusion( const in float dotNV, const in float ambientOcclusion, const in float roughness ) {
	return saturate( pow( dotNV + ambientOcclusion, exp2( - 16.0 * roughness - 1.0 ) ) - 1.0 + ambientOcclusion );
}`,sv=`
vec3 geometryPosition = - vViewPosition;
vec3 geometryNormal = normal;
vec3 geometryViewDir = ( isOrthographic ) ? vec3( 0, 0, 1 ) : normalize( vViewPosition );
vec3 geometryClearcoatNormal = vec3( 0.0 );
#ifdef USE_CLEARCOAT
	geometryClearcoatNormal = clearcoatNormal;
#endif
#ifdef USE_IRIDESCENCE
	float dotNVi = saturate( dot( normal, geometryViewDir ) );
	if ( material.iridescenceThickness == 0.0 ) {
		material.iridescence = 0.0;
	} else {
		material.iridescence = saturate( material.iridescence );
	}
	if ( material.iridescence > 0.0 ) {
		material.iridescenceFresnel = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.specularColor );
		material.iridescenceF0 = Schlick_to_F0( material.iridescenceFresnel, 1.0, dotNVi );
	}
#endif
IncidentLight directLight;
#if ( NUM_POINT_LIGHTS > 0 ) && defined( RE_Direct )
	PointLight pointLight;
	#if defined( USE_SHADOWMAP ) && NUM_POINT_LIGHT_SHADOWS > 0
	PointLightShadow pointLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHTS; i ++ ) {
		pointLight = pointLights[ i ];
		getPointLightInfo( pointLight, geometryPosition, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_POINT_LIGHT_SHADOWS )
		pointLightShadow = pointLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getPointShadow( pointShadowMap[ i ], pointLightShadow.shadowMapSize, pointLightShadow.shadowBias, pointLightShadow.shadowRadius, vPointShadowCoord[ i ], pointLightShadow.shadowCameraNear, pointLightShadow.shadowCameraFar ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SPOT_LIGHTS > 0 ) && defined( RE_Direct )
	SpotLight spotLight;
	vec4 spotColor;
	vec3 spotLightCoord;
	bool inSpotLightMap;
	#if defined( USE_SHADOWMAP ) && NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHTS; i ++ ) {
		spotLight = spotLights[ i ];
		getSpotLightInfo( spotLight, geometryPosition, directLight );
		#if ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#define SPOT_LIGHT_MAP_INDEX UNROLLED_LOOP_INDEX
		#elif ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		#define SPOT_LIGHT_MAP_INDEX NUM_SPOT_LIGHT_MAPS
		#else
		#define SPOT_LIGHT_MAP_INDEX ( UNROLLED_LOOP_INDEX - NUM_SPOT_LIGHT_SHADOWS + NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#endif
		#if ( SPOT_LIGHT_MAP_INDEX < NUM_SPOT_LIGHT_MAPS )
			spotLightCoord = vSpotLightCoord[ i ].xyz / vSpotLightCoord[ i ].w;
			inSpotLightMap = all( lessThan( abs( spotLightCoord * 2. - 1. ), vec3( 1.0 ) ) );
			spotColor = texture2D( spotLightMap[ SPOT_LIGHT_MAP_INDEX ], spotLightCoord.xy );
			directLight.color = inSpotLightMap ? directLight.color * spotColor.rgb : directLight.color;
		#endif
		#undef SPOT_LIGHT_MAP_INDEX
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		spotLightShadow = spotLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( spotShadowMap[ i ], spotLightShadow.shadowMapSize, spotLightShadow.shadowBias, spotLightShadow.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_DIR_LIGHTS > 0 ) && defined( RE_Direct )
	DirectionalLight directionalLight;
	#if defined( USE_SHADOWMAP ) && NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHTS; i ++ ) {
		directionalLight = directionalLights[ i ];
		getDirectionalLightInfo( directionalLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_DIR_LIGHT_SHADOWS )
		directionalLightShadow = directionalLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( directionalShadowMap[ i ], directionalLightShadow.shadowMapSize, directionalLightShadow.shadowBias, directionalLightShadow.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_RECT_AREA_LIGHTS > 0 ) && defined( RE_Direct_RectArea )
	RectAreaLight rectAreaLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_RECT_AREA_LIGHTS; i ++ ) {
		rectAreaLight = rectAreaLights[ i ];
		RE_Direct_RectArea( rectAreaLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if defined( RE_IndirectDiffuse )
	vec3 iblIrradiance = vec3( 0.0 );
	vec3 irradiance = getAmbientLightIrradiance( ambientLightColor );
	#if defined( USE_LIGHT_PROBES )
		irradiance += getLightProbeIrradiance( lightProbe, geometryNormal );
	#endif
	#if ( NUM_HEMI_LIGHTS > 0 )
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_HEMI_LIGHTS; i ++ ) {
			irradiance += getHemisphereLightIrradiance( hemisphereLights[ i ], geometryNormal );
		}
		#pragma unroll_loop_end
	#endif
#endif
#if defined( RE_IndirectSpecular )
	vec3 radiance = vec3( 0.0 );
	vec3 clearcoatRadiance = vec3( 0.0 );
#endif`,rv=`#if defined( RE_IndirectDiffuse )
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		vec3 lightMapIrradiance = lightMapTexel.rgb * lightMapIntensity;
		irradiance += lightMapIrradiance;
	#endif
	#if defined( USE_ENVMAP ) && defined( STANDARD ) && defined( ENVMAP_TYPE_CUBE_UV )
		iblIrradiance += getIBLIrradiance( geometryNormal );
	#endif
#endif
#if defined( USE_ENVMAP ) && defined( RE_IndirectSpecular )
	#ifdef USE_ANISOTROPY
		radiance += getIBLAnisotropyRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
	#else
		radiance += getIBLRadiance( geometryViewDir, geometryNormal, material.roughness );
	#endif
	#ifdef USE_CLEARCOAT
		clearcoatRadiance += getIBLRadiance( geometryViewDir, geometryClearcoatNormal, material.clearcoatRoughness );
	#endif
#endif`,ov=`#if defined( RE_IndirectDiffuse )
	RE_IndirectDiffuse( irradiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif
#if defined( RE_IndirectSpecular )
	RE_IndirectSpecular( radiance, iblIrradiance, clearcoatRadiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif`,av=`#if defined( USE_LOGDEPTHBUF )
	gl_FragDepth = vIsPerspective == 0.0 ? gl_FragCoord.z : log2( vFragDepth ) * logDepthBufFC * 0.5;
#endif`,lv=`#if defined( USE_LOGDEPTHBUF )
	uniform float logDepthBufFC;
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,cv=`#ifdef USE_LOGDEPTHBUF
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,hv=`#ifdef USE_LOGDEPTHBUF
	vFragDepth = 1.0 + gl_Position.w;
	vIsPerspective = float( isPerspectiveMatrix( projectionMatrix ) );
#endif`,uv=`#ifdef USE_MAP
	vec4 sampledDiffuseColor = texture2D( map, vMapUv );
	#ifdef DECODE_VIDEO_TEXTURE
		sampledDiffuseColor = vec4( mix( pow( sampledDiffuseColor.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), sampledDiffuseColor.rgb * 0.0773993808, vec3( lessThanEqual( sampledDiffuseColor.rgb, vec3( 0.04045 ) ) ) ), sampledDiffuseColor.w );
	
	#endif
	diffuseColor *= sampledDiffuseColor;
#endif`,dv=`#ifdef USE_MAP
	uniform sampler2D map;
#endif`,fv=`#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
	#if defined( USE_POINTS_UV )
		vec2 uv = vUv;
	#else
		vec2 uv = ( uvTransform * vec3( gl_PointCoord.x, 1.0 - gl_PointCoord.y, 1 ) ).xy;
	#endif
#endif
#ifdef USE_MAP
	diffuseColor *= texture2D( map, uv );
#endif
#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, uv ).g;
#endif`,pv=`#if defined( USE_POINTS_UV )
	varying vec2 vUv;
#else
	#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
		uniform mat3 uvTransform;
	#endif
#endif
#ifdef USE_MAP
	uniform sampler2D map;
#endif
#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,mv=`float metalnessFactor = metalness;
#ifdef USE_METALNESSMAP
	vec4 texelMetalness = texture2D( metalnessMap, vMetalnessMapUv );
	metalnessFactor *= texelMetalness.b;
#endif`,gv=`#ifdef USE_METALNESSMAP
	uniform sampler2D metalnessMap;
#endif`,_v=`#ifdef USE_INSTANCING_MORPH
	float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	float morphTargetBaseInfluence = texelFetch( morphTexture, ivec2( 0, gl_InstanceID ), 0 ).r;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		morphTargetInfluences[i] =  texelFetch( morphTexture, ivec2( i + 1, gl_InstanceID ), 0 ).r;
	}
#endif`,vv=`#if defined( USE_MORPHCOLORS )
	vColor *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		#if defined( USE_COLOR_ALPHA )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor += getMorph( gl_VertexID, i, 2 ) * morphTargetInfluences[ i ];
		#elif defined( USE_COLOR )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor += getMorph( gl_VertexID, i, 2 ).rgb * morphTargetInfluences[ i ];
		#endif
	}
#endif`,yv=`#ifdef USE_MORPHNORMALS
	objectNormal *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) objectNormal += getMorph( gl_VertexID, i, 1 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,xv=`#ifdef USE_MORPHTARGETS
	#ifndef USE_INSTANCING_MORPH
		uniform float morphTargetBaseInfluence;
		uniform float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	#endif
	uniform sampler2DArray morphTargetsTexture;
	uniform ivec2 morphTargetsTextureSize;
	vec4 getMorph( const in int vertexIndex, const in int morphTargetIndex, const in int offset ) {
		int texelIndex = vertexIndex * MORPHTARGETS_TEXTURE_STRIDE + offset;
		int y = texelIndex / morphTargetsTextureSize.x;
		int x = texelIndex - y * morphTargetsTextureSize.x;
		ivec3 morphUV = ivec3( x, y, morphTargetIndex );
		return texelFetch( morphTargetsTexture, morphUV, 0 );
	}
#endif`,Mv=`#ifdef USE_MORPHTARGETS
	transformed *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) transformed += getMorph( gl_VertexID, i, 0 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,bv=`float faceDirection = gl_FrontFacing ? 1.0 : - 1.0;
#ifdef FLAT_SHADED
	vec3 fdx = dFdx( vViewPosition );
	vec3 fdy = dFdy( vViewPosition );
	vec3 normal = normalize( cross( fdx, fdy ) );
#else
	vec3 normal = normalize( vNormal );
	#ifdef DOUBLE_SIDED
		normal *= faceDirection;
	#endif
#endif
#if defined( USE_NORMALMAP_TANGENTSPACE ) || defined( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY )
	#ifdef USE_TANGENT
		mat3 tbn = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn = getTangentFrame( - vViewPosition, normal,
		#if defined( USE_NORMALMAP )
			vNormalMapUv
		#elif defined( USE_CLEARCOAT_NORMALMAP )
			vClearcoatNormalMapUv
		#else
			vUv
		#endif
		);
	#endif
	#if defined( DOUBLE_SIDED ) && ! defined( FLAT_SHADED )
		tbn[0] *= faceDirection;
		tbn[1] *= faceDirection;
	#endif
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	#ifdef USE_TANGENT
		mat3 tbn2 = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn2 = getTangentFrame( - vViewPosition, normal, vClearcoatNormalMapUv );
	#endif
	#if defined( DOUBLE_SIDED ) && ! defined( FLAT_SHADED )
		tbn2[0] *= faceDirection;
		tbn2[1] *= faceDirection;
	#endif
#endif
vec3 nonPerturbedNormal = normal;`,wv=`#ifdef USE_NORMALMAP_OBJECTSPACE
	normal = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#ifdef FLIP_SIDED
		normal = - normal;
	#endif
	#ifdef DOUBLE_SIDED
		normal = normal * faceDirection;
	#endif
	normal = normalize( normalMatrix * normal );
#elif defined( USE_NORMALMAP_TANGENTSPACE )
	vec3 mapN = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	mapN.xy *= normalScale;
	normal = normalize( tbn * mapN );
#elif defined( USE_BUMPMAP )
	normal = perturbNormalArb( - vViewPosition, normal, dHdxy_fwd(), faceDirection );
#endif`,Sv=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,Ev=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,Tv=`#ifndef FLAT_SHADED
	vNormal = normalize( transformedNormal );
	#ifdef USE_TANGENT
		vTangent = normalize( transformedTangent );
		vBitangent = normalize( cross( vNormal, vTangent ) * tangent.w );
	#endif
#endif`,Av=`#ifdef USE_NORMALMAP
	uniform sampler2D normalMap;
	uniform vec2 normalScale;
#endif
#ifdef USE_NORMALMAP_OBJECTSPACE
	uniform mat3 normalMatrix;
#endif
#if ! defined ( USE_TANGENT ) && ( defined ( USE_NORMALMAP_TANGENTSPACE ) || defined ( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY ) )
	mat3 getTangentFrame( vec3 eye_pos, vec3 surf_norm, vec2 uv ) {
		vec3 q0 = dFdx( eye_pos.xyz );
		vec3 q1 = dFdy( eye_pos.xyz );
		vec2 st0 = dFdx( uv.st );
		vec2 st1 = dFdy( uv.st );
		vec3 N = surf_norm;
		vec3 q1perp = cross( q1, N );
		vec3 q0perp = cross( N, q0 );
		vec3 T = q1perp * st0.x + q0perp * st1.x;
		vec3 B = q1perp * st0.y + q0perp * st1.y;
		float det = max( dot( T, T ), dot( B, B ) );
		float scale = ( det == 0.0 ) ? 0.0 : inversesqrt( det );
		return mat3( T * scale, B * scale, N );
	}
#endif`,Cv=`#ifdef USE_CLEARCOAT
	vec3 clearcoatNormal = nonPerturbedNormal;
#endif`,Rv=`#ifdef USE_CLEARCOAT_NORMALMAP
	vec3 clearcoatMapN = texture2D( clearcoatNormalMap, vClearcoatNormalMapUv ).xyz * 2.0 - 1.0;
	clearcoatMapN.xy *= clearcoatNormalScale;
	clearcoatNormal = normalize( tbn2 * clearcoatMapN );
#endif`,Pv=`#ifdef USE_CLEARCOATMAP
	uniform sampler2D clearcoatMap;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform sampler2D clearcoatNormalMap;
	uniform vec2 clearcoatNormalScale;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform sampler2D clearcoatRoughnessMap;
#endif`,Lv=`#ifdef USE_IRIDESCENCEMAP
	uniform sampler2D iridescenceMap;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform sampler2D iridescenceThicknessMap;
#endif`,Iv=`#ifdef OPAQUE
diffuseColor.a = 1.0;
#endif
#ifdef USE_TRANSMISSION
diffuseColor.a *= material.transmissionAlpha;
#endif
gl_FragColor = vec4( outgoingLight, diffuseColor.a );`,Dv=`vec3 packNormalToRGB( const in vec3 normal ) {
	return normalize( normal ) * 0.5 + 0.5;
}
vec3 unpackRGBToNormal( const in vec3 rgb ) {
	return 2.0 * rgb.xyz - 1.0;
}
const float PackUpscale = 256. / 255.;const float UnpackDownscale = 255. / 256.;
const vec3 PackFactors = vec3( 256. * 256. * 256., 256. * 256., 256. );
const vec4 UnpackFactors = UnpackDownscale / vec4( PackFactors, 1. );
const float ShiftRight8 = 1. / 256.;
vec4 packDepthToRGBA( const in float v ) {
	vec4 r = vec4( fract( v * PackFactors ), v );
	r.yzw -= r.xyz * ShiftRight8;	return r * PackUpscale;
}
float unpackRGBAToDepth( const in vec4 v ) {
	return dot( v, UnpackFactors );
}
vec2 packDepthToRG( in highp float v ) {
	return packDepthToRGBA( v ).yx;
}
float unpackRGToDepth( const in highp vec2 v ) {
	return unpackRGBAToDepth( vec4( v.xy, 0.0, 0.0 ) );
}
vec4 pack2HalfToRGBA( vec2 v ) {
	vec4 r = vec4( v.x, fract( v.x * 255.0 ), v.y, fract( v.y * 255.0 ) );
	return vec4( r.x - r.y / 255.0, r.y, r.z - r.w / 255.0, r.w );
}
vec2 unpackRGBATo2Half( vec4 v ) {
	return vec2( v.x + ( v.y / 255.0 ), v.z + ( v.w / 255.0 ) );
}
float viewZToOrthographicDepth( const in float viewZ, const in float near, const in float far ) {
	return ( viewZ + near ) / ( near - far );
}
float orthographicDepthToViewZ( const in float depth, const in float near, const in float far ) {
	return depth * ( near - far ) - near;
}
float viewZToPerspectiveDepth( const in float viewZ, const in float near, const in float far ) {
	return ( ( near + viewZ ) * far ) / ( ( far - near ) * viewZ );
}
float perspectiveDepthToViewZ( const in float depth, const in float near, const in float far ) {
	return ( near * far ) / ( ( far - near ) * depth - far );
}`,Nv=`#ifdef PREMULTIPLIED_ALPHA
	gl_FragColor.rgb *= gl_FragColor.a;
#endif`,Uv=`vec4 mvPosition = vec4( transformed, 1.0 );
#ifdef USE_BATCHING
	mvPosition = batchingMatrix * mvPosition;
#endif
#ifdef USE_INSTANCING
	mvPosition = instanceMatrix * mvPosition;
#endif
mvPosition = modelViewMatrix * mvPosition;
gl_Position = projectionMatrix * mvPosition;`,Ov=`#ifdef DITHERING
	gl_FragColor.rgb = dithering( gl_FragColor.rgb );
#endif`,Fv=`#ifdef DITHERING
	vec3 dithering( vec3 color ) {
		float grid_position = rand( gl_FragCoord.xy );
		vec3 dither_shift_RGB = vec3( 0.25 / 255.0, -0.25 / 255.0, 0.25 / 255.0 );
		dither_shift_RGB = mix( 2.0 * dither_shift_RGB, -2.0 * dither_shift_RGB, grid_position );
		return color + dither_shift_RGB;
	}
#endif`,kv=`float roughnessFactor = roughness;
#ifdef USE_ROUGHNESSMAP
	vec4 texelRoughness = texture2D( roughnessMap, vRoughnessMapUv );
	roughnessFactor *= texelRoughness.g;
#endif`,Bv=`#ifdef USE_ROUGHNESSMAP
	uniform sampler2D roughnessMap;
#endif`,zv=`#if NUM_SPOT_LIGHT_COORDS > 0
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#if NUM_SPOT_LIGHT_MAPS > 0
	uniform sampler2D spotLightMap[ NUM_SPOT_LIGHT_MAPS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_DIR_LIGHT_SHADOWS > 0
		uniform sampler2D directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		uniform sampler2D spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		struct SpotLightShadow {
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		uniform sampler2D pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
	float texture2DCompare( sampler2D depths, vec2 uv, float compare ) {
		return step( compare, unpackRGBAToDepth( texture2D( depths, uv ) ) );
	}
	vec2 texture2DDistribution( sampler2D shadow, vec2 uv ) {
		return unpackRGBATo2Half( texture2D( shadow, uv ) );
	}
	float VSMShadow (sampler2D shadow, vec2 uv, float compare ){
		float occlusion = 1.0;
		vec2 distribution = texture2DDistribution( shadow, uv );
		float hard_shadow = step( compare , distribution.x );
		if (hard_shadow != 1.0 ) {
			float distance = compare - distribution.x ;
			float variance = max( 0.00000, distribution.y * distribution.y );
			float softness_probability = variance / (variance + distance * distance );			softness_probability = clamp( ( softness_probability - 0.3 ) / ( 0.95 - 0.3 ), 0.0, 1.0 );			occlusion = clamp( max( hard_shadow, softness_probability ), 0.0, 1.0 );
		}
		return occlusion;
	}
	float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
		float shadow = 1.0;
		shadowCoord.xyz /= shadowCoord.w;
		shadowCoord.z += shadowBias;
		bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
		bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
		if ( frustumTest ) {
		#if defined( SHADOWMAP_TYPE_PCF )
			vec2 texelSize = vec2( 1.0 ) / shadowMapSize;
			float dx0 = - texelSize.x * shadowRadius;
			float dy0 = - texelSize.y * shadowRadius;
			float dx1 = + texelSize.x * shadowRadius;
			float dy1 = + texelSize.y * shadowRadius;
			float dx2 = dx0 / 2.0;
			float dy2 = dy0 / 2.0;
			float dx3 = dx1 / 2.0;
			float dy3 = dy1 / 2.0;
			shadow = (
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( dx0, dy0 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( 0.0, dy0 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( dx1, dy0 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( dx2, dy2 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( 0.0, dy2 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( dx3, dy2 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( dx0, 0.0 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( dx2, 0.0 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy, shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( dx3, 0.0 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( dx1, 0.0 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( dx2, dy3 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( 0.0, dy3 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( dx3, dy3 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( dx0, dy1 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( 0.0, dy1 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( dx1, dy1 ), shadowCoord.z )
			) * ( 1.0 / 17.0 );
		#elif defined( SHADOWMAP_TYPE_PCF_SOFT )
			vec2 texelSize = vec2( 1.0 ) / shadowMapSize;
			float dx = texelSize.x;
			float dy = texelSize.y;
			vec2 uv = shadowCoord.xy;
			vec2 f = fract( uv * shadowMapSize + 0.5 );
			uv -= f * texelSize;
			shadow = (
				texture2DCompare( shadowMap, uv, shadowCoord.z ) +
				texture2DCompare( shadowMap, uv + vec2( dx, 0.0 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, uv + vec2( 0.0, dy ), shadowCoord.z ) +
				texture2DCompare( shadowMap, uv + texelSize, shadowCoord.z ) +
				mix( texture2DCompare( shadowMap, uv + vec2( -dx, 0.0 ), shadowCoord.z ),
					 texture2DCompare( shadowMap, uv + vec2( 2.0 * dx, 0.0 ), shadowCoord.z ),
					 f.x ) +
				mix( texture2DCompare( shadowMap, uv + vec2( -dx, dy ), shadowCoord.z ),
					 texture2DCompare( shadowMap, uv + vec2( 2.0 * dx, dy ), shadowCoord.z ),
					 f.x ) +
				mix( texture2DCompare( shadowMap, uv + vec2( 0.0, -dy ), shadowCoord.z ),
					 texture2DCompare( shadowMap, uv + vec2( 0.0, 2.0 * dy ), shadowCoord.z ),
					 f.y ) +
				mix( texture2DCompare( shadowMap, uv + vec2( dx, -dy ), shadowCoord.z ),
					 texture2DCompare( shadowMap, uv + vec2( dx, 2.0 * dy ), shadowCoord.z ),
					 f.y ) +
				mix( mix( texture2DCompare( shadowMap, uv + vec2( -dx, -dy ), shadowCoord.z ),
						  texture2DCompare( shadowMap, uv + vec2( 2.0 * dx, -dy ), shadowCoord.z ),
						  f.x ),
					 mix( texture2DCompare( shadowMap, uv + vec2( -dx, 2.0 * dy ), shadowCoord.z ),
						  texture2DCompare( shadowMap, uv + vec2( 2.0 * dx, 2.0 * dy ), shadowCoord.z ),
						  f.x ),
					 f.y )
			) * ( 1.0 / 9.0 );
		#elif defined( SHADOWMAP_TYPE_VSM )
			shadow = VSMShadow( shadowMap, shadowCoord.xy, shadowCoord.z );
		#else
			shadow = texture2DCompare( shadowMap, shadowCoord.xy, shadowCoord.z );
		#endif
		}
		return shadow;
	}
	vec2 cubeToUV( vec3 v, float texelSizeY ) {
		vec3 absV = abs( v );
		float scaleToCube = 1.0 / max( absV.x, max( absV.y, absV.z ) );
		absV *= scaleToCube;
		v *= scaleToCube * ( 1.0 - 2.0 * texelSizeY );
		vec2 planar = v.xy;
		float almostATexel = 1.5 * texelSizeY;
		float almostOne = 1.0 - almostATexel;
		if ( absV.z >= almostOne ) {
			if ( v.z > 0.0 )
				planar.x = 4.0 - v.x;
		} else if ( absV.x >= almostOne ) {
			float signX = sign( v.x );
			planar.x = v.z * signX + 2.0 * signX;
		} else if ( absV.y >= almostOne ) {
			float signY = sign( v.y );
			planar.x = v.x + 2.0 * signY + 2.0;
			planar.y = v.z * signY - 2.0;
		}
		return vec2( 0.125, 0.25 ) * planar + vec2( 0.375, 0.75 );
	}
	float getPointShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		
		float lightToPositionLength = length( lightToPosition );
		if ( lightToPositionLength - shadowCameraFar <= 0.0 && lightToPositionLength - shadowCameraNear >= 0.0 ) {
			float dp = ( lightToPositionLength - shadowCameraNear ) / ( shadowCameraFar - shadowCameraNear );			dp += shadowBias;
			vec3 bd3D = normalize( lightToPosition );
			vec2 texelSize = vec2( 1.0 ) / ( shadowMapSize * vec2( 4.0, 2.0 ) );
			#if defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_PCF_SOFT ) || defined( SHADOWMAP_TYPE_VSM )
				vec2 offset = vec2( - 1, 1 ) * shadowRadius * texelSize.y;
				shadow = (
					texture2DCompare( shadowMap, cubeToUV( bd3D + offset.xyy, texelSize.y ), dp ) +
					texture2DCompare( shadowMap, cubeToUV( bd3D + offset.yyy, texelSize.y ), dp ) +
					texture2DCompare( shadowMap, cubeToUV( bd3D + offset.xyx, texelSize.y ), dp ) +
					texture2DCompare( shadowMap, cubeToUV( bd3D + offset.yyx, texelSize.y ), dp ) +
					texture2DCompare( shadowMap, cubeToUV( bd3D, texelSize.y ), dp ) +
					texture2DCompare( shadowMap, cubeToUV( bd3D + offset.xxy, texelSize.y ), dp ) +
					texture2DCompare( shadowMap, cubeToUV( bd3D + offset.yxy, texelSize.y ), dp ) +
					texture2DCompare( shadowMap, cubeToUV( bd3D + offset.xxx, texelSize.y ), dp ) +
					texture2DCompare( shadowMap, cubeToUV( bd3D + offset.yxx, texelSize.y ), dp )
				) * ( 1.0 / 9.0 );
			#else
				shadow = texture2DCompare( shadowMap, cubeToUV( bd3D, texelSize.y ), dp );
			#endif
		}
		return shadow;
	}
#endif`,Vv=`#if NUM_SPOT_LIGHT_COORDS > 0
	uniform mat4 spotLightMatrix[ NUM_SPOT_LIGHT_COORDS ];
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_DIR_LIGHT_SHADOWS > 0
		uniform mat4 directionalShadowMatrix[ NUM_DIR_LIGHT_SHADOWS ];
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		struct SpotLightShadow {
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		uniform mat4 pointShadowMatrix[ NUM_POINT_LIGHT_SHADOWS ];
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
#endif`,Hv=`#if ( defined( USE_SHADOWMAP ) && ( NUM_DIR_LIGHT_SHADOWS > 0 || NUM_POINT_LIGHT_SHADOWS > 0 ) ) || ( NUM_SPOT_LIGHT_COORDS > 0 )
	vec3 shadowWorldNormal = inverseTransformDirection( transformedNormal, viewMatrix );
	vec4 shadowWorldPosition;
#endif
#if defined( USE_SHADOWMAP )
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * directionalLightShadows[ i ].shadowNormalBias, 0 );
			vDirectionalShadowCoord[ i ] = directionalShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * pointLightShadows[ i ].shadowNormalBias, 0 );
			vPointShadowCoord[ i ] = pointShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
#endif
#if NUM_SPOT_LIGHT_COORDS > 0
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_COORDS; i ++ ) {
		shadowWorldPosition = worldPosition;
		#if ( defined( USE_SHADOWMAP ) && UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
			shadowWorldPosition.xyz += shadowWorldNormal * spotLightShadows[ i ].shadowNormalBias;
		#endif
		vSpotLightCoord[ i ] = spotLightMatrix[ i ] * shadowWorldPosition;
	}
	#pragma unroll_loop_end
#endif`,Gv=`float getShadowMask() {
	float shadow = 1.0;
	#ifdef USE_SHADOWMAP
	#if NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
		directionalLight = directionalLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( directionalShadowMap[ i ], directionalLight.shadowMapSize, directionalLight.shadowBias, directionalLight.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_SHADOWS; i ++ ) {
		spotLight = spotLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( spotShadowMap[ i ], spotLight.shadowMapSize, spotLight.shadowBias, spotLight.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
	PointLightShadow pointLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
		pointLight = pointLightShadows[ i ];
		shadow *= receiveShadow ? getPointShadow( pointShadowMap[ i ], pointLight.shadowMapSize, pointLight.shadowBias, pointLight.shadowRadius, vPointShadowCoord[ i ], pointLight.shadowCameraNear, pointLight.shadowCameraFar ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#endif
	return shadow;
}`,Wv=`#ifdef USE_SKINNING
	mat4 boneMatX = getBoneMatrix( skinIndex.x );
	mat4 boneMatY = getBoneMatrix( skinIndex.y );
	mat4 boneMatZ = getBoneMatrix( skinIndex.z );
	mat4 boneMatW = getBoneMatrix( skinIndex.w );
#endif`,Xv=`#ifdef USE_SKINNING
	uniform mat4 bindMatrix;
	uniform mat4 bindMatrixInverse;
	uniform highp sampler2D boneTexture;
	mat4 getBoneMatrix( const in float i ) {
		int size = textureSize( boneTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( boneTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( boneTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( boneTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( boneTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
#endif`,$v=`#ifdef USE_SKINNING
	vec4 skinVertex = bindMatrix * vec4( transformed, 1.0 );
	vec4 skinned = vec4( 0.0 );
	skinned += boneMatX * skinVertex * skinWeight.x;
	skinned += boneMatY * skinVertex * skinWeight.y;
	skinned += boneMatZ * skinVertex * skinWeight.z;
	skinned += boneMatW * skinVertex * skinWeight.w;
	transformed = ( bindMatrixInverse * skinned ).xyz;
#endif`,qv=`#ifdef USE_SKINNING
	mat4 skinMatrix = mat4( 0.0 );
	skinMatrix += skinWeight.x * boneMatX;
	skinMatrix += skinWeight.y * boneMatY;
	skinMatrix += skinWeight.z * boneMatZ;
	skinMatrix += skinWeight.w * boneMatW;
	skinMatrix = bindMatrixInverse * skinMatrix * bindMatrix;
	objectNormal = vec4( skinMatrix * vec4( objectNormal, 0.0 ) ).xyz;
	#ifdef USE_TANGENT
		objectTangent = vec4( skinMatrix * vec4( objectTangent, 0.0 ) ).xyz;
	#endif
#endif`,Yv=`float specularStrength;
#ifdef USE_SPECULARMAP
	vec4 texelSpecular = texture2D( specularMap, vSpecularMapUv );
	specularStrength = texelSpecular.r;
#else
	specularStrength = 1.0;
#endif`,Zv=`#ifdef USE_SPECULARMAP
	uniform sampler2D specularMap;
#endif`,Jv=`#if defined( TONE_MAPPING )
	gl_FragColor.rgb = toneMapping( gl_FragColor.rgb );
#endif`,Kv=`#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
uniform float toneMappingExposure;
vec3 LinearToneMapping( vec3 color ) {
	return saturate( toneMappingExposure * color );
}
vec3 ReinhardToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	return saturate( color / ( vec3( 1.0 ) + color ) );
}
vec3 OptimizedCineonToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	color = max( vec3( 0.0 ), color - 0.004 );
	return pow( ( color * ( 6.2 * color + 0.5 ) ) / ( color * ( 6.2 * color + 1.7 ) + 0.06 ), vec3( 2.2 ) );
}
vec3 RRTAndODTFit( vec3 v ) {
	vec3 a = v * ( v + 0.0245786 ) - 0.000090537;
	vec3 b = v * ( 0.983729 * v + 0.4329510 ) + 0.238081;
	return a / b;
}
vec3 ACESFilmicToneMapping( vec3 color ) {
	const mat3 ACESInputMat = mat3(
		vec3( 0.59719, 0.07600, 0.02840 ),		vec3( 0.35458, 0.90834, 0.13383 ),
		vec3( 0.04823, 0.01566, 0.83777 )
	);
	const mat3 ACESOutputMat = mat3(
		vec3(  1.60475, -0.10208, -0.00327 ),		vec3( -0.53108,  1.10813, -0.07276 ),
		vec3( -0.07367, -0.00605,  1.07602 )
	);
	color *= toneMappingExposure / 0.6;
	color = ACESInputMat * color;
	color = RRTAndODTFit( color );
	color = ACESOutputMat * color;
	return saturate( color );
}
const mat3 LINEAR_REC2020_TO_LINEAR_SRGB = mat3(
	vec3( 1.6605, - 0.1246, - 0.0182 ),
	vec3( - 0.5876, 1.1329, - 0.1006 ),
	vec3( - 0.0728, - 0.0083, 1.1187 )
);
const mat3 LINEAR_SRGB_TO_LINEAR_REC2020 = mat3(
	vec3( 0.6274, 0.0691, 0.0164 ),
	vec3( 0.3293, 0.9195, 0.0880 ),
	vec3( 0.0433, 0.0113, 0.8956 )
);
vec3 agxDefaultContrastApprox( vec3 x ) {
	vec3 x2 = x * x;
	vec3 x4 = x2 * x2;
	return + 15.5 * x4 * x2
		- 40.14 * x4 * x
		+ 31.96 * x4
		- 6.868 * x2 * x
		+ 0.4298 * x2
		+ 0.1191 * x
		- 0.00232;
}
vec3 AgXToneMapping( vec3 color ) {
	const mat3 AgXInsetMatrix = mat3(
		vec3( 0.856627153315983, 0.137318972929847, 0.11189821299995 ),
		vec3( 0.0951212405381588, 0.761241990602591, 0.0767994186031903 ),
		vec3( 0.0482516061458583, 0.101439036467562, 0.811302368396859 )
	);
	const mat3 AgXOutsetMatrix = mat3(
		vec3( 1.1271005818144368, - 0.1413297634984383, - 0.14132976349843826 ),
		vec3( - 0.11060664309660323, 1.157823702216272, - 0.11060664309660294 ),
		vec3( - 0.016493938717834573, - 0.016493938717834257, 1.2519364065950405 )
	);
	const float AgxMinEv = - 12.47393;	const float AgxMaxEv = 4.026069;
	color *= toneMappingExposure;
	color = LINEAR_SRGB_TO_LINEAR_REC2020 * color;
	color = AgXInsetMatrix * color;
	color = max( color, 1e-10 );	color = log2( color );
	color = ( color - AgxMinEv ) / ( AgxMaxEv - AgxMinEv );
	color = clamp( color, 0.0, 1.0 );
	color = agxDefaultContrastApprox( color );
	color = AgXOutsetMatrix * color;
	color = pow( max( vec3( 0.0 ), color ), vec3( 2.2 ) );
	color = LINEAR_REC2020_TO_LINEAR_SRGB * color;
	color = clamp( color, 0.0, 1.0 );
	return color;
}
vec3 NeutralToneMapping( vec3 color ) {
	const float StartCompression = 0.8 - 0.04;
	const float Desaturation = 0.15;
	color *= toneMappingExposure;
	float x = min( color.r, min( color.g, color.b ) );
	float offset = x < 0.08 ? x - 6.25 * x * x : 0.04;
	color -= offset;
	float peak = max( color.r, max( color.g, color.b ) );
	if ( peak < StartCompression ) return color;
	float d = 1. - StartCompression;
	float newPeak = 1. - d * d / ( peak + d - StartCompression );
	color *= newPeak / peak;
	float g = 1. - 1. / ( Desaturation * ( peak - newPeak ) + 1. );
	return mix( color, vec3( newPeak ), g );
}
vec3 CustomToneMapping( vec3 color ) { return color; }`,jv=`#ifdef USE_TRANSMISSION
	material.transmission = transmission;
	material.transmissionAlpha = 1.0;
	material.thickness = thickness;
	material.attenuationDistance = attenuationDistance;
	material.attenuationColor = attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		material.transmission *= texture2D( transmissionMap, vTransmissionMapUv ).r;
	#endif
	#ifdef USE_THICKNESSMAP
		material.thickness *= texture2D( thicknessMap, vThicknessMapUv ).g;
	#endif
	vec3 pos = vWorldPosition;
	vec3 v = normalize( cameraPosition - pos );
	vec3 n = inverseTransformDirection( normal, viewMatrix );
	vec4 transmitted = getIBLVolumeRefraction(
		n, v, material.roughness, material.diffuseColor, material.specularColor, material.specularF90,
		pos, modelMatrix, viewMatrix, projectionMatrix, material.dispersion, material.ior, material.thickness,
		material.attenuationColor, material.attenuationDistance );
	material.transmissionAlpha = mix( material.transmissionAlpha, transmitted.a, material.transmission );
	totalDiffuse = mix( totalDiffuse, transmitted.rgb, material.transmission );
#endif`,Qv=`#ifdef USE_TRANSMISSION
	uniform float transmission;
	uniform float thickness;
	uniform float attenuationDistance;
	uniform vec3 attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		uniform sampler2D transmissionMap;
	#endif
	#ifdef USE_THICKNESSMAP
		uniform sampler2D thicknessMap;
	#endif
	uniform vec2 transmissionSamplerSize;
	uniform sampler2D transmissionSamplerMap;
	uniform mat4 modelMatrix;
	uniform mat4 projectionMatrix;
	varying vec3 vWorldPosition;
	float w0( float a ) {
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - a + 3.0 ) - 3.0 ) + 1.0 );
	}
	float w1( float a ) {
		return ( 1.0 / 6.0 ) * ( a *  a * ( 3.0 * a - 6.0 ) + 4.0 );
	}
	float w2( float a ){
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - 3.0 * a + 3.0 ) + 3.0 ) + 1.0 );
	}
	float w3( float a ) {
		return ( 1.0 / 6.0 ) * ( a * a * a );
	}
	float g0( float a ) {
		return w0( a ) + w1( a );
	}
	float g1( float a ) {
		return w2( a ) + w3( a );
	}
	float h0( float a ) {
		return - 1.0 + w1( a ) / ( w0( a ) + w1( a ) );
	}
	float h1( float a ) {
		return 1.0 + w3( a ) / ( w2( a ) + w3( a ) );
	}
	vec4 bicubic( sampler2D tex, vec2 uv, vec4 texelSize, float lod ) {
		uv = uv * texelSize.zw + 0.5;
		vec2 iuv = floor( uv );
		vec2 fuv = fract( uv );
		float g0x = g0( fuv.x );
		float g1x = g1( fuv.x );
		float h0x = h0( fuv.x );
		float h1x = h1( fuv.x );
		float h0y = h0( fuv.y );
		float h1y = h1( fuv.y );
		vec2 p0 = ( vec2( iuv.x + h0x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p1 = ( vec2( iuv.x + h1x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p2 = ( vec2( iuv.x + h0x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		vec2 p3 = ( vec2( iuv.x + h1x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		return g0( fuv.y ) * ( g0x * textureLod( tex, p0, lod ) + g1x * textureLod( tex, p1, lod ) ) +
			g1( fuv.y ) * ( g0x * textureLod( tex, p2, lod ) + g1x * textureLod( tex, p3, lod ) );
	}
	vec4 textureBicubic( sampler2D sampler, vec2 uv, float lod ) {
		vec2 fLodSize = vec2( textureSize( sampler, int( lod ) ) );
		vec2 cLodSize = vec2( textureSize( sampler, int( lod + 1.0 ) ) );
		vec2 fLodSizeInv = 1.0 / fLodSize;
		vec2 cLodSizeInv = 1.0 / cLodSize;
		vec4 fSample = bicubic( sampler, uv, vec4( fLodSizeInv, fLodSize ), floor( lod ) );
		vec4 cSample = bicubic( sampler, uv, vec4( cLodSizeInv, cLodSize ), ceil( lod ) );
		return mix( fSample, cSample, fract( lod ) );
	}
	vec3 getVolumeTransmissionRay( const in vec3 n, const in vec3 v, const in float thickness, const in float ior, const in mat4 modelMatrix ) {
		vec3 refractionVector = refract( - v, normalize( n ), 1.0 / ior );
		vec3 modelScale;
		modelScale.x = length( vec3( modelMatrix[ 0 ].xyz ) );
		modelScale.y = length( vec3( modelMatrix[ 1 ].xyz ) );
		modelScale.z = length( vec3( modelMatrix[ 2 ].xyz ) );
		return normalize( refractionVector ) * thickness * modelScale;
	}
	float applyIorToRoughness( const in float roughness, const in float ior ) {
		return roughness * clamp( ior * 2.0 - 2.0, 0.0, 1.0 );
	}
	vec4 getTransmissionSample( const in vec2 fragCoord, const in float roughness, const in float ior ) {
		float lod = log2( transmissionSamplerSize.x ) * applyIorToRoughness( roughness, ior );
		return textureBicubic( transmissionSamplerMap, fragCoord.xy, lod );
	}
	vec3 volumeAttenuation( const in float transmissionDistance, const in vec3 attenuationColor, const in float attenuationDistance ) {
		if ( isinf( attenuationDistance ) ) {
			return vec3( 1.0 );
		} else {
			vec3 attenuationCoefficient = -log( attenuationColor ) / attenuationDistance;
			vec3 transmittance = exp( - attenuationCoefficient * transmissionDistance );			return transmittance;
		}
	}
	vec4 getIBLVolumeRefraction( const in vec3 n, const in vec3 v, const in float roughness, const in vec3 diffuseColor,
		const in vec3 specularColor, const in float specularF90, const in vec3 position, const in mat4 modelMatrix,
		const in mat4 viewMatrix, const in mat4 projMatrix, const in float dispersion, const in float ior, const in float thickness,
		const in vec3 attenuationColor, const in float attenuationDistance ) {
		vec4 transmittedLight;
		vec3 transmittance;
		#ifdef USE_DISPERSION
			float halfSpread = ( ior - 1.0 ) * 0.025 * dispersion;
			vec3 iors = vec3( ior - halfSpread, ior, ior + halfSpread );
			for ( int i = 0; i < 3; i ++ ) {
				vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, iors[ i ], modelMatrix );
				vec3 refractedRayExit = position + transmissionRay;
		
				vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
				vec2 refractionCoords = ndcPos.xy / ndcPos.w;
				refractionCoords += 1.0;
				refractionCoords /= 2.0;
		
				vec4 transmissionSample = getTransmissionSample( refractionCoords, roughness, iors[ i ] );
				transmittedLight[ i ] = transmissionSample[ i ];
				transmittedLight.a += transmissionSample.a;
				transmittance[ i ] = diffuseColor[ i ] * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance )[ i ];
			}
			transmittedLight.a /= 3.0;
		
		#else
		
			vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, ior, modelMatrix );
			vec3 refractedRayExit = position + transmissionRay;
			vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
			vec2 refractionCoords = ndcPos.xy / ndcPos.w;
			refractionCoords += 1.0;
			refractionCoords /= 2.0;
			transmittedLight = getTransmissionSample( refractionCoords, roughness, ior );
			transmittance = diffuseColor * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance );
		
		#endif
		vec3 attenuatedColor = transmittance * transmittedLight.rgb;
		vec3 F = EnvironmentBRDF( n, v, specularColor, specularF90, roughness );
		float transmittanceFactor = ( transmittance.r + transmittance.g + transmittance.b ) / 3.0;
		return vec4( ( 1.0 - F ) * attenuatedColor, 1.0 - ( 1.0 - transmittedLight.a ) * transmittanceFactor );
	}
#endif`,ty=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_SPECULARMAP
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,ey=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	uniform mat3 mapTransform;
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	uniform mat3 alphaMapTransform;
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	uniform mat3 lightMapTransform;
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	uniform mat3 aoMapTransform;
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	uniform mat3 bumpMapTransform;
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	uniform mat3 normalMapTransform;
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_DISPLACEMENTMAP
	uniform mat3 displacementMapTransform;
	varying vec2 vDisplacementMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	uniform mat3 emissiveMapTransform;
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	uniform mat3 metalnessMapTransform;
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	uniform mat3 roughnessMapTransform;
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	uniform mat3 anisotropyMapTransform;
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	uniform mat3 clearcoatMapTransform;
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform mat3 clearcoatNormalMapTransform;
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform mat3 clearcoatRoughnessMapTransform;
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	uniform mat3 sheenColorMapTransform;
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	uniform mat3 sheenRoughnessMapTransform;
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	uniform mat3 iridescenceMapTransform;
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform mat3 iridescenceThicknessMapTransform;
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SPECULARMAP
	uniform mat3 specularMapTransform;
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	uniform mat3 specularColorMapTransform;
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	uniform mat3 specularIntensityMapTransform;
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,ny=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	vUv = vec3( uv, 1 ).xy;
#endif
#ifdef USE_MAP
	vMapUv = ( mapTransform * vec3( MAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ALPHAMAP
	vAlphaMapUv = ( alphaMapTransform * vec3( ALPHAMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_LIGHTMAP
	vLightMapUv = ( lightMapTransform * vec3( LIGHTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_AOMAP
	vAoMapUv = ( aoMapTransform * vec3( AOMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_BUMPMAP
	vBumpMapUv = ( bumpMapTransform * vec3( BUMPMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_NORMALMAP
	vNormalMapUv = ( normalMapTransform * vec3( NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DISPLACEMENTMAP
	vDisplacementMapUv = ( displacementMapTransform * vec3( DISPLACEMENTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_EMISSIVEMAP
	vEmissiveMapUv = ( emissiveMapTransform * vec3( EMISSIVEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_METALNESSMAP
	vMetalnessMapUv = ( metalnessMapTransform * vec3( METALNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ROUGHNESSMAP
	vRoughnessMapUv = ( roughnessMapTransform * vec3( ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ANISOTROPYMAP
	vAnisotropyMapUv = ( anisotropyMapTransform * vec3( ANISOTROPYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOATMAP
	vClearcoatMapUv = ( clearcoatMapTransform * vec3( CLEARCOATMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	vClearcoatNormalMapUv = ( clearcoatNormalMapTransform * vec3( CLEARCOAT_NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	vClearcoatRoughnessMapUv = ( clearcoatRoughnessMapTransform * vec3( CLEARCOAT_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCEMAP
	vIridescenceMapUv = ( iridescenceMapTransform * vec3( IRIDESCENCEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	vIridescenceThicknessMapUv = ( iridescenceThicknessMapTransform * vec3( IRIDESCENCE_THICKNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_COLORMAP
	vSheenColorMapUv = ( sheenColorMapTransform * vec3( SHEEN_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	vSheenRoughnessMapUv = ( sheenRoughnessMapTransform * vec3( SHEEN_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULARMAP
	vSpecularMapUv = ( specularMapTransform * vec3( SPECULARMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_COLORMAP
	vSpecularColorMapUv = ( specularColorMapTransform * vec3( SPECULAR_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	vSpecularIntensityMapUv = ( specularIntensityMapTransform * vec3( SPECULAR_INTENSITYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_TRANSMISSIONMAP
	vTransmissionMapUv = ( transmissionMapTransform * vec3( TRANSMISSIONMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_THICKNESSMAP
	vThicknessMapUv = ( thicknessMapTransform * vec3( THICKNESSMAP_UV, 1 ) ).xy;
#endif`,iy=`#if defined( USE_ENVMAP ) || defined( DISTANCE ) || defined ( USE_SHADOWMAP ) || defined ( USE_TRANSMISSION ) || NUM_SPOT_LIGHT_COORDS > 0
	vec4 worldPosition = vec4( transformed, 1.0 );
	#ifdef USE_BATCHING
		worldPosition = batchingMatrix * worldPosition;
	#endif
	#ifdef USE_INSTANCING
		worldPosition = instanceMatrix * worldPosition;
	#endif
	worldPosition = modelMatrix * worldPosition;
#endif`,sy=`varying vec2 vUv;
uniform mat3 uvTransform;
void main() {
	vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	gl_Position = vec4( position.xy, 1.0, 1.0 );
}`,ry=`uniform sampler2D t2D;
uniform float backgroundIntensity;
varying vec2 vUv;
void main() {
	vec4 texColor = texture2D( t2D, vUv );
	#ifdef DECODE_VIDEO_TEXTURE
		texColor = vec4( mix( pow( texColor.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), texColor.rgb * 0.0773993808, vec3( lessThanEqual( texColor.rgb, vec3( 0.04045 ) ) ) ), texColor.w );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,oy=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,ay=`#ifdef ENVMAP_TYPE_CUBE
	uniform samplerCube envMap;
#elif defined( ENVMAP_TYPE_CUBE_UV )
	uniform sampler2D envMap;
#endif
uniform float flipEnvMap;
uniform float backgroundBlurriness;
uniform float backgroundIntensity;
uniform mat3 backgroundRotation;
varying vec3 vWorldDirection;
#include <cube_uv_reflection_fragment>
void main() {
	#ifdef ENVMAP_TYPE_CUBE
		vec4 texColor = textureCube( envMap, backgroundRotation * vec3( flipEnvMap * vWorldDirection.x, vWorldDirection.yz ) );
	#elif defined( ENVMAP_TYPE_CUBE_UV )
		vec4 texColor = textureCubeUV( envMap, backgroundRotation * vWorldDirection, backgroundBlurriness );
	#else
		vec4 texColor = vec4( 0.0, 0.0, 0.0, 1.0 );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,ly=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,cy=`uniform samplerCube tCube;
uniform float tFlip;
uniform float opacity;
varying vec3 vWorldDirection;
void main() {
	vec4 texColor = textureCube( tCube, vec3( tFlip * vWorldDirection.x, vWorldDirection.yz ) );
	gl_FragColor = texColor;
	gl_FragColor.a *= opacity;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,hy=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
varying vec2 vHighPrecisionZW;
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vHighPrecisionZW = gl_Position.zw;
}`,uy=`#if DEPTH_PACKING == 3200
	uniform float opacity;
#endif
#include <common>
#include <packing>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
varying vec2 vHighPrecisionZW;
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#if DEPTH_PACKING == 3200
		diffuseColor.a = opacity;
	#endif
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <logdepthbuf_fragment>
	float fragCoordZ = 0.5 * vHighPrecisionZW[0] / vHighPrecisionZW[1] + 0.5;
	#if DEPTH_PACKING == 3200
		gl_FragColor = vec4( vec3( 1.0 - fragCoordZ ), opacity );
	#elif DEPTH_PACKING == 3201
		gl_FragColor = packDepthToRGBA( fragCoordZ );
	#endif
}`,dy=`#define DISTANCE
varying vec3 vWorldPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <worldpos_vertex>
	#include <clipping_planes_vertex>
	vWorldPosition = worldPosition.xyz;
}`,fy=`#define DISTANCE
uniform vec3 referencePosition;
uniform float nearDistance;
uniform float farDistance;
varying vec3 vWorldPosition;
#include <common>
#include <packing>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <clipping_planes_pars_fragment>
void main () {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	float dist = length( vWorldPosition - referencePosition );
	dist = ( dist - nearDistance ) / ( farDistance - nearDistance );
	dist = saturate( dist );
	gl_FragColor = packDepthToRGBA( dist );
}`,py=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
}`,my=`uniform sampler2D tEquirect;
varying vec3 vWorldDirection;
#include <common>
void main() {
	vec3 direction = normalize( vWorldDirection );
	vec2 sampleUV = equirectUv( direction );
	gl_FragColor = texture2D( tEquirect, sampleUV );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,gy=`uniform float scale;
attribute float lineDistance;
varying float vLineDistance;
#include <common>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	vLineDistance = scale * lineDistance;
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,_y=`uniform vec3 diffuse;
uniform float opacity;
uniform float dashSize;
uniform float totalSize;
varying float vLineDistance;
#include <common>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	if ( mod( vLineDistance, totalSize ) > dashSize ) {
		discard;
	}
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,vy=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#if defined ( USE_ENVMAP ) || defined ( USE_SKINNING )
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinbase_vertex>
		#include <skinnormal_vertex>
		#include <defaultnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <fog_vertex>
}`,yy=`uniform vec3 diffuse;
uniform float opacity;
#ifndef FLAT_SHADED
	varying vec3 vNormal;
#endif
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <fog_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		reflectedLight.indirectDiffuse += lightMapTexel.rgb * lightMapIntensity * RECIPROCAL_PI;
	#else
		reflectedLight.indirectDiffuse += vec3( 1.0 );
	#endif
	#include <aomap_fragment>
	reflectedLight.indirectDiffuse *= diffuseColor.rgb;
	vec3 outgoingLight = reflectedLight.indirectDiffuse;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,xy=`#define LAMBERT
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,My=`#define LAMBERT
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <packing>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_lambert_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_lambert_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,by=`#define MATCAP
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <displacementmap_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
	vViewPosition = - mvPosition.xyz;
}`,wy=`#define MATCAP
uniform vec3 diffuse;
uniform float opacity;
uniform sampler2D matcap;
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	vec3 viewDir = normalize( vViewPosition );
	vec3 x = normalize( vec3( viewDir.z, 0.0, - viewDir.x ) );
	vec3 y = cross( viewDir, x );
	vec2 uv = vec2( dot( x, normal ), dot( y, normal ) ) * 0.495 + 0.5;
	#ifdef USE_MATCAP
		vec4 matcapColor = texture2D( matcap, uv );
	#else
		vec4 matcapColor = vec4( vec3( mix( 0.2, 0.8, uv.y ) ), 1.0 );
	#endif
	vec3 outgoingLight = diffuseColor.rgb * matcapColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,Sy=`#define NORMAL
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	vViewPosition = - mvPosition.xyz;
#endif
}`,Ey=`#define NORMAL
uniform float opacity;
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <packing>
#include <uv_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 0.0, 0.0, 0.0, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	gl_FragColor = vec4( packNormalToRGB( normal ), diffuseColor.a );
	#ifdef OPAQUE
		gl_FragColor.a = 1.0;
	#endif
}`,Ty=`#define PHONG
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,Ay=`#define PHONG
uniform vec3 diffuse;
uniform vec3 emissive;
uniform vec3 specular;
uniform float shininess;
uniform float opacity;
#include <common>
#include <packing>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_phong_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_phong_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + reflectedLight.directSpecular + reflectedLight.indirectSpecular + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,Cy=`#define STANDARD
varying vec3 vViewPosition;
#ifdef USE_TRANSMISSION
	varying vec3 vWorldPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
#ifdef USE_TRANSMISSION
	vWorldPosition = worldPosition.xyz;
#endif
}`,Ry=`#define STANDARD
#ifdef PHYSICAL
	#define IOR
	#define USE_SPECULAR
#endif
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float roughness;
uniform float metalness;
uniform float opacity;
#ifdef IOR
	uniform float ior;
#endif
#ifdef USE_SPECULAR
	uniform float specularIntensity;
	uniform vec3 specularColor;
	#ifdef USE_SPECULAR_COLORMAP
		uniform sampler2D specularColorMap;
	#endif
	#ifdef USE_SPECULAR_INTENSITYMAP
		uniform sampler2D specularIntensityMap;
	#endif
#endif
#ifdef USE_CLEARCOAT
	uniform float clearcoat;
	uniform float clearcoatRoughness;
#endif
#ifdef USE_DISPERSION
	uniform float dispersion;
#endif
#ifdef USE_IRIDESCENCE
	uniform float iridescence;
	uniform float iridescenceIOR;
	uniform float iridescenceThicknessMinimum;
	uniform float iridescenceThicknessMaximum;
#endif
#ifdef USE_SHEEN
	uniform vec3 sheenColor;
	uniform float sheenRoughness;
	#ifdef USE_SHEEN_COLORMAP
		uniform sampler2D sheenColorMap;
	#endif
	#ifdef USE_SHEEN_ROUGHNESSMAP
		uniform sampler2D sheenRoughnessMap;
	#endif
#endif
#ifdef USE_ANISOTROPY
	uniform vec2 anisotropyVector;
	#ifdef USE_ANISOTROPYMAP
		uniform sampler2D anisotropyMap;
	#endif
#endif
varying vec3 vViewPosition;
#include <common>
#include <packing>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <iridescence_fragment>
#include <cube_uv_reflection_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_physical_pars_fragment>
#include <transmission_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <clearcoat_pars_fragment>
#include <iridescence_pars_fragment>
#include <roughnessmap_pars_fragment>
#include <metalnessmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <roughnessmap_fragment>
	#include <metalnessmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <clearcoat_normal_fragment_begin>
	#include <clearcoat_normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_physical_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 totalDiffuse = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse;
	vec3 totalSpecular = reflectedLight.directSpecular + reflectedLight.indirectSpecular;
	#include <transmission_fragment>
	vec3 outgoingLight = totalDiffuse + totalSpecular + totalEmissiveRadiance;
	#ifdef USE_SHEEN
		float sheenEnergyComp = 1.0 - 0.157 * max3( material.sheenColor );
		outgoingLight = outgoingLight * sheenEnergyComp + sheenSpecularDirect + sheenSpecularIndirect;
	#endif
	#ifdef USE_CLEARCOAT
		float dotNVcc = saturate( dot( geometryClearcoatNormal, geometryViewDir ) );
		vec3 Fcc = F_Schlick( material.clearcoatF0, material.clearcoatF90, dotNVcc );
		outgoingLight = outgoingLight * ( 1.0 - material.clearcoat * Fcc ) + ( clearcoatSpecularDirect + clearcoatSpecularIndirect ) * material.clearcoat;
	#endif
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,Py=`#define TOON
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,Ly=`#define TOON
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <packing>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <gradientmap_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_toon_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_toon_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,Iy=`uniform float size;
uniform float scale;
#include <common>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
#ifdef USE_POINTS_UV
	varying vec2 vUv;
	uniform mat3 uvTransform;
#endif
void main() {
	#ifdef USE_POINTS_UV
		vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	#endif
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	gl_PointSize = size;
	#ifdef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) gl_PointSize *= ( scale / - mvPosition.z );
	#endif
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <fog_vertex>
}`,Dy=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <color_pars_fragment>
#include <map_particle_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_particle_fragment>
	#include <color_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,Ny=`#include <common>
#include <batching_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <shadowmap_pars_vertex>
void main() {
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,Uy=`uniform vec3 color;
uniform float opacity;
#include <common>
#include <packing>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <logdepthbuf_pars_fragment>
#include <shadowmap_pars_fragment>
#include <shadowmask_pars_fragment>
void main() {
	#include <logdepthbuf_fragment>
	gl_FragColor = vec4( color, opacity * ( 1.0 - getShadowMask() ) );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
}`,Oy=`uniform float rotation;
uniform vec2 center;
#include <common>
#include <uv_pars_vertex>
#include <fog_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	vec4 mvPosition = modelViewMatrix * vec4( 0.0, 0.0, 0.0, 1.0 );
	vec2 scale;
	scale.x = length( vec3( modelMatrix[ 0 ].x, modelMatrix[ 0 ].y, modelMatrix[ 0 ].z ) );
	scale.y = length( vec3( modelMatrix[ 1 ].x, modelMatrix[ 1 ].y, modelMatrix[ 1 ].z ) );
	#ifndef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) scale *= - mvPosition.z;
	#endif
	vec2 alignedPosition = ( position.xy - ( center - vec2( 0.5 ) ) ) * scale;
	vec2 rotatedPosition;
	rotatedPosition.x = cos( rotation ) * alignedPosition.x - sin( rotation ) * alignedPosition.y;
	rotatedPosition.y = sin( rotation ) * alignedPosition.x + cos( rotation ) * alignedPosition.y;
	mvPosition.xy += rotatedPosition;
	gl_Position = projectionMatrix * mvPosition;
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,Fy=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
}`,re={alphahash_fragment:r_,alphahash_pars_fragment:o_,alphamap_fragment:a_,alphamap_pars_fragment:l_,alphatest_fragment:c_,alphatest_pars_fragment:h_,aomap_fragment:u_,aomap_pars_fragment:d_,batching_pars_vertex:f_,batching_vertex:p_,begin_vertex:m_,beginnormal_vertex:g_,bsdfs:__,iridescence_fragment:v_,bumpmap_pars_fragment:y_,clipping_planes_fragment:x_,clipping_planes_pars_fragment:M_,clipping_planes_pars_vertex:b_,clipping_planes_vertex:w_,color_fragment:S_,color_pars_fragment:E_,color_pars_vertex:T_,color_vertex:A_,common:C_,cube_uv_reflection_fragment:R_,defaultnormal_vertex:P_,displacementmap_pars_vertex:L_,displacementmap_vertex:I_,emissivemap_fragment:D_,emissivemap_pars_fragment:N_,colorspace_fragment:U_,colorspace_pars_fragment:O_,envmap_fragment:F_,envmap_common_pars_fragment:k_,envmap_pars_fragment:B_,envmap_pars_vertex:z_,envmap_physical_pars_fragment:K_,envmap_vertex:V_,fog_vertex:H_,fog_pars_vertex:G_,fog_fragment:W_,fog_pars_fragment:X_,gradientmap_pars_fragment:$_,lightmap_pars_fragment:q_,lights_lambert_fragment:Y_,lights_lambert_pars_fragment:Z_,lights_pars_begin:J_,lights_toon_fragment:j_,lights_toon_pars_fragment:Q_,lights_phong_fragment:tv,lights_phong_pars_fragment:ev,lights_physical_fragment:nv,lights_physical_pars_fragment:iv,lights_fragment_begin:sv,lights_fragment_maps:rv,lights_fragment_end:ov,logdepthbuf_fragment:av,logdepthbuf_pars_fragment:lv,logdepthbuf_pars_vertex:cv,logdepthbuf_vertex:hv,map_fragment:uv,map_pars_fragment:dv,map_particle_fragment:fv,map_particle_pars_fragment:pv,metalnessmap_fragment:mv,metalnessmap_pars_fragment:gv,morphinstance_vertex:_v,morphcolor_vertex:vv,morphnormal_vertex:yv,morphtarget_pars_vertex:xv,morphtarget_vertex:Mv,normal_fragment_begin:bv,normal_fragment_maps:wv,normal_pars_fragment:Sv,normal_pars_vertex:Ev,normal_vertex:Tv,normalmap_pars_fragment:Av,clearcoat_normal_fragment_begin:Cv,clearcoat_normal_fragment_maps:Rv,clearcoat_pars_fragment:Pv,iridescence_pars_fragment:Lv,opaque_fragment:Iv,packing:Dv,premultiplied_alpha_fragment:Nv,project_vertex:Uv,dithering_fragment:Ov,dithering_pars_fragment:Fv,roughnessmap_fragment:kv,roughnessmap_pars_fragment:Bv,shadowmap_pars_fragment:zv,shadowmap_pars_vertex:Vv,shadowmap_vertex:Hv,shadowmask_pars_fragment:Gv,skinbase_vertex:Wv,skinning_pars_vertex:Xv,skinning_vertex:$v,skinnormal_vertex:qv,specularmap_fragment:Yv,specularmap_pars_fragment:Zv,tonemapping_fragment:Jv,tonemapping_pars_fragment:Kv,transmission_fragment:jv,transmission_pars_fragment:Qv,uv_pars_fragment:ty,uv_pars_vertex:ey,uv_vertex:ny,worldpos_vertex:iy,background_vert:sy,background_frag:ry,backgroundCube_vert:oy,backgroundCube_frag:ay,cube_vert:ly,cube_frag:cy,depth_vert:hy,depth_frag:uy,distanceRGBA_vert:dy,distanceRGBA_frag:fy,equirect_vert:py,equirect_frag:my,linedashed_vert:gy,linedashed_frag:_y,meshbasic_vert:vy,meshbasic_frag:yy,meshlambert_vert:xy,meshlambert_frag:My,meshmatcap_vert:by,meshmatcap_frag:wy,meshnormal_vert:Sy,meshnormal_frag:Ey,meshphong_vert:Ty,meshphong_frag:Ay,meshphysical_vert:Cy,meshphysical_frag:Ry,meshtoon_vert:Py,meshtoon_frag:Ly,points_vert:Iy,points_frag:Dy,shadow_vert:Ny,shadow_frag:Uy,sprite_vert:Oy,sprite_frag:Fy},bt={common:{diffuse:{value:new ce(16777215)},opacity:{value:1},map:{value:null},mapTransform:{value:new ie},alphaMap:{value:null},alphaMapTransform:{value:new ie},alphaTest:{value:0}},specularmap:{specularMap:{value:null},specularMapTransform:{value:new ie}},envmap:{envMap:{value:null},envMapRotation:{value:new ie},flipEnvMap:{value:-1},reflectivity:{value:1},ior:{value:1.5},refractionRatio:{value:.98}},aomap:{aoMap:{value:null},aoMapIntensity:{value:1},aoMapTransform:{value:new ie}},lightmap:{lightMap:{value:null},lightMapIntensity:{value:1},lightMapTransform:{value:new ie}},bumpmap:{bumpMap:{value:null},bumpMapTransform:{value:new ie},bumpScale:{value:1}},normalmap:{normalMap:{value:null},normalMapTransform:{value:new ie},normalScale:{value:new Jt(1,1)}},displacementmap:{displacementMap:{value:null},displacementMapTransform:{value:new ie},displacementScale:{value:1},displacementBias:{value:0}},emissivemap:{emissiveMap:{value:null},emissiveMapTransform:{value:new ie}},metalnessmap:{metalnessMap:{value:null},metalnessMapTransform:{value:new ie}},roughnessmap:{roughnessMap:{value:null},roughnessMapTransform:{value:new ie}},gradientmap:{gradientMap:{value:null}},fog:{fogDensity:{value:25e-5},fogNear:{value:1},fogFar:{value:2e3},fogColor:{value:new ce(16777215)}},lights:{ambientLightColor:{value:[]},lightProbe:{value:[]},directionalLights:{value:[],properties:{direction:{},color:{}}},directionalLightShadows:{value:[],properties:{shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},directionalShadowMap:{value:[]},directionalShadowMatrix:{value:[]},spotLights:{value:[],properties:{color:{},position:{},direction:{},distance:{},coneCos:{},penumbraCos:{},decay:{}}},spotLightShadows:{value:[],properties:{shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},spotLightMap:{value:[]},spotShadowMap:{value:[]},spotLightMatrix:{value:[]},pointLights:{value:[],properties:{color:{},position:{},decay:{},distance:{}}},pointLightShadows:{value:[],properties:{shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{},shadowCameraNear:{},shadowCameraFar:{}}},pointShadowMap:{value:[]},pointShadowMatrix:{value:[]},hemisphereLights:{value:[],properties:{direction:{},skyColor:{},groundColor:{}}},rectAreaLights:{value:[],properties:{color:{},position:{},width:{},height:{}}},ltc_1:{value:null},ltc_2:{value:null}},points:{diffuse:{value:new ce(16777215)},opacity:{value:1},size:{value:1},scale:{value:1},map:{value:null},alphaMap:{value:null},alphaMapTransform:{value:new ie},alphaTest:{value:0},uvTransform:{value:new ie}},sprite:{diffuse:{value:new ce(16777215)},opacity:{value:1},center:{value:new Jt(.5,.5)},rotation:{value:0},map:{value:null},mapTransform:{value:new ie},alphaMap:{value:null},alphaMapTransform:{value:new ie},alphaTest:{value:0}}},yi={basic:{uniforms:Tn([bt.common,bt.specularmap,bt.envmap,bt.aomap,bt.lightmap,bt.fog]),vertexShader:re.meshbasic_vert,fragmentShader:re.meshbasic_frag},lambert:{uniforms:Tn([bt.common,bt.specularmap,bt.envmap,bt.aomap,bt.lightmap,bt.emissivemap,bt.bumpmap,bt.normalmap,bt.displacementmap,bt.fog,bt.lights,{emissive:{value:new ce(0)}}]),vertexShader:re.meshlambert_vert,fragmentShader:re.meshlambert_frag},phong:{uniforms:Tn([bt.common,bt.specularmap,bt.envmap,bt.aomap,bt.lightmap,bt.emissivemap,bt.bumpmap,bt.normalmap,bt.displacementmap,bt.fog,bt.lights,{emissive:{value:new ce(0)},specular:{value:new ce(1118481)},shininess:{value:30}}]),vertexShader:re.meshphong_vert,fragmentShader:re.meshphong_frag},standard:{uniforms:Tn([bt.common,bt.envmap,bt.aomap,bt.lightmap,bt.emissivemap,bt.bumpmap,bt.normalmap,bt.displacementmap,bt.roughnessmap,bt.metalnessmap,bt.fog,bt.lights,{emissive:{value:new ce(0)},roughness:{value:1},metalness:{value:0},envMapIntensity:{value:1}}]),vertexShader:re.meshphysical_vert,fragmentShader:re.meshphysical_frag},toon:{uniforms:Tn([bt.common,bt.aomap,bt.lightmap,bt.emissivemap,bt.bumpmap,bt.normalmap,bt.displacementmap,bt.gradientmap,bt.fog,bt.lights,{emissive:{value:new ce(0)}}]),vertexShader:re.meshtoon_vert,fragmentShader:re.meshtoon_frag},matcap:{uniforms:Tn([bt.common,bt.bumpmap,bt.normalmap,bt.displacementmap,bt.fog,{matcap:{value:null}}]),vertexShader:re.meshmatcap_vert,fragmentShader:re.meshmatcap_frag},points:{uniforms:Tn([bt.points,bt.fog]),vertexShader:re.points_vert,fragmentShader:re.points_frag},dashed:{uniforms:Tn([bt.common,bt.fog,{scale:{value:1},dashSize:{value:1},totalSize:{value:2}}]),vertexShader:re.linedashed_vert,fragmentShader:re.linedashed_frag},depth:{uniforms:Tn([bt.common,bt.displacementmap]),vertexShader:re.depth_vert,fragmentShader:re.depth_frag},normal:{uniforms:Tn([bt.common,bt.bumpmap,bt.normalmap,bt.displacementmap,{opacity:{value:1}}]),vertexShader:re.meshnormal_vert,fragmentShader:re.meshnormal_frag},sprite:{uniforms:Tn([bt.sprite,bt.fog]),vertexShader:re.sprite_vert,fragmentShader:re.sprite_frag},background:{uniforms:{uvTransform:{value:new ie},t2D:{value:null},backgroundIntensity:{value:1}},vertexShader:re.background_vert,fragmentShader:re.background_frag},backgroundCube:{uniforms:{envMap:{value:null},flipEnvMap:{value:-1},backgroundBlurriness:{value:0},backgroundIntensity:{value:1},backgroundRotation:{value:new ie}},vertexShader:re.backgroundCube_vert,fragmentShader:re.backgroundCube_frag},cube:{uniforms:{tCube:{value:null},tFlip:{value:-1},opacity:{value:1}},vertexShader:re.cube_vert,fragmentShader:re.cube_frag},equirect:{uniforms:{tEquirect:{value:null}},vertexShader:re.equirect_vert,fragmentShader:re.equirect_frag},distanceRGBA:{uniforms:Tn([bt.common,bt.displacementmap,{referencePosition:{value:new V},nearDistance:{value:1},farDistance:{value:1e3}}]),vertexShader:re.distanceRGBA_vert,fragmentShader:re.distanceRGBA_frag},shadow:{uniforms:Tn([bt.lights,bt.fog,{color:{value:new ce(0)},opacity:{value:1}}]),vertexShader:re.shadow_vert,fragmentShader:re.shadow_frag}};yi.physical={uniforms:Tn([yi.standard.uniforms,{clearcoat:{value:0},clearcoatMap:{value:null},clearcoatMapTransform:{value:new ie},clearcoatNormalMap:{value:null},clearcoatNormalMapTransform:{value:new ie},clearcoatNormalScale:{value:new Jt(1,1)},clearcoatRoughness:{value:0},clearcoatRoughnessMap:{value:null},clearcoatRoughnessMapTransform:{value:new ie},dispersion:{value:0},iridescence:{value:0},iridescenceMap:{value:null},iridescenceMapTransform:{value:new ie},iridescenceIOR:{value:1.3},iridescenceThicknessMinimum:{value:100},iridescenceThicknessMaximum:{value:400},iridescenceThicknessMap:{value:null},iridescenceThicknessMapTransform:{value:new ie},sheen:{value:0},sheenColor:{value:new ce(0)},sheenColorMap:{value:null},sheenColorMapTransform:{value:new ie},sheenRoughness:{value:1},sheenRoughnessMap:{value:null},sheenRoughnessMapTransform:{value:new ie},transmission:{value:0},transmissionMap:{value:null},transmissionMapTransform:{value:new ie},transmissionSamplerSize:{value:new Jt},transmissionSamplerMap:{value:null},thickness:{value:0},thicknessMap:{value:null},thicknessMapTransform:{value:new ie},attenuationDistance:{value:0},attenuationColor:{value:new ce(0)},specularColor:{value:new ce(1,1,1)},specularColorMap:{value:null},specularColorMapTransform:{value:new ie},specularIntensity:{value:1},specularIntensityMap:{value:null},specularIntensityMapTransform:{value:new ie},anisotropyVector:{value:new Jt},anisotropyMap:{value:null},anisotropyMapTransform:{value:new ie}}]),vertexShader:re.meshphysical_vert,fragmentShader:re.meshphysical_frag};var ya={r:0,b:0,g:0},xs=new Kn,ky=new ve;function By(i,t,e,n,s,r,o){let a=new ce(0),l=r===!0?0:1,c,u,d=null,h=0,p=null;function g(T){let b=T.isScene===!0?T.background:null;return b&&b.isTexture&&(b=(T.backgroundBlurriness>0?e:t).get(b)),b}function v(T){let b=!1,A=g(T);A===null?f(a,l):A&&A.isColor&&(f(A,1),b=!0);let N=i.xr.getEnvironmentBlendMode();N==="additive"?n.buffers.color.setClear(0,0,0,1,o):N==="alpha-blend"&&n.buffers.color.setClear(0,0,0,0,o),(i.autoClear||b)&&(n.buffers.depth.setTest(!0),n.buffers.depth.setMask(!0),n.buffers.color.setMask(!0),i.clear(i.autoClearColor,i.autoClearDepth,i.autoClearStencil))}function m(T,b){let A=g(b);A&&(A.isCubeTexture||A.mapping===tl)?(u===void 0&&(u=new zn(new As(1,1,1),new wi({name:"BackgroundCubeMaterial",uniforms:Rr(yi.backgroundCube.uniforms),vertexShader:yi.backgroundCube.vertexShader,fragmentShader:yi.backgroundCube.fragmentShader,side:Un,depthTest:!1,depthWrite:!1,fog:!1})),u.geometry.deleteAttribute("normal"),u.geometry.deleteAttribute("uv"),u.onBeforeRender=function(N,L,C){this.matrixWorld.copyPosition(C.matrixWorld)},Object.defineProperty(u.material,"envMap",{get:function(){return this.uniforms.envMap.value}}),s.update(u)),xs.copy(b.backgroundRotation),xs.x*=-1,xs.y*=-1,xs.z*=-1,A.isCubeTexture&&A.isRenderTargetTexture===!1&&(xs.y*=-1,xs.z*=-1),u.material.uniforms.envMap.value=A,u.material.uniforms.flipEnvMap.value=A.isCubeTexture&&A.isRenderTargetTexture===!1?-1:1,u.material.uniforms.backgroundBlurriness.value=b.backgroundBlurriness,u.material.uniforms.backgroundIntensity.value=b.backgroundIntensity,u.material.uniforms.backgroundRotation.value.setFromMatrix4(ky.makeRotationFromEuler(xs)),u.material.toneMapped=we.getTransfer(A.colorSpace)!==Ue,(d!==A||h!==A.version||p!==i.toneMapping)&&(u.material.needsUpdate=!0,d=A,h=A.version,p=i.toneMapping),u.layers.enableAll(),T.unshift(u,u.geometry,u.material,0,0,null)):A&&A.isTexture&&(c===void 0&&(c=new zn(new Pr(2,2),new wi({name:"BackgroundMaterial",uniforms:Rr(yi.background.uniforms),vertexShader:yi.background.vertexShader,fragmentShader:yi.background.fragmentShader,side:ss,depthTest:!1,depthWrite:!1,fog:!1})),c.geometry.deleteAttribute("normal"),Object.defineProperty(c.material,"map",{get:function(){return this.uniforms.t2D.value}}),s.update(c)),c.material.uniforms.t2D.value=A,c.material.uniforms.backgroundIntensity.value=b.backgroundIntensity,c.material.toneMapped=we.getTransfer(A.colorSpace)!==Ue,A.matrixAutoUpdate===!0&&A.updateMatrix(),c.material.uniforms.uvTransform.value.copy(A.matrix),(d!==A||h!==A.version||p!==i.toneMapping)&&(c.material.needsUpdate=!0,d=A,h=A.version,p=i.toneMapping),c.layers.enableAll(),T.unshift(c,c.geometry,c.material,0,0,null))}function f(T,b){T.getRGB(ya,Nf(i)),n.buffers.color.setClear(ya.r,ya.g,ya.b,b,o)}return{getClearColor:function(){return a},setClearColor:function(T,b=1){a.set(T),l=b,f(a,l)},getClearAlpha:function(){return l},setClearAlpha:function(T){l=T,f(a,l)},render:v,addToRenderList:m}}function zy(i,t){let e=i.getParameter(i.MAX_VERTEX_ATTRIBS),n={},s=h(null),r=s,o=!1;function a(x,R,z,B,X){let J=!1,q=d(B,z,R);r!==q&&(r=q,c(r.object)),J=p(x,B,z,X),J&&g(x,B,z,X),X!==null&&t.update(X,i.ELEMENT_ARRAY_BUFFER),(J||o)&&(o=!1,A(x,R,z,B),X!==null&&i.bindBuffer(i.ELEMENT_ARRAY_BUFFER,t.get(X).buffer))}function l(){return i.createVertexArray()}function c(x){return i.bindVertexArray(x)}function u(x){return i.deleteVertexArray(x)}function d(x,R,z){let B=z.wireframe===!0,X=n[x.id];X===void 0&&(X={},n[x.id]=X);let J=X[R.id];J===void 0&&(J={},X[R.id]=J);let q=J[B];return q===void 0&&(q=h(l()),J[B]=q),q}function h(x){let R=[],z=[],B=[];for(let X=0;X<e;X++)R[X]=0,z[X]=0,B[X]=0;return{geometry:null,program:null,wireframe:!1,newAttributes:R,enabledAttributes:z,attributeDivisors:B,object:x,attributes:{},index:null}}function p(x,R,z,B){let X=r.attributes,J=R.attributes,q=0,st=z.getAttributes();for(let nt in st)if(st[nt].location>=0){let dt=X[nt],pt=J[nt];if(pt===void 0&&(nt==="instanceMatrix"&&x.instanceMatrix&&(pt=x.instanceMatrix),nt==="instanceColor"&&x.instanceColor&&(pt=x.instanceColor)),dt===void 0||dt.attribute!==pt||pt&&dt.data!==pt.data)return!0;q++}return r.attributesNum!==q||r.index!==B}function g(x,R,z,B){let X={},J=R.attributes,q=0,st=z.getAttributes();for(let nt in st)if(st[nt].location>=0){let dt=J[nt];dt===void 0&&(nt==="instanceMatrix"&&x.instanceMatrix&&(dt=x.instanceMatrix),nt==="instanceColor"&&x.instanceColor&&(dt=x.instanceColor));let pt={};pt.attribute=dt,dt&&dt.data&&(pt.data=dt.data),X[nt]=pt,q++}r.attributes=X,r.attributesNum=q,r.index=B}function v(){let x=r.newAttributes;for(let R=0,z=x.length;R<z;R++)x[R]=0}function m(x){f(x,0)}function f(x,R){let z=r.newAttributes,B=r.enabledAttributes,X=r.attributeDivisors;z[x]=1,B[x]===0&&(i.enableVertexAttribArray(x),B[x]=1),X[x]!==R&&(i.vertexAttribDivisor(x,R),X[x]=R)}function T(){let x=r.newAttributes,R=r.enabledAttributes;for(let z=0,B=R.length;z<B;z++)R[z]!==x[z]&&(i.disableVertexAttribArray(z),R[z]=0)}function b(x,R,z,B,X,J,q){q===!0?i.vertexAttribIPointer(x,R,z,X,J):i.vertexAttribPointer(x,R,z,B,X,J)}function A(x,R,z,B){v();let X=B.attributes,J=z.getAttributes(),q=R.defaultAttributeValues;for(let st in J){let nt=J[st];if(nt.location>=0){let gt=X[st];if(gt===void 0&&(st==="instanceMatrix"&&x.instanceMatrix&&(gt=x.instanceMatrix),st==="instanceColor"&&x.instanceColor&&(gt=x.instanceColor)),gt!==void 0){let dt=gt.normalized,pt=gt.itemSize,mt=t.get(gt);if(mt===void 0)continue;let kt=mt.buffer,Q=mt.type,ct=mt.bytesPerElement,Rt=Q===i.INT||Q===i.UNSIGNED_INT||gt.gpuType===Mf;if(gt.isInterleavedBufferAttribute){let ft=gt.data,Ht=ft.stride,Bt=gt.offset;if(ft.isInstancedInterleavedBuffer){for(let Nt=0;Nt<nt.locationSize;Nt++)f(nt.location+Nt,ft.meshPerAttribute);x.isInstancedMesh!==!0&&B._maxInstanceCount===void 0&&(B._maxInstanceCount=ft.meshPerAttribute*ft.count)}else for(let Nt=0;Nt<nt.locationSize;Nt++)m(nt.location+Nt);i.bindBuffer(i.ARRAY_BUFFER,kt);for(let Nt=0;Nt<nt.locationSize;Nt++)b(nt.location+Nt,pt/nt.locationSize,Q,dt,Ht*ct,(Bt+pt/nt.locationSize*Nt)*ct,Rt)}else{if(gt.isInstancedBufferAttribute){for(let ft=0;ft<nt.locationSize;ft++)f(nt.location+ft,gt.meshPerAttribute);x.isInstancedMesh!==!0&&B._maxInstanceCount===void 0&&(B._maxInstanceCount=gt.meshPerAttribute*gt.count)}else for(let ft=0;ft<nt.locationSize;ft++)m(nt.location+ft);i.bindBuffer(i.ARRAY_BUFFER,kt);for(let ft=0;ft<nt.locationSize;ft++)b(nt.location+ft,pt/nt.locationSize,Q,dt,pt*ct,pt/nt.locationSize*ft*ct,Rt)}}else if(q!==void 0){let dt=q[st];if(dt!==void 0)switch(dt.length){case 2:i.vertexAttrib2fv(nt.location,dt);break;case 3:i.vertexAttrib3fv(nt.location,dt);break;case 4:i.vertexAttrib4fv(nt.location,dt);break;default:i.vertexAttrib1fv(nt.location,dt)}}}}T()}function N(){F();for(let x in n){let R=n[x];for(let z in R){let B=R[z];for(let X in B)u(B[X].object),delete B[X];delete R[z]}delete n[x]}}function L(x){if(n[x.id]===void 0)return;let R=n[x.id];for(let z in R){let B=R[z];for(let X in B)u(B[X].object),delete B[X];delete R[z]}delete n[x.id]}function C(x){for(let R in n){let z=n[R];if(z[x.id]===void 0)continue;let B=z[x.id];for(let X in B)u(B[X].object),delete B[X];delete z[x.id]}}function F(){S(),o=!0,r!==s&&(r=s,c(r.object))}function S(){s.geometry=null,s.program=null,s.wireframe=!1}return{setup:a,reset:F,resetDefaultState:S,dispose:N,releaseStatesOfGeometry:L,releaseStatesOfProgram:C,initAttributes:v,enableAttribute:m,disableUnusedAttributes:T}}function Vy(i,t,e){let n;function s(c){n=c}function r(c,u){i.drawArrays(n,c,u),e.update(u,n,1)}function o(c,u,d){d!==0&&(i.drawArraysInstanced(n,c,u,d),e.update(u,n,d))}function a(c,u,d){if(d===0)return;let h=t.get("WEBGL_multi_draw");if(h===null)for(let p=0;p<d;p++)this.render(c[p],u[p]);else{h.multiDrawArraysWEBGL(n,c,0,u,0,d);let p=0;for(let g=0;g<d;g++)p+=u[g];e.update(p,n,1)}}function l(c,u,d,h){if(d===0)return;let p=t.get("WEBGL_multi_draw");if(p===null)for(let g=0;g<c.length;g++)o(c[g],u[g],h[g]);else{p.multiDrawArraysInstancedWEBGL(n,c,0,u,0,h,0,d);let g=0;for(let v=0;v<d;v++)g+=u[v];for(let v=0;v<h.length;v++)e.update(g,n,h[v])}}this.setMode=s,this.render=r,this.renderInstances=o,this.renderMultiDraw=a,this.renderMultiDrawInstances=l}function Hy(i,t,e,n){let s;function r(){if(s!==void 0)return s;if(t.has("EXT_texture_filter_anisotropic")===!0){let L=t.get("EXT_texture_filter_anisotropic");s=i.getParameter(L.MAX_TEXTURE_MAX_ANISOTROPY_EXT)}else s=0;return s}function o(L){return!(L!==xi&&n.convert(L)!==i.getParameter(i.IMPLEMENTATION_COLOR_READ_FORMAT))}function a(L){let C=L===el&&(t.has("EXT_color_buffer_half_float")||t.has("EXT_color_buffer_float"));return!(L!==rs&&n.convert(L)!==i.getParameter(i.IMPLEMENTATION_COLOR_READ_TYPE)&&L!==Oi&&!C)}function l(L){if(L==="highp"){if(i.getShaderPrecisionFormat(i.VERTEX_SHADER,i.HIGH_FLOAT).precision>0&&i.getShaderPrecisionFormat(i.FRAGMENT_SHADER,i.HIGH_FLOAT).precision>0)return"highp";L="mediump"}return L==="mediump"&&i.getShaderPrecisionFormat(i.VERTEX_SHADER,i.MEDIUM_FLOAT).precision>0&&i.getShaderPrecisionFormat(i.FRAGMENT_SHADER,i.MEDIUM_FLOAT).precision>0?"mediump":"lowp"}let c=e.precision!==void 0?e.precision:"highp",u=l(c);u!==c&&(console.warn("THREE.WebGLRenderer:",c,"not supported, using",u,"instead."),c=u);let d=e.logarithmicDepthBuffer===!0,h=i.getParameter(i.MAX_TEXTURE_IMAGE_UNITS),p=i.getParameter(i.MAX_VERTEX_TEXTURE_IMAGE_UNITS),g=i.getParameter(i.MAX_TEXTURE_SIZE),v=i.getParameter(i.MAX_CUBE_MAP_TEXTURE_SIZE),m=i.getParameter(i.MAX_VERTEX_ATTRIBS),f=i.getParameter(i.MAX_VERTEX_UNIFORM_VECTORS),T=i.getParameter(i.MAX_VARYING_VECTORS),b=i.getParameter(i.MAX_FRAGMENT_UNIFORM_VECTORS),A=p>0,N=i.getParameter(i.MAX_SAMPLES);return{isWebGL2:!0,getMaxAnisotropy:r,getMaxPrecision:l,textureFormatReadable:o,textureTypeReadable:a,precision:c,logarithmicDepthBuffer:d,maxTextures:h,maxVertexTextures:p,maxTextureSize:g,maxCubemapSize:v,maxAttributes:m,maxVertexUniforms:f,maxVaryings:T,maxFragmentUniforms:b,vertexTextures:A,maxSamples:N}}function Gy(i){let t=this,e=null,n=0,s=!1,r=!1,o=new oi,a=new ie,l={value:null,needsUpdate:!1};this.uniform=l,this.numPlanes=0,this.numIntersection=0,this.init=function(d,h){let p=d.length!==0||h||n!==0||s;return s=h,n=d.length,p},this.beginShadows=function(){r=!0,u(null)},this.endShadows=function(){r=!1},this.setGlobalState=function(d,h){e=u(d,h,0)},this.setState=function(d,h,p){let g=d.clippingPlanes,v=d.clipIntersection,m=d.clipShadows,f=i.get(d);if(!s||g===null||g.length===0||r&&!m)r?u(null):c();else{let T=r?0:n,b=T*4,A=f.clippingState||null;l.value=A,A=u(g,h,b,p);for(let N=0;N!==b;++N)A[N]=e[N];f.clippingState=A,this.numIntersection=v?this.numPlanes:0,this.numPlanes+=T}};function c(){l.value!==e&&(l.value=e,l.needsUpdate=n>0),t.numPlanes=n,t.numIntersection=0}function u(d,h,p,g){let v=d!==null?d.length:0,m=null;if(v!==0){if(m=l.value,g!==!0||m===null){let f=p+v*4,T=h.matrixWorldInverse;a.getNormalMatrix(T),(m===null||m.length<f)&&(m=new Float32Array(f));for(let b=0,A=p;b!==v;++b,A+=4)o.copy(d[b]).applyMatrix4(T,a),o.normal.toArray(m,A),m[A+3]=o.constant}l.value=m,l.needsUpdate=!0}return t.numPlanes=v,t.numIntersection=0,m}}function Wy(i){let t=new WeakMap;function e(o,a){return a===Pc?o.mapping=br:a===Lc&&(o.mapping=wr),o}function n(o){if(o&&o.isTexture){let a=o.mapping;if(a===Pc||a===Lc)if(t.has(o)){let l=t.get(o).texture;return e(l,o.mapping)}else{let l=o.image;if(l&&l.height>0){let c=new Bc(l.height);return c.fromEquirectangularTexture(i,o),t.set(o,c),o.addEventListener("dispose",s),e(c.texture,o.mapping)}else return null}}return o}function s(o){let a=o.target;a.removeEventListener("dispose",s);let l=t.get(a);l!==void 0&&(t.delete(a),l.dispose())}function r(){t=new WeakMap}return{get:n,dispose:r}}var za=class extends ka{constructor(t=-1,e=1,n=1,s=-1,r=.1,o=2e3){super(),this.isOrthographicCamera=!0,this.type="OrthographicCamera",this.zoom=1,this.view=null,this.left=t,this.right=e,this.top=n,this.bottom=s,this.near=r,this.far=o,this.updateProjectionMatrix()}copy(t,e){return super.copy(t,e),this.left=t.left,this.right=t.right,this.top=t.top,this.bottom=t.bottom,this.near=t.near,this.far=t.far,this.zoom=t.zoom,this.view=t.view===null?null:Object.assign({},t.view),this}setViewOffset(t,e,n,s,r,o){this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=t,this.view.fullHeight=e,this.view.offsetX=n,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let t=(this.right-this.left)/(2*this.zoom),e=(this.top-this.bottom)/(2*this.zoom),n=(this.right+this.left)/2,s=(this.top+this.bottom)/2,r=n-t,o=n+t,a=s+e,l=s-e;if(this.view!==null&&this.view.enabled){let c=(this.right-this.left)/this.view.fullWidth/this.zoom,u=(this.top-this.bottom)/this.view.fullHeight/this.zoom;r+=c*this.view.offsetX,o=r+c*this.view.width,a-=u*this.view.offsetY,l=a-u*this.view.height}this.projectionMatrix.makeOrthographic(r,o,a,l,this.near,this.far,this.coordinateSystem),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(t){let e=super.toJSON(t);return e.object.zoom=this.zoom,e.object.left=this.left,e.object.right=this.right,e.object.top=this.top,e.object.bottom=this.bottom,e.object.near=this.near,e.object.far=this.far,this.view!==null&&(e.object.view=Object.assign({},this.view)),e}},_r=4,Gd=[.125,.215,.35,.446,.526,.582],Ss=20,xc=new za,Wd=new ce,Mc=null,bc=0,wc=0,Sc=!1,bs=(1+Math.sqrt(5))/2,pr=1/bs,Xd=[new V(-bs,pr,0),new V(bs,pr,0),new V(-pr,0,bs),new V(pr,0,bs),new V(0,bs,-pr),new V(0,bs,pr),new V(-1,1,-1),new V(1,1,-1),new V(-1,1,1),new V(1,1,1)],Va=class{constructor(t){this._renderer=t,this._pingPongRenderTarget=null,this._lodMax=0,this._cubeSize=0,this._lodPlanes=[],this._sizeLods=[],this._sigmas=[],this._blurMaterial=null,this._cubemapMaterial=null,this._equirectMaterial=null,this._compileMaterial(this._blurMaterial)}fromScene(t,e=0,n=.1,s=100){Mc=this._renderer.getRenderTarget(),bc=this._renderer.getActiveCubeFace(),wc=this._renderer.getActiveMipmapLevel(),Sc=this._renderer.xr.enabled,this._renderer.xr.enabled=!1,this._setSize(256);let r=this._allocateTargets();return r.depthBuffer=!0,this._sceneToCubeUV(t,n,s,r),e>0&&this._blur(r,0,0,e),this._applyPMREM(r),this._cleanup(r),r}fromEquirectangular(t,e=null){return this._fromTexture(t,e)}fromCubemap(t,e=null){return this._fromTexture(t,e)}compileCubemapShader(){this._cubemapMaterial===null&&(this._cubemapMaterial=Yd(),this._compileMaterial(this._cubemapMaterial))}compileEquirectangularShader(){this._equirectMaterial===null&&(this._equirectMaterial=qd(),this._compileMaterial(this._equirectMaterial))}dispose(){this._dispose(),this._cubemapMaterial!==null&&this._cubemapMaterial.dispose(),this._equirectMaterial!==null&&this._equirectMaterial.dispose()}_setSize(t){this._lodMax=Math.floor(Math.log2(t)),this._cubeSize=Math.pow(2,this._lodMax)}_dispose(){this._blurMaterial!==null&&this._blurMaterial.dispose(),this._pingPongRenderTarget!==null&&this._pingPongRenderTarget.dispose();for(let t=0;t<this._lodPlanes.length;t++)this._lodPlanes[t].dispose()}_cleanup(t){this._renderer.setRenderTarget(Mc,bc,wc),this._renderer.xr.enabled=Sc,t.scissorTest=!1,xa(t,0,0,t.width,t.height)}_fromTexture(t,e){t.mapping===br||t.mapping===wr?this._setSize(t.image.length===0?16:t.image[0].width||t.image[0].image.width):this._setSize(t.image.width/4),Mc=this._renderer.getRenderTarget(),bc=this._renderer.getActiveCubeFace(),wc=this._renderer.getActiveMipmapLevel(),Sc=this._renderer.xr.enabled,this._renderer.xr.enabled=!1;let n=e||this._allocateTargets();return this._textureToCubeUV(t,n),this._applyPMREM(n),this._cleanup(n),n}_allocateTargets(){let t=3*Math.max(this._cubeSize,112),e=4*this._cubeSize,n={magFilter:ai,minFilter:ai,generateMipmaps:!1,type:el,format:xi,colorSpace:ls,depthBuffer:!1},s=$d(t,e,n);if(this._pingPongRenderTarget===null||this._pingPongRenderTarget.width!==t||this._pingPongRenderTarget.height!==e){this._pingPongRenderTarget!==null&&this._dispose(),this._pingPongRenderTarget=$d(t,e,n);let{_lodMax:r}=this;({sizeLods:this._sizeLods,lodPlanes:this._lodPlanes,sigmas:this._sigmas}=Xy(r)),this._blurMaterial=$y(r,t,e)}return s}_compileMaterial(t){let e=new zn(this._lodPlanes[0],t);this._renderer.compile(e,xc)}_sceneToCubeUV(t,e,n,s){let a=new An(90,1,e,n),l=[1,-1,1,1,1,1],c=[1,1,1,-1,-1,-1],u=this._renderer,d=u.autoClear,h=u.toneMapping;u.getClearColor(Wd),u.toneMapping=is,u.autoClear=!1;let p=new Cr({name:"PMREM.Background",side:Un,depthWrite:!1,depthTest:!1}),g=new zn(new As,p),v=!1,m=t.background;m?m.isColor&&(p.color.copy(m),t.background=null,v=!0):(p.color.copy(Wd),v=!0);for(let f=0;f<6;f++){let T=f%3;T===0?(a.up.set(0,l[f],0),a.lookAt(c[f],0,0)):T===1?(a.up.set(0,0,l[f]),a.lookAt(0,c[f],0)):(a.up.set(0,l[f],0),a.lookAt(0,0,c[f]));let b=this._cubeSize;xa(s,T*b,f>2?b:0,b,b),u.setRenderTarget(s),v&&u.render(g,a),u.render(t,a)}g.geometry.dispose(),g.material.dispose(),u.toneMapping=h,u.autoClear=d,t.background=m}_textureToCubeUV(t,e){let n=this._renderer,s=t.mapping===br||t.mapping===wr;s?(this._cubemapMaterial===null&&(this._cubemapMaterial=Yd()),this._cubemapMaterial.uniforms.flipEnvMap.value=t.isRenderTargetTexture===!1?-1:1):this._equirectMaterial===null&&(this._equirectMaterial=qd());let r=s?this._cubemapMaterial:this._equirectMaterial,o=new zn(this._lodPlanes[0],r),a=r.uniforms;a.envMap.value=t;let l=this._cubeSize;xa(e,0,0,3*l,2*l),n.setRenderTarget(e),n.render(o,xc)}_applyPMREM(t){let e=this._renderer,n=e.autoClear;e.autoClear=!1;let s=this._lodPlanes.length;for(let r=1;r<s;r++){let o=Math.sqrt(this._sigmas[r]*this._sigmas[r]-this._sigmas[r-1]*this._sigmas[r-1]),a=Xd[(s-r-1)%Xd.length];this._blur(t,r-1,r,o,a)}e.autoClear=n}_blur(t,e,n,s,r){let o=this._pingPongRenderTarget;this._halfBlur(t,o,e,n,s,"latitudinal",r),this._halfBlur(o,t,n,n,s,"longitudinal",r)}_halfBlur(t,e,n,s,r,o,a){let l=this._renderer,c=this._blurMaterial;o!=="latitudinal"&&o!=="longitudinal"&&console.error("blur direction must be either latitudinal or longitudinal!");let u=3,d=new zn(this._lodPlanes[s],c),h=c.uniforms,p=this._sizeLods[n]-1,g=isFinite(r)?Math.PI/(2*p):2*Math.PI/(2*Ss-1),v=r/g,m=isFinite(r)?1+Math.floor(u*v):Ss;m>Ss&&console.warn(`sigmaRadians, ${r}, is too large and will clip, as it requested ${m} samples when the maximum is set to ${Ss}`);let f=[],T=0;for(let C=0;C<Ss;++C){let F=C/v,S=Math.exp(-F*F/2);f.push(S),C===0?T+=S:C<m&&(T+=2*S)}for(let C=0;C<f.length;C++)f[C]=f[C]/T;h.envMap.value=t.texture,h.samples.value=m,h.weights.value=f,h.latitudinal.value=o==="latitudinal",a&&(h.poleAxis.value=a);let{_lodMax:b}=this;h.dTheta.value=g,h.mipInt.value=b-n;let A=this._sizeLods[s],N=3*A*(s>b-_r?s-b+_r:0),L=4*(this._cubeSize-A);xa(e,N,L,3*A,2*A),l.setRenderTarget(e),l.render(d,xc)}};function Xy(i){let t=[],e=[],n=[],s=i,r=i-_r+1+Gd.length;for(let o=0;o<r;o++){let a=Math.pow(2,s);e.push(a);let l=1/a;o>i-_r?l=Gd[o-i+_r-1]:o===0&&(l=0),n.push(l);let c=1/(a-2),u=-c,d=1+c,h=[u,u,d,u,d,d,u,u,d,d,u,d],p=6,g=6,v=3,m=2,f=1,T=new Float32Array(v*g*p),b=new Float32Array(m*g*p),A=new Float32Array(f*g*p);for(let L=0;L<p;L++){let C=L%3*2/3-1,F=L>2?0:-1,S=[C,F,0,C+2/3,F,0,C+2/3,F+1,0,C,F,0,C+2/3,F+1,0,C,F+1,0];T.set(S,v*g*L),b.set(h,m*g*L);let x=[L,L,L,L,L,L];A.set(x,f*g*L)}let N=new Cn;N.setAttribute("position",new Vn(T,v)),N.setAttribute("uv",new Vn(b,m)),N.setAttribute("faceIndex",new Vn(A,f)),t.push(N),s>_r&&s--}return{lodPlanes:t,sizeLods:e,sigmas:n}}function $d(i,t,e){let n=new ki(i,t,e);return n.texture.mapping=tl,n.texture.name="PMREM.cubeUv",n.scissorTest=!0,n}function xa(i,t,e,n,s){i.viewport.set(t,e,n,s),i.scissor.set(t,e,n,s)}function $y(i,t,e){let n=new Float32Array(Ss),s=new V(0,1,0);return new wi({name:"SphericalGaussianBlur",defines:{n:Ss,CUBEUV_TEXEL_WIDTH:1/t,CUBEUV_TEXEL_HEIGHT:1/e,CUBEUV_MAX_MIP:`${i}.0`},uniforms:{envMap:{value:null},samples:{value:1},weights:{value:n},latitudinal:{value:!1},dTheta:{value:0},mipInt:{value:0},poleAxis:{value:s}},vertexShader:mh(),fragmentShader:`

			precision mediump float;
			precision mediump int;

			varying vec3 vOutputDirection;

			uniform sampler2D envMap;
			uniform int samples;
			uniform float weights[ n ];
			uniform bool latitudinal;
			uniform float dTheta;
			uniform float mipInt;
			uniform vec3 poleAxis;

			#define ENVMAP_TYPE_CUBE_UV
			#include <cube_uv_reflection_fragment>

			vec3 getSample( float theta, vec3 axis ) {

				float cosTheta = cos( theta );
				// Rodrigues' axis-angle rotation
				vec3 sampleDirection = vOutputDirection * cosTheta
					+ cross( axis, vOutputDirection ) * sin( theta )
					+ axis * dot( axis, vOutputDirection ) * ( 1.0 - cosTheta );

				return bilinearCubeUV( envMap, sampleDirection, mipInt );

			}

			void main() {

				vec3 axis = latitudinal ? poleAxis : cross( poleAxis, vOutputDirection );

				if ( all( equal( axis, vec3( 0.0 ) ) ) ) {

					axis = vec3( vOutputDirection.z, 0.0, - vOutputDirection.x );

				}

				axis = normalize( axis );

				gl_FragColor = vec4( 0.0, 0.0, 0.0, 1.0 );
				gl_FragColor.rgb += weights[ 0 ] * getSample( 0.0, axis );

				for ( int i = 1; i < n; i++ ) {

					if ( i >= samples ) {

						break;

					}

					float theta = dTheta * float( i );
					gl_FragColor.rgb += weights[ i ] * getSample( -1.0 * theta, axis );
					gl_FragColor.rgb += weights[ i ] * getSample( theta, axis );

				}

			}
		`,blending:ns,depthTest:!1,depthWrite:!1})}function qd(){return new wi({name:"EquirectangularToCubeUV",uniforms:{envMap:{value:null}},vertexShader:mh(),fragmentShader:`

			precision mediump float;
			precision mediump int;

			varying vec3 vOutputDirection;

			uniform sampler2D envMap;

			#include <common>

			void main() {

				vec3 outputDirection = normalize( vOutputDirection );
				vec2 uv = equirectUv( outputDirection );

				gl_FragColor = vec4( texture2D ( envMap, uv ).rgb, 1.0 );

			}
		`,blending:ns,depthTest:!1,depthWrite:!1})}function Yd(){return new wi({name:"CubemapToCubeUV",uniforms:{envMap:{value:null},flipEnvMap:{value:-1}},vertexShader:mh(),fragmentShader:`

			precision mediump float;
			precision mediump int;

			uniform float flipEnvMap;

			varying vec3 vOutputDirection;

			uniform samplerCube envMap;

			void main() {

				gl_FragColor = textureCube( envMap, vec3( flipEnvMap * vOutputDirection.x, vOutputDirection.yz ) );

			}
		`,blending:ns,depthTest:!1,depthWrite:!1})}function mh(){return`

		precision mediump float;
		precision mediump int;

		attribute float faceIndex;

		varying vec3 vOutputDirection;

		// RH coordinate system; PMREM face-indexing convention
		vec3 getDirection( vec2 uv, float face ) {

			uv = 2.0 * uv - 1.0;

			vec3 direction = vec3( uv, 1.0 );

			if ( face == 0.0 ) {

				direction = direction.zyx; // ( 1, v, u ) pos x

			} else if ( face == 1.0 ) {

				direction = direction.xzy;
				direction.xz *= -1.0; // ( -u, 1, -v ) pos y

			} else if ( face == 2.0 ) {

				direction.x *= -1.0; // ( -u, v, 1 ) pos z

			} else if ( face == 3.0 ) {

				direction = direction.zyx;
				direction.xz *= -1.0; // ( -1, v, -u ) neg x

			} else if ( face == 4.0 ) {

				direction = direction.xzy;
				direction.xy *= -1.0; // ( -u, -1, v ) neg y

			} else if ( face == 5.0 ) {

				direction.z *= -1.0; // ( u, v, -1 ) neg z

			}

			return direction;

		}

		void main() {

			vOutputDirection = getDirection( uv, faceIndex );
			gl_Position = vec4( position, 1.0 );

		}
	`}function qy(i){let t=new WeakMap,e=null;function n(a){if(a&&a.isTexture){let l=a.mapping,c=l===Pc||l===Lc,u=l===br||l===wr;if(c||u){let d=t.get(a),h=d!==void 0?d.texture.pmremVersion:0;if(a.isRenderTargetTexture&&a.pmremVersion!==h)return e===null&&(e=new Va(i)),d=c?e.fromEquirectangular(a,d):e.fromCubemap(a,d),d.texture.pmremVersion=a.pmremVersion,t.set(a,d),d.texture;if(d!==void 0)return d.texture;{let p=a.image;return c&&p&&p.height>0||u&&p&&s(p)?(e===null&&(e=new Va(i)),d=c?e.fromEquirectangular(a):e.fromCubemap(a),d.texture.pmremVersion=a.pmremVersion,t.set(a,d),a.addEventListener("dispose",r),d.texture):null}}}return a}function s(a){let l=0,c=6;for(let u=0;u<c;u++)a[u]!==void 0&&l++;return l===c}function r(a){let l=a.target;l.removeEventListener("dispose",r);let c=t.get(l);c!==void 0&&(t.delete(l),c.dispose())}function o(){t=new WeakMap,e!==null&&(e.dispose(),e=null)}return{get:n,dispose:o}}function Yy(i){let t={};function e(n){if(t[n]!==void 0)return t[n];let s;switch(n){case"WEBGL_depth_texture":s=i.getExtension("WEBGL_depth_texture")||i.getExtension("MOZ_WEBGL_depth_texture")||i.getExtension("WEBKIT_WEBGL_depth_texture");break;case"EXT_texture_filter_anisotropic":s=i.getExtension("EXT_texture_filter_anisotropic")||i.getExtension("MOZ_EXT_texture_filter_anisotropic")||i.getExtension("WEBKIT_EXT_texture_filter_anisotropic");break;case"WEBGL_compressed_texture_s3tc":s=i.getExtension("WEBGL_compressed_texture_s3tc")||i.getExtension("MOZ_WEBGL_compressed_texture_s3tc")||i.getExtension("WEBKIT_WEBGL_compressed_texture_s3tc");break;case"WEBGL_compressed_texture_pvrtc":s=i.getExtension("WEBGL_compressed_texture_pvrtc")||i.getExtension("WEBKIT_WEBGL_compressed_texture_pvrtc");break;default:s=i.getExtension(n)}return t[n]=s,s}return{has:function(n){return e(n)!==null},init:function(){e("EXT_color_buffer_float"),e("WEBGL_clip_cull_distance"),e("OES_texture_float_linear"),e("EXT_color_buffer_half_float"),e("WEBGL_multisampled_render_to_texture"),e("WEBGL_render_shared_exponent")},get:function(n){let s=e(n);return s===null&&If("THREE.WebGLRenderer: "+n+" extension not supported."),s}}}function Zy(i,t,e,n){let s={},r=new WeakMap;function o(d){let h=d.target;h.index!==null&&t.remove(h.index);for(let g in h.attributes)t.remove(h.attributes[g]);for(let g in h.morphAttributes){let v=h.morphAttributes[g];for(let m=0,f=v.length;m<f;m++)t.remove(v[m])}h.removeEventListener("dispose",o),delete s[h.id];let p=r.get(h);p&&(t.remove(p),r.delete(h)),n.releaseStatesOfGeometry(h),h.isInstancedBufferGeometry===!0&&delete h._maxInstanceCount,e.memory.geometries--}function a(d,h){return s[h.id]===!0||(h.addEventListener("dispose",o),s[h.id]=!0,e.memory.geometries++),h}function l(d){let h=d.attributes;for(let g in h)t.update(h[g],i.ARRAY_BUFFER);let p=d.morphAttributes;for(let g in p){let v=p[g];for(let m=0,f=v.length;m<f;m++)t.update(v[m],i.ARRAY_BUFFER)}}function c(d){let h=[],p=d.index,g=d.attributes.position,v=0;if(p!==null){let T=p.array;v=p.version;for(let b=0,A=T.length;b<A;b+=3){let N=T[b+0],L=T[b+1],C=T[b+2];h.push(N,L,L,C,C,N)}}else if(g!==void 0){let T=g.array;v=g.version;for(let b=0,A=T.length/3-1;b<A;b+=3){let N=b+0,L=b+1,C=b+2;h.push(N,L,L,C,C,N)}}else return;let m=new(Lf(h)?Fa:Oa)(h,1);m.version=v;let f=r.get(d);f&&t.remove(f),r.set(d,m)}function u(d){let h=r.get(d);if(h){let p=d.index;p!==null&&h.version<p.version&&c(d)}else c(d);return r.get(d)}return{get:a,update:l,getWireframeAttribute:u}}function Jy(i,t,e){let n;function s(h){n=h}let r,o;function a(h){r=h.type,o=h.bytesPerElement}function l(h,p){i.drawElements(n,p,r,h*o),e.update(p,n,1)}function c(h,p,g){g!==0&&(i.drawElementsInstanced(n,p,r,h*o,g),e.update(p,n,g))}function u(h,p,g){if(g===0)return;let v=t.get("WEBGL_multi_draw");if(v===null)for(let m=0;m<g;m++)this.render(h[m]/o,p[m]);else{v.multiDrawElementsWEBGL(n,p,0,r,h,0,g);let m=0;for(let f=0;f<g;f++)m+=p[f];e.update(m,n,1)}}function d(h,p,g,v){if(g===0)return;let m=t.get("WEBGL_multi_draw");if(m===null)for(let f=0;f<h.length;f++)c(h[f]/o,p[f],v[f]);else{m.multiDrawElementsInstancedWEBGL(n,p,0,r,h,0,v,0,g);let f=0;for(let T=0;T<g;T++)f+=p[T];for(let T=0;T<v.length;T++)e.update(f,n,v[T])}}this.setMode=s,this.setIndex=a,this.render=l,this.renderInstances=c,this.renderMultiDraw=u,this.renderMultiDrawInstances=d}function Ky(i){let t={geometries:0,textures:0},e={frame:0,calls:0,triangles:0,points:0,lines:0};function n(r,o,a){switch(e.calls++,o){case i.TRIANGLES:e.triangles+=a*(r/3);break;case i.LINES:e.lines+=a*(r/2);break;case i.LINE_STRIP:e.lines+=a*(r-1);break;case i.LINE_LOOP:e.lines+=a*r;break;case i.POINTS:e.points+=a*r;break;default:console.error("THREE.WebGLInfo: Unknown draw mode:",o);break}}function s(){e.calls=0,e.triangles=0,e.points=0,e.lines=0}return{memory:t,render:e,programs:null,autoReset:!0,reset:s,update:n}}function jy(i,t,e){let n=new WeakMap,s=new Ze;function r(o,a,l){let c=o.morphTargetInfluences,u=a.morphAttributes.position||a.morphAttributes.normal||a.morphAttributes.color,d=u!==void 0?u.length:0,h=n.get(a);if(h===void 0||h.count!==d){let S=function(){C.dispose(),n.delete(a),a.removeEventListener("dispose",S)};h!==void 0&&h.texture.dispose();let p=a.morphAttributes.position!==void 0,g=a.morphAttributes.normal!==void 0,v=a.morphAttributes.color!==void 0,m=a.morphAttributes.position||[],f=a.morphAttributes.normal||[],T=a.morphAttributes.color||[],b=0;p===!0&&(b=1),g===!0&&(b=2),v===!0&&(b=3);let A=a.attributes.position.count*b,N=1;A>t.maxTextureSize&&(N=Math.ceil(A/t.maxTextureSize),A=t.maxTextureSize);let L=new Float32Array(A*N*4*d),C=new Na(L,A,N,d);C.type=Oi,C.needsUpdate=!0;let F=b*4;for(let x=0;x<d;x++){let R=m[x],z=f[x],B=T[x],X=A*N*4*x;for(let J=0;J<R.count;J++){let q=J*F;p===!0&&(s.fromBufferAttribute(R,J),L[X+q+0]=s.x,L[X+q+1]=s.y,L[X+q+2]=s.z,L[X+q+3]=0),g===!0&&(s.fromBufferAttribute(z,J),L[X+q+4]=s.x,L[X+q+5]=s.y,L[X+q+6]=s.z,L[X+q+7]=0),v===!0&&(s.fromBufferAttribute(B,J),L[X+q+8]=s.x,L[X+q+9]=s.y,L[X+q+10]=s.z,L[X+q+11]=B.itemSize===4?s.w:1)}}h={count:d,texture:C,size:new Jt(A,N)},n.set(a,h),a.addEventListener("dispose",S)}if(o.isInstancedMesh===!0&&o.morphTexture!==null)l.getUniforms().setValue(i,"morphTexture",o.morphTexture,e);else{let p=0;for(let v=0;v<c.length;v++)p+=c[v];let g=a.morphTargetsRelative?1:1-p;l.getUniforms().setValue(i,"morphTargetBaseInfluence",g),l.getUniforms().setValue(i,"morphTargetInfluences",c)}l.getUniforms().setValue(i,"morphTargetsTexture",h.texture,e),l.getUniforms().setValue(i,"morphTargetsTextureSize",h.size)}return{update:r}}function Qy(i,t,e,n){let s=new WeakMap;function r(l){let c=n.render.frame,u=l.geometry,d=t.get(l,u);if(s.get(d)!==c&&(t.update(d),s.set(d,c)),l.isInstancedMesh&&(l.hasEventListener("dispose",a)===!1&&l.addEventListener("dispose",a),s.get(l)!==c&&(e.update(l.instanceMatrix,i.ARRAY_BUFFER),l.instanceColor!==null&&e.update(l.instanceColor,i.ARRAY_BUFFER),s.set(l,c))),l.isSkinnedMesh){let h=l.skeleton;s.get(h)!==c&&(h.update(),s.set(h,c))}return d}function o(){s=new WeakMap}function a(l){let c=l.target;c.removeEventListener("dispose",a),e.remove(c.instanceMatrix),c.instanceColor!==null&&e.remove(c.instanceColor)}return{update:r,dispose:o}}var Ha=class extends mn{constructor(t,e,n,s,r,o,a,l,c,u=yr){if(u!==yr&&u!==Tr)throw new Error("DepthTexture format must be either THREE.DepthFormat or THREE.DepthStencilFormat");n===void 0&&u===yr&&(n=Sr),n===void 0&&u===Tr&&(n=Er),super(null,s,r,o,a,l,u,n,c),this.isDepthTexture=!0,this.image={width:t,height:e},this.magFilter=a!==void 0?a:Nn,this.minFilter=l!==void 0?l:Nn,this.flipY=!1,this.generateMipmaps=!1,this.compareFunction=null}copy(t){return super.copy(t),this.compareFunction=t.compareFunction,this}toJSON(t){let e=super.toJSON(t);return this.compareFunction!==null&&(e.compareFunction=this.compareFunction),e}},Of=new mn,Ff=new Ha(1,1);Ff.compareFunction=Rf;var kf=new Na,Bf=new Fc,zf=new Ba,Zd=[],Jd=[],Kd=new Float32Array(16),jd=new Float32Array(9),Qd=new Float32Array(4);function Or(i,t,e){let n=i[0];if(n<=0||n>0)return i;let s=t*e,r=Zd[s];if(r===void 0&&(r=new Float32Array(s),Zd[s]=r),t!==0){n.toArray(r,0);for(let o=1,a=0;o!==t;++o)a+=e,i[o].toArray(r,a)}return r}function nn(i,t){if(i.length!==t.length)return!1;for(let e=0,n=i.length;e<n;e++)if(i[e]!==t[e])return!1;return!0}function sn(i,t){for(let e=0,n=t.length;e<n;e++)i[e]=t[e]}function il(i,t){let e=Jd[t];e===void 0&&(e=new Int32Array(t),Jd[t]=e);for(let n=0;n!==t;++n)e[n]=i.allocateTextureUnit();return e}function tx(i,t){let e=this.cache;e[0]!==t&&(i.uniform1f(this.addr,t),e[0]=t)}function ex(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(i.uniform2f(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(nn(e,t))return;i.uniform2fv(this.addr,t),sn(e,t)}}function nx(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(i.uniform3f(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else if(t.r!==void 0)(e[0]!==t.r||e[1]!==t.g||e[2]!==t.b)&&(i.uniform3f(this.addr,t.r,t.g,t.b),e[0]=t.r,e[1]=t.g,e[2]=t.b);else{if(nn(e,t))return;i.uniform3fv(this.addr,t),sn(e,t)}}function ix(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(i.uniform4f(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(nn(e,t))return;i.uniform4fv(this.addr,t),sn(e,t)}}function sx(i,t){let e=this.cache,n=t.elements;if(n===void 0){if(nn(e,t))return;i.uniformMatrix2fv(this.addr,!1,t),sn(e,t)}else{if(nn(e,n))return;Qd.set(n),i.uniformMatrix2fv(this.addr,!1,Qd),sn(e,n)}}function rx(i,t){let e=this.cache,n=t.elements;if(n===void 0){if(nn(e,t))return;i.uniformMatrix3fv(this.addr,!1,t),sn(e,t)}else{if(nn(e,n))return;jd.set(n),i.uniformMatrix3fv(this.addr,!1,jd),sn(e,n)}}function ox(i,t){let e=this.cache,n=t.elements;if(n===void 0){if(nn(e,t))return;i.uniformMatrix4fv(this.addr,!1,t),sn(e,t)}else{if(nn(e,n))return;Kd.set(n),i.uniformMatrix4fv(this.addr,!1,Kd),sn(e,n)}}function ax(i,t){let e=this.cache;e[0]!==t&&(i.uniform1i(this.addr,t),e[0]=t)}function lx(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(i.uniform2i(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(nn(e,t))return;i.uniform2iv(this.addr,t),sn(e,t)}}function cx(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(i.uniform3i(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else{if(nn(e,t))return;i.uniform3iv(this.addr,t),sn(e,t)}}function hx(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(i.uniform4i(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(nn(e,t))return;i.uniform4iv(this.addr,t),sn(e,t)}}function ux(i,t){let e=this.cache;e[0]!==t&&(i.uniform1ui(this.addr,t),e[0]=t)}function dx(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(i.uniform2ui(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(nn(e,t))return;i.uniform2uiv(this.addr,t),sn(e,t)}}function fx(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(i.uniform3ui(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else{if(nn(e,t))return;i.uniform3uiv(this.addr,t),sn(e,t)}}function px(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(i.uniform4ui(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(nn(e,t))return;i.uniform4uiv(this.addr,t),sn(e,t)}}function mx(i,t,e){let n=this.cache,s=e.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s);let r=this.type===i.SAMPLER_2D_SHADOW?Ff:Of;e.setTexture2D(t||r,s)}function gx(i,t,e){let n=this.cache,s=e.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s),e.setTexture3D(t||Bf,s)}function _x(i,t,e){let n=this.cache,s=e.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s),e.setTextureCube(t||zf,s)}function vx(i,t,e){let n=this.cache,s=e.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s),e.setTexture2DArray(t||kf,s)}function yx(i){switch(i){case 5126:return tx;case 35664:return ex;case 35665:return nx;case 35666:return ix;case 35674:return sx;case 35675:return rx;case 35676:return ox;case 5124:case 35670:return ax;case 35667:case 35671:return lx;case 35668:case 35672:return cx;case 35669:case 35673:return hx;case 5125:return ux;case 36294:return dx;case 36295:return fx;case 36296:return px;case 35678:case 36198:case 36298:case 36306:case 35682:return mx;case 35679:case 36299:case 36307:return gx;case 35680:case 36300:case 36308:case 36293:return _x;case 36289:case 36303:case 36311:case 36292:return vx}}function xx(i,t){i.uniform1fv(this.addr,t)}function Mx(i,t){let e=Or(t,this.size,2);i.uniform2fv(this.addr,e)}function bx(i,t){let e=Or(t,this.size,3);i.uniform3fv(this.addr,e)}function wx(i,t){let e=Or(t,this.size,4);i.uniform4fv(this.addr,e)}function Sx(i,t){let e=Or(t,this.size,4);i.uniformMatrix2fv(this.addr,!1,e)}function Ex(i,t){let e=Or(t,this.size,9);i.uniformMatrix3fv(this.addr,!1,e)}function Tx(i,t){let e=Or(t,this.size,16);i.uniformMatrix4fv(this.addr,!1,e)}function Ax(i,t){i.uniform1iv(this.addr,t)}function Cx(i,t){i.uniform2iv(this.addr,t)}function Rx(i,t){i.uniform3iv(this.addr,t)}function Px(i,t){i.uniform4iv(this.addr,t)}function Lx(i,t){i.uniform1uiv(this.addr,t)}function Ix(i,t){i.uniform2uiv(this.addr,t)}function Dx(i,t){i.uniform3uiv(this.addr,t)}function Nx(i,t){i.uniform4uiv(this.addr,t)}function Ux(i,t,e){let n=this.cache,s=t.length,r=il(e,s);nn(n,r)||(i.uniform1iv(this.addr,r),sn(n,r));for(let o=0;o!==s;++o)e.setTexture2D(t[o]||Of,r[o])}function Ox(i,t,e){let n=this.cache,s=t.length,r=il(e,s);nn(n,r)||(i.uniform1iv(this.addr,r),sn(n,r));for(let o=0;o!==s;++o)e.setTexture3D(t[o]||Bf,r[o])}function Fx(i,t,e){let n=this.cache,s=t.length,r=il(e,s);nn(n,r)||(i.uniform1iv(this.addr,r),sn(n,r));for(let o=0;o!==s;++o)e.setTextureCube(t[o]||zf,r[o])}function kx(i,t,e){let n=this.cache,s=t.length,r=il(e,s);nn(n,r)||(i.uniform1iv(this.addr,r),sn(n,r));for(let o=0;o!==s;++o)e.setTexture2DArray(t[o]||kf,r[o])}function Bx(i){switch(i){case 5126:return xx;case 35664:return Mx;case 35665:return bx;case 35666:return wx;case 35674:return Sx;case 35675:return Ex;case 35676:return Tx;case 5124:case 35670:return Ax;case 35667:case 35671:return Cx;case 35668:case 35672:return Rx;case 35669:case 35673:return Px;case 5125:return Lx;case 36294:return Ix;case 36295:return Dx;case 36296:return Nx;case 35678:case 36198:case 36298:case 36306:case 35682:return Ux;case 35679:case 36299:case 36307:return Ox;case 35680:case 36300:case 36308:case 36293:return Fx;case 36289:case 36303:case 36311:case 36292:return kx}}var zc=class{constructor(t,e,n){this.id=t,this.addr=n,this.cache=[],this.type=e.type,this.setValue=yx(e.type)}},Vc=class{constructor(t,e,n){this.id=t,this.addr=n,this.cache=[],this.type=e.type,this.size=e.size,this.setValue=Bx(e.type)}},Hc=class{constructor(t){this.id=t,this.seq=[],this.map={}}setValue(t,e,n){let s=this.seq;for(let r=0,o=s.length;r!==o;++r){let a=s[r];a.setValue(t,e[a.id],n)}}},Ec=/(\w+)(\])?(\[|\.)?/g;function tf(i,t){i.seq.push(t),i.map[t.id]=t}function zx(i,t,e){let n=i.name,s=n.length;for(Ec.lastIndex=0;;){let r=Ec.exec(n),o=Ec.lastIndex,a=r[1],l=r[2]==="]",c=r[3];if(l&&(a=a|0),c===void 0||c==="["&&o+2===s){tf(e,c===void 0?new zc(a,i,t):new Vc(a,i,t));break}else{let d=e.map[a];d===void 0&&(d=new Hc(a),tf(e,d)),e=d}}}var Mr=class{constructor(t,e){this.seq=[],this.map={};let n=t.getProgramParameter(e,t.ACTIVE_UNIFORMS);for(let s=0;s<n;++s){let r=t.getActiveUniform(e,s),o=t.getUniformLocation(e,r.name);zx(r,o,this)}}setValue(t,e,n,s){let r=this.map[e];r!==void 0&&r.setValue(t,n,s)}setOptional(t,e,n){let s=e[n];s!==void 0&&this.setValue(t,n,s)}static upload(t,e,n,s){for(let r=0,o=e.length;r!==o;++r){let a=e[r],l=n[a.id];l.needsUpdate!==!1&&a.setValue(t,l.value,s)}}static seqWithValue(t,e){let n=[];for(let s=0,r=t.length;s!==r;++s){let o=t[s];o.id in e&&n.push(o)}return n}};function ef(i,t,e){let n=i.createShader(t);return i.shaderSource(n,e),i.compileShader(n),n}var Vx=37297,Hx=0;function Gx(i,t){let e=i.split(`
`),n=[],s=Math.max(t-6,0),r=Math.min(t+6,e.length);for(let o=s;o<r;o++){let a=o+1;n.push(`${a===t?">":" "} ${a}: ${e[o]}`)}return n.join(`
`)}function Wx(i){let t=we.getPrimaries(we.workingColorSpace),e=we.getPrimaries(i),n;switch(t===e?n="":t===Pa&&e===Ra?n="LinearDisplayP3ToLinearSRGB":t===Ra&&e===Pa&&(n="LinearSRGBToLinearDisplayP3"),i){case ls:case nl:return[n,"LinearTransferOETF"];case vi:case fh:return[n,"sRGBTransferOETF"];default:return console.warn("THREE.WebGLProgram: Unsupported color space:",i),[n,"LinearTransferOETF"]}}function nf(i,t,e){let n=i.getShaderParameter(t,i.COMPILE_STATUS),s=i.getShaderInfoLog(t).trim();if(n&&s==="")return"";let r=/ERROR: 0:(\d+)/.exec(s);if(r){let o=parseInt(r[1]);return e.toUpperCase()+`

`+s+`

`+Gx(i.getShaderSource(t),o)}else return s}function Xx(i,t){let e=Wx(t);return`vec4 ${i}( vec4 value ) { return ${e[0]}( ${e[1]}( value ) ); }`}function $x(i,t){let e;switch(t){case Yg:e="Linear";break;case Zg:e="Reinhard";break;case Jg:e="OptimizedCineon";break;case Kg:e="ACESFilmic";break;case Qg:e="AgX";break;case t0:e="Neutral";break;case jg:e="Custom";break;default:console.warn("THREE.WebGLProgram: Unsupported toneMapping:",t),e="Linear"}return"vec3 "+i+"( vec3 color ) { return "+e+"ToneMapping( color ); }"}function qx(i){return[i.extensionClipCullDistance?"#extension GL_ANGLE_clip_cull_distance : require":"",i.extensionMultiDraw?"#extension GL_ANGLE_multi_draw : require":""].filter(_o).join(`
`)}function Yx(i){let t=[];for(let e in i){let n=i[e];n!==!1&&t.push("#define "+e+" "+n)}return t.join(`
`)}function Zx(i,t){let e={},n=i.getProgramParameter(t,i.ACTIVE_ATTRIBUTES);for(let s=0;s<n;s++){let r=i.getActiveAttrib(t,s),o=r.name,a=1;r.type===i.FLOAT_MAT2&&(a=2),r.type===i.FLOAT_MAT3&&(a=3),r.type===i.FLOAT_MAT4&&(a=4),e[o]={type:r.type,location:i.getAttribLocation(t,o),locationSize:a}}return e}function _o(i){return i!==""}function sf(i,t){let e=t.numSpotLightShadows+t.numSpotLightMaps-t.numSpotLightShadowsWithMaps;return i.replace(/NUM_DIR_LIGHTS/g,t.numDirLights).replace(/NUM_SPOT_LIGHTS/g,t.numSpotLights).replace(/NUM_SPOT_LIGHT_MAPS/g,t.numSpotLightMaps).replace(/NUM_SPOT_LIGHT_COORDS/g,e).replace(/NUM_RECT_AREA_LIGHTS/g,t.numRectAreaLights).replace(/NUM_POINT_LIGHTS/g,t.numPointLights).replace(/NUM_HEMI_LIGHTS/g,t.numHemiLights).replace(/NUM_DIR_LIGHT_SHADOWS/g,t.numDirLightShadows).replace(/NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS/g,t.numSpotLightShadowsWithMaps).replace(/NUM_SPOT_LIGHT_SHADOWS/g,t.numSpotLightShadows).replace(/NUM_POINT_LIGHT_SHADOWS/g,t.numPointLightShadows)}function rf(i,t){return i.replace(/NUM_CLIPPING_PLANES/g,t.numClippingPlanes).replace(/UNION_CLIPPING_PLANES/g,t.numClippingPlanes-t.numClipIntersection)}var Jx=/^[ \t]*#include +<([\w\d./]+)>/gm;function Gc(i){return i.replace(Jx,jx)}var Kx=new Map;function jx(i,t){let e=re[t];if(e===void 0){let n=Kx.get(t);if(n!==void 0)e=re[n],console.warn('THREE.WebGLRenderer: Shader chunk "%s" has been deprecated. Use "%s" instead.',t,n);else throw new Error("Can not resolve #include <"+t+">")}return Gc(e)}var Qx=/#pragma unroll_loop_start\s+for\s*\(\s*int\s+i\s*=\s*(\d+)\s*;\s*i\s*<\s*(\d+)\s*;\s*i\s*\+\+\s*\)\s*{([\s\S]+?)}\s+#pragma unroll_loop_end/g;function of(i){return i.replace(Qx,tM)}function tM(i,t,e,n){let s="";for(let r=parseInt(t);r<parseInt(e);r++)s+=n.replace(/\[\s*i\s*\]/g,"[ "+r+" ]").replace(/UNROLLED_LOOP_INDEX/g,r);return s}function af(i){let t=`precision ${i.precision} float;
	precision ${i.precision} int;
	precision ${i.precision} sampler2D;
	precision ${i.precision} samplerCube;
	precision ${i.precision} sampler3D;
	precision ${i.precision} sampler2DArray;
	precision ${i.precision} sampler2DShadow;
	precision ${i.precision} samplerCubeShadow;
	precision ${i.precision} sampler2DArrayShadow;
	precision ${i.precision} isampler2D;
	precision ${i.precision} isampler3D;
	precision ${i.precision} isamplerCube;
	precision ${i.precision} isampler2DArray;
	precision ${i.precision} usampler2D;
	precision ${i.precision} usampler3D;
	precision ${i.precision} usamplerCube;
	precision ${i.precision} usampler2DArray;
	`;return i.precision==="highp"?t+=`
#define HIGH_PRECISION`:i.precision==="mediump"?t+=`
#define MEDIUM_PRECISION`:i.precision==="lowp"&&(t+=`
#define LOW_PRECISION`),t}function eM(i){let t="SHADOWMAP_TYPE_BASIC";return i.shadowMapType===yf?t="SHADOWMAP_TYPE_PCF":i.shadowMapType===xg?t="SHADOWMAP_TYPE_PCF_SOFT":i.shadowMapType===Ni&&(t="SHADOWMAP_TYPE_VSM"),t}function nM(i){let t="ENVMAP_TYPE_CUBE";if(i.envMap)switch(i.envMapMode){case br:case wr:t="ENVMAP_TYPE_CUBE";break;case tl:t="ENVMAP_TYPE_CUBE_UV";break}return t}function iM(i){let t="ENVMAP_MODE_REFLECTION";if(i.envMap)switch(i.envMapMode){case wr:t="ENVMAP_MODE_REFRACTION";break}return t}function sM(i){let t="ENVMAP_BLENDING_NONE";if(i.envMap)switch(i.combine){case dh:t="ENVMAP_BLENDING_MULTIPLY";break;case $g:t="ENVMAP_BLENDING_MIX";break;case qg:t="ENVMAP_BLENDING_ADD";break}return t}function rM(i){let t=i.envMapCubeUVHeight;if(t===null)return null;let e=Math.log2(t)-2,n=1/t;return{texelWidth:1/(3*Math.max(Math.pow(2,e),7*16)),texelHeight:n,maxMip:e}}function oM(i,t,e,n){let s=i.getContext(),r=e.defines,o=e.vertexShader,a=e.fragmentShader,l=eM(e),c=nM(e),u=iM(e),d=sM(e),h=rM(e),p=qx(e),g=Yx(r),v=s.createProgram(),m,f,T=e.glslVersion?"#version "+e.glslVersion+`
`:"";e.isRawShaderMaterial?(m=["#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,g].filter(_o).join(`
`),m.length>0&&(m+=`
`),f=["#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,g].filter(_o).join(`
`),f.length>0&&(f+=`
`)):(m=[af(e),"#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,g,e.extensionClipCullDistance?"#define USE_CLIP_DISTANCE":"",e.batching?"#define USE_BATCHING":"",e.batchingColor?"#define USE_BATCHING_COLOR":"",e.instancing?"#define USE_INSTANCING":"",e.instancingColor?"#define USE_INSTANCING_COLOR":"",e.instancingMorph?"#define USE_INSTANCING_MORPH":"",e.useFog&&e.fog?"#define USE_FOG":"",e.useFog&&e.fogExp2?"#define FOG_EXP2":"",e.map?"#define USE_MAP":"",e.envMap?"#define USE_ENVMAP":"",e.envMap?"#define "+u:"",e.lightMap?"#define USE_LIGHTMAP":"",e.aoMap?"#define USE_AOMAP":"",e.bumpMap?"#define USE_BUMPMAP":"",e.normalMap?"#define USE_NORMALMAP":"",e.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",e.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",e.displacementMap?"#define USE_DISPLACEMENTMAP":"",e.emissiveMap?"#define USE_EMISSIVEMAP":"",e.anisotropy?"#define USE_ANISOTROPY":"",e.anisotropyMap?"#define USE_ANISOTROPYMAP":"",e.clearcoatMap?"#define USE_CLEARCOATMAP":"",e.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",e.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",e.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",e.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",e.specularMap?"#define USE_SPECULARMAP":"",e.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",e.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",e.roughnessMap?"#define USE_ROUGHNESSMAP":"",e.metalnessMap?"#define USE_METALNESSMAP":"",e.alphaMap?"#define USE_ALPHAMAP":"",e.alphaHash?"#define USE_ALPHAHASH":"",e.transmission?"#define USE_TRANSMISSION":"",e.transmissionMap?"#define USE_TRANSMISSIONMAP":"",e.thicknessMap?"#define USE_THICKNESSMAP":"",e.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",e.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",e.mapUv?"#define MAP_UV "+e.mapUv:"",e.alphaMapUv?"#define ALPHAMAP_UV "+e.alphaMapUv:"",e.lightMapUv?"#define LIGHTMAP_UV "+e.lightMapUv:"",e.aoMapUv?"#define AOMAP_UV "+e.aoMapUv:"",e.emissiveMapUv?"#define EMISSIVEMAP_UV "+e.emissiveMapUv:"",e.bumpMapUv?"#define BUMPMAP_UV "+e.bumpMapUv:"",e.normalMapUv?"#define NORMALMAP_UV "+e.normalMapUv:"",e.displacementMapUv?"#define DISPLACEMENTMAP_UV "+e.displacementMapUv:"",e.metalnessMapUv?"#define METALNESSMAP_UV "+e.metalnessMapUv:"",e.roughnessMapUv?"#define ROUGHNESSMAP_UV "+e.roughnessMapUv:"",e.anisotropyMapUv?"#define ANISOTROPYMAP_UV "+e.anisotropyMapUv:"",e.clearcoatMapUv?"#define CLEARCOATMAP_UV "+e.clearcoatMapUv:"",e.clearcoatNormalMapUv?"#define CLEARCOAT_NORMALMAP_UV "+e.clearcoatNormalMapUv:"",e.clearcoatRoughnessMapUv?"#define CLEARCOAT_ROUGHNESSMAP_UV "+e.clearcoatRoughnessMapUv:"",e.iridescenceMapUv?"#define IRIDESCENCEMAP_UV "+e.iridescenceMapUv:"",e.iridescenceThicknessMapUv?"#define IRIDESCENCE_THICKNESSMAP_UV "+e.iridescenceThicknessMapUv:"",e.sheenColorMapUv?"#define SHEEN_COLORMAP_UV "+e.sheenColorMapUv:"",e.sheenRoughnessMapUv?"#define SHEEN_ROUGHNESSMAP_UV "+e.sheenRoughnessMapUv:"",e.specularMapUv?"#define SPECULARMAP_UV "+e.specularMapUv:"",e.specularColorMapUv?"#define SPECULAR_COLORMAP_UV "+e.specularColorMapUv:"",e.specularIntensityMapUv?"#define SPECULAR_INTENSITYMAP_UV "+e.specularIntensityMapUv:"",e.transmissionMapUv?"#define TRANSMISSIONMAP_UV "+e.transmissionMapUv:"",e.thicknessMapUv?"#define THICKNESSMAP_UV "+e.thicknessMapUv:"",e.vertexTangents&&e.flatShading===!1?"#define USE_TANGENT":"",e.vertexColors?"#define USE_COLOR":"",e.vertexAlphas?"#define USE_COLOR_ALPHA":"",e.vertexUv1s?"#define USE_UV1":"",e.vertexUv2s?"#define USE_UV2":"",e.vertexUv3s?"#define USE_UV3":"",e.pointsUvs?"#define USE_POINTS_UV":"",e.flatShading?"#define FLAT_SHADED":"",e.skinning?"#define USE_SKINNING":"",e.morphTargets?"#define USE_MORPHTARGETS":"",e.morphNormals&&e.flatShading===!1?"#define USE_MORPHNORMALS":"",e.morphColors?"#define USE_MORPHCOLORS":"",e.morphTargetsCount>0?"#define MORPHTARGETS_TEXTURE_STRIDE "+e.morphTextureStride:"",e.morphTargetsCount>0?"#define MORPHTARGETS_COUNT "+e.morphTargetsCount:"",e.doubleSided?"#define DOUBLE_SIDED":"",e.flipSided?"#define FLIP_SIDED":"",e.shadowMapEnabled?"#define USE_SHADOWMAP":"",e.shadowMapEnabled?"#define "+l:"",e.sizeAttenuation?"#define USE_SIZEATTENUATION":"",e.numLightProbes>0?"#define USE_LIGHT_PROBES":"",e.logarithmicDepthBuffer?"#define USE_LOGDEPTHBUF":"","uniform mat4 modelMatrix;","uniform mat4 modelViewMatrix;","uniform mat4 projectionMatrix;","uniform mat4 viewMatrix;","uniform mat3 normalMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;","#ifdef USE_INSTANCING","	attribute mat4 instanceMatrix;","#endif","#ifdef USE_INSTANCING_COLOR","	attribute vec3 instanceColor;","#endif","#ifdef USE_INSTANCING_MORPH","	uniform sampler2D morphTexture;","#endif","attribute vec3 position;","attribute vec3 normal;","attribute vec2 uv;","#ifdef USE_UV1","	attribute vec2 uv1;","#endif","#ifdef USE_UV2","	attribute vec2 uv2;","#endif","#ifdef USE_UV3","	attribute vec2 uv3;","#endif","#ifdef USE_TANGENT","	attribute vec4 tangent;","#endif","#if defined( USE_COLOR_ALPHA )","	attribute vec4 color;","#elif defined( USE_COLOR )","	attribute vec3 color;","#endif","#ifdef USE_SKINNING","	attribute vec4 skinIndex;","	attribute vec4 skinWeight;","#endif",`
`].filter(_o).join(`
`),f=[af(e),"#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,g,e.useFog&&e.fog?"#define USE_FOG":"",e.useFog&&e.fogExp2?"#define FOG_EXP2":"",e.alphaToCoverage?"#define ALPHA_TO_COVERAGE":"",e.map?"#define USE_MAP":"",e.matcap?"#define USE_MATCAP":"",e.envMap?"#define USE_ENVMAP":"",e.envMap?"#define "+c:"",e.envMap?"#define "+u:"",e.envMap?"#define "+d:"",h?"#define CUBEUV_TEXEL_WIDTH "+h.texelWidth:"",h?"#define CUBEUV_TEXEL_HEIGHT "+h.texelHeight:"",h?"#define CUBEUV_MAX_MIP "+h.maxMip+".0":"",e.lightMap?"#define USE_LIGHTMAP":"",e.aoMap?"#define USE_AOMAP":"",e.bumpMap?"#define USE_BUMPMAP":"",e.normalMap?"#define USE_NORMALMAP":"",e.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",e.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",e.emissiveMap?"#define USE_EMISSIVEMAP":"",e.anisotropy?"#define USE_ANISOTROPY":"",e.anisotropyMap?"#define USE_ANISOTROPYMAP":"",e.clearcoat?"#define USE_CLEARCOAT":"",e.clearcoatMap?"#define USE_CLEARCOATMAP":"",e.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",e.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",e.dispersion?"#define USE_DISPERSION":"",e.iridescence?"#define USE_IRIDESCENCE":"",e.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",e.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",e.specularMap?"#define USE_SPECULARMAP":"",e.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",e.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",e.roughnessMap?"#define USE_ROUGHNESSMAP":"",e.metalnessMap?"#define USE_METALNESSMAP":"",e.alphaMap?"#define USE_ALPHAMAP":"",e.alphaTest?"#define USE_ALPHATEST":"",e.alphaHash?"#define USE_ALPHAHASH":"",e.sheen?"#define USE_SHEEN":"",e.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",e.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",e.transmission?"#define USE_TRANSMISSION":"",e.transmissionMap?"#define USE_TRANSMISSIONMAP":"",e.thicknessMap?"#define USE_THICKNESSMAP":"",e.vertexTangents&&e.flatShading===!1?"#define USE_TANGENT":"",e.vertexColors||e.instancingColor||e.batchingColor?"#define USE_COLOR":"",e.vertexAlphas?"#define USE_COLOR_ALPHA":"",e.vertexUv1s?"#define USE_UV1":"",e.vertexUv2s?"#define USE_UV2":"",e.vertexUv3s?"#define USE_UV3":"",e.pointsUvs?"#define USE_POINTS_UV":"",e.gradientMap?"#define USE_GRADIENTMAP":"",e.flatShading?"#define FLAT_SHADED":"",e.doubleSided?"#define DOUBLE_SIDED":"",e.flipSided?"#define FLIP_SIDED":"",e.shadowMapEnabled?"#define USE_SHADOWMAP":"",e.shadowMapEnabled?"#define "+l:"",e.premultipliedAlpha?"#define PREMULTIPLIED_ALPHA":"",e.numLightProbes>0?"#define USE_LIGHT_PROBES":"",e.decodeVideoTexture?"#define DECODE_VIDEO_TEXTURE":"",e.logarithmicDepthBuffer?"#define USE_LOGDEPTHBUF":"","uniform mat4 viewMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;",e.toneMapping!==is?"#define TONE_MAPPING":"",e.toneMapping!==is?re.tonemapping_pars_fragment:"",e.toneMapping!==is?$x("toneMapping",e.toneMapping):"",e.dithering?"#define DITHERING":"",e.opaque?"#define OPAQUE":"",re.colorspace_pars_fragment,Xx("linearToOutputTexel",e.outputColorSpace),e.useDepthPacking?"#define DEPTH_PACKING "+e.depthPacking:"",`
`].filter(_o).join(`
`)),o=Gc(o),o=sf(o,e),o=rf(o,e),a=Gc(a),a=sf(a,e),a=rf(a,e),o=of(o),a=of(a),e.isRawShaderMaterial!==!0&&(T=`#version 300 es
`,m=[p,"#define attribute in","#define varying out","#define texture2D texture"].join(`
`)+`
`+m,f=["#define varying in",e.glslVersion===bd?"":"layout(location = 0) out highp vec4 pc_fragColor;",e.glslVersion===bd?"":"#define gl_FragColor pc_fragColor","#define gl_FragDepthEXT gl_FragDepth","#define texture2D texture","#define textureCube texture","#define texture2DProj textureProj","#define texture2DLodEXT textureLod","#define texture2DProjLodEXT textureProjLod","#define textureCubeLodEXT textureLod","#define texture2DGradEXT textureGrad","#define texture2DProjGradEXT textureProjGrad","#define textureCubeGradEXT textureGrad"].join(`
`)+`
`+f);let b=T+m+o,A=T+f+a,N=ef(s,s.VERTEX_SHADER,b),L=ef(s,s.FRAGMENT_SHADER,A);s.attachShader(v,N),s.attachShader(v,L),e.index0AttributeName!==void 0?s.bindAttribLocation(v,0,e.index0AttributeName):e.morphTargets===!0&&s.bindAttribLocation(v,0,"position"),s.linkProgram(v);function C(R){if(i.debug.checkShaderErrors){let z=s.getProgramInfoLog(v).trim(),B=s.getShaderInfoLog(N).trim(),X=s.getShaderInfoLog(L).trim(),J=!0,q=!0;if(s.getProgramParameter(v,s.LINK_STATUS)===!1)if(J=!1,typeof i.debug.onShaderError=="function")i.debug.onShaderError(s,v,N,L);else{let st=nf(s,N,"vertex"),nt=nf(s,L,"fragment");console.error("THREE.WebGLProgram: Shader Error "+s.getError()+" - VALIDATE_STATUS "+s.getProgramParameter(v,s.VALIDATE_STATUS)+`

Material Name: `+R.name+`
Material Type: `+R.type+`

Program Info Log: `+z+`
`+st+`
`+nt)}else z!==""?console.warn("THREE.WebGLProgram: Program Info Log:",z):(B===""||X==="")&&(q=!1);q&&(R.diagnostics={runnable:J,programLog:z,vertexShader:{log:B,prefix:m},fragmentShader:{log:X,prefix:f}})}s.deleteShader(N),s.deleteShader(L),F=new Mr(s,v),S=Zx(s,v)}let F;this.getUniforms=function(){return F===void 0&&C(this),F};let S;this.getAttributes=function(){return S===void 0&&C(this),S};let x=e.rendererExtensionParallelShaderCompile===!1;return this.isReady=function(){return x===!1&&(x=s.getProgramParameter(v,Vx)),x},this.destroy=function(){n.releaseStatesOfProgram(this),s.deleteProgram(v),this.program=void 0},this.type=e.shaderType,this.name=e.shaderName,this.id=Hx++,this.cacheKey=t,this.usedTimes=1,this.program=v,this.vertexShader=N,this.fragmentShader=L,this}var aM=0,Wc=class{constructor(){this.shaderCache=new Map,this.materialCache=new Map}update(t){let e=t.vertexShader,n=t.fragmentShader,s=this._getShaderStage(e),r=this._getShaderStage(n),o=this._getShaderCacheForMaterial(t);return o.has(s)===!1&&(o.add(s),s.usedTimes++),o.has(r)===!1&&(o.add(r),r.usedTimes++),this}remove(t){let e=this.materialCache.get(t);for(let n of e)n.usedTimes--,n.usedTimes===0&&this.shaderCache.delete(n.code);return this.materialCache.delete(t),this}getVertexShaderID(t){return this._getShaderStage(t.vertexShader).id}getFragmentShaderID(t){return this._getShaderStage(t.fragmentShader).id}dispose(){this.shaderCache.clear(),this.materialCache.clear()}_getShaderCacheForMaterial(t){let e=this.materialCache,n=e.get(t);return n===void 0&&(n=new Set,e.set(t,n)),n}_getShaderStage(t){let e=this.shaderCache,n=e.get(t);return n===void 0&&(n=new Xc(t),e.set(t,n)),n}},Xc=class{constructor(t){this.id=aM++,this.code=t,this.usedTimes=0}};function lM(i,t,e,n,s,r,o){let a=new Ua,l=new Wc,c=new Set,u=[],d=s.logarithmicDepthBuffer,h=s.vertexTextures,p=s.precision,g={MeshDepthMaterial:"depth",MeshDistanceMaterial:"distanceRGBA",MeshNormalMaterial:"normal",MeshBasicMaterial:"basic",MeshLambertMaterial:"lambert",MeshPhongMaterial:"phong",MeshToonMaterial:"toon",MeshStandardMaterial:"physical",MeshPhysicalMaterial:"physical",MeshMatcapMaterial:"matcap",LineBasicMaterial:"basic",LineDashedMaterial:"dashed",PointsMaterial:"points",ShadowMaterial:"shadow",SpriteMaterial:"sprite"};function v(S){return c.add(S),S===0?"uv":`uv${S}`}function m(S,x,R,z,B){let X=z.fog,J=B.geometry,q=S.isMeshStandardMaterial?z.environment:null,st=(S.isMeshStandardMaterial?e:t).get(S.envMap||q),nt=st&&st.mapping===tl?st.image.height:null,gt=g[S.type];S.precision!==null&&(p=s.getMaxPrecision(S.precision),p!==S.precision&&console.warn("THREE.WebGLProgram.getParameters:",S.precision,"not supported, using",p,"instead."));let dt=J.morphAttributes.position||J.morphAttributes.normal||J.morphAttributes.color,pt=dt!==void 0?dt.length:0,mt=0;J.morphAttributes.position!==void 0&&(mt=1),J.morphAttributes.normal!==void 0&&(mt=2),J.morphAttributes.color!==void 0&&(mt=3);let kt,Q,ct,Rt;if(gt){let Mt=yi[gt];kt=Mt.vertexShader,Q=Mt.fragmentShader}else kt=S.vertexShader,Q=S.fragmentShader,l.update(S),ct=l.getVertexShaderID(S),Rt=l.getFragmentShaderID(S);let ft=i.getRenderTarget(),Ht=B.isInstancedMesh===!0,Bt=B.isBatchedMesh===!0,Nt=!!S.map,O=!!S.matcap,jt=!!st,te=!!S.aoMap,fe=!!S.lightMap,Ut=!!S.bumpMap,se=!!S.normalMap,Yt=!!S.displacementMap,zt=!!S.emissiveMap,Se=!!S.metalnessMap,D=!!S.roughnessMap,w=S.anisotropy>0,G=S.clearcoat>0,tt=S.dispersion>0,rt=S.iridescence>0,et=S.sheen>0,At=S.transmission>0,vt=w&&!!S.anisotropyMap,yt=G&&!!S.clearcoatMap,Wt=G&&!!S.clearcoatNormalMap,lt=G&&!!S.clearcoatRoughnessMap,Et=rt&&!!S.iridescenceMap,Gt=rt&&!!S.iridescenceThicknessMap,It=et&&!!S.sheenColorMap,xt=et&&!!S.sheenRoughnessMap,Xt=!!S.specularMap,Zt=!!S.specularColorMap,xe=!!S.specularIntensityMap,y=At&&!!S.transmissionMap,j=At&&!!S.thicknessMap,Y=!!S.gradientMap,it=!!S.alphaMap,ht=S.alphaTest>0,Ft=!!S.alphaHash,Kt=!!S.extensions,Fe=is;S.toneMapped&&(ft===null||ft.isXRRenderTarget===!0)&&(Fe=i.toneMapping);let Be={shaderID:gt,shaderType:S.type,shaderName:S.name,vertexShader:kt,fragmentShader:Q,defines:S.defines,customVertexShaderID:ct,customFragmentShaderID:Rt,isRawShaderMaterial:S.isRawShaderMaterial===!0,glslVersion:S.glslVersion,precision:p,batching:Bt,batchingColor:Bt&&B._colorsTexture!==null,instancing:Ht,instancingColor:Ht&&B.instanceColor!==null,instancingMorph:Ht&&B.morphTexture!==null,supportsVertexTextures:h,outputColorSpace:ft===null?i.outputColorSpace:ft.isXRRenderTarget===!0?ft.texture.colorSpace:ls,alphaToCoverage:!!S.alphaToCoverage,map:Nt,matcap:O,envMap:jt,envMapMode:jt&&st.mapping,envMapCubeUVHeight:nt,aoMap:te,lightMap:fe,bumpMap:Ut,normalMap:se,displacementMap:h&&Yt,emissiveMap:zt,normalMapObjectSpace:se&&S.normalMapType===f0,normalMapTangentSpace:se&&S.normalMapType===Cf,metalnessMap:Se,roughnessMap:D,anisotropy:w,anisotropyMap:vt,clearcoat:G,clearcoatMap:yt,clearcoatNormalMap:Wt,clearcoatRoughnessMap:lt,dispersion:tt,iridescence:rt,iridescenceMap:Et,iridescenceThicknessMap:Gt,sheen:et,sheenColorMap:It,sheenRoughnessMap:xt,specularMap:Xt,specularColorMap:Zt,specularIntensityMap:xe,transmission:At,transmissionMap:y,thicknessMap:j,gradientMap:Y,opaque:S.transparent===!1&&S.blending===vr&&S.alphaToCoverage===!1,alphaMap:it,alphaTest:ht,alphaHash:Ft,combine:S.combine,mapUv:Nt&&v(S.map.channel),aoMapUv:te&&v(S.aoMap.channel),lightMapUv:fe&&v(S.lightMap.channel),bumpMapUv:Ut&&v(S.bumpMap.channel),normalMapUv:se&&v(S.normalMap.channel),displacementMapUv:Yt&&v(S.displacementMap.channel),emissiveMapUv:zt&&v(S.emissiveMap.channel),metalnessMapUv:Se&&v(S.metalnessMap.channel),roughnessMapUv:D&&v(S.roughnessMap.channel),anisotropyMapUv:vt&&v(S.anisotropyMap.channel),clearcoatMapUv:yt&&v(S.clearcoatMap.channel),clearcoatNormalMapUv:Wt&&v(S.clearcoatNormalMap.channel),clearcoatRoughnessMapUv:lt&&v(S.clearcoatRoughnessMap.channel),iridescenceMapUv:Et&&v(S.iridescenceMap.channel),iridescenceThicknessMapUv:Gt&&v(S.iridescenceThicknessMap.channel),sheenColorMapUv:It&&v(S.sheenColorMap.channel),sheenRoughnessMapUv:xt&&v(S.sheenRoughnessMap.channel),specularMapUv:Xt&&v(S.specularMap.channel),specularColorMapUv:Zt&&v(S.specularColorMap.channel),specularIntensityMapUv:xe&&v(S.specularIntensityMap.channel),transmissionMapUv:y&&v(S.transmissionMap.channel),thicknessMapUv:j&&v(S.thicknessMap.channel),alphaMapUv:it&&v(S.alphaMap.channel),vertexTangents:!!J.attributes.tangent&&(se||w),vertexColors:S.vertexColors,vertexAlphas:S.vertexColors===!0&&!!J.attributes.color&&J.attributes.color.itemSize===4,pointsUvs:B.isPoints===!0&&!!J.attributes.uv&&(Nt||it),fog:!!X,useFog:S.fog===!0,fogExp2:!!X&&X.isFogExp2,flatShading:S.flatShading===!0,sizeAttenuation:S.sizeAttenuation===!0,logarithmicDepthBuffer:d,skinning:B.isSkinnedMesh===!0,morphTargets:J.morphAttributes.position!==void 0,morphNormals:J.morphAttributes.normal!==void 0,morphColors:J.morphAttributes.color!==void 0,morphTargetsCount:pt,morphTextureStride:mt,numDirLights:x.directional.length,numPointLights:x.point.length,numSpotLights:x.spot.length,numSpotLightMaps:x.spotLightMap.length,numRectAreaLights:x.rectArea.length,numHemiLights:x.hemi.length,numDirLightShadows:x.directionalShadowMap.length,numPointLightShadows:x.pointShadowMap.length,numSpotLightShadows:x.spotShadowMap.length,numSpotLightShadowsWithMaps:x.numSpotLightShadowsWithMaps,numLightProbes:x.numLightProbes,numClippingPlanes:o.numPlanes,numClipIntersection:o.numIntersection,dithering:S.dithering,shadowMapEnabled:i.shadowMap.enabled&&R.length>0,shadowMapType:i.shadowMap.type,toneMapping:Fe,decodeVideoTexture:Nt&&S.map.isVideoTexture===!0&&we.getTransfer(S.map.colorSpace)===Ue,premultipliedAlpha:S.premultipliedAlpha,doubleSided:S.side===Ui,flipSided:S.side===Un,useDepthPacking:S.depthPacking>=0,depthPacking:S.depthPacking||0,index0AttributeName:S.index0AttributeName,extensionClipCullDistance:Kt&&S.extensions.clipCullDistance===!0&&n.has("WEBGL_clip_cull_distance"),extensionMultiDraw:Kt&&S.extensions.multiDraw===!0&&n.has("WEBGL_multi_draw"),rendererExtensionParallelShaderCompile:n.has("KHR_parallel_shader_compile"),customProgramCacheKey:S.customProgramCacheKey()};return Be.vertexUv1s=c.has(1),Be.vertexUv2s=c.has(2),Be.vertexUv3s=c.has(3),c.clear(),Be}function f(S){let x=[];if(S.shaderID?x.push(S.shaderID):(x.push(S.customVertexShaderID),x.push(S.customFragmentShaderID)),S.defines!==void 0)for(let R in S.defines)x.push(R),x.push(S.defines[R]);return S.isRawShaderMaterial===!1&&(T(x,S),b(x,S),x.push(i.outputColorSpace)),x.push(S.customProgramCacheKey),x.join()}function T(S,x){S.push(x.precision),S.push(x.outputColorSpace),S.push(x.envMapMode),S.push(x.envMapCubeUVHeight),S.push(x.mapUv),S.push(x.alphaMapUv),S.push(x.lightMapUv),S.push(x.aoMapUv),S.push(x.bumpMapUv),S.push(x.normalMapUv),S.push(x.displacementMapUv),S.push(x.emissiveMapUv),S.push(x.metalnessMapUv),S.push(x.roughnessMapUv),S.push(x.anisotropyMapUv),S.push(x.clearcoatMapUv),S.push(x.clearcoatNormalMapUv),S.push(x.clearcoatRoughnessMapUv),S.push(x.iridescenceMapUv),S.push(x.iridescenceThicknessMapUv),S.push(x.sheenColorMapUv),S.push(x.sheenRoughnessMapUv),S.push(x.specularMapUv),S.push(x.specularColorMapUv),S.push(x.specularIntensityMapUv),S.push(x.transmissionMapUv),S.push(x.thicknessMapUv),S.push(x.combine),S.push(x.fogExp2),S.push(x.sizeAttenuation),S.push(x.morphTargetsCount),S.push(x.morphAttributeCount),S.push(x.numDirLights),S.push(x.numPointLights),S.push(x.numSpotLights),S.push(x.numSpotLightMaps),S.push(x.numHemiLights),S.push(x.numRectAreaLights),S.push(x.numDirLightShadows),S.push(x.numPointLightShadows),S.push(x.numSpotLightShadows),S.push(x.numSpotLightShadowsWithMaps),S.push(x.numLightProbes),S.push(x.shadowMapType),S.push(x.toneMapping),S.push(x.numClippingPlanes),S.push(x.numClipIntersection),S.push(x.depthPacking)}function b(S,x){a.disableAll(),x.supportsVertexTextures&&a.enable(0),x.instancing&&a.enable(1),x.instancingColor&&a.enable(2),x.instancingMorph&&a.enable(3),x.matcap&&a.enable(4),x.envMap&&a.enable(5),x.normalMapObjectSpace&&a.enable(6),x.normalMapTangentSpace&&a.enable(7),x.clearcoat&&a.enable(8),x.iridescence&&a.enable(9),x.alphaTest&&a.enable(10),x.vertexColors&&a.enable(11),x.vertexAlphas&&a.enable(12),x.vertexUv1s&&a.enable(13),x.vertexUv2s&&a.enable(14),x.vertexUv3s&&a.enable(15),x.vertexTangents&&a.enable(16),x.anisotropy&&a.enable(17),x.alphaHash&&a.enable(18),x.batching&&a.enable(19),x.dispersion&&a.enable(20),x.batchingColor&&a.enable(21),S.push(a.mask),a.disableAll(),x.fog&&a.enable(0),x.useFog&&a.enable(1),x.flatShading&&a.enable(2),x.logarithmicDepthBuffer&&a.enable(3),x.skinning&&a.enable(4),x.morphTargets&&a.enable(5),x.morphNormals&&a.enable(6),x.morphColors&&a.enable(7),x.premultipliedAlpha&&a.enable(8),x.shadowMapEnabled&&a.enable(9),x.doubleSided&&a.enable(10),x.flipSided&&a.enable(11),x.useDepthPacking&&a.enable(12),x.dithering&&a.enable(13),x.transmission&&a.enable(14),x.sheen&&a.enable(15),x.opaque&&a.enable(16),x.pointsUvs&&a.enable(17),x.decodeVideoTexture&&a.enable(18),x.alphaToCoverage&&a.enable(19),S.push(a.mask)}function A(S){let x=g[S.type],R;if(x){let z=yi[x];R=Q0.clone(z.uniforms)}else R=S.uniforms;return R}function N(S,x){let R;for(let z=0,B=u.length;z<B;z++){let X=u[z];if(X.cacheKey===x){R=X,++R.usedTimes;break}}return R===void 0&&(R=new oM(i,x,S,r),u.push(R)),R}function L(S){if(--S.usedTimes===0){let x=u.indexOf(S);u[x]=u[u.length-1],u.pop(),S.destroy()}}function C(S){l.remove(S)}function F(){l.dispose()}return{getParameters:m,getProgramCacheKey:f,getUniforms:A,acquireProgram:N,releaseProgram:L,releaseShaderCache:C,programs:u,dispose:F}}function cM(){let i=new WeakMap;function t(r){let o=i.get(r);return o===void 0&&(o={},i.set(r,o)),o}function e(r){i.delete(r)}function n(r,o,a){i.get(r)[o]=a}function s(){i=new WeakMap}return{get:t,remove:e,update:n,dispose:s}}function hM(i,t){return i.groupOrder!==t.groupOrder?i.groupOrder-t.groupOrder:i.renderOrder!==t.renderOrder?i.renderOrder-t.renderOrder:i.material.id!==t.material.id?i.material.id-t.material.id:i.z!==t.z?i.z-t.z:i.id-t.id}function lf(i,t){return i.groupOrder!==t.groupOrder?i.groupOrder-t.groupOrder:i.renderOrder!==t.renderOrder?i.renderOrder-t.renderOrder:i.z!==t.z?t.z-i.z:i.id-t.id}function cf(){let i=[],t=0,e=[],n=[],s=[];function r(){t=0,e.length=0,n.length=0,s.length=0}function o(d,h,p,g,v,m){let f=i[t];return f===void 0?(f={id:d.id,object:d,geometry:h,material:p,groupOrder:g,renderOrder:d.renderOrder,z:v,group:m},i[t]=f):(f.id=d.id,f.object=d,f.geometry=h,f.material=p,f.groupOrder=g,f.renderOrder=d.renderOrder,f.z=v,f.group=m),t++,f}function a(d,h,p,g,v,m){let f=o(d,h,p,g,v,m);p.transmission>0?n.push(f):p.transparent===!0?s.push(f):e.push(f)}function l(d,h,p,g,v,m){let f=o(d,h,p,g,v,m);p.transmission>0?n.unshift(f):p.transparent===!0?s.unshift(f):e.unshift(f)}function c(d,h){e.length>1&&e.sort(d||hM),n.length>1&&n.sort(h||lf),s.length>1&&s.sort(h||lf)}function u(){for(let d=t,h=i.length;d<h;d++){let p=i[d];if(p.id===null)break;p.id=null,p.object=null,p.geometry=null,p.material=null,p.group=null}}return{opaque:e,transmissive:n,transparent:s,init:r,push:a,unshift:l,finish:u,sort:c}}function uM(){let i=new WeakMap;function t(n,s){let r=i.get(n),o;return r===void 0?(o=new cf,i.set(n,[o])):s>=r.length?(o=new cf,r.push(o)):o=r[s],o}function e(){i=new WeakMap}return{get:t,dispose:e}}function dM(){let i={};return{get:function(t){if(i[t.id]!==void 0)return i[t.id];let e;switch(t.type){case"DirectionalLight":e={direction:new V,color:new ce};break;case"SpotLight":e={position:new V,direction:new V,color:new ce,distance:0,coneCos:0,penumbraCos:0,decay:0};break;case"PointLight":e={position:new V,color:new ce,distance:0,decay:0};break;case"HemisphereLight":e={direction:new V,skyColor:new ce,groundColor:new ce};break;case"RectAreaLight":e={color:new ce,position:new V,halfWidth:new V,halfHeight:new V};break}return i[t.id]=e,e}}}function fM(){let i={};return{get:function(t){if(i[t.id]!==void 0)return i[t.id];let e;switch(t.type){case"DirectionalLight":e={shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new Jt};break;case"SpotLight":e={shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new Jt};break;case"PointLight":e={shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new Jt,shadowCameraNear:1,shadowCameraFar:1e3};break}return i[t.id]=e,e}}}var pM=0;function mM(i,t){return(t.castShadow?2:0)-(i.castShadow?2:0)+(t.map?1:0)-(i.map?1:0)}function gM(i){let t=new dM,e=fM(),n={version:0,hash:{directionalLength:-1,pointLength:-1,spotLength:-1,rectAreaLength:-1,hemiLength:-1,numDirectionalShadows:-1,numPointShadows:-1,numSpotShadows:-1,numSpotMaps:-1,numLightProbes:-1},ambient:[0,0,0],probe:[],directional:[],directionalShadow:[],directionalShadowMap:[],directionalShadowMatrix:[],spot:[],spotLightMap:[],spotShadow:[],spotShadowMap:[],spotLightMatrix:[],rectArea:[],rectAreaLTC1:null,rectAreaLTC2:null,point:[],pointShadow:[],pointShadowMap:[],pointShadowMatrix:[],hemi:[],numSpotLightShadowsWithMaps:0,numLightProbes:0};for(let c=0;c<9;c++)n.probe.push(new V);let s=new V,r=new ve,o=new ve;function a(c){let u=0,d=0,h=0;for(let S=0;S<9;S++)n.probe[S].set(0,0,0);let p=0,g=0,v=0,m=0,f=0,T=0,b=0,A=0,N=0,L=0,C=0;c.sort(mM);for(let S=0,x=c.length;S<x;S++){let R=c[S],z=R.color,B=R.intensity,X=R.distance,J=R.shadow&&R.shadow.map?R.shadow.map.texture:null;if(R.isAmbientLight)u+=z.r*B,d+=z.g*B,h+=z.b*B;else if(R.isLightProbe){for(let q=0;q<9;q++)n.probe[q].addScaledVector(R.sh.coefficients[q],B);C++}else if(R.isDirectionalLight){let q=t.get(R);if(q.color.copy(R.color).multiplyScalar(R.intensity),R.castShadow){let st=R.shadow,nt=e.get(R);nt.shadowBias=st.bias,nt.shadowNormalBias=st.normalBias,nt.shadowRadius=st.radius,nt.shadowMapSize=st.mapSize,n.directionalShadow[p]=nt,n.directionalShadowMap[p]=J,n.directionalShadowMatrix[p]=R.shadow.matrix,T++}n.directional[p]=q,p++}else if(R.isSpotLight){let q=t.get(R);q.position.setFromMatrixPosition(R.matrixWorld),q.color.copy(z).multiplyScalar(B),q.distance=X,q.coneCos=Math.cos(R.angle),q.penumbraCos=Math.cos(R.angle*(1-R.penumbra)),q.decay=R.decay,n.spot[v]=q;let st=R.shadow;if(R.map&&(n.spotLightMap[N]=R.map,N++,st.updateMatrices(R),R.castShadow&&L++),n.spotLightMatrix[v]=st.matrix,R.castShadow){let nt=e.get(R);nt.shadowBias=st.bias,nt.shadowNormalBias=st.normalBias,nt.shadowRadius=st.radius,nt.shadowMapSize=st.mapSize,n.spotShadow[v]=nt,n.spotShadowMap[v]=J,A++}v++}else if(R.isRectAreaLight){let q=t.get(R);q.color.copy(z).multiplyScalar(B),q.halfWidth.set(R.width*.5,0,0),q.halfHeight.set(0,R.height*.5,0),n.rectArea[m]=q,m++}else if(R.isPointLight){let q=t.get(R);if(q.color.copy(R.color).multiplyScalar(R.intensity),q.distance=R.distance,q.decay=R.decay,R.castShadow){let st=R.shadow,nt=e.get(R);nt.shadowBias=st.bias,nt.shadowNormalBias=st.normalBias,nt.shadowRadius=st.radius,nt.shadowMapSize=st.mapSize,nt.shadowCameraNear=st.camera.near,nt.shadowCameraFar=st.camera.far,n.pointShadow[g]=nt,n.pointShadowMap[g]=J,n.pointShadowMatrix[g]=R.shadow.matrix,b++}n.point[g]=q,g++}else if(R.isHemisphereLight){let q=t.get(R);q.skyColor.copy(R.color).multiplyScalar(B),q.groundColor.copy(R.groundColor).multiplyScalar(B),n.hemi[f]=q,f++}}m>0&&(i.has("OES_texture_float_linear")===!0?(n.rectAreaLTC1=bt.LTC_FLOAT_1,n.rectAreaLTC2=bt.LTC_FLOAT_2):(n.rectAreaLTC1=bt.LTC_HALF_1,n.rectAreaLTC2=bt.LTC_HALF_2)),n.ambient[0]=u,n.ambient[1]=d,n.ambient[2]=h;let F=n.hash;(F.directionalLength!==p||F.pointLength!==g||F.spotLength!==v||F.rectAreaLength!==m||F.hemiLength!==f||F.numDirectionalShadows!==T||F.numPointShadows!==b||F.numSpotShadows!==A||F.numSpotMaps!==N||F.numLightProbes!==C)&&(n.directional.length=p,n.spot.length=v,n.rectArea.length=m,n.point.length=g,n.hemi.length=f,n.directionalShadow.length=T,n.directionalShadowMap.length=T,n.pointShadow.length=b,n.pointShadowMap.length=b,n.spotShadow.length=A,n.spotShadowMap.length=A,n.directionalShadowMatrix.length=T,n.pointShadowMatrix.length=b,n.spotLightMatrix.length=A+N-L,n.spotLightMap.length=N,n.numSpotLightShadowsWithMaps=L,n.numLightProbes=C,F.directionalLength=p,F.pointLength=g,F.spotLength=v,F.rectAreaLength=m,F.hemiLength=f,F.numDirectionalShadows=T,F.numPointShadows=b,F.numSpotShadows=A,F.numSpotMaps=N,F.numLightProbes=C,n.version=pM++)}function l(c,u){let d=0,h=0,p=0,g=0,v=0,m=u.matrixWorldInverse;for(let f=0,T=c.length;f<T;f++){let b=c[f];if(b.isDirectionalLight){let A=n.directional[d];A.direction.setFromMatrixPosition(b.matrixWorld),s.setFromMatrixPosition(b.target.matrixWorld),A.direction.sub(s),A.direction.transformDirection(m),d++}else if(b.isSpotLight){let A=n.spot[p];A.position.setFromMatrixPosition(b.matrixWorld),A.position.applyMatrix4(m),A.direction.setFromMatrixPosition(b.matrixWorld),s.setFromMatrixPosition(b.target.matrixWorld),A.direction.sub(s),A.direction.transformDirection(m),p++}else if(b.isRectAreaLight){let A=n.rectArea[g];A.position.setFromMatrixPosition(b.matrixWorld),A.position.applyMatrix4(m),o.identity(),r.copy(b.matrixWorld),r.premultiply(m),o.extractRotation(r),A.halfWidth.set(b.width*.5,0,0),A.halfHeight.set(0,b.height*.5,0),A.halfWidth.applyMatrix4(o),A.halfHeight.applyMatrix4(o),g++}else if(b.isPointLight){let A=n.point[h];A.position.setFromMatrixPosition(b.matrixWorld),A.position.applyMatrix4(m),h++}else if(b.isHemisphereLight){let A=n.hemi[v];A.direction.setFromMatrixPosition(b.matrixWorld),A.direction.transformDirection(m),v++}}}return{setup:a,setupView:l,state:n}}function hf(i){let t=new gM(i),e=[],n=[];function s(u){c.camera=u,e.length=0,n.length=0}function r(u){e.push(u)}function o(u){n.push(u)}function a(){t.setup(e)}function l(u){t.setupView(e,u)}let c={lightsArray:e,shadowsArray:n,camera:null,lights:t,transmissionRenderTarget:{}};return{init:s,state:c,setupLights:a,setupLightsView:l,pushLight:r,pushShadow:o}}function _M(i){let t=new WeakMap;function e(s,r=0){let o=t.get(s),a;return o===void 0?(a=new hf(i),t.set(s,[a])):r>=o.length?(a=new hf(i),o.push(a)):a=o[r],a}function n(){t=new WeakMap}return{get:e,dispose:n}}var $c=class extends os{constructor(t){super(),this.isMeshDepthMaterial=!0,this.type="MeshDepthMaterial",this.depthPacking=u0,this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.wireframe=!1,this.wireframeLinewidth=1,this.setValues(t)}copy(t){return super.copy(t),this.depthPacking=t.depthPacking,this.map=t.map,this.alphaMap=t.alphaMap,this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this}},qc=class extends os{constructor(t){super(),this.isMeshDistanceMaterial=!0,this.type="MeshDistanceMaterial",this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.setValues(t)}copy(t){return super.copy(t),this.map=t.map,this.alphaMap=t.alphaMap,this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this}},vM=`void main() {
	gl_Position = vec4( position, 1.0 );
}`,yM=`uniform sampler2D shadow_pass;
uniform vec2 resolution;
uniform float radius;
#include <packing>
void main() {
	const float samples = float( VSM_SAMPLES );
	float mean = 0.0;
	float squared_mean = 0.0;
	float uvStride = samples <= 1.0 ? 0.0 : 2.0 / ( samples - 1.0 );
	float uvStart = samples <= 1.0 ? 0.0 : - 1.0;
	for ( float i = 0.0; i < samples; i ++ ) {
		float uvOffset = uvStart + i * uvStride;
		#ifdef HORIZONTAL_PASS
			vec2 distribution = unpackRGBATo2Half( texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( uvOffset, 0.0 ) * radius ) / resolution ) );
			mean += distribution.x;
			squared_mean += distribution.y * distribution.y + distribution.x * distribution.x;
		#else
			float depth = unpackRGBAToDepth( texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( 0.0, uvOffset ) * radius ) / resolution ) );
			mean += depth;
			squared_mean += depth * depth;
		#endif
	}
	mean = mean / samples;
	squared_mean = squared_mean / samples;
	float std_dev = sqrt( squared_mean - mean * mean );
	gl_FragColor = pack2HalfToRGBA( vec2( mean, std_dev ) );
}`;function xM(i,t,e){let n=new bo,s=new Jt,r=new Jt,o=new Ze,a=new $c({depthPacking:d0}),l=new qc,c={},u=e.maxTextureSize,d={[ss]:Un,[Un]:ss,[Ui]:Ui},h=new wi({defines:{VSM_SAMPLES:8},uniforms:{shadow_pass:{value:null},resolution:{value:new Jt},radius:{value:4}},vertexShader:vM,fragmentShader:yM}),p=h.clone();p.defines.HORIZONTAL_PASS=1;let g=new Cn;g.setAttribute("position",new Vn(new Float32Array([-1,-1,.5,3,-1,.5,-1,3,.5]),3));let v=new zn(g,h),m=this;this.enabled=!1,this.autoUpdate=!0,this.needsUpdate=!1,this.type=yf;let f=this.type;this.render=function(L,C,F){if(m.enabled===!1||m.autoUpdate===!1&&m.needsUpdate===!1||L.length===0)return;let S=i.getRenderTarget(),x=i.getActiveCubeFace(),R=i.getActiveMipmapLevel(),z=i.state;z.setBlending(ns),z.buffers.color.setClear(1,1,1,1),z.buffers.depth.setTest(!0),z.setScissorTest(!1);let B=f!==Ni&&this.type===Ni,X=f===Ni&&this.type!==Ni;for(let J=0,q=L.length;J<q;J++){let st=L[J],nt=st.shadow;if(nt===void 0){console.warn("THREE.WebGLShadowMap:",st,"has no shadow.");continue}if(nt.autoUpdate===!1&&nt.needsUpdate===!1)continue;s.copy(nt.mapSize);let gt=nt.getFrameExtents();if(s.multiply(gt),r.copy(nt.mapSize),(s.x>u||s.y>u)&&(s.x>u&&(r.x=Math.floor(u/gt.x),s.x=r.x*gt.x,nt.mapSize.x=r.x),s.y>u&&(r.y=Math.floor(u/gt.y),s.y=r.y*gt.y,nt.mapSize.y=r.y)),nt.map===null||B===!0||X===!0){let pt=this.type!==Ni?{minFilter:Nn,magFilter:Nn}:{};nt.map!==null&&nt.map.dispose(),nt.map=new ki(s.x,s.y,pt),nt.map.texture.name=st.name+".shadowMap",nt.camera.updateProjectionMatrix()}i.setRenderTarget(nt.map),i.clear();let dt=nt.getViewportCount();for(let pt=0;pt<dt;pt++){let mt=nt.getViewport(pt);o.set(r.x*mt.x,r.y*mt.y,r.x*mt.z,r.y*mt.w),z.viewport(o),nt.updateMatrices(st,pt),n=nt.getFrustum(),A(C,F,nt.camera,st,this.type)}nt.isPointLightShadow!==!0&&this.type===Ni&&T(nt,F),nt.needsUpdate=!1}f=this.type,m.needsUpdate=!1,i.setRenderTarget(S,x,R)};function T(L,C){let F=t.update(v);h.defines.VSM_SAMPLES!==L.blurSamples&&(h.defines.VSM_SAMPLES=L.blurSamples,p.defines.VSM_SAMPLES=L.blurSamples,h.needsUpdate=!0,p.needsUpdate=!0),L.mapPass===null&&(L.mapPass=new ki(s.x,s.y)),h.uniforms.shadow_pass.value=L.map.texture,h.uniforms.resolution.value=L.mapSize,h.uniforms.radius.value=L.radius,i.setRenderTarget(L.mapPass),i.clear(),i.renderBufferDirect(C,null,F,h,v,null),p.uniforms.shadow_pass.value=L.mapPass.texture,p.uniforms.resolution.value=L.mapSize,p.uniforms.radius.value=L.radius,i.setRenderTarget(L.map),i.clear(),i.renderBufferDirect(C,null,F,p,v,null)}function b(L,C,F,S){let x=null,R=F.isPointLight===!0?L.customDistanceMaterial:L.customDepthMaterial;if(R!==void 0)x=R;else if(x=F.isPointLight===!0?l:a,i.localClippingEnabled&&C.clipShadows===!0&&Array.isArray(C.clippingPlanes)&&C.clippingPlanes.length!==0||C.displacementMap&&C.displacementScale!==0||C.alphaMap&&C.alphaTest>0||C.map&&C.alphaTest>0){let z=x.uuid,B=C.uuid,X=c[z];X===void 0&&(X={},c[z]=X);let J=X[B];J===void 0&&(J=x.clone(),X[B]=J,C.addEventListener("dispose",N)),x=J}if(x.visible=C.visible,x.wireframe=C.wireframe,S===Ni?x.side=C.shadowSide!==null?C.shadowSide:C.side:x.side=C.shadowSide!==null?C.shadowSide:d[C.side],x.alphaMap=C.alphaMap,x.alphaTest=C.alphaTest,x.map=C.map,x.clipShadows=C.clipShadows,x.clippingPlanes=C.clippingPlanes,x.clipIntersection=C.clipIntersection,x.displacementMap=C.displacementMap,x.displacementScale=C.displacementScale,x.displacementBias=C.displacementBias,x.wireframeLinewidth=C.wireframeLinewidth,x.linewidth=C.linewidth,F.isPointLight===!0&&x.isMeshDistanceMaterial===!0){let z=i.properties.get(x);z.light=F}return x}function A(L,C,F,S,x){if(L.visible===!1)return;if(L.layers.test(C.layers)&&(L.isMesh||L.isLine||L.isPoints)&&(L.castShadow||L.receiveShadow&&x===Ni)&&(!L.frustumCulled||n.intersectsObject(L))){L.modelViewMatrix.multiplyMatrices(F.matrixWorldInverse,L.matrixWorld);let B=t.update(L),X=L.material;if(Array.isArray(X)){let J=B.groups;for(let q=0,st=J.length;q<st;q++){let nt=J[q],gt=X[nt.materialIndex];if(gt&&gt.visible){let dt=b(L,gt,S,x);L.onBeforeShadow(i,L,C,F,B,dt,nt),i.renderBufferDirect(F,null,B,dt,L,nt),L.onAfterShadow(i,L,C,F,B,dt,nt)}}}else if(X.visible){let J=b(L,X,S,x);L.onBeforeShadow(i,L,C,F,B,J,null),i.renderBufferDirect(F,null,B,J,L,null),L.onAfterShadow(i,L,C,F,B,J,null)}}let z=L.children;for(let B=0,X=z.length;B<X;B++)A(z[B],C,F,S,x)}function N(L){L.target.removeEventListener("dispose",N);for(let F in c){let S=c[F],x=L.target.uuid;x in S&&(S[x].dispose(),delete S[x])}}}function MM(i){function t(){let y=!1,j=new Ze,Y=null,it=new Ze(0,0,0,0);return{setMask:function(ht){Y!==ht&&!y&&(i.colorMask(ht,ht,ht,ht),Y=ht)},setLocked:function(ht){y=ht},setClear:function(ht,Ft,Kt,Fe,Be){Be===!0&&(ht*=Fe,Ft*=Fe,Kt*=Fe),j.set(ht,Ft,Kt,Fe),it.equals(j)===!1&&(i.clearColor(ht,Ft,Kt,Fe),it.copy(j))},reset:function(){y=!1,Y=null,it.set(-1,0,0,0)}}}function e(){let y=!1,j=null,Y=null,it=null;return{setTest:function(ht){ht?Rt(i.DEPTH_TEST):ft(i.DEPTH_TEST)},setMask:function(ht){j!==ht&&!y&&(i.depthMask(ht),j=ht)},setFunc:function(ht){if(Y!==ht){switch(ht){case Bg:i.depthFunc(i.NEVER);break;case zg:i.depthFunc(i.ALWAYS);break;case Vg:i.depthFunc(i.LESS);break;case Ea:i.depthFunc(i.LEQUAL);break;case Hg:i.depthFunc(i.EQUAL);break;case Gg:i.depthFunc(i.GEQUAL);break;case Wg:i.depthFunc(i.GREATER);break;case Xg:i.depthFunc(i.NOTEQUAL);break;default:i.depthFunc(i.LEQUAL)}Y=ht}},setLocked:function(ht){y=ht},setClear:function(ht){it!==ht&&(i.clearDepth(ht),it=ht)},reset:function(){y=!1,j=null,Y=null,it=null}}}function n(){let y=!1,j=null,Y=null,it=null,ht=null,Ft=null,Kt=null,Fe=null,Be=null;return{setTest:function(Mt){y||(Mt?Rt(i.STENCIL_TEST):ft(i.STENCIL_TEST))},setMask:function(Mt){j!==Mt&&!y&&(i.stencilMask(Mt),j=Mt)},setFunc:function(Mt,Ee,oe){(Y!==Mt||it!==Ee||ht!==oe)&&(i.stencilFunc(Mt,Ee,oe),Y=Mt,it=Ee,ht=oe)},setOp:function(Mt,Ee,oe){(Ft!==Mt||Kt!==Ee||Fe!==oe)&&(i.stencilOp(Mt,Ee,oe),Ft=Mt,Kt=Ee,Fe=oe)},setLocked:function(Mt){y=Mt},setClear:function(Mt){Be!==Mt&&(i.clearStencil(Mt),Be=Mt)},reset:function(){y=!1,j=null,Y=null,it=null,ht=null,Ft=null,Kt=null,Fe=null,Be=null}}}let s=new t,r=new e,o=new n,a=new WeakMap,l=new WeakMap,c={},u={},d=new WeakMap,h=[],p=null,g=!1,v=null,m=null,f=null,T=null,b=null,A=null,N=null,L=new ce(0,0,0),C=0,F=!1,S=null,x=null,R=null,z=null,B=null,X=i.getParameter(i.MAX_COMBINED_TEXTURE_IMAGE_UNITS),J=!1,q=0,st=i.getParameter(i.VERSION);st.indexOf("WebGL")!==-1?(q=parseFloat(/^WebGL (\d)/.exec(st)[1]),J=q>=1):st.indexOf("OpenGL ES")!==-1&&(q=parseFloat(/^OpenGL ES (\d)/.exec(st)[1]),J=q>=2);let nt=null,gt={},dt=i.getParameter(i.SCISSOR_BOX),pt=i.getParameter(i.VIEWPORT),mt=new Ze().fromArray(dt),kt=new Ze().fromArray(pt);function Q(y,j,Y,it){let ht=new Uint8Array(4),Ft=i.createTexture();i.bindTexture(y,Ft),i.texParameteri(y,i.TEXTURE_MIN_FILTER,i.NEAREST),i.texParameteri(y,i.TEXTURE_MAG_FILTER,i.NEAREST);for(let Kt=0;Kt<Y;Kt++)y===i.TEXTURE_3D||y===i.TEXTURE_2D_ARRAY?i.texImage3D(j,0,i.RGBA,1,1,it,0,i.RGBA,i.UNSIGNED_BYTE,ht):i.texImage2D(j+Kt,0,i.RGBA,1,1,0,i.RGBA,i.UNSIGNED_BYTE,ht);return Ft}let ct={};ct[i.TEXTURE_2D]=Q(i.TEXTURE_2D,i.TEXTURE_2D,1),ct[i.TEXTURE_CUBE_MAP]=Q(i.TEXTURE_CUBE_MAP,i.TEXTURE_CUBE_MAP_POSITIVE_X,6),ct[i.TEXTURE_2D_ARRAY]=Q(i.TEXTURE_2D_ARRAY,i.TEXTURE_2D_ARRAY,1,1),ct[i.TEXTURE_3D]=Q(i.TEXTURE_3D,i.TEXTURE_3D,1,1),s.setClear(0,0,0,1),r.setClear(1),o.setClear(0),Rt(i.DEPTH_TEST),r.setFunc(Ea),Ut(!1),se(Vu),Rt(i.CULL_FACE),te(ns);function Rt(y){c[y]!==!0&&(i.enable(y),c[y]=!0)}function ft(y){c[y]!==!1&&(i.disable(y),c[y]=!1)}function Ht(y,j){return u[y]!==j?(i.bindFramebuffer(y,j),u[y]=j,y===i.DRAW_FRAMEBUFFER&&(u[i.FRAMEBUFFER]=j),y===i.FRAMEBUFFER&&(u[i.DRAW_FRAMEBUFFER]=j),!0):!1}function Bt(y,j){let Y=h,it=!1;if(y){Y=d.get(j),Y===void 0&&(Y=[],d.set(j,Y));let ht=y.textures;if(Y.length!==ht.length||Y[0]!==i.COLOR_ATTACHMENT0){for(let Ft=0,Kt=ht.length;Ft<Kt;Ft++)Y[Ft]=i.COLOR_ATTACHMENT0+Ft;Y.length=ht.length,it=!0}}else Y[0]!==i.BACK&&(Y[0]=i.BACK,it=!0);it&&i.drawBuffers(Y)}function Nt(y){return p!==y?(i.useProgram(y),p=y,!0):!1}let O={[ws]:i.FUNC_ADD,[bg]:i.FUNC_SUBTRACT,[wg]:i.FUNC_REVERSE_SUBTRACT};O[Sg]=i.MIN,O[Eg]=i.MAX;let jt={[Tg]:i.ZERO,[Ag]:i.ONE,[Cg]:i.SRC_COLOR,[Cc]:i.SRC_ALPHA,[Ng]:i.SRC_ALPHA_SATURATE,[Ig]:i.DST_COLOR,[Pg]:i.DST_ALPHA,[Rg]:i.ONE_MINUS_SRC_COLOR,[Rc]:i.ONE_MINUS_SRC_ALPHA,[Dg]:i.ONE_MINUS_DST_COLOR,[Lg]:i.ONE_MINUS_DST_ALPHA,[Ug]:i.CONSTANT_COLOR,[Og]:i.ONE_MINUS_CONSTANT_COLOR,[Fg]:i.CONSTANT_ALPHA,[kg]:i.ONE_MINUS_CONSTANT_ALPHA};function te(y,j,Y,it,ht,Ft,Kt,Fe,Be,Mt){if(y===ns){g===!0&&(ft(i.BLEND),g=!1);return}if(g===!1&&(Rt(i.BLEND),g=!0),y!==Mg){if(y!==v||Mt!==F){if((m!==ws||b!==ws)&&(i.blendEquation(i.FUNC_ADD),m=ws,b=ws),Mt)switch(y){case vr:i.blendFuncSeparate(i.ONE,i.ONE_MINUS_SRC_ALPHA,i.ONE,i.ONE_MINUS_SRC_ALPHA);break;case Hu:i.blendFunc(i.ONE,i.ONE);break;case Gu:i.blendFuncSeparate(i.ZERO,i.ONE_MINUS_SRC_COLOR,i.ZERO,i.ONE);break;case Wu:i.blendFuncSeparate(i.ZERO,i.SRC_COLOR,i.ZERO,i.SRC_ALPHA);break;default:console.error("THREE.WebGLState: Invalid blending: ",y);break}else switch(y){case vr:i.blendFuncSeparate(i.SRC_ALPHA,i.ONE_MINUS_SRC_ALPHA,i.ONE,i.ONE_MINUS_SRC_ALPHA);break;case Hu:i.blendFunc(i.SRC_ALPHA,i.ONE);break;case Gu:i.blendFuncSeparate(i.ZERO,i.ONE_MINUS_SRC_COLOR,i.ZERO,i.ONE);break;case Wu:i.blendFunc(i.ZERO,i.SRC_COLOR);break;default:console.error("THREE.WebGLState: Invalid blending: ",y);break}f=null,T=null,A=null,N=null,L.set(0,0,0),C=0,v=y,F=Mt}return}ht=ht||j,Ft=Ft||Y,Kt=Kt||it,(j!==m||ht!==b)&&(i.blendEquationSeparate(O[j],O[ht]),m=j,b=ht),(Y!==f||it!==T||Ft!==A||Kt!==N)&&(i.blendFuncSeparate(jt[Y],jt[it],jt[Ft],jt[Kt]),f=Y,T=it,A=Ft,N=Kt),(Fe.equals(L)===!1||Be!==C)&&(i.blendColor(Fe.r,Fe.g,Fe.b,Be),L.copy(Fe),C=Be),v=y,F=!1}function fe(y,j){y.side===Ui?ft(i.CULL_FACE):Rt(i.CULL_FACE);let Y=y.side===Un;j&&(Y=!Y),Ut(Y),y.blending===vr&&y.transparent===!1?te(ns):te(y.blending,y.blendEquation,y.blendSrc,y.blendDst,y.blendEquationAlpha,y.blendSrcAlpha,y.blendDstAlpha,y.blendColor,y.blendAlpha,y.premultipliedAlpha),r.setFunc(y.depthFunc),r.setTest(y.depthTest),r.setMask(y.depthWrite),s.setMask(y.colorWrite);let it=y.stencilWrite;o.setTest(it),it&&(o.setMask(y.stencilWriteMask),o.setFunc(y.stencilFunc,y.stencilRef,y.stencilFuncMask),o.setOp(y.stencilFail,y.stencilZFail,y.stencilZPass)),zt(y.polygonOffset,y.polygonOffsetFactor,y.polygonOffsetUnits),y.alphaToCoverage===!0?Rt(i.SAMPLE_ALPHA_TO_COVERAGE):ft(i.SAMPLE_ALPHA_TO_COVERAGE)}function Ut(y){S!==y&&(y?i.frontFace(i.CW):i.frontFace(i.CCW),S=y)}function se(y){y!==vg?(Rt(i.CULL_FACE),y!==x&&(y===Vu?i.cullFace(i.BACK):y===yg?i.cullFace(i.FRONT):i.cullFace(i.FRONT_AND_BACK))):ft(i.CULL_FACE),x=y}function Yt(y){y!==R&&(J&&i.lineWidth(y),R=y)}function zt(y,j,Y){y?(Rt(i.POLYGON_OFFSET_FILL),(z!==j||B!==Y)&&(i.polygonOffset(j,Y),z=j,B=Y)):ft(i.POLYGON_OFFSET_FILL)}function Se(y){y?Rt(i.SCISSOR_TEST):ft(i.SCISSOR_TEST)}function D(y){y===void 0&&(y=i.TEXTURE0+X-1),nt!==y&&(i.activeTexture(y),nt=y)}function w(y,j,Y){Y===void 0&&(nt===null?Y=i.TEXTURE0+X-1:Y=nt);let it=gt[Y];it===void 0&&(it={type:void 0,texture:void 0},gt[Y]=it),(it.type!==y||it.texture!==j)&&(nt!==Y&&(i.activeTexture(Y),nt=Y),i.bindTexture(y,j||ct[y]),it.type=y,it.texture=j)}function G(){let y=gt[nt];y!==void 0&&y.type!==void 0&&(i.bindTexture(y.type,null),y.type=void 0,y.texture=void 0)}function tt(){try{i.compressedTexImage2D.apply(i,arguments)}catch(y){console.error("THREE.WebGLState:",y)}}function rt(){try{i.compressedTexImage3D.apply(i,arguments)}catch(y){console.error("THREE.WebGLState:",y)}}function et(){try{i.texSubImage2D.apply(i,arguments)}catch(y){console.error("THREE.WebGLState:",y)}}function At(){try{i.texSubImage3D.apply(i,arguments)}catch(y){console.error("THREE.WebGLState:",y)}}function vt(){try{i.compressedTexSubImage2D.apply(i,arguments)}catch(y){console.error("THREE.WebGLState:",y)}}function yt(){try{i.compressedTexSubImage3D.apply(i,arguments)}catch(y){console.error("THREE.WebGLState:",y)}}function Wt(){try{i.texStorage2D.apply(i,arguments)}catch(y){console.error("THREE.WebGLState:",y)}}function lt(){try{i.texStorage3D.apply(i,arguments)}catch(y){console.error("THREE.WebGLState:",y)}}function Et(){try{i.texImage2D.apply(i,arguments)}catch(y){console.error("THREE.WebGLState:",y)}}function Gt(){try{i.texImage3D.apply(i,arguments)}catch(y){console.error("THREE.WebGLState:",y)}}function It(y){mt.equals(y)===!1&&(i.scissor(y.x,y.y,y.z,y.w),mt.copy(y))}function xt(y){kt.equals(y)===!1&&(i.viewport(y.x,y.y,y.z,y.w),kt.copy(y))}function Xt(y,j){let Y=l.get(j);Y===void 0&&(Y=new WeakMap,l.set(j,Y));let it=Y.get(y);it===void 0&&(it=i.getUniformBlockIndex(j,y.name),Y.set(y,it))}function Zt(y,j){let it=l.get(j).get(y);a.get(j)!==it&&(i.uniformBlockBinding(j,it,y.__bindingPointIndex),a.set(j,it))}function xe(){i.disable(i.BLEND),i.disable(i.CULL_FACE),i.disable(i.DEPTH_TEST),i.disable(i.POLYGON_OFFSET_FILL),i.disable(i.SCISSOR_TEST),i.disable(i.STENCIL_TEST),i.disable(i.SAMPLE_ALPHA_TO_COVERAGE),i.blendEquation(i.FUNC_ADD),i.blendFunc(i.ONE,i.ZERO),i.blendFuncSeparate(i.ONE,i.ZERO,i.ONE,i.ZERO),i.blendColor(0,0,0,0),i.colorMask(!0,!0,!0,!0),i.clearColor(0,0,0,0),i.depthMask(!0),i.depthFunc(i.LESS),i.clearDepth(1),i.stencilMask(4294967295),i.stencilFunc(i.ALWAYS,0,4294967295),i.stencilOp(i.KEEP,i.KEEP,i.KEEP),i.clearStencil(0),i.cullFace(i.BACK),i.frontFace(i.CCW),i.polygonOffset(0,0),i.activeTexture(i.TEXTURE0),i.bindFramebuffer(i.FRAMEBUFFER,null),i.bindFramebuffer(i.DRAW_FRAMEBUFFER,null),i.bindFramebuffer(i.READ_FRAMEBUFFER,null),i.useProgram(null),i.lineWidth(1),i.scissor(0,0,i.canvas.width,i.canvas.height),i.viewport(0,0,i.canvas.width,i.canvas.height),c={},nt=null,gt={},u={},d=new WeakMap,h=[],p=null,g=!1,v=null,m=null,f=null,T=null,b=null,A=null,N=null,L=new ce(0,0,0),C=0,F=!1,S=null,x=null,R=null,z=null,B=null,mt.set(0,0,i.canvas.width,i.canvas.height),kt.set(0,0,i.canvas.width,i.canvas.height),s.reset(),r.reset(),o.reset()}return{buffers:{color:s,depth:r,stencil:o},enable:Rt,disable:ft,bindFramebuffer:Ht,drawBuffers:Bt,useProgram:Nt,setBlending:te,setMaterial:fe,setFlipSided:Ut,setCullFace:se,setLineWidth:Yt,setPolygonOffset:zt,setScissorTest:Se,activeTexture:D,bindTexture:w,unbindTexture:G,compressedTexImage2D:tt,compressedTexImage3D:rt,texImage2D:Et,texImage3D:Gt,updateUBOMapping:Xt,uniformBlockBinding:Zt,texStorage2D:Wt,texStorage3D:lt,texSubImage2D:et,texSubImage3D:At,compressedTexSubImage2D:vt,compressedTexSubImage3D:yt,scissor:It,viewport:xt,reset:xe}}function bM(i,t,e,n,s,r,o){let a=t.has("WEBGL_multisampled_render_to_texture")?t.get("WEBGL_multisampled_render_to_texture"):null,l=typeof navigator>"u"?!1:/OculusBrowser/g.test(navigator.userAgent),c=new Jt,u=new WeakMap,d,h=new WeakMap,p=!1;try{p=typeof OffscreenCanvas<"u"&&new OffscreenCanvas(1,1).getContext("2d")!==null}catch{}function g(D,w){return p?new OffscreenCanvas(D,w):Ia("canvas")}function v(D,w,G){let tt=1,rt=Se(D);if((rt.width>G||rt.height>G)&&(tt=G/Math.max(rt.width,rt.height)),tt<1)if(typeof HTMLImageElement<"u"&&D instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&D instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&D instanceof ImageBitmap||typeof VideoFrame<"u"&&D instanceof VideoFrame){let et=Math.floor(tt*rt.width),At=Math.floor(tt*rt.height);d===void 0&&(d=g(et,At));let vt=w?g(et,At):d;return vt.width=et,vt.height=At,vt.getContext("2d").drawImage(D,0,0,et,At),console.warn("THREE.WebGLRenderer: Texture has been resized from ("+rt.width+"x"+rt.height+") to ("+et+"x"+At+")."),vt}else return"data"in D&&console.warn("THREE.WebGLRenderer: Image in DataTexture is too big ("+rt.width+"x"+rt.height+")."),D;return D}function m(D){return D.generateMipmaps&&D.minFilter!==Nn&&D.minFilter!==ai}function f(D){i.generateMipmap(D)}function T(D,w,G,tt,rt=!1){if(D!==null){if(i[D]!==void 0)return i[D];console.warn("THREE.WebGLRenderer: Attempt to use non-existing WebGL internal format '"+D+"'")}let et=w;if(w===i.RED&&(G===i.FLOAT&&(et=i.R32F),G===i.HALF_FLOAT&&(et=i.R16F),G===i.UNSIGNED_BYTE&&(et=i.R8)),w===i.RED_INTEGER&&(G===i.UNSIGNED_BYTE&&(et=i.R8UI),G===i.UNSIGNED_SHORT&&(et=i.R16UI),G===i.UNSIGNED_INT&&(et=i.R32UI),G===i.BYTE&&(et=i.R8I),G===i.SHORT&&(et=i.R16I),G===i.INT&&(et=i.R32I)),w===i.RG&&(G===i.FLOAT&&(et=i.RG32F),G===i.HALF_FLOAT&&(et=i.RG16F),G===i.UNSIGNED_BYTE&&(et=i.RG8)),w===i.RG_INTEGER&&(G===i.UNSIGNED_BYTE&&(et=i.RG8UI),G===i.UNSIGNED_SHORT&&(et=i.RG16UI),G===i.UNSIGNED_INT&&(et=i.RG32UI),G===i.BYTE&&(et=i.RG8I),G===i.SHORT&&(et=i.RG16I),G===i.INT&&(et=i.RG32I)),w===i.RGB&&G===i.UNSIGNED_INT_5_9_9_9_REV&&(et=i.RGB9_E5),w===i.RGBA){let At=rt?Ca:we.getTransfer(tt);G===i.FLOAT&&(et=i.RGBA32F),G===i.HALF_FLOAT&&(et=i.RGBA16F),G===i.UNSIGNED_BYTE&&(et=At===Ue?i.SRGB8_ALPHA8:i.RGBA8),G===i.UNSIGNED_SHORT_4_4_4_4&&(et=i.RGBA4),G===i.UNSIGNED_SHORT_5_5_5_1&&(et=i.RGB5_A1)}return(et===i.R16F||et===i.R32F||et===i.RG16F||et===i.RG32F||et===i.RGBA16F||et===i.RGBA32F)&&t.get("EXT_color_buffer_float"),et}function b(D,w){let G;return D?w===null||w===Sr||w===Er?G=i.DEPTH24_STENCIL8:w===Oi?G=i.DEPTH32F_STENCIL8:w===Ta&&(G=i.DEPTH24_STENCIL8,console.warn("DepthTexture: 16 bit depth attachment is not supported with stencil. Using 24-bit attachment.")):w===null||w===Sr||w===Er?G=i.DEPTH_COMPONENT24:w===Oi?G=i.DEPTH_COMPONENT32F:w===Ta&&(G=i.DEPTH_COMPONENT16),G}function A(D,w){return m(D)===!0||D.isFramebufferTexture&&D.minFilter!==Nn&&D.minFilter!==ai?Math.log2(Math.max(w.width,w.height))+1:D.mipmaps!==void 0&&D.mipmaps.length>0?D.mipmaps.length:D.isCompressedTexture&&Array.isArray(D.image)?w.mipmaps.length:1}function N(D){let w=D.target;w.removeEventListener("dispose",N),C(w),w.isVideoTexture&&u.delete(w)}function L(D){let w=D.target;w.removeEventListener("dispose",L),S(w)}function C(D){let w=n.get(D);if(w.__webglInit===void 0)return;let G=D.source,tt=h.get(G);if(tt){let rt=tt[w.__cacheKey];rt.usedTimes--,rt.usedTimes===0&&F(D),Object.keys(tt).length===0&&h.delete(G)}n.remove(D)}function F(D){let w=n.get(D);i.deleteTexture(w.__webglTexture);let G=D.source,tt=h.get(G);delete tt[w.__cacheKey],o.memory.textures--}function S(D){let w=n.get(D);if(D.depthTexture&&D.depthTexture.dispose(),D.isWebGLCubeRenderTarget)for(let tt=0;tt<6;tt++){if(Array.isArray(w.__webglFramebuffer[tt]))for(let rt=0;rt<w.__webglFramebuffer[tt].length;rt++)i.deleteFramebuffer(w.__webglFramebuffer[tt][rt]);else i.deleteFramebuffer(w.__webglFramebuffer[tt]);w.__webglDepthbuffer&&i.deleteRenderbuffer(w.__webglDepthbuffer[tt])}else{if(Array.isArray(w.__webglFramebuffer))for(let tt=0;tt<w.__webglFramebuffer.length;tt++)i.deleteFramebuffer(w.__webglFramebuffer[tt]);else i.deleteFramebuffer(w.__webglFramebuffer);if(w.__webglDepthbuffer&&i.deleteRenderbuffer(w.__webglDepthbuffer),w.__webglMultisampledFramebuffer&&i.deleteFramebuffer(w.__webglMultisampledFramebuffer),w.__webglColorRenderbuffer)for(let tt=0;tt<w.__webglColorRenderbuffer.length;tt++)w.__webglColorRenderbuffer[tt]&&i.deleteRenderbuffer(w.__webglColorRenderbuffer[tt]);w.__webglDepthRenderbuffer&&i.deleteRenderbuffer(w.__webglDepthRenderbuffer)}let G=D.textures;for(let tt=0,rt=G.length;tt<rt;tt++){let et=n.get(G[tt]);et.__webglTexture&&(i.deleteTexture(et.__webglTexture),o.memory.textures--),n.remove(G[tt])}n.remove(D)}let x=0;function R(){x=0}function z(){let D=x;return D>=s.maxTextures&&console.warn("THREE.WebGLTextures: Trying to use "+D+" texture units while this GPU supports only "+s.maxTextures),x+=1,D}function B(D){let w=[];return w.push(D.wrapS),w.push(D.wrapT),w.push(D.wrapR||0),w.push(D.magFilter),w.push(D.minFilter),w.push(D.anisotropy),w.push(D.internalFormat),w.push(D.format),w.push(D.type),w.push(D.generateMipmaps),w.push(D.premultiplyAlpha),w.push(D.flipY),w.push(D.unpackAlignment),w.push(D.colorSpace),w.join()}function X(D,w){let G=n.get(D);if(D.isVideoTexture&&Yt(D),D.isRenderTargetTexture===!1&&D.version>0&&G.__version!==D.version){let tt=D.image;if(tt===null)console.warn("THREE.WebGLRenderer: Texture marked for update but no image data found.");else if(tt.complete===!1)console.warn("THREE.WebGLRenderer: Texture marked for update but image is incomplete");else{kt(G,D,w);return}}e.bindTexture(i.TEXTURE_2D,G.__webglTexture,i.TEXTURE0+w)}function J(D,w){let G=n.get(D);if(D.version>0&&G.__version!==D.version){kt(G,D,w);return}e.bindTexture(i.TEXTURE_2D_ARRAY,G.__webglTexture,i.TEXTURE0+w)}function q(D,w){let G=n.get(D);if(D.version>0&&G.__version!==D.version){kt(G,D,w);return}e.bindTexture(i.TEXTURE_3D,G.__webglTexture,i.TEXTURE0+w)}function st(D,w){let G=n.get(D);if(D.version>0&&G.__version!==D.version){Q(G,D,w);return}e.bindTexture(i.TEXTURE_CUBE_MAP,G.__webglTexture,i.TEXTURE0+w)}let nt={[Ic]:i.REPEAT,[Es]:i.CLAMP_TO_EDGE,[Dc]:i.MIRRORED_REPEAT},gt={[Nn]:i.NEAREST,[e0]:i.NEAREST_MIPMAP_NEAREST,[Qo]:i.NEAREST_MIPMAP_LINEAR,[ai]:i.LINEAR,[Zl]:i.LINEAR_MIPMAP_NEAREST,[Ts]:i.LINEAR_MIPMAP_LINEAR},dt={[p0]:i.NEVER,[x0]:i.ALWAYS,[m0]:i.LESS,[Rf]:i.LEQUAL,[g0]:i.EQUAL,[y0]:i.GEQUAL,[_0]:i.GREATER,[v0]:i.NOTEQUAL};function pt(D,w){if(w.type===Oi&&t.has("OES_texture_float_linear")===!1&&(w.magFilter===ai||w.magFilter===Zl||w.magFilter===Qo||w.magFilter===Ts||w.minFilter===ai||w.minFilter===Zl||w.minFilter===Qo||w.minFilter===Ts)&&console.warn("THREE.WebGLRenderer: Unable to use linear filtering with floating point textures. OES_texture_float_linear not supported on this device."),i.texParameteri(D,i.TEXTURE_WRAP_S,nt[w.wrapS]),i.texParameteri(D,i.TEXTURE_WRAP_T,nt[w.wrapT]),(D===i.TEXTURE_3D||D===i.TEXTURE_2D_ARRAY)&&i.texParameteri(D,i.TEXTURE_WRAP_R,nt[w.wrapR]),i.texParameteri(D,i.TEXTURE_MAG_FILTER,gt[w.magFilter]),i.texParameteri(D,i.TEXTURE_MIN_FILTER,gt[w.minFilter]),w.compareFunction&&(i.texParameteri(D,i.TEXTURE_COMPARE_MODE,i.COMPARE_REF_TO_TEXTURE),i.texParameteri(D,i.TEXTURE_COMPARE_FUNC,dt[w.compareFunction])),t.has("EXT_texture_filter_anisotropic")===!0){if(w.magFilter===Nn||w.minFilter!==Qo&&w.minFilter!==Ts||w.type===Oi&&t.has("OES_texture_float_linear")===!1)return;if(w.anisotropy>1||n.get(w).__currentAnisotropy){let G=t.get("EXT_texture_filter_anisotropic");i.texParameterf(D,G.TEXTURE_MAX_ANISOTROPY_EXT,Math.min(w.anisotropy,s.getMaxAnisotropy())),n.get(w).__currentAnisotropy=w.anisotropy}}}function mt(D,w){let G=!1;D.__webglInit===void 0&&(D.__webglInit=!0,w.addEventListener("dispose",N));let tt=w.source,rt=h.get(tt);rt===void 0&&(rt={},h.set(tt,rt));let et=B(w);if(et!==D.__cacheKey){rt[et]===void 0&&(rt[et]={texture:i.createTexture(),usedTimes:0},o.memory.textures++,G=!0),rt[et].usedTimes++;let At=rt[D.__cacheKey];At!==void 0&&(rt[D.__cacheKey].usedTimes--,At.usedTimes===0&&F(w)),D.__cacheKey=et,D.__webglTexture=rt[et].texture}return G}function kt(D,w,G){let tt=i.TEXTURE_2D;(w.isDataArrayTexture||w.isCompressedArrayTexture)&&(tt=i.TEXTURE_2D_ARRAY),w.isData3DTexture&&(tt=i.TEXTURE_3D);let rt=mt(D,w),et=w.source;e.bindTexture(tt,D.__webglTexture,i.TEXTURE0+G);let At=n.get(et);if(et.version!==At.__version||rt===!0){e.activeTexture(i.TEXTURE0+G);let vt=we.getPrimaries(we.workingColorSpace),yt=w.colorSpace===es?null:we.getPrimaries(w.colorSpace),Wt=w.colorSpace===es||vt===yt?i.NONE:i.BROWSER_DEFAULT_WEBGL;i.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,w.flipY),i.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,w.premultiplyAlpha),i.pixelStorei(i.UNPACK_ALIGNMENT,w.unpackAlignment),i.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,Wt);let lt=v(w.image,!1,s.maxTextureSize);lt=zt(w,lt);let Et=r.convert(w.format,w.colorSpace),Gt=r.convert(w.type),It=T(w.internalFormat,Et,Gt,w.colorSpace,w.isVideoTexture);pt(tt,w);let xt,Xt=w.mipmaps,Zt=w.isVideoTexture!==!0,xe=At.__version===void 0||rt===!0,y=et.dataReady,j=A(w,lt);if(w.isDepthTexture)It=b(w.format===Tr,w.type),xe&&(Zt?e.texStorage2D(i.TEXTURE_2D,1,It,lt.width,lt.height):e.texImage2D(i.TEXTURE_2D,0,It,lt.width,lt.height,0,Et,Gt,null));else if(w.isDataTexture)if(Xt.length>0){Zt&&xe&&e.texStorage2D(i.TEXTURE_2D,j,It,Xt[0].width,Xt[0].height);for(let Y=0,it=Xt.length;Y<it;Y++)xt=Xt[Y],Zt?y&&e.texSubImage2D(i.TEXTURE_2D,Y,0,0,xt.width,xt.height,Et,Gt,xt.data):e.texImage2D(i.TEXTURE_2D,Y,It,xt.width,xt.height,0,Et,Gt,xt.data);w.generateMipmaps=!1}else Zt?(xe&&e.texStorage2D(i.TEXTURE_2D,j,It,lt.width,lt.height),y&&e.texSubImage2D(i.TEXTURE_2D,0,0,0,lt.width,lt.height,Et,Gt,lt.data)):e.texImage2D(i.TEXTURE_2D,0,It,lt.width,lt.height,0,Et,Gt,lt.data);else if(w.isCompressedTexture)if(w.isCompressedArrayTexture){Zt&&xe&&e.texStorage3D(i.TEXTURE_2D_ARRAY,j,It,Xt[0].width,Xt[0].height,lt.depth);for(let Y=0,it=Xt.length;Y<it;Y++)if(xt=Xt[Y],w.format!==xi)if(Et!==null)if(Zt){if(y)if(w.layerUpdates.size>0){for(let ht of w.layerUpdates){let Ft=xt.width*xt.height;e.compressedTexSubImage3D(i.TEXTURE_2D_ARRAY,Y,0,0,ht,xt.width,xt.height,1,Et,xt.data.slice(Ft*ht,Ft*(ht+1)),0,0)}w.clearLayerUpdates()}else e.compressedTexSubImage3D(i.TEXTURE_2D_ARRAY,Y,0,0,0,xt.width,xt.height,lt.depth,Et,xt.data,0,0)}else e.compressedTexImage3D(i.TEXTURE_2D_ARRAY,Y,It,xt.width,xt.height,lt.depth,0,xt.data,0,0);else console.warn("THREE.WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()");else Zt?y&&e.texSubImage3D(i.TEXTURE_2D_ARRAY,Y,0,0,0,xt.width,xt.height,lt.depth,Et,Gt,xt.data):e.texImage3D(i.TEXTURE_2D_ARRAY,Y,It,xt.width,xt.height,lt.depth,0,Et,Gt,xt.data)}else{Zt&&xe&&e.texStorage2D(i.TEXTURE_2D,j,It,Xt[0].width,Xt[0].height);for(let Y=0,it=Xt.length;Y<it;Y++)xt=Xt[Y],w.format!==xi?Et!==null?Zt?y&&e.compressedTexSubImage2D(i.TEXTURE_2D,Y,0,0,xt.width,xt.height,Et,xt.data):e.compressedTexImage2D(i.TEXTURE_2D,Y,It,xt.width,xt.height,0,xt.data):console.warn("THREE.WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()"):Zt?y&&e.texSubImage2D(i.TEXTURE_2D,Y,0,0,xt.width,xt.height,Et,Gt,xt.data):e.texImage2D(i.TEXTURE_2D,Y,It,xt.width,xt.height,0,Et,Gt,xt.data)}else if(w.isDataArrayTexture)if(Zt){if(xe&&e.texStorage3D(i.TEXTURE_2D_ARRAY,j,It,lt.width,lt.height,lt.depth),y)if(w.layerUpdates.size>0){let Y;switch(Gt){case i.UNSIGNED_BYTE:switch(Et){case i.ALPHA:Y=1;break;case i.LUMINANCE:Y=1;break;case i.LUMINANCE_ALPHA:Y=2;break;case i.RGB:Y=3;break;case i.RGBA:Y=4;break;default:throw new Error(`Unknown texel size for format ${Et}.`)}break;case i.UNSIGNED_SHORT_4_4_4_4:case i.UNSIGNED_SHORT_5_5_5_1:case i.UNSIGNED_SHORT_5_6_5:Y=1;break;default:throw new Error(`Unknown texel size for type ${Gt}.`)}let it=lt.width*lt.height*Y;for(let ht of w.layerUpdates)e.texSubImage3D(i.TEXTURE_2D_ARRAY,0,0,0,ht,lt.width,lt.height,1,Et,Gt,lt.data.slice(it*ht,it*(ht+1)));w.clearLayerUpdates()}else e.texSubImage3D(i.TEXTURE_2D_ARRAY,0,0,0,0,lt.width,lt.height,lt.depth,Et,Gt,lt.data)}else e.texImage3D(i.TEXTURE_2D_ARRAY,0,It,lt.width,lt.height,lt.depth,0,Et,Gt,lt.data);else if(w.isData3DTexture)Zt?(xe&&e.texStorage3D(i.TEXTURE_3D,j,It,lt.width,lt.height,lt.depth),y&&e.texSubImage3D(i.TEXTURE_3D,0,0,0,0,lt.width,lt.height,lt.depth,Et,Gt,lt.data)):e.texImage3D(i.TEXTURE_3D,0,It,lt.width,lt.height,lt.depth,0,Et,Gt,lt.data);else if(w.isFramebufferTexture){if(xe)if(Zt)e.texStorage2D(i.TEXTURE_2D,j,It,lt.width,lt.height);else{let Y=lt.width,it=lt.height;for(let ht=0;ht<j;ht++)e.texImage2D(i.TEXTURE_2D,ht,It,Y,it,0,Et,Gt,null),Y>>=1,it>>=1}}else if(Xt.length>0){if(Zt&&xe){let Y=Se(Xt[0]);e.texStorage2D(i.TEXTURE_2D,j,It,Y.width,Y.height)}for(let Y=0,it=Xt.length;Y<it;Y++)xt=Xt[Y],Zt?y&&e.texSubImage2D(i.TEXTURE_2D,Y,0,0,Et,Gt,xt):e.texImage2D(i.TEXTURE_2D,Y,It,Et,Gt,xt);w.generateMipmaps=!1}else if(Zt){if(xe){let Y=Se(lt);e.texStorage2D(i.TEXTURE_2D,j,It,Y.width,Y.height)}y&&e.texSubImage2D(i.TEXTURE_2D,0,0,0,Et,Gt,lt)}else e.texImage2D(i.TEXTURE_2D,0,It,Et,Gt,lt);m(w)&&f(tt),At.__version=et.version,w.onUpdate&&w.onUpdate(w)}D.__version=w.version}function Q(D,w,G){if(w.image.length!==6)return;let tt=mt(D,w),rt=w.source;e.bindTexture(i.TEXTURE_CUBE_MAP,D.__webglTexture,i.TEXTURE0+G);let et=n.get(rt);if(rt.version!==et.__version||tt===!0){e.activeTexture(i.TEXTURE0+G);let At=we.getPrimaries(we.workingColorSpace),vt=w.colorSpace===es?null:we.getPrimaries(w.colorSpace),yt=w.colorSpace===es||At===vt?i.NONE:i.BROWSER_DEFAULT_WEBGL;i.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,w.flipY),i.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,w.premultiplyAlpha),i.pixelStorei(i.UNPACK_ALIGNMENT,w.unpackAlignment),i.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,yt);let Wt=w.isCompressedTexture||w.image[0].isCompressedTexture,lt=w.image[0]&&w.image[0].isDataTexture,Et=[];for(let it=0;it<6;it++)!Wt&&!lt?Et[it]=v(w.image[it],!0,s.maxCubemapSize):Et[it]=lt?w.image[it].image:w.image[it],Et[it]=zt(w,Et[it]);let Gt=Et[0],It=r.convert(w.format,w.colorSpace),xt=r.convert(w.type),Xt=T(w.internalFormat,It,xt,w.colorSpace),Zt=w.isVideoTexture!==!0,xe=et.__version===void 0||tt===!0,y=rt.dataReady,j=A(w,Gt);pt(i.TEXTURE_CUBE_MAP,w);let Y;if(Wt){Zt&&xe&&e.texStorage2D(i.TEXTURE_CUBE_MAP,j,Xt,Gt.width,Gt.height);for(let it=0;it<6;it++){Y=Et[it].mipmaps;for(let ht=0;ht<Y.length;ht++){let Ft=Y[ht];w.format!==xi?It!==null?Zt?y&&e.compressedTexSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+it,ht,0,0,Ft.width,Ft.height,It,Ft.data):e.compressedTexImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+it,ht,Xt,Ft.width,Ft.height,0,Ft.data):console.warn("THREE.WebGLRenderer: Attempt to load unsupported compressed texture format in .setTextureCube()"):Zt?y&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+it,ht,0,0,Ft.width,Ft.height,It,xt,Ft.data):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+it,ht,Xt,Ft.width,Ft.height,0,It,xt,Ft.data)}}}else{if(Y=w.mipmaps,Zt&&xe){Y.length>0&&j++;let it=Se(Et[0]);e.texStorage2D(i.TEXTURE_CUBE_MAP,j,Xt,it.width,it.height)}for(let it=0;it<6;it++)if(lt){Zt?y&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+it,0,0,0,Et[it].width,Et[it].height,It,xt,Et[it].data):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+it,0,Xt,Et[it].width,Et[it].height,0,It,xt,Et[it].data);for(let ht=0;ht<Y.length;ht++){let Kt=Y[ht].image[it].image;Zt?y&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+it,ht+1,0,0,Kt.width,Kt.height,It,xt,Kt.data):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+it,ht+1,Xt,Kt.width,Kt.height,0,It,xt,Kt.data)}}else{Zt?y&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+it,0,0,0,It,xt,Et[it]):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+it,0,Xt,It,xt,Et[it]);for(let ht=0;ht<Y.length;ht++){let Ft=Y[ht];Zt?y&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+it,ht+1,0,0,It,xt,Ft.image[it]):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+it,ht+1,Xt,It,xt,Ft.image[it])}}}m(w)&&f(i.TEXTURE_CUBE_MAP),et.__version=rt.version,w.onUpdate&&w.onUpdate(w)}D.__version=w.version}function ct(D,w,G,tt,rt,et){let At=r.convert(G.format,G.colorSpace),vt=r.convert(G.type),yt=T(G.internalFormat,At,vt,G.colorSpace);if(!n.get(w).__hasExternalTextures){let lt=Math.max(1,w.width>>et),Et=Math.max(1,w.height>>et);rt===i.TEXTURE_3D||rt===i.TEXTURE_2D_ARRAY?e.texImage3D(rt,et,yt,lt,Et,w.depth,0,At,vt,null):e.texImage2D(rt,et,yt,lt,Et,0,At,vt,null)}e.bindFramebuffer(i.FRAMEBUFFER,D),se(w)?a.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,tt,rt,n.get(G).__webglTexture,0,Ut(w)):(rt===i.TEXTURE_2D||rt>=i.TEXTURE_CUBE_MAP_POSITIVE_X&&rt<=i.TEXTURE_CUBE_MAP_NEGATIVE_Z)&&i.framebufferTexture2D(i.FRAMEBUFFER,tt,rt,n.get(G).__webglTexture,et),e.bindFramebuffer(i.FRAMEBUFFER,null)}function Rt(D,w,G){if(i.bindRenderbuffer(i.RENDERBUFFER,D),w.depthBuffer){let tt=w.depthTexture,rt=tt&&tt.isDepthTexture?tt.type:null,et=b(w.stencilBuffer,rt),At=w.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,vt=Ut(w);se(w)?a.renderbufferStorageMultisampleEXT(i.RENDERBUFFER,vt,et,w.width,w.height):G?i.renderbufferStorageMultisample(i.RENDERBUFFER,vt,et,w.width,w.height):i.renderbufferStorage(i.RENDERBUFFER,et,w.width,w.height),i.framebufferRenderbuffer(i.FRAMEBUFFER,At,i.RENDERBUFFER,D)}else{let tt=w.textures;for(let rt=0;rt<tt.length;rt++){let et=tt[rt],At=r.convert(et.format,et.colorSpace),vt=r.convert(et.type),yt=T(et.internalFormat,At,vt,et.colorSpace),Wt=Ut(w);G&&se(w)===!1?i.renderbufferStorageMultisample(i.RENDERBUFFER,Wt,yt,w.width,w.height):se(w)?a.renderbufferStorageMultisampleEXT(i.RENDERBUFFER,Wt,yt,w.width,w.height):i.renderbufferStorage(i.RENDERBUFFER,yt,w.width,w.height)}}i.bindRenderbuffer(i.RENDERBUFFER,null)}function ft(D,w){if(w&&w.isWebGLCubeRenderTarget)throw new Error("Depth Texture with cube render targets is not supported");if(e.bindFramebuffer(i.FRAMEBUFFER,D),!(w.depthTexture&&w.depthTexture.isDepthTexture))throw new Error("renderTarget.depthTexture must be an instance of THREE.DepthTexture");(!n.get(w.depthTexture).__webglTexture||w.depthTexture.image.width!==w.width||w.depthTexture.image.height!==w.height)&&(w.depthTexture.image.width=w.width,w.depthTexture.image.height=w.height,w.depthTexture.needsUpdate=!0),X(w.depthTexture,0);let tt=n.get(w.depthTexture).__webglTexture,rt=Ut(w);if(w.depthTexture.format===yr)se(w)?a.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,i.DEPTH_ATTACHMENT,i.TEXTURE_2D,tt,0,rt):i.framebufferTexture2D(i.FRAMEBUFFER,i.DEPTH_ATTACHMENT,i.TEXTURE_2D,tt,0);else if(w.depthTexture.format===Tr)se(w)?a.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,i.DEPTH_STENCIL_ATTACHMENT,i.TEXTURE_2D,tt,0,rt):i.framebufferTexture2D(i.FRAMEBUFFER,i.DEPTH_STENCIL_ATTACHMENT,i.TEXTURE_2D,tt,0);else throw new Error("Unknown depthTexture format")}function Ht(D){let w=n.get(D),G=D.isWebGLCubeRenderTarget===!0;if(D.depthTexture&&!w.__autoAllocateDepthBuffer){if(G)throw new Error("target.depthTexture not supported in Cube render targets");ft(w.__webglFramebuffer,D)}else if(G){w.__webglDepthbuffer=[];for(let tt=0;tt<6;tt++)e.bindFramebuffer(i.FRAMEBUFFER,w.__webglFramebuffer[tt]),w.__webglDepthbuffer[tt]=i.createRenderbuffer(),Rt(w.__webglDepthbuffer[tt],D,!1)}else e.bindFramebuffer(i.FRAMEBUFFER,w.__webglFramebuffer),w.__webglDepthbuffer=i.createRenderbuffer(),Rt(w.__webglDepthbuffer,D,!1);e.bindFramebuffer(i.FRAMEBUFFER,null)}function Bt(D,w,G){let tt=n.get(D);w!==void 0&&ct(tt.__webglFramebuffer,D,D.texture,i.COLOR_ATTACHMENT0,i.TEXTURE_2D,0),G!==void 0&&Ht(D)}function Nt(D){let w=D.texture,G=n.get(D),tt=n.get(w);D.addEventListener("dispose",L);let rt=D.textures,et=D.isWebGLCubeRenderTarget===!0,At=rt.length>1;if(At||(tt.__webglTexture===void 0&&(tt.__webglTexture=i.createTexture()),tt.__version=w.version,o.memory.textures++),et){G.__webglFramebuffer=[];for(let vt=0;vt<6;vt++)if(w.mipmaps&&w.mipmaps.length>0){G.__webglFramebuffer[vt]=[];for(let yt=0;yt<w.mipmaps.length;yt++)G.__webglFramebuffer[vt][yt]=i.createFramebuffer()}else G.__webglFramebuffer[vt]=i.createFramebuffer()}else{if(w.mipmaps&&w.mipmaps.length>0){G.__webglFramebuffer=[];for(let vt=0;vt<w.mipmaps.length;vt++)G.__webglFramebuffer[vt]=i.createFramebuffer()}else G.__webglFramebuffer=i.createFramebuffer();if(At)for(let vt=0,yt=rt.length;vt<yt;vt++){let Wt=n.get(rt[vt]);Wt.__webglTexture===void 0&&(Wt.__webglTexture=i.createTexture(),o.memory.textures++)}if(D.samples>0&&se(D)===!1){G.__webglMultisampledFramebuffer=i.createFramebuffer(),G.__webglColorRenderbuffer=[],e.bindFramebuffer(i.FRAMEBUFFER,G.__webglMultisampledFramebuffer);for(let vt=0;vt<rt.length;vt++){let yt=rt[vt];G.__webglColorRenderbuffer[vt]=i.createRenderbuffer(),i.bindRenderbuffer(i.RENDERBUFFER,G.__webglColorRenderbuffer[vt]);let Wt=r.convert(yt.format,yt.colorSpace),lt=r.convert(yt.type),Et=T(yt.internalFormat,Wt,lt,yt.colorSpace,D.isXRRenderTarget===!0),Gt=Ut(D);i.renderbufferStorageMultisample(i.RENDERBUFFER,Gt,Et,D.width,D.height),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+vt,i.RENDERBUFFER,G.__webglColorRenderbuffer[vt])}i.bindRenderbuffer(i.RENDERBUFFER,null),D.depthBuffer&&(G.__webglDepthRenderbuffer=i.createRenderbuffer(),Rt(G.__webglDepthRenderbuffer,D,!0)),e.bindFramebuffer(i.FRAMEBUFFER,null)}}if(et){e.bindTexture(i.TEXTURE_CUBE_MAP,tt.__webglTexture),pt(i.TEXTURE_CUBE_MAP,w);for(let vt=0;vt<6;vt++)if(w.mipmaps&&w.mipmaps.length>0)for(let yt=0;yt<w.mipmaps.length;yt++)ct(G.__webglFramebuffer[vt][yt],D,w,i.COLOR_ATTACHMENT0,i.TEXTURE_CUBE_MAP_POSITIVE_X+vt,yt);else ct(G.__webglFramebuffer[vt],D,w,i.COLOR_ATTACHMENT0,i.TEXTURE_CUBE_MAP_POSITIVE_X+vt,0);m(w)&&f(i.TEXTURE_CUBE_MAP),e.unbindTexture()}else if(At){for(let vt=0,yt=rt.length;vt<yt;vt++){let Wt=rt[vt],lt=n.get(Wt);e.bindTexture(i.TEXTURE_2D,lt.__webglTexture),pt(i.TEXTURE_2D,Wt),ct(G.__webglFramebuffer,D,Wt,i.COLOR_ATTACHMENT0+vt,i.TEXTURE_2D,0),m(Wt)&&f(i.TEXTURE_2D)}e.unbindTexture()}else{let vt=i.TEXTURE_2D;if((D.isWebGL3DRenderTarget||D.isWebGLArrayRenderTarget)&&(vt=D.isWebGL3DRenderTarget?i.TEXTURE_3D:i.TEXTURE_2D_ARRAY),e.bindTexture(vt,tt.__webglTexture),pt(vt,w),w.mipmaps&&w.mipmaps.length>0)for(let yt=0;yt<w.mipmaps.length;yt++)ct(G.__webglFramebuffer[yt],D,w,i.COLOR_ATTACHMENT0,vt,yt);else ct(G.__webglFramebuffer,D,w,i.COLOR_ATTACHMENT0,vt,0);m(w)&&f(vt),e.unbindTexture()}D.depthBuffer&&Ht(D)}function O(D){let w=D.textures;for(let G=0,tt=w.length;G<tt;G++){let rt=w[G];if(m(rt)){let et=D.isWebGLCubeRenderTarget?i.TEXTURE_CUBE_MAP:i.TEXTURE_2D,At=n.get(rt).__webglTexture;e.bindTexture(et,At),f(et),e.unbindTexture()}}}let jt=[],te=[];function fe(D){if(D.samples>0){if(se(D)===!1){let w=D.textures,G=D.width,tt=D.height,rt=i.COLOR_BUFFER_BIT,et=D.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,At=n.get(D),vt=w.length>1;if(vt)for(let yt=0;yt<w.length;yt++)e.bindFramebuffer(i.FRAMEBUFFER,At.__webglMultisampledFramebuffer),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+yt,i.RENDERBUFFER,null),e.bindFramebuffer(i.FRAMEBUFFER,At.__webglFramebuffer),i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0+yt,i.TEXTURE_2D,null,0);e.bindFramebuffer(i.READ_FRAMEBUFFER,At.__webglMultisampledFramebuffer),e.bindFramebuffer(i.DRAW_FRAMEBUFFER,At.__webglFramebuffer);for(let yt=0;yt<w.length;yt++){if(D.resolveDepthBuffer&&(D.depthBuffer&&(rt|=i.DEPTH_BUFFER_BIT),D.stencilBuffer&&D.resolveStencilBuffer&&(rt|=i.STENCIL_BUFFER_BIT)),vt){i.framebufferRenderbuffer(i.READ_FRAMEBUFFER,i.COLOR_ATTACHMENT0,i.RENDERBUFFER,At.__webglColorRenderbuffer[yt]);let Wt=n.get(w[yt]).__webglTexture;i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0,i.TEXTURE_2D,Wt,0)}i.blitFramebuffer(0,0,G,tt,0,0,G,tt,rt,i.NEAREST),l===!0&&(jt.length=0,te.length=0,jt.push(i.COLOR_ATTACHMENT0+yt),D.depthBuffer&&D.resolveDepthBuffer===!1&&(jt.push(et),te.push(et),i.invalidateFramebuffer(i.DRAW_FRAMEBUFFER,te)),i.invalidateFramebuffer(i.READ_FRAMEBUFFER,jt))}if(e.bindFramebuffer(i.READ_FRAMEBUFFER,null),e.bindFramebuffer(i.DRAW_FRAMEBUFFER,null),vt)for(let yt=0;yt<w.length;yt++){e.bindFramebuffer(i.FRAMEBUFFER,At.__webglMultisampledFramebuffer),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+yt,i.RENDERBUFFER,At.__webglColorRenderbuffer[yt]);let Wt=n.get(w[yt]).__webglTexture;e.bindFramebuffer(i.FRAMEBUFFER,At.__webglFramebuffer),i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0+yt,i.TEXTURE_2D,Wt,0)}e.bindFramebuffer(i.DRAW_FRAMEBUFFER,At.__webglMultisampledFramebuffer)}else if(D.depthBuffer&&D.resolveDepthBuffer===!1&&l){let w=D.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT;i.invalidateFramebuffer(i.DRAW_FRAMEBUFFER,[w])}}}function Ut(D){return Math.min(s.maxSamples,D.samples)}function se(D){let w=n.get(D);return D.samples>0&&t.has("WEBGL_multisampled_render_to_texture")===!0&&w.__useRenderToTexture!==!1}function Yt(D){let w=o.render.frame;u.get(D)!==w&&(u.set(D,w),D.update())}function zt(D,w){let G=D.colorSpace,tt=D.format,rt=D.type;return D.isCompressedTexture===!0||D.isVideoTexture===!0||G!==ls&&G!==es&&(we.getTransfer(G)===Ue?(tt!==xi||rt!==rs)&&console.warn("THREE.WebGLTextures: sRGB encoded textures have to use RGBAFormat and UnsignedByteType."):console.error("THREE.WebGLTextures: Unsupported texture color space:",G)),w}function Se(D){return typeof HTMLImageElement<"u"&&D instanceof HTMLImageElement?(c.width=D.naturalWidth||D.width,c.height=D.naturalHeight||D.height):typeof VideoFrame<"u"&&D instanceof VideoFrame?(c.width=D.displayWidth,c.height=D.displayHeight):(c.width=D.width,c.height=D.height),c}this.allocateTextureUnit=z,this.resetTextureUnits=R,this.setTexture2D=X,this.setTexture2DArray=J,this.setTexture3D=q,this.setTextureCube=st,this.rebindTextures=Bt,this.setupRenderTarget=Nt,this.updateRenderTargetMipmap=O,this.updateMultisampleRenderTarget=fe,this.setupDepthRenderbuffer=Ht,this.setupFrameBufferTexture=ct,this.useMultisampledRTT=se}function wM(i,t){function e(n,s=es){let r,o=we.getTransfer(s);if(n===rs)return i.UNSIGNED_BYTE;if(n===bf)return i.UNSIGNED_SHORT_4_4_4_4;if(n===wf)return i.UNSIGNED_SHORT_5_5_5_1;if(n===s0)return i.UNSIGNED_INT_5_9_9_9_REV;if(n===n0)return i.BYTE;if(n===i0)return i.SHORT;if(n===Ta)return i.UNSIGNED_SHORT;if(n===Mf)return i.INT;if(n===Sr)return i.UNSIGNED_INT;if(n===Oi)return i.FLOAT;if(n===el)return i.HALF_FLOAT;if(n===r0)return i.ALPHA;if(n===o0)return i.RGB;if(n===xi)return i.RGBA;if(n===a0)return i.LUMINANCE;if(n===l0)return i.LUMINANCE_ALPHA;if(n===yr)return i.DEPTH_COMPONENT;if(n===Tr)return i.DEPTH_STENCIL;if(n===Sf)return i.RED;if(n===Ef)return i.RED_INTEGER;if(n===c0)return i.RG;if(n===Tf)return i.RG_INTEGER;if(n===Af)return i.RGBA_INTEGER;if(n===Jl||n===Kl||n===jl||n===Ql)if(o===Ue)if(r=t.get("WEBGL_compressed_texture_s3tc_srgb"),r!==null){if(n===Jl)return r.COMPRESSED_SRGB_S3TC_DXT1_EXT;if(n===Kl)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT1_EXT;if(n===jl)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT3_EXT;if(n===Ql)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT5_EXT}else return null;else if(r=t.get("WEBGL_compressed_texture_s3tc"),r!==null){if(n===Jl)return r.COMPRESSED_RGB_S3TC_DXT1_EXT;if(n===Kl)return r.COMPRESSED_RGBA_S3TC_DXT1_EXT;if(n===jl)return r.COMPRESSED_RGBA_S3TC_DXT3_EXT;if(n===Ql)return r.COMPRESSED_RGBA_S3TC_DXT5_EXT}else return null;if(n===Xu||n===$u||n===qu||n===Yu)if(r=t.get("WEBGL_compressed_texture_pvrtc"),r!==null){if(n===Xu)return r.COMPRESSED_RGB_PVRTC_4BPPV1_IMG;if(n===$u)return r.COMPRESSED_RGB_PVRTC_2BPPV1_IMG;if(n===qu)return r.COMPRESSED_RGBA_PVRTC_4BPPV1_IMG;if(n===Yu)return r.COMPRESSED_RGBA_PVRTC_2BPPV1_IMG}else return null;if(n===Zu||n===Ju||n===Ku)if(r=t.get("WEBGL_compressed_texture_etc"),r!==null){if(n===Zu||n===Ju)return o===Ue?r.COMPRESSED_SRGB8_ETC2:r.COMPRESSED_RGB8_ETC2;if(n===Ku)return o===Ue?r.COMPRESSED_SRGB8_ALPHA8_ETC2_EAC:r.COMPRESSED_RGBA8_ETC2_EAC}else return null;if(n===ju||n===Qu||n===td||n===ed||n===nd||n===id||n===sd||n===rd||n===od||n===ad||n===ld||n===cd||n===hd||n===ud)if(r=t.get("WEBGL_compressed_texture_astc"),r!==null){if(n===ju)return o===Ue?r.COMPRESSED_SRGB8_ALPHA8_ASTC_4x4_KHR:r.COMPRESSED_RGBA_ASTC_4x4_KHR;if(n===Qu)return o===Ue?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x4_KHR:r.COMPRESSED_RGBA_ASTC_5x4_KHR;if(n===td)return o===Ue?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x5_KHR:r.COMPRESSED_RGBA_ASTC_5x5_KHR;if(n===ed)return o===Ue?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x5_KHR:r.COMPRESSED_RGBA_ASTC_6x5_KHR;if(n===nd)return o===Ue?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x6_KHR:r.COMPRESSED_RGBA_ASTC_6x6_KHR;if(n===id)return o===Ue?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x5_KHR:r.COMPRESSED_RGBA_ASTC_8x5_KHR;if(n===sd)return o===Ue?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x6_KHR:r.COMPRESSED_RGBA_ASTC_8x6_KHR;if(n===rd)return o===Ue?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x8_KHR:r.COMPRESSED_RGBA_ASTC_8x8_KHR;if(n===od)return o===Ue?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x5_KHR:r.COMPRESSED_RGBA_ASTC_10x5_KHR;if(n===ad)return o===Ue?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x6_KHR:r.COMPRESSED_RGBA_ASTC_10x6_KHR;if(n===ld)return o===Ue?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x8_KHR:r.COMPRESSED_RGBA_ASTC_10x8_KHR;if(n===cd)return o===Ue?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x10_KHR:r.COMPRESSED_RGBA_ASTC_10x10_KHR;if(n===hd)return o===Ue?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x10_KHR:r.COMPRESSED_RGBA_ASTC_12x10_KHR;if(n===ud)return o===Ue?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x12_KHR:r.COMPRESSED_RGBA_ASTC_12x12_KHR}else return null;if(n===tc||n===dd||n===fd)if(r=t.get("EXT_texture_compression_bptc"),r!==null){if(n===tc)return o===Ue?r.COMPRESSED_SRGB_ALPHA_BPTC_UNORM_EXT:r.COMPRESSED_RGBA_BPTC_UNORM_EXT;if(n===dd)return r.COMPRESSED_RGB_BPTC_SIGNED_FLOAT_EXT;if(n===fd)return r.COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT_EXT}else return null;if(n===h0||n===pd||n===md||n===gd)if(r=t.get("EXT_texture_compression_rgtc"),r!==null){if(n===tc)return r.COMPRESSED_RED_RGTC1_EXT;if(n===pd)return r.COMPRESSED_SIGNED_RED_RGTC1_EXT;if(n===md)return r.COMPRESSED_RED_GREEN_RGTC2_EXT;if(n===gd)return r.COMPRESSED_SIGNED_RED_GREEN_RGTC2_EXT}else return null;return n===Er?i.UNSIGNED_INT_24_8:i[n]!==void 0?i[n]:null}return{convert:e}}var Yc=class extends An{constructor(t=[]){super(),this.isArrayCamera=!0,this.cameras=t}},Mi=class extends Je{constructor(){super(),this.isGroup=!0,this.type="Group"}},SM={type:"move"},xo=class{constructor(){this._targetRay=null,this._grip=null,this._hand=null}getHandSpace(){return this._hand===null&&(this._hand=new Mi,this._hand.matrixAutoUpdate=!1,this._hand.visible=!1,this._hand.joints={},this._hand.inputState={pinching:!1}),this._hand}getTargetRaySpace(){return this._targetRay===null&&(this._targetRay=new Mi,this._targetRay.matrixAutoUpdate=!1,this._targetRay.visible=!1,this._targetRay.hasLinearVelocity=!1,this._targetRay.linearVelocity=new V,this._targetRay.hasAngularVelocity=!1,this._targetRay.angularVelocity=new V),this._targetRay}getGripSpace(){return this._grip===null&&(this._grip=new Mi,this._grip.matrixAutoUpdate=!1,this._grip.visible=!1,this._grip.hasLinearVelocity=!1,this._grip.linearVelocity=new V,this._grip.hasAngularVelocity=!1,this._grip.angularVelocity=new V),this._grip}dispatchEvent(t){return this._targetRay!==null&&this._targetRay.dispatchEvent(t),this._grip!==null&&this._grip.dispatchEvent(t),this._hand!==null&&this._hand.dispatchEvent(t),this}connect(t){if(t&&t.hand){let e=this._hand;if(e)for(let n of t.hand.values())this._getHandJoint(e,n)}return this.dispatchEvent({type:"connected",data:t}),this}disconnect(t){return this.dispatchEvent({type:"disconnected",data:t}),this._targetRay!==null&&(this._targetRay.visible=!1),this._grip!==null&&(this._grip.visible=!1),this._hand!==null&&(this._hand.visible=!1),this}update(t,e,n){let s=null,r=null,o=null,a=this._targetRay,l=this._grip,c=this._hand;if(t&&e.session.visibilityState!=="visible-blurred"){if(c&&t.hand){o=!0;for(let v of t.hand.values()){let m=e.getJointPose(v,n),f=this._getHandJoint(c,v);m!==null&&(f.matrix.fromArray(m.transform.matrix),f.matrix.decompose(f.position,f.rotation,f.scale),f.matrixWorldNeedsUpdate=!0,f.jointRadius=m.radius),f.visible=m!==null}let u=c.joints["index-finger-tip"],d=c.joints["thumb-tip"],h=u.position.distanceTo(d.position),p=.02,g=.005;c.inputState.pinching&&h>p+g?(c.inputState.pinching=!1,this.dispatchEvent({type:"pinchend",handedness:t.handedness,target:this})):!c.inputState.pinching&&h<=p-g&&(c.inputState.pinching=!0,this.dispatchEvent({type:"pinchstart",handedness:t.handedness,target:this}))}else l!==null&&t.gripSpace&&(r=e.getPose(t.gripSpace,n),r!==null&&(l.matrix.fromArray(r.transform.matrix),l.matrix.decompose(l.position,l.rotation,l.scale),l.matrixWorldNeedsUpdate=!0,r.linearVelocity?(l.hasLinearVelocity=!0,l.linearVelocity.copy(r.linearVelocity)):l.hasLinearVelocity=!1,r.angularVelocity?(l.hasAngularVelocity=!0,l.angularVelocity.copy(r.angularVelocity)):l.hasAngularVelocity=!1));a!==null&&(s=e.getPose(t.targetRaySpace,n),s===null&&r!==null&&(s=r),s!==null&&(a.matrix.fromArray(s.transform.matrix),a.matrix.decompose(a.position,a.rotation,a.scale),a.matrixWorldNeedsUpdate=!0,s.linearVelocity?(a.hasLinearVelocity=!0,a.linearVelocity.copy(s.linearVelocity)):a.hasLinearVelocity=!1,s.angularVelocity?(a.hasAngularVelocity=!0,a.angularVelocity.copy(s.angularVelocity)):a.hasAngularVelocity=!1,this.dispatchEvent(SM)))}return a!==null&&(a.visible=s!==null),l!==null&&(l.visible=r!==null),c!==null&&(c.visible=o!==null),this}_getHandJoint(t,e){if(t.joints[e.jointName]===void 0){let n=new Mi;n.matrixAutoUpdate=!1,n.visible=!1,t.joints[e.jointName]=n,t.add(n)}return t.joints[e.jointName]}},EM=`
void main() {

	gl_Position = vec4( position, 1.0 );

}`,TM=`
uniform sampler2DArray depthColor;
uniform float depthWidth;
uniform float depthHeight;

void main() {

	vec2 coord = vec2( gl_FragCoord.x / depthWidth, gl_FragCoord.y / depthHeight );

	if ( coord.x >= 1.0 ) {

		gl_FragDepth = texture( depthColor, vec3( coord.x - 1.0, coord.y, 1 ) ).r;

	} else {

		gl_FragDepth = texture( depthColor, vec3( coord.x, coord.y, 0 ) ).r;

	}

}`,Zc=class{constructor(){this.texture=null,this.mesh=null,this.depthNear=0,this.depthFar=0}init(t,e,n){if(this.texture===null){let s=new mn,r=t.properties.get(s);r.__webglTexture=e.texture,(e.depthNear!=n.depthNear||e.depthFar!=n.depthFar)&&(this.depthNear=e.depthNear,this.depthFar=e.depthFar),this.texture=s}}getMesh(t){if(this.texture!==null&&this.mesh===null){let e=t.cameras[0].viewport,n=new wi({vertexShader:EM,fragmentShader:TM,uniforms:{depthColor:{value:this.texture},depthWidth:{value:e.z},depthHeight:{value:e.w}}});this.mesh=new zn(new Pr(20,20),n)}return this.mesh}reset(){this.texture=null,this.mesh=null}},Jc=class extends bi{constructor(t,e){super();let n=this,s=null,r=1,o=null,a="local-floor",l=1,c=null,u=null,d=null,h=null,p=null,g=null,v=new Zc,m=e.getContextAttributes(),f=null,T=null,b=[],A=[],N=new Jt,L=null,C=new An;C.layers.enable(1),C.viewport=new Ze;let F=new An;F.layers.enable(2),F.viewport=new Ze;let S=[C,F],x=new Yc;x.layers.enable(1),x.layers.enable(2);let R=null,z=null;this.cameraAutoUpdate=!0,this.enabled=!1,this.isPresenting=!1,this.getController=function(Q){let ct=b[Q];return ct===void 0&&(ct=new xo,b[Q]=ct),ct.getTargetRaySpace()},this.getControllerGrip=function(Q){let ct=b[Q];return ct===void 0&&(ct=new xo,b[Q]=ct),ct.getGripSpace()},this.getHand=function(Q){let ct=b[Q];return ct===void 0&&(ct=new xo,b[Q]=ct),ct.getHandSpace()};function B(Q){let ct=A.indexOf(Q.inputSource);if(ct===-1)return;let Rt=b[ct];Rt!==void 0&&(Rt.update(Q.inputSource,Q.frame,c||o),Rt.dispatchEvent({type:Q.type,data:Q.inputSource}))}function X(){s.removeEventListener("select",B),s.removeEventListener("selectstart",B),s.removeEventListener("selectend",B),s.removeEventListener("squeeze",B),s.removeEventListener("squeezestart",B),s.removeEventListener("squeezeend",B),s.removeEventListener("end",X),s.removeEventListener("inputsourceschange",J);for(let Q=0;Q<b.length;Q++){let ct=A[Q];ct!==null&&(A[Q]=null,b[Q].disconnect(ct))}R=null,z=null,v.reset(),t.setRenderTarget(f),p=null,h=null,d=null,s=null,T=null,kt.stop(),n.isPresenting=!1,t.setPixelRatio(L),t.setSize(N.width,N.height,!1),n.dispatchEvent({type:"sessionend"})}this.setFramebufferScaleFactor=function(Q){r=Q,n.isPresenting===!0&&console.warn("THREE.WebXRManager: Cannot change framebuffer scale while presenting.")},this.setReferenceSpaceType=function(Q){a=Q,n.isPresenting===!0&&console.warn("THREE.WebXRManager: Cannot change reference space type while presenting.")},this.getReferenceSpace=function(){return c||o},this.setReferenceSpace=function(Q){c=Q},this.getBaseLayer=function(){return h!==null?h:p},this.getBinding=function(){return d},this.getFrame=function(){return g},this.getSession=function(){return s},this.setSession=async function(Q){if(s=Q,s!==null){if(f=t.getRenderTarget(),s.addEventListener("select",B),s.addEventListener("selectstart",B),s.addEventListener("selectend",B),s.addEventListener("squeeze",B),s.addEventListener("squeezestart",B),s.addEventListener("squeezeend",B),s.addEventListener("end",X),s.addEventListener("inputsourceschange",J),m.xrCompatible!==!0&&await e.makeXRCompatible(),L=t.getPixelRatio(),t.getSize(N),s.renderState.layers===void 0){let ct={antialias:m.antialias,alpha:!0,depth:m.depth,stencil:m.stencil,framebufferScaleFactor:r};p=new XRWebGLLayer(s,e,ct),s.updateRenderState({baseLayer:p}),t.setPixelRatio(1),t.setSize(p.framebufferWidth,p.framebufferHeight,!1),T=new ki(p.framebufferWidth,p.framebufferHeight,{format:xi,type:rs,colorSpace:t.outputColorSpace,stencilBuffer:m.stencil})}else{let ct=null,Rt=null,ft=null;m.depth&&(ft=m.stencil?e.DEPTH24_STENCIL8:e.DEPTH_COMPONENT24,ct=m.stencil?Tr:yr,Rt=m.stencil?Er:Sr);let Ht={colorFormat:e.RGBA8,depthFormat:ft,scaleFactor:r};d=new XRWebGLBinding(s,e),h=d.createProjectionLayer(Ht),s.updateRenderState({layers:[h]}),t.setPixelRatio(1),t.setSize(h.textureWidth,h.textureHeight,!1),T=new ki(h.textureWidth,h.textureHeight,{format:xi,type:rs,depthTexture:new Ha(h.textureWidth,h.textureHeight,Rt,void 0,void 0,void 0,void 0,void 0,void 0,ct),stencilBuffer:m.stencil,colorSpace:t.outputColorSpace,samples:m.antialias?4:0,resolveDepthBuffer:h.ignoreDepthValues===!1})}T.isXRRenderTarget=!0,this.setFoveation(l),c=null,o=await s.requestReferenceSpace(a),kt.setContext(s),kt.start(),n.isPresenting=!0,n.dispatchEvent({type:"sessionstart"})}},this.getEnvironmentBlendMode=function(){if(s!==null)return s.environmentBlendMode};function J(Q){for(let ct=0;ct<Q.removed.length;ct++){let Rt=Q.removed[ct],ft=A.indexOf(Rt);ft>=0&&(A[ft]=null,b[ft].disconnect(Rt))}for(let ct=0;ct<Q.added.length;ct++){let Rt=Q.added[ct],ft=A.indexOf(Rt);if(ft===-1){for(let Bt=0;Bt<b.length;Bt++)if(Bt>=A.length){A.push(Rt),ft=Bt;break}else if(A[Bt]===null){A[Bt]=Rt,ft=Bt;break}if(ft===-1)break}let Ht=b[ft];Ht&&Ht.connect(Rt)}}let q=new V,st=new V;function nt(Q,ct,Rt){q.setFromMatrixPosition(ct.matrixWorld),st.setFromMatrixPosition(Rt.matrixWorld);let ft=q.distanceTo(st),Ht=ct.projectionMatrix.elements,Bt=Rt.projectionMatrix.elements,Nt=Ht[14]/(Ht[10]-1),O=Ht[14]/(Ht[10]+1),jt=(Ht[9]+1)/Ht[5],te=(Ht[9]-1)/Ht[5],fe=(Ht[8]-1)/Ht[0],Ut=(Bt[8]+1)/Bt[0],se=Nt*fe,Yt=Nt*Ut,zt=ft/(-fe+Ut),Se=zt*-fe;ct.matrixWorld.decompose(Q.position,Q.quaternion,Q.scale),Q.translateX(Se),Q.translateZ(zt),Q.matrixWorld.compose(Q.position,Q.quaternion,Q.scale),Q.matrixWorldInverse.copy(Q.matrixWorld).invert();let D=Nt+zt,w=O+zt,G=se-Se,tt=Yt+(ft-Se),rt=jt*O/w*D,et=te*O/w*D;Q.projectionMatrix.makePerspective(G,tt,rt,et,D,w),Q.projectionMatrixInverse.copy(Q.projectionMatrix).invert()}function gt(Q,ct){ct===null?Q.matrixWorld.copy(Q.matrix):Q.matrixWorld.multiplyMatrices(ct.matrixWorld,Q.matrix),Q.matrixWorldInverse.copy(Q.matrixWorld).invert()}this.updateCamera=function(Q){if(s===null)return;v.texture!==null&&(Q.near=v.depthNear,Q.far=v.depthFar),x.near=F.near=C.near=Q.near,x.far=F.far=C.far=Q.far,(R!==x.near||z!==x.far)&&(s.updateRenderState({depthNear:x.near,depthFar:x.far}),R=x.near,z=x.far,C.near=R,C.far=z,F.near=R,F.far=z,C.updateProjectionMatrix(),F.updateProjectionMatrix(),Q.updateProjectionMatrix());let ct=Q.parent,Rt=x.cameras;gt(x,ct);for(let ft=0;ft<Rt.length;ft++)gt(Rt[ft],ct);Rt.length===2?nt(x,C,F):x.projectionMatrix.copy(C.projectionMatrix),dt(Q,x,ct)};function dt(Q,ct,Rt){Rt===null?Q.matrix.copy(ct.matrixWorld):(Q.matrix.copy(Rt.matrixWorld),Q.matrix.invert(),Q.matrix.multiply(ct.matrixWorld)),Q.matrix.decompose(Q.position,Q.quaternion,Q.scale),Q.updateMatrixWorld(!0),Q.projectionMatrix.copy(ct.projectionMatrix),Q.projectionMatrixInverse.copy(ct.projectionMatrixInverse),Q.isPerspectiveCamera&&(Q.fov=Mo*2*Math.atan(1/Q.projectionMatrix.elements[5]),Q.zoom=1)}this.getCamera=function(){return x},this.getFoveation=function(){if(!(h===null&&p===null))return l},this.setFoveation=function(Q){l=Q,h!==null&&(h.fixedFoveation=Q),p!==null&&p.fixedFoveation!==void 0&&(p.fixedFoveation=Q)},this.hasDepthSensing=function(){return v.texture!==null},this.getDepthSensingMesh=function(){return v.getMesh(x)};let pt=null;function mt(Q,ct){if(u=ct.getViewerPose(c||o),g=ct,u!==null){let Rt=u.views;p!==null&&(t.setRenderTargetFramebuffer(T,p.framebuffer),t.setRenderTarget(T));let ft=!1;Rt.length!==x.cameras.length&&(x.cameras.length=0,ft=!0);for(let Bt=0;Bt<Rt.length;Bt++){let Nt=Rt[Bt],O=null;if(p!==null)O=p.getViewport(Nt);else{let te=d.getViewSubImage(h,Nt);O=te.viewport,Bt===0&&(t.setRenderTargetTextures(T,te.colorTexture,h.ignoreDepthValues?void 0:te.depthStencilTexture),t.setRenderTarget(T))}let jt=S[Bt];jt===void 0&&(jt=new An,jt.layers.enable(Bt),jt.viewport=new Ze,S[Bt]=jt),jt.matrix.fromArray(Nt.transform.matrix),jt.matrix.decompose(jt.position,jt.quaternion,jt.scale),jt.projectionMatrix.fromArray(Nt.projectionMatrix),jt.projectionMatrixInverse.copy(jt.projectionMatrix).invert(),jt.viewport.set(O.x,O.y,O.width,O.height),Bt===0&&(x.matrix.copy(jt.matrix),x.matrix.decompose(x.position,x.quaternion,x.scale)),ft===!0&&x.cameras.push(jt)}let Ht=s.enabledFeatures;if(Ht&&Ht.includes("depth-sensing")){let Bt=d.getDepthInformation(Rt[0]);Bt&&Bt.isValid&&Bt.texture&&v.init(t,Bt,s.renderState)}}for(let Rt=0;Rt<b.length;Rt++){let ft=A[Rt],Ht=b[Rt];ft!==null&&Ht!==void 0&&Ht.update(ft,ct,c||o)}pt&&pt(Q,ct),ct.detectedPlanes&&n.dispatchEvent({type:"planesdetected",data:ct}),g=null}let kt=new Uf;kt.setAnimationLoop(mt),this.setAnimationLoop=function(Q){pt=Q},this.dispose=function(){}}},Ms=new Kn,AM=new ve;function CM(i,t){function e(m,f){m.matrixAutoUpdate===!0&&m.updateMatrix(),f.value.copy(m.matrix)}function n(m,f){f.color.getRGB(m.fogColor.value,Nf(i)),f.isFog?(m.fogNear.value=f.near,m.fogFar.value=f.far):f.isFogExp2&&(m.fogDensity.value=f.density)}function s(m,f,T,b,A){f.isMeshBasicMaterial||f.isMeshLambertMaterial?r(m,f):f.isMeshToonMaterial?(r(m,f),d(m,f)):f.isMeshPhongMaterial?(r(m,f),u(m,f)):f.isMeshStandardMaterial?(r(m,f),h(m,f),f.isMeshPhysicalMaterial&&p(m,f,A)):f.isMeshMatcapMaterial?(r(m,f),g(m,f)):f.isMeshDepthMaterial?r(m,f):f.isMeshDistanceMaterial?(r(m,f),v(m,f)):f.isMeshNormalMaterial?r(m,f):f.isLineBasicMaterial?(o(m,f),f.isLineDashedMaterial&&a(m,f)):f.isPointsMaterial?l(m,f,T,b):f.isSpriteMaterial?c(m,f):f.isShadowMaterial?(m.color.value.copy(f.color),m.opacity.value=f.opacity):f.isShaderMaterial&&(f.uniformsNeedUpdate=!1)}function r(m,f){m.opacity.value=f.opacity,f.color&&m.diffuse.value.copy(f.color),f.emissive&&m.emissive.value.copy(f.emissive).multiplyScalar(f.emissiveIntensity),f.map&&(m.map.value=f.map,e(f.map,m.mapTransform)),f.alphaMap&&(m.alphaMap.value=f.alphaMap,e(f.alphaMap,m.alphaMapTransform)),f.bumpMap&&(m.bumpMap.value=f.bumpMap,e(f.bumpMap,m.bumpMapTransform),m.bumpScale.value=f.bumpScale,f.side===Un&&(m.bumpScale.value*=-1)),f.normalMap&&(m.normalMap.value=f.normalMap,e(f.normalMap,m.normalMapTransform),m.normalScale.value.copy(f.normalScale),f.side===Un&&m.normalScale.value.negate()),f.displacementMap&&(m.displacementMap.value=f.displacementMap,e(f.displacementMap,m.displacementMapTransform),m.displacementScale.value=f.displacementScale,m.displacementBias.value=f.displacementBias),f.emissiveMap&&(m.emissiveMap.value=f.emissiveMap,e(f.emissiveMap,m.emissiveMapTransform)),f.specularMap&&(m.specularMap.value=f.specularMap,e(f.specularMap,m.specularMapTransform)),f.alphaTest>0&&(m.alphaTest.value=f.alphaTest);let T=t.get(f),b=T.envMap,A=T.envMapRotation;b&&(m.envMap.value=b,Ms.copy(A),Ms.x*=-1,Ms.y*=-1,Ms.z*=-1,b.isCubeTexture&&b.isRenderTargetTexture===!1&&(Ms.y*=-1,Ms.z*=-1),m.envMapRotation.value.setFromMatrix4(AM.makeRotationFromEuler(Ms)),m.flipEnvMap.value=b.isCubeTexture&&b.isRenderTargetTexture===!1?-1:1,m.reflectivity.value=f.reflectivity,m.ior.value=f.ior,m.refractionRatio.value=f.refractionRatio),f.lightMap&&(m.lightMap.value=f.lightMap,m.lightMapIntensity.value=f.lightMapIntensity,e(f.lightMap,m.lightMapTransform)),f.aoMap&&(m.aoMap.value=f.aoMap,m.aoMapIntensity.value=f.aoMapIntensity,e(f.aoMap,m.aoMapTransform))}function o(m,f){m.diffuse.value.copy(f.color),m.opacity.value=f.opacity,f.map&&(m.map.value=f.map,e(f.map,m.mapTransform))}function a(m,f){m.dashSize.value=f.dashSize,m.totalSize.value=f.dashSize+f.gapSize,m.scale.value=f.scale}function l(m,f,T,b){m.diffuse.value.copy(f.color),m.opacity.value=f.opacity,m.size.value=f.size*T,m.scale.value=b*.5,f.map&&(m.map.value=f.map,e(f.map,m.uvTransform)),f.alphaMap&&(m.alphaMap.value=f.alphaMap,e(f.alphaMap,m.alphaMapTransform)),f.alphaTest>0&&(m.alphaTest.value=f.alphaTest)}function c(m,f){m.diffuse.value.copy(f.color),m.opacity.value=f.opacity,m.rotation.value=f.rotation,f.map&&(m.map.value=f.map,e(f.map,m.mapTransform)),f.alphaMap&&(m.alphaMap.value=f.alphaMap,e(f.alphaMap,m.alphaMapTransform)),f.alphaTest>0&&(m.alphaTest.value=f.alphaTest)}function u(m,f){m.specular.value.copy(f.specular),m.shininess.value=Math.max(f.shininess,1e-4)}function d(m,f){f.gradientMap&&(m.gradientMap.value=f.gradientMap)}function h(m,f){m.metalness.value=f.metalness,f.metalnessMap&&(m.metalnessMap.value=f.metalnessMap,e(f.metalnessMap,m.metalnessMapTransform)),m.roughness.value=f.roughness,f.roughnessMap&&(m.roughnessMap.value=f.roughnessMap,e(f.roughnessMap,m.roughnessMapTransform)),f.envMap&&(m.envMapIntensity.value=f.envMapIntensity)}function p(m,f,T){m.ior.value=f.ior,f.sheen>0&&(m.sheenColor.value.copy(f.sheenColor).multiplyScalar(f.sheen),m.sheenRoughness.value=f.sheenRoughness,f.sheenColorMap&&(m.sheenColorMap.value=f.sheenColorMap,e(f.sheenColorMap,m.sheenColorMapTransform)),f.sheenRoughnessMap&&(m.sheenRoughnessMap.value=f.sheenRoughnessMap,e(f.sheenRoughnessMap,m.sheenRoughnessMapTransform))),f.clearcoat>0&&(m.clearcoat.value=f.clearcoat,m.clearcoatRoughness.value=f.clearcoatRoughness,f.clearcoatMap&&(m.clearcoatMap.value=f.clearcoatMap,e(f.clearcoatMap,m.clearcoatMapTransform)),f.clearcoatRoughnessMap&&(m.clearcoatRoughnessMap.value=f.clearcoatRoughnessMap,e(f.clearcoatRoughnessMap,m.clearcoatRoughnessMapTransform)),f.clearcoatNormalMap&&(m.clearcoatNormalMap.value=f.clearcoatNormalMap,e(f.clearcoatNormalMap,m.clearcoatNormalMapTransform),m.clearcoatNormalScale.value.copy(f.clearcoatNormalScale),f.side===Un&&m.clearcoatNormalScale.value.negate())),f.dispersion>0&&(m.dispersion.value=f.dispersion),f.iridescence>0&&(m.iridescence.value=f.iridescence,m.iridescenceIOR.value=f.iridescenceIOR,m.iridescenceThicknessMinimum.value=f.iridescenceThicknessRange[0],m.iridescenceThicknessMaximum.value=f.iridescenceThicknessRange[1],f.iridescenceMap&&(m.iridescenceMap.value=f.iridescenceMap,e(f.iridescenceMap,m.iridescenceMapTransform)),f.iridescenceThicknessMap&&(m.iridescenceThicknessMap.value=f.iridescenceThicknessMap,e(f.iridescenceThicknessMap,m.iridescenceThicknessMapTransform))),f.transmission>0&&(m.transmission.value=f.transmission,m.transmissionSamplerMap.value=T.texture,m.transmissionSamplerSize.value.set(T.width,T.height),f.transmissionMap&&(m.transmissionMap.value=f.transmissionMap,e(f.transmissionMap,m.transmissionMapTransform)),m.thickness.value=f.thickness,f.thicknessMap&&(m.thicknessMap.value=f.thicknessMap,e(f.thicknessMap,m.thicknessMapTransform)),m.attenuationDistance.value=f.attenuationDistance,m.attenuationColor.value.copy(f.attenuationColor)),f.anisotropy>0&&(m.anisotropyVector.value.set(f.anisotropy*Math.cos(f.anisotropyRotation),f.anisotropy*Math.sin(f.anisotropyRotation)),f.anisotropyMap&&(m.anisotropyMap.value=f.anisotropyMap,e(f.anisotropyMap,m.anisotropyMapTransform))),m.specularIntensity.value=f.specularIntensity,m.specularColor.value.copy(f.specularColor),f.specularColorMap&&(m.specularColorMap.value=f.specularColorMap,e(f.specularColorMap,m.specularColorMapTransform)),f.specularIntensityMap&&(m.specularIntensityMap.value=f.specularIntensityMap,e(f.specularIntensityMap,m.specularIntensityMapTransform))}function g(m,f){f.matcap&&(m.matcap.value=f.matcap)}function v(m,f){let T=t.get(f).light;m.referencePosition.value.setFromMatrixPosition(T.matrixWorld),m.nearDistance.value=T.shadow.camera.near,m.farDistance.value=T.shadow.camera.far}return{refreshFogUniforms:n,refreshMaterialUniforms:s}}function RM(i,t,e,n){let s={},r={},o=[],a=i.getParameter(i.MAX_UNIFORM_BUFFER_BINDINGS);function l(T,b){let A=b.program;n.uniformBlockBinding(T,A)}function c(T,b){let A=s[T.id];A===void 0&&(g(T),A=u(T),s[T.id]=A,T.addEventListener("dispose",m));let N=b.program;n.updateUBOMapping(T,N);let L=t.render.frame;r[T.id]!==L&&(h(T),r[T.id]=L)}function u(T){let b=d();T.__bindingPointIndex=b;let A=i.createBuffer(),N=T.__size,L=T.usage;return i.bindBuffer(i.UNIFORM_BUFFER,A),i.bufferData(i.UNIFORM_BUFFER,N,L),i.bindBuffer(i.UNIFORM_BUFFER,null),i.bindBufferBase(i.UNIFORM_BUFFER,b,A),A}function d(){for(let T=0;T<a;T++)if(o.indexOf(T)===-1)return o.push(T),T;return console.error("THREE.WebGLRenderer: Maximum number of simultaneously usable uniforms groups reached."),0}function h(T){let b=s[T.id],A=T.uniforms,N=T.__cache;i.bindBuffer(i.UNIFORM_BUFFER,b);for(let L=0,C=A.length;L<C;L++){let F=Array.isArray(A[L])?A[L]:[A[L]];for(let S=0,x=F.length;S<x;S++){let R=F[S];if(p(R,L,S,N)===!0){let z=R.__offset,B=Array.isArray(R.value)?R.value:[R.value],X=0;for(let J=0;J<B.length;J++){let q=B[J],st=v(q);typeof q=="number"||typeof q=="boolean"?(R.__data[0]=q,i.bufferSubData(i.UNIFORM_BUFFER,z+X,R.__data)):q.isMatrix3?(R.__data[0]=q.elements[0],R.__data[1]=q.elements[1],R.__data[2]=q.elements[2],R.__data[3]=0,R.__data[4]=q.elements[3],R.__data[5]=q.elements[4],R.__data[6]=q.elements[5],R.__data[7]=0,R.__data[8]=q.elements[6],R.__data[9]=q.elements[7],R.__data[10]=q.elements[8],R.__data[11]=0):(q.toArray(R.__data,X),X+=st.storage/Float32Array.BYTES_PER_ELEMENT)}i.bufferSubData(i.UNIFORM_BUFFER,z,R.__data)}}}i.bindBuffer(i.UNIFORM_BUFFER,null)}function p(T,b,A,N){let L=T.value,C=b+"_"+A;if(N[C]===void 0)return typeof L=="number"||typeof L=="boolean"?N[C]=L:N[C]=L.clone(),!0;{let F=N[C];if(typeof L=="number"||typeof L=="boolean"){if(F!==L)return N[C]=L,!0}else if(F.equals(L)===!1)return F.copy(L),!0}return!1}function g(T){let b=T.uniforms,A=0,N=16;for(let C=0,F=b.length;C<F;C++){let S=Array.isArray(b[C])?b[C]:[b[C]];for(let x=0,R=S.length;x<R;x++){let z=S[x],B=Array.isArray(z.value)?z.value:[z.value];for(let X=0,J=B.length;X<J;X++){let q=B[X],st=v(q),nt=A%N;nt!==0&&N-nt<st.boundary&&(A+=N-nt),z.__data=new Float32Array(st.storage/Float32Array.BYTES_PER_ELEMENT),z.__offset=A,A+=st.storage}}}let L=A%N;return L>0&&(A+=N-L),T.__size=A,T.__cache={},this}function v(T){let b={boundary:0,storage:0};return typeof T=="number"||typeof T=="boolean"?(b.boundary=4,b.storage=4):T.isVector2?(b.boundary=8,b.storage=8):T.isVector3||T.isColor?(b.boundary=16,b.storage=12):T.isVector4?(b.boundary=16,b.storage=16):T.isMatrix3?(b.boundary=48,b.storage=48):T.isMatrix4?(b.boundary=64,b.storage=64):T.isTexture?console.warn("THREE.WebGLRenderer: Texture samplers can not be part of an uniforms group."):console.warn("THREE.WebGLRenderer: Unsupported uniform value type.",T),b}function m(T){let b=T.target;b.removeEventListener("dispose",m);let A=o.indexOf(b.__bindingPointIndex);o.splice(A,1),i.deleteBuffer(s[b.id]),delete s[b.id],delete r[b.id]}function f(){for(let T in s)i.deleteBuffer(s[T]);o=[],s={},r={}}return{bind:l,update:c,dispose:f}}var Ga=class{constructor(t={}){let{canvas:e=F0(),context:n=null,depth:s=!0,stencil:r=!1,alpha:o=!1,antialias:a=!1,premultipliedAlpha:l=!0,preserveDrawingBuffer:c=!1,powerPreference:u="default",failIfMajorPerformanceCaveat:d=!1}=t;this.isWebGLRenderer=!0;let h;if(n!==null){if(typeof WebGLRenderingContext<"u"&&n instanceof WebGLRenderingContext)throw new Error("THREE.WebGLRenderer: WebGL 1 is not supported since r163.");h=n.getContextAttributes().alpha}else h=o;let p=new Uint32Array(4),g=new Int32Array(4),v=null,m=null,f=[],T=[];this.domElement=e,this.debug={checkShaderErrors:!0,onShaderError:null},this.autoClear=!0,this.autoClearColor=!0,this.autoClearDepth=!0,this.autoClearStencil=!0,this.sortObjects=!0,this.clippingPlanes=[],this.localClippingEnabled=!1,this._outputColorSpace=vi,this.toneMapping=is,this.toneMappingExposure=1;let b=this,A=!1,N=0,L=0,C=null,F=-1,S=null,x=new Ze,R=new Ze,z=null,B=new ce(0),X=0,J=e.width,q=e.height,st=1,nt=null,gt=null,dt=new Ze(0,0,J,q),pt=new Ze(0,0,J,q),mt=!1,kt=new bo,Q=!1,ct=!1,Rt=new ve,ft=new V,Ht={background:null,fog:null,environment:null,overrideMaterial:null,isScene:!0},Bt=!1;function Nt(){return C===null?st:1}let O=n;function jt(E,W){return e.getContext(E,W)}try{let E={alpha:!0,depth:s,stencil:r,antialias:a,premultipliedAlpha:l,preserveDrawingBuffer:c,powerPreference:u,failIfMajorPerformanceCaveat:d};if("setAttribute"in e&&e.setAttribute("data-engine",`three.js r${uh}`),e.addEventListener("webglcontextlost",j,!1),e.addEventListener("webglcontextrestored",Y,!1),e.addEventListener("webglcontextcreationerror",it,!1),O===null){let W="webgl2";if(O=jt(W,E),O===null)throw jt(W)?new Error("Error creating WebGL context with your selected attributes."):new Error("Error creating WebGL context.")}}catch(E){throw console.error("THREE.WebGLRenderer: "+E.message),E}let te,fe,Ut,se,Yt,zt,Se,D,w,G,tt,rt,et,At,vt,yt,Wt,lt,Et,Gt,It,xt,Xt,Zt;function xe(){te=new Yy(O),te.init(),xt=new wM(O,te),fe=new Hy(O,te,t,xt),Ut=new MM(O),se=new Ky(O),Yt=new cM,zt=new bM(O,te,Ut,Yt,fe,xt,se),Se=new Wy(b),D=new qy(b),w=new s_(O),Xt=new zy(O,w),G=new Zy(O,w,se,Xt),tt=new Qy(O,G,w,se),Et=new jy(O,fe,zt),yt=new Gy(Yt),rt=new lM(b,Se,D,te,fe,Xt,yt),et=new CM(b,Yt),At=new uM,vt=new _M(te),lt=new By(b,Se,D,Ut,tt,h,l),Wt=new xM(b,tt,fe),Zt=new RM(O,se,fe,Ut),Gt=new Vy(O,te,se),It=new Jy(O,te,se),se.programs=rt.programs,b.capabilities=fe,b.extensions=te,b.properties=Yt,b.renderLists=At,b.shadowMap=Wt,b.state=Ut,b.info=se}xe();let y=new Jc(b,O);this.xr=y,this.getContext=function(){return O},this.getContextAttributes=function(){return O.getContextAttributes()},this.forceContextLoss=function(){let E=te.get("WEBGL_lose_context");E&&E.loseContext()},this.forceContextRestore=function(){let E=te.get("WEBGL_lose_context");E&&E.restoreContext()},this.getPixelRatio=function(){return st},this.setPixelRatio=function(E){E!==void 0&&(st=E,this.setSize(J,q,!1))},this.getSize=function(E){return E.set(J,q)},this.setSize=function(E,W,Z=!0){if(y.isPresenting){console.warn("THREE.WebGLRenderer: Can't change size while VR device is presenting.");return}J=E,q=W,e.width=Math.floor(E*st),e.height=Math.floor(W*st),Z===!0&&(e.style.width=E+"px",e.style.height=W+"px"),this.setViewport(0,0,E,W)},this.getDrawingBufferSize=function(E){return E.set(J*st,q*st).floor()},this.setDrawingBufferSize=function(E,W,Z){J=E,q=W,st=Z,e.width=Math.floor(E*Z),e.height=Math.floor(W*Z),this.setViewport(0,0,E,W)},this.getCurrentViewport=function(E){return E.copy(x)},this.getViewport=function(E){return E.copy(dt)},this.setViewport=function(E,W,Z,$){E.isVector4?dt.set(E.x,E.y,E.z,E.w):dt.set(E,W,Z,$),Ut.viewport(x.copy(dt).multiplyScalar(st).round())},this.getScissor=function(E){return E.copy(pt)},this.setScissor=function(E,W,Z,$){E.isVector4?pt.set(E.x,E.y,E.z,E.w):pt.set(E,W,Z,$),Ut.scissor(R.copy(pt).multiplyScalar(st).round())},this.getScissorTest=function(){return mt},this.setScissorTest=function(E){Ut.setScissorTest(mt=E)},this.setOpaqueSort=function(E){nt=E},this.setTransparentSort=function(E){gt=E},this.getClearColor=function(E){return E.copy(lt.getClearColor())},this.setClearColor=function(){lt.setClearColor.apply(lt,arguments)},this.getClearAlpha=function(){return lt.getClearAlpha()},this.setClearAlpha=function(){lt.setClearAlpha.apply(lt,arguments)},this.clear=function(E=!0,W=!0,Z=!0){let $=0;if(E){let H=!1;if(C!==null){let at=C.texture.format;H=at===Af||at===Tf||at===Ef}if(H){let at=C.texture.type,St=at===rs||at===Sr||at===Ta||at===Er||at===bf||at===wf,wt=lt.getClearColor(),Lt=lt.getClearAlpha(),$t=wt.r,qt=wt.g,Vt=wt.b;St?(p[0]=$t,p[1]=qt,p[2]=Vt,p[3]=Lt,O.clearBufferuiv(O.COLOR,0,p)):(g[0]=$t,g[1]=qt,g[2]=Vt,g[3]=Lt,O.clearBufferiv(O.COLOR,0,g))}else $|=O.COLOR_BUFFER_BIT}W&&($|=O.DEPTH_BUFFER_BIT),Z&&($|=O.STENCIL_BUFFER_BIT,this.state.buffers.stencil.setMask(4294967295)),O.clear($)},this.clearColor=function(){this.clear(!0,!1,!1)},this.clearDepth=function(){this.clear(!1,!0,!1)},this.clearStencil=function(){this.clear(!1,!1,!0)},this.dispose=function(){e.removeEventListener("webglcontextlost",j,!1),e.removeEventListener("webglcontextrestored",Y,!1),e.removeEventListener("webglcontextcreationerror",it,!1),At.dispose(),vt.dispose(),Yt.dispose(),Se.dispose(),D.dispose(),tt.dispose(),Xt.dispose(),Zt.dispose(),rt.dispose(),y.dispose(),y.removeEventListener("sessionstart",Ee),y.removeEventListener("sessionend",oe),ze.stop()};function j(E){E.preventDefault(),console.log("THREE.WebGLRenderer: Context Lost."),A=!0}function Y(){console.log("THREE.WebGLRenderer: Context Restored."),A=!1;let E=se.autoReset,W=Wt.enabled,Z=Wt.autoUpdate,$=Wt.needsUpdate,H=Wt.type;xe(),se.autoReset=E,Wt.enabled=W,Wt.autoUpdate=Z,Wt.needsUpdate=$,Wt.type=H}function it(E){console.error("THREE.WebGLRenderer: A WebGL context could not be created. Reason: ",E.statusMessage)}function ht(E){let W=E.target;W.removeEventListener("dispose",ht),Ft(W)}function Ft(E){Kt(E),Yt.remove(E)}function Kt(E){let W=Yt.get(E).programs;W!==void 0&&(W.forEach(function(Z){rt.releaseProgram(Z)}),E.isShaderMaterial&&rt.releaseShaderCache(E))}this.renderBufferDirect=function(E,W,Z,$,H,at){W===null&&(W=Ht);let St=H.isMesh&&H.matrixWorld.determinant()<0,wt=Dl(E,W,Z,$,H);Ut.setMaterial($,St);let Lt=Z.index,$t=1;if($.wireframe===!0){if(Lt=G.getWireframeAttribute(Z),Lt===void 0)return;$t=2}let qt=Z.drawRange,Vt=Z.attributes.position,ae=qt.start*$t,Re=(qt.start+qt.count)*$t;at!==null&&(ae=Math.max(ae,at.start*$t),Re=Math.min(Re,(at.start+at.count)*$t)),Lt!==null?(ae=Math.max(ae,0),Re=Math.min(Re,Lt.count)):Vt!=null&&(ae=Math.max(ae,0),Re=Math.min(Re,Vt.count));let Pe=Re-ae;if(Pe<0||Pe===1/0)return;Xt.setup(H,$,wt,Z,Lt);let fn,pe=Gt;if(Lt!==null&&(fn=w.get(Lt),pe=It,pe.setIndex(fn)),H.isMesh)$.wireframe===!0?(Ut.setLineWidth($.wireframeLinewidth*Nt()),pe.setMode(O.LINES)):pe.setMode(O.TRIANGLES);else if(H.isLine){let Ot=$.linewidth;Ot===void 0&&(Ot=1),Ut.setLineWidth(Ot*Nt()),H.isLineSegments?pe.setMode(O.LINES):H.isLineLoop?pe.setMode(O.LINE_LOOP):pe.setMode(O.LINE_STRIP)}else H.isPoints?pe.setMode(O.POINTS):H.isSprite&&pe.setMode(O.TRIANGLES);if(H.isBatchedMesh)H._multiDrawInstances!==null?pe.renderMultiDrawInstances(H._multiDrawStarts,H._multiDrawCounts,H._multiDrawCount,H._multiDrawInstances):pe.renderMultiDraw(H._multiDrawStarts,H._multiDrawCounts,H._multiDrawCount);else if(H.isInstancedMesh)pe.renderInstances(ae,Pe,H.count);else if(Z.isInstancedBufferGeometry){let Ot=Z._maxInstanceCount!==void 0?Z._maxInstanceCount:1/0,Qe=Math.min(Z.instanceCount,Ot);pe.renderInstances(ae,Pe,Qe)}else pe.render(ae,Pe)};function Fe(E,W,Z){E.transparent===!0&&E.side===Ui&&E.forceSinglePass===!1?(E.side=Un,E.needsUpdate=!0,us(E,W,Z),E.side=ss,E.needsUpdate=!0,us(E,W,Z),E.side=Ui):us(E,W,Z)}this.compile=function(E,W,Z=null){Z===null&&(Z=E),m=vt.get(Z),m.init(W),T.push(m),Z.traverseVisible(function(H){H.isLight&&H.layers.test(W.layers)&&(m.pushLight(H),H.castShadow&&m.pushShadow(H))}),E!==Z&&E.traverseVisible(function(H){H.isLight&&H.layers.test(W.layers)&&(m.pushLight(H),H.castShadow&&m.pushShadow(H))}),m.setupLights();let $=new Set;return E.traverse(function(H){let at=H.material;if(at)if(Array.isArray(at))for(let St=0;St<at.length;St++){let wt=at[St];Fe(wt,Z,H),$.add(wt)}else Fe(at,Z,H),$.add(at)}),T.pop(),m=null,$},this.compileAsync=function(E,W,Z=null){let $=this.compile(E,W,Z);return new Promise(H=>{function at(){if($.forEach(function(St){Yt.get(St).currentProgram.isReady()&&$.delete(St)}),$.size===0){H(E);return}setTimeout(at,10)}te.get("KHR_parallel_shader_compile")!==null?at():setTimeout(at,10)})};let Be=null;function Mt(E){Be&&Be(E)}function Ee(){ze.stop()}function oe(){ze.start()}let ze=new Uf;ze.setAnimationLoop(Mt),typeof self<"u"&&ze.setContext(self),this.setAnimationLoop=function(E){Be=E,y.setAnimationLoop(E),E===null?ze.stop():ze.start()},y.addEventListener("sessionstart",Ee),y.addEventListener("sessionend",oe),this.render=function(E,W){if(W!==void 0&&W.isCamera!==!0){console.error("THREE.WebGLRenderer.render: camera is not an instance of THREE.Camera.");return}if(A===!0)return;if(E.matrixWorldAutoUpdate===!0&&E.updateMatrixWorld(),W.parent===null&&W.matrixWorldAutoUpdate===!0&&W.updateMatrixWorld(),y.enabled===!0&&y.isPresenting===!0&&(y.cameraAutoUpdate===!0&&y.updateCamera(W),W=y.getCamera()),E.isScene===!0&&E.onBeforeRender(b,E,W,C),m=vt.get(E,T.length),m.init(W),T.push(m),Rt.multiplyMatrices(W.projectionMatrix,W.matrixWorldInverse),kt.setFromProjectionMatrix(Rt),ct=this.localClippingEnabled,Q=yt.init(this.clippingPlanes,ct),v=At.get(E,f.length),v.init(),f.push(v),y.enabled===!0&&y.isPresenting===!0){let at=b.xr.getDepthSensingMesh();at!==null&&We(at,W,-1/0,b.sortObjects)}We(E,W,0,b.sortObjects),v.finish(),b.sortObjects===!0&&v.sort(nt,gt),Bt=y.enabled===!1||y.isPresenting===!1||y.hasDepthSensing()===!1,Bt&&lt.addToRenderList(v,E),this.info.render.frame++,Q===!0&&yt.beginShadows();let Z=m.state.shadowsArray;Wt.render(Z,E,W),Q===!0&&yt.endShadows(),this.info.autoReset===!0&&this.info.reset();let $=v.opaque,H=v.transmissive;if(m.setupLights(),W.isArrayCamera){let at=W.cameras;if(H.length>0)for(let St=0,wt=at.length;St<wt;St++){let Lt=at[St];Xe($,H,E,Lt)}Bt&&lt.render(E);for(let St=0,wt=at.length;St<wt;St++){let Lt=at[St];xn(v,E,Lt,Lt.viewport)}}else H.length>0&&Xe($,H,E,W),Bt&&lt.render(E),xn(v,E,W);C!==null&&(zt.updateMultisampleRenderTarget(C),zt.updateRenderTargetMipmap(C)),E.isScene===!0&&E.onAfterRender(b,E,W),Xt.resetDefaultState(),F=-1,S=null,T.pop(),T.length>0?(m=T[T.length-1],Q===!0&&yt.setGlobalState(b.clippingPlanes,m.state.camera)):m=null,f.pop(),f.length>0?v=f[f.length-1]:v=null};function We(E,W,Z,$){if(E.visible===!1)return;if(E.layers.test(W.layers)){if(E.isGroup)Z=E.renderOrder;else if(E.isLOD)E.autoUpdate===!0&&E.update(W);else if(E.isLight)m.pushLight(E),E.castShadow&&m.pushShadow(E);else if(E.isSprite){if(!E.frustumCulled||kt.intersectsSprite(E)){$&&ft.setFromMatrixPosition(E.matrixWorld).applyMatrix4(Rt);let St=tt.update(E),wt=E.material;wt.visible&&v.push(E,St,wt,Z,ft.z,null)}}else if((E.isMesh||E.isLine||E.isPoints)&&(!E.frustumCulled||kt.intersectsObject(E))){let St=tt.update(E),wt=E.material;if($&&(E.boundingSphere!==void 0?(E.boundingSphere===null&&E.computeBoundingSphere(),ft.copy(E.boundingSphere.center)):(St.boundingSphere===null&&St.computeBoundingSphere(),ft.copy(St.boundingSphere.center)),ft.applyMatrix4(E.matrixWorld).applyMatrix4(Rt)),Array.isArray(wt)){let Lt=St.groups;for(let $t=0,qt=Lt.length;$t<qt;$t++){let Vt=Lt[$t],ae=wt[Vt.materialIndex];ae&&ae.visible&&v.push(E,St,ae,Z,ft.z,Vt)}}else wt.visible&&v.push(E,St,wt,Z,ft.z,null)}}let at=E.children;for(let St=0,wt=at.length;St<wt;St++)We(at[St],W,Z,$)}function xn(E,W,Z,$){let H=E.opaque,at=E.transmissive,St=E.transparent;m.setupLightsView(Z),Q===!0&&yt.setGlobalState(b.clippingPlanes,Z),$&&Ut.viewport(x.copy($)),H.length>0&&Rn(H,W,Z),at.length>0&&Rn(at,W,Z),St.length>0&&Rn(St,W,Z),Ut.buffers.depth.setTest(!0),Ut.buffers.depth.setMask(!0),Ut.buffers.color.setMask(!0),Ut.setPolygonOffset(!1)}function Xe(E,W,Z,$){if((Z.isScene===!0?Z.overrideMaterial:null)!==null)return;m.state.transmissionRenderTarget[$.id]===void 0&&(m.state.transmissionRenderTarget[$.id]=new ki(1,1,{generateMipmaps:!0,type:te.has("EXT_color_buffer_half_float")||te.has("EXT_color_buffer_float")?el:rs,minFilter:Ts,samples:4,stencilBuffer:r,resolveDepthBuffer:!1,resolveStencilBuffer:!1,colorSpace:we.workingColorSpace}));let at=m.state.transmissionRenderTarget[$.id],St=$.viewport||x;at.setSize(St.z,St.w);let wt=b.getRenderTarget();b.setRenderTarget(at),b.getClearColor(B),X=b.getClearAlpha(),X<1&&b.setClearColor(16777215,.5),Bt?lt.render(Z):b.clear();let Lt=b.toneMapping;b.toneMapping=is;let $t=$.viewport;if($.viewport!==void 0&&($.viewport=void 0),m.setupLightsView($),Q===!0&&yt.setGlobalState(b.clippingPlanes,$),Rn(E,Z,$),zt.updateMultisampleRenderTarget(at),zt.updateRenderTargetMipmap(at),te.has("WEBGL_multisampled_render_to_texture")===!1){let qt=!1;for(let Vt=0,ae=W.length;Vt<ae;Vt++){let Re=W[Vt],Pe=Re.object,fn=Re.geometry,pe=Re.material,Ot=Re.group;if(pe.side===Ui&&Pe.layers.test($.layers)){let Qe=pe.side;pe.side=Un,pe.needsUpdate=!0,Ei(Pe,Z,$,fn,pe,Ot),pe.side=Qe,pe.needsUpdate=!0,qt=!0}}qt===!0&&(zt.updateMultisampleRenderTarget(at),zt.updateRenderTargetMipmap(at))}b.setRenderTarget(wt),b.setClearColor(B,X),$t!==void 0&&($.viewport=$t),b.toneMapping=Lt}function Rn(E,W,Z){let $=W.isScene===!0?W.overrideMaterial:null;for(let H=0,at=E.length;H<at;H++){let St=E[H],wt=St.object,Lt=St.geometry,$t=$===null?St.material:$,qt=St.group;wt.layers.test(Z.layers)&&Ei(wt,W,Z,Lt,$t,qt)}}function Ei(E,W,Z,$,H,at){E.onBeforeRender(b,W,Z,$,H,at),E.modelViewMatrix.multiplyMatrices(Z.matrixWorldInverse,E.matrixWorld),E.normalMatrix.getNormalMatrix(E.modelViewMatrix),H.onBeforeRender(b,W,Z,$,E,at),H.transparent===!0&&H.side===Ui&&H.forceSinglePass===!1?(H.side=Un,H.needsUpdate=!0,b.renderBufferDirect(Z,W,$,H,E,at),H.side=ss,H.needsUpdate=!0,b.renderBufferDirect(Z,W,$,H,E,at),H.side=Ui):b.renderBufferDirect(Z,W,$,H,E,at),E.onAfterRender(b,W,Z,$,H,at)}function us(E,W,Z){W.isScene!==!0&&(W=Ht);let $=Yt.get(E),H=m.state.lights,at=m.state.shadowsArray,St=H.state.version,wt=rt.getParameters(E,H.state,at,W,Z),Lt=rt.getProgramCacheKey(wt),$t=$.programs;$.environment=E.isMeshStandardMaterial?W.environment:null,$.fog=W.fog,$.envMap=(E.isMeshStandardMaterial?D:Se).get(E.envMap||$.environment),$.envMapRotation=$.environment!==null&&E.envMap===null?W.environmentRotation:E.envMapRotation,$t===void 0&&(E.addEventListener("dispose",ht),$t=new Map,$.programs=$t);let qt=$t.get(Lt);if(qt!==void 0){if($.currentProgram===qt&&$.lightsStateVersion===St)return Fo(E,wt),qt}else wt.uniforms=rt.getUniforms(E),E.onBuild(Z,wt,b),E.onBeforeCompile(wt,b),qt=rt.acquireProgram(wt,Lt),$t.set(Lt,qt),$.uniforms=wt.uniforms;let Vt=$.uniforms;return(!E.isShaderMaterial&&!E.isRawShaderMaterial||E.clipping===!0)&&(Vt.clippingPlanes=yt.uniform),Fo(E,wt),$.needsLights=Nl(E),$.lightsStateVersion=St,$.needsLights&&(Vt.ambientLightColor.value=H.state.ambient,Vt.lightProbe.value=H.state.probe,Vt.directionalLights.value=H.state.directional,Vt.directionalLightShadows.value=H.state.directionalShadow,Vt.spotLights.value=H.state.spot,Vt.spotLightShadows.value=H.state.spotShadow,Vt.rectAreaLights.value=H.state.rectArea,Vt.ltc_1.value=H.state.rectAreaLTC1,Vt.ltc_2.value=H.state.rectAreaLTC2,Vt.pointLights.value=H.state.point,Vt.pointLightShadows.value=H.state.pointShadow,Vt.hemisphereLights.value=H.state.hemi,Vt.directionalShadowMap.value=H.state.directionalShadowMap,Vt.directionalShadowMatrix.value=H.state.directionalShadowMatrix,Vt.spotShadowMap.value=H.state.spotShadowMap,Vt.spotLightMatrix.value=H.state.spotLightMatrix,Vt.spotLightMap.value=H.state.spotLightMap,Vt.pointShadowMap.value=H.state.pointShadowMap,Vt.pointShadowMatrix.value=H.state.pointShadowMatrix),$.currentProgram=qt,$.uniformsList=null,qt}function no(E){if(E.uniformsList===null){let W=E.currentProgram.getUniforms();E.uniformsList=Mr.seqWithValue(W.seq,E.uniforms)}return E.uniformsList}function Fo(E,W){let Z=Yt.get(E);Z.outputColorSpace=W.outputColorSpace,Z.batching=W.batching,Z.batchingColor=W.batchingColor,Z.instancing=W.instancing,Z.instancingColor=W.instancingColor,Z.instancingMorph=W.instancingMorph,Z.skinning=W.skinning,Z.morphTargets=W.morphTargets,Z.morphNormals=W.morphNormals,Z.morphColors=W.morphColors,Z.morphTargetsCount=W.morphTargetsCount,Z.numClippingPlanes=W.numClippingPlanes,Z.numIntersection=W.numClipIntersection,Z.vertexAlphas=W.vertexAlphas,Z.vertexTangents=W.vertexTangents,Z.toneMapping=W.toneMapping}function Dl(E,W,Z,$,H){W.isScene!==!0&&(W=Ht),zt.resetTextureUnits();let at=W.fog,St=$.isMeshStandardMaterial?W.environment:null,wt=C===null?b.outputColorSpace:C.isXRRenderTarget===!0?C.texture.colorSpace:ls,Lt=($.isMeshStandardMaterial?D:Se).get($.envMap||St),$t=$.vertexColors===!0&&!!Z.attributes.color&&Z.attributes.color.itemSize===4,qt=!!Z.attributes.tangent&&(!!$.normalMap||$.anisotropy>0),Vt=!!Z.morphAttributes.position,ae=!!Z.morphAttributes.normal,Re=!!Z.morphAttributes.color,Pe=is;$.toneMapped&&(C===null||C.isXRRenderTarget===!0)&&(Pe=b.toneMapping);let fn=Z.morphAttributes.position||Z.morphAttributes.normal||Z.morphAttributes.color,pe=fn!==void 0?fn.length:0,Ot=Yt.get($),Qe=m.state.lights;if(Q===!0&&(ct===!0||E!==S)){let Pn=E===S&&$.id===F;yt.setState($,E,Pn)}let ge=!1;$.version===Ot.__version?(Ot.needsLights&&Ot.lightsStateVersion!==Qe.state.version||Ot.outputColorSpace!==wt||H.isBatchedMesh&&Ot.batching===!1||!H.isBatchedMesh&&Ot.batching===!0||H.isBatchedMesh&&Ot.batchingColor===!0&&H.colorTexture===null||H.isBatchedMesh&&Ot.batchingColor===!1&&H.colorTexture!==null||H.isInstancedMesh&&Ot.instancing===!1||!H.isInstancedMesh&&Ot.instancing===!0||H.isSkinnedMesh&&Ot.skinning===!1||!H.isSkinnedMesh&&Ot.skinning===!0||H.isInstancedMesh&&Ot.instancingColor===!0&&H.instanceColor===null||H.isInstancedMesh&&Ot.instancingColor===!1&&H.instanceColor!==null||H.isInstancedMesh&&Ot.instancingMorph===!0&&H.morphTexture===null||H.isInstancedMesh&&Ot.instancingMorph===!1&&H.morphTexture!==null||Ot.envMap!==Lt||$.fog===!0&&Ot.fog!==at||Ot.numClippingPlanes!==void 0&&(Ot.numClippingPlanes!==yt.numPlanes||Ot.numIntersection!==yt.numIntersection)||Ot.vertexAlphas!==$t||Ot.vertexTangents!==qt||Ot.morphTargets!==Vt||Ot.morphNormals!==ae||Ot.morphColors!==Re||Ot.toneMapping!==Pe||Ot.morphTargetsCount!==pe)&&(ge=!0):(ge=!0,Ot.__version=$.version);let tn=Ot.currentProgram;ge===!0&&(tn=us($,W,H));let ds=!1,di=!1,fs=!1,He=tn.getUniforms(),fi=Ot.uniforms;if(Ut.useProgram(tn.program)&&(ds=!0,di=!0,fs=!0),$.id!==F&&(F=$.id,di=!0),ds||S!==E){He.setValue(O,"projectionMatrix",E.projectionMatrix),He.setValue(O,"viewMatrix",E.matrixWorldInverse);let Pn=He.map.cameraPosition;Pn!==void 0&&Pn.setValue(O,ft.setFromMatrixPosition(E.matrixWorld)),fe.logarithmicDepthBuffer&&He.setValue(O,"logDepthBufFC",2/(Math.log(E.far+1)/Math.LN2)),($.isMeshPhongMaterial||$.isMeshToonMaterial||$.isMeshLambertMaterial||$.isMeshBasicMaterial||$.isMeshStandardMaterial||$.isShaderMaterial)&&He.setValue(O,"isOrthographic",E.isOrthographicCamera===!0),S!==E&&(S=E,di=!0,fs=!0)}if(H.isSkinnedMesh){He.setOptional(O,H,"bindMatrix"),He.setOptional(O,H,"bindMatrixInverse");let Pn=H.skeleton;Pn&&(Pn.boneTexture===null&&Pn.computeBoneTexture(),He.setValue(O,"boneTexture",Pn.boneTexture,zt))}H.isBatchedMesh&&(He.setOptional(O,H,"batchingTexture"),He.setValue(O,"batchingTexture",H._matricesTexture,zt),He.setOptional(O,H,"batchingColorTexture"),H._colorsTexture!==null&&He.setValue(O,"batchingColorTexture",H._colorsTexture,zt));let io=Z.morphAttributes;if((io.position!==void 0||io.normal!==void 0||io.color!==void 0)&&Et.update(H,Z,tn),(di||Ot.receiveShadow!==H.receiveShadow)&&(Ot.receiveShadow=H.receiveShadow,He.setValue(O,"receiveShadow",H.receiveShadow)),$.isMeshGouraudMaterial&&$.envMap!==null&&(fi.envMap.value=Lt,fi.flipEnvMap.value=Lt.isCubeTexture&&Lt.isRenderTargetTexture===!1?-1:1),$.isMeshStandardMaterial&&$.envMap===null&&W.environment!==null&&(fi.envMapIntensity.value=W.environmentIntensity),di&&(He.setValue(O,"toneMappingExposure",b.toneMappingExposure),Ot.needsLights&&Ti(fi,fs),at&&$.fog===!0&&et.refreshFogUniforms(fi,at),et.refreshMaterialUniforms(fi,$,st,q,m.state.transmissionRenderTarget[E.id]),Mr.upload(O,no(Ot),fi,zt)),$.isShaderMaterial&&$.uniformsNeedUpdate===!0&&(Mr.upload(O,no(Ot),fi,zt),$.uniformsNeedUpdate=!1),$.isSpriteMaterial&&He.setValue(O,"center",H.center),He.setValue(O,"modelViewMatrix",H.modelViewMatrix),He.setValue(O,"normalMatrix",H.normalMatrix),He.setValue(O,"modelMatrix",H.matrixWorld),$.isShaderMaterial||$.isRawShaderMaterial){let Pn=$.uniformsGroups;for(let ks=0,ko=Pn.length;ks<ko;ks++){let Bo=Pn[ks];Zt.update(Bo,tn),Zt.bind(Bo,tn)}}return tn}function Ti(E,W){E.ambientLightColor.needsUpdate=W,E.lightProbe.needsUpdate=W,E.directionalLights.needsUpdate=W,E.directionalLightShadows.needsUpdate=W,E.pointLights.needsUpdate=W,E.pointLightShadows.needsUpdate=W,E.spotLights.needsUpdate=W,E.spotLightShadows.needsUpdate=W,E.rectAreaLights.needsUpdate=W,E.hemisphereLights.needsUpdate=W}function Nl(E){return E.isMeshLambertMaterial||E.isMeshToonMaterial||E.isMeshPhongMaterial||E.isMeshStandardMaterial||E.isShadowMaterial||E.isShaderMaterial&&E.lights===!0}this.getActiveCubeFace=function(){return N},this.getActiveMipmapLevel=function(){return L},this.getRenderTarget=function(){return C},this.setRenderTargetTextures=function(E,W,Z){Yt.get(E.texture).__webglTexture=W,Yt.get(E.depthTexture).__webglTexture=Z;let $=Yt.get(E);$.__hasExternalTextures=!0,$.__autoAllocateDepthBuffer=Z===void 0,$.__autoAllocateDepthBuffer||te.has("WEBGL_multisampled_render_to_texture")===!0&&(console.warn("THREE.WebGLRenderer: Render-to-texture extension was disabled because an external texture was provided"),$.__useRenderToTexture=!1)},this.setRenderTargetFramebuffer=function(E,W){let Z=Yt.get(E);Z.__webglFramebuffer=W,Z.__useDefaultFramebuffer=W===void 0},this.setRenderTarget=function(E,W=0,Z=0){C=E,N=W,L=Z;let $=!0,H=null,at=!1,St=!1;if(E){let Lt=Yt.get(E);Lt.__useDefaultFramebuffer!==void 0?(Ut.bindFramebuffer(O.FRAMEBUFFER,null),$=!1):Lt.__webglFramebuffer===void 0?zt.setupRenderTarget(E):Lt.__hasExternalTextures&&zt.rebindTextures(E,Yt.get(E.texture).__webglTexture,Yt.get(E.depthTexture).__webglTexture);let $t=E.texture;($t.isData3DTexture||$t.isDataArrayTexture||$t.isCompressedArrayTexture)&&(St=!0);let qt=Yt.get(E).__webglFramebuffer;E.isWebGLCubeRenderTarget?(Array.isArray(qt[W])?H=qt[W][Z]:H=qt[W],at=!0):E.samples>0&&zt.useMultisampledRTT(E)===!1?H=Yt.get(E).__webglMultisampledFramebuffer:Array.isArray(qt)?H=qt[Z]:H=qt,x.copy(E.viewport),R.copy(E.scissor),z=E.scissorTest}else x.copy(dt).multiplyScalar(st).floor(),R.copy(pt).multiplyScalar(st).floor(),z=mt;if(Ut.bindFramebuffer(O.FRAMEBUFFER,H)&&$&&Ut.drawBuffers(E,H),Ut.viewport(x),Ut.scissor(R),Ut.setScissorTest(z),at){let Lt=Yt.get(E.texture);O.framebufferTexture2D(O.FRAMEBUFFER,O.COLOR_ATTACHMENT0,O.TEXTURE_CUBE_MAP_POSITIVE_X+W,Lt.__webglTexture,Z)}else if(St){let Lt=Yt.get(E.texture),$t=W||0;O.framebufferTextureLayer(O.FRAMEBUFFER,O.COLOR_ATTACHMENT0,Lt.__webglTexture,Z||0,$t)}F=-1},this.readRenderTargetPixels=function(E,W,Z,$,H,at,St){if(!(E&&E.isWebGLRenderTarget)){console.error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");return}let wt=Yt.get(E).__webglFramebuffer;if(E.isWebGLCubeRenderTarget&&St!==void 0&&(wt=wt[St]),wt){Ut.bindFramebuffer(O.FRAMEBUFFER,wt);try{let Lt=E.texture,$t=Lt.format,qt=Lt.type;if(!fe.textureFormatReadable($t)){console.error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not in RGBA or implementation defined format.");return}if(!fe.textureTypeReadable(qt)){console.error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not in UnsignedByteType or implementation defined type.");return}W>=0&&W<=E.width-$&&Z>=0&&Z<=E.height-H&&O.readPixels(W,Z,$,H,xt.convert($t),xt.convert(qt),at)}finally{let Lt=C!==null?Yt.get(C).__webglFramebuffer:null;Ut.bindFramebuffer(O.FRAMEBUFFER,Lt)}}},this.readRenderTargetPixelsAsync=async function(E,W,Z,$,H,at,St){if(!(E&&E.isWebGLRenderTarget))throw new Error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");let wt=Yt.get(E).__webglFramebuffer;if(E.isWebGLCubeRenderTarget&&St!==void 0&&(wt=wt[St]),wt){Ut.bindFramebuffer(O.FRAMEBUFFER,wt);try{let Lt=E.texture,$t=Lt.format,qt=Lt.type;if(!fe.textureFormatReadable($t))throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in RGBA or implementation defined format.");if(!fe.textureTypeReadable(qt))throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in UnsignedByteType or implementation defined type.");if(W>=0&&W<=E.width-$&&Z>=0&&Z<=E.height-H){let Vt=O.createBuffer();O.bindBuffer(O.PIXEL_PACK_BUFFER,Vt),O.bufferData(O.PIXEL_PACK_BUFFER,at.byteLength,O.STREAM_READ),O.readPixels(W,Z,$,H,xt.convert($t),xt.convert(qt),0),O.flush();let ae=O.fenceSync(O.SYNC_GPU_COMMANDS_COMPLETE,0);await k0(O,ae,4);try{O.bindBuffer(O.PIXEL_PACK_BUFFER,Vt),O.getBufferSubData(O.PIXEL_PACK_BUFFER,0,at)}finally{O.deleteBuffer(Vt),O.deleteSync(ae)}return at}}finally{let Lt=C!==null?Yt.get(C).__webglFramebuffer:null;Ut.bindFramebuffer(O.FRAMEBUFFER,Lt)}}},this.copyFramebufferToTexture=function(E,W=null,Z=0){E.isTexture!==!0&&(console.warn("WebGLRenderer: copyFramebufferToTexture function signature has changed."),W=arguments[0]||null,E=arguments[1]);let $=Math.pow(2,-Z),H=Math.floor(E.image.width*$),at=Math.floor(E.image.height*$),St=W!==null?W.x:0,wt=W!==null?W.y:0;zt.setTexture2D(E,0),O.copyTexSubImage2D(O.TEXTURE_2D,Z,0,0,St,wt,H,at),Ut.unbindTexture()},this.copyTextureToTexture=function(E,W,Z=null,$=null,H=0){E.isTexture!==!0&&(console.warn("WebGLRenderer: copyTextureToTexture function signature has changed."),$=arguments[0]||null,E=arguments[1],W=arguments[2],H=arguments[3]||0,Z=null);let at,St,wt,Lt,$t,qt;Z!==null?(at=Z.max.x-Z.min.x,St=Z.max.y-Z.min.y,wt=Z.min.x,Lt=Z.min.y):(at=E.image.width,St=E.image.height,wt=0,Lt=0),$!==null?($t=$.x,qt=$.y):($t=0,qt=0);let Vt=xt.convert(W.format),ae=xt.convert(W.type);zt.setTexture2D(W,0),O.pixelStorei(O.UNPACK_FLIP_Y_WEBGL,W.flipY),O.pixelStorei(O.UNPACK_PREMULTIPLY_ALPHA_WEBGL,W.premultiplyAlpha),O.pixelStorei(O.UNPACK_ALIGNMENT,W.unpackAlignment);let Re=O.getParameter(O.UNPACK_ROW_LENGTH),Pe=O.getParameter(O.UNPACK_IMAGE_HEIGHT),fn=O.getParameter(O.UNPACK_SKIP_PIXELS),pe=O.getParameter(O.UNPACK_SKIP_ROWS),Ot=O.getParameter(O.UNPACK_SKIP_IMAGES),Qe=E.isCompressedTexture?E.mipmaps[H]:E.image;O.pixelStorei(O.UNPACK_ROW_LENGTH,Qe.width),O.pixelStorei(O.UNPACK_IMAGE_HEIGHT,Qe.height),O.pixelStorei(O.UNPACK_SKIP_PIXELS,wt),O.pixelStorei(O.UNPACK_SKIP_ROWS,Lt),E.isDataTexture?O.texSubImage2D(O.TEXTURE_2D,H,$t,qt,at,St,Vt,ae,Qe.data):E.isCompressedTexture?O.compressedTexSubImage2D(O.TEXTURE_2D,H,$t,qt,Qe.width,Qe.height,Vt,Qe.data):O.texSubImage2D(O.TEXTURE_2D,H,$t,qt,Vt,ae,Qe),O.pixelStorei(O.UNPACK_ROW_LENGTH,Re),O.pixelStorei(O.UNPACK_IMAGE_HEIGHT,Pe),O.pixelStorei(O.UNPACK_SKIP_PIXELS,fn),O.pixelStorei(O.UNPACK_SKIP_ROWS,pe),O.pixelStorei(O.UNPACK_SKIP_IMAGES,Ot),H===0&&W.generateMipmaps&&O.generateMipmap(O.TEXTURE_2D),Ut.unbindTexture()},this.copyTextureToTexture3D=function(E,W,Z=null,$=null,H=0){E.isTexture!==!0&&(console.warn("WebGLRenderer: copyTextureToTexture3D function signature has changed."),Z=arguments[0]||null,$=arguments[1]||null,E=arguments[2],W=arguments[3],H=arguments[4]||0);let at,St,wt,Lt,$t,qt,Vt,ae,Re,Pe=E.isCompressedTexture?E.mipmaps[H]:E.image;Z!==null?(at=Z.max.x-Z.min.x,St=Z.max.y-Z.min.y,wt=Z.max.z-Z.min.z,Lt=Z.min.x,$t=Z.min.y,qt=Z.min.z):(at=Pe.width,St=Pe.height,wt=Pe.depth,Lt=0,$t=0,qt=0),$!==null?(Vt=$.x,ae=$.y,Re=$.z):(Vt=0,ae=0,Re=0);let fn=xt.convert(W.format),pe=xt.convert(W.type),Ot;if(W.isData3DTexture)zt.setTexture3D(W,0),Ot=O.TEXTURE_3D;else if(W.isDataArrayTexture||W.isCompressedArrayTexture)zt.setTexture2DArray(W,0),Ot=O.TEXTURE_2D_ARRAY;else{console.warn("THREE.WebGLRenderer.copyTextureToTexture3D: only supports THREE.DataTexture3D and THREE.DataTexture2DArray.");return}O.pixelStorei(O.UNPACK_FLIP_Y_WEBGL,W.flipY),O.pixelStorei(O.UNPACK_PREMULTIPLY_ALPHA_WEBGL,W.premultiplyAlpha),O.pixelStorei(O.UNPACK_ALIGNMENT,W.unpackAlignment);let Qe=O.getParameter(O.UNPACK_ROW_LENGTH),ge=O.getParameter(O.UNPACK_IMAGE_HEIGHT),tn=O.getParameter(O.UNPACK_SKIP_PIXELS),ds=O.getParameter(O.UNPACK_SKIP_ROWS),di=O.getParameter(O.UNPACK_SKIP_IMAGES);O.pixelStorei(O.UNPACK_ROW_LENGTH,Pe.width),O.pixelStorei(O.UNPACK_IMAGE_HEIGHT,Pe.height),O.pixelStorei(O.UNPACK_SKIP_PIXELS,Lt),O.pixelStorei(O.UNPACK_SKIP_ROWS,$t),O.pixelStorei(O.UNPACK_SKIP_IMAGES,qt),E.isDataTexture||E.isData3DTexture?O.texSubImage3D(Ot,H,Vt,ae,Re,at,St,wt,fn,pe,Pe.data):W.isCompressedArrayTexture?O.compressedTexSubImage3D(Ot,H,Vt,ae,Re,at,St,wt,fn,Pe.data):O.texSubImage3D(Ot,H,Vt,ae,Re,at,St,wt,fn,pe,Pe),O.pixelStorei(O.UNPACK_ROW_LENGTH,Qe),O.pixelStorei(O.UNPACK_IMAGE_HEIGHT,ge),O.pixelStorei(O.UNPACK_SKIP_PIXELS,tn),O.pixelStorei(O.UNPACK_SKIP_ROWS,ds),O.pixelStorei(O.UNPACK_SKIP_IMAGES,di),H===0&&W.generateMipmaps&&O.generateMipmap(Ot),Ut.unbindTexture()},this.initRenderTarget=function(E){Yt.get(E).__webglFramebuffer===void 0&&zt.setupRenderTarget(E)},this.initTexture=function(E){E.isCubeTexture?zt.setTextureCube(E,0):E.isData3DTexture?zt.setTexture3D(E,0):E.isDataArrayTexture||E.isCompressedArrayTexture?zt.setTexture2DArray(E,0):zt.setTexture2D(E,0),Ut.unbindTexture()},this.resetState=function(){N=0,L=0,C=null,Ut.reset(),Xt.reset()},typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}get coordinateSystem(){return Fi}get outputColorSpace(){return this._outputColorSpace}set outputColorSpace(t){this._outputColorSpace=t;let e=this.getContext();e.drawingBufferColorSpace=t===fh?"display-p3":"srgb",e.unpackColorSpace=we.workingColorSpace===nl?"display-p3":"srgb"}};var Wa=class extends Je{constructor(){super(),this.isScene=!0,this.type="Scene",this.background=null,this.environment=null,this.fog=null,this.backgroundBlurriness=0,this.backgroundIntensity=1,this.backgroundRotation=new Kn,this.environmentIntensity=1,this.environmentRotation=new Kn,this.overrideMaterial=null,typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}copy(t,e){return super.copy(t,e),t.background!==null&&(this.background=t.background.clone()),t.environment!==null&&(this.environment=t.environment.clone()),t.fog!==null&&(this.fog=t.fog.clone()),this.backgroundBlurriness=t.backgroundBlurriness,this.backgroundIntensity=t.backgroundIntensity,this.backgroundRotation.copy(t.backgroundRotation),this.environmentIntensity=t.environmentIntensity,this.environmentRotation.copy(t.environmentRotation),t.overrideMaterial!==null&&(this.overrideMaterial=t.overrideMaterial.clone()),this.matrixAutoUpdate=t.matrixAutoUpdate,this}toJSON(t){let e=super.toJSON(t);return this.fog!==null&&(e.object.fog=this.fog.toJSON()),this.backgroundBlurriness>0&&(e.object.backgroundBlurriness=this.backgroundBlurriness),this.backgroundIntensity!==1&&(e.object.backgroundIntensity=this.backgroundIntensity),e.object.backgroundRotation=this.backgroundRotation.toArray(),this.environmentIntensity!==1&&(e.object.environmentIntensity=this.environmentIntensity),e.object.environmentRotation=this.environmentRotation.toArray(),e}};var Kc=class extends mn{constructor(t=null,e=1,n=1,s,r,o,a,l,c=Nn,u=Nn,d,h){super(null,o,a,l,c,u,s,r,d,h),this.isDataTexture=!0,this.image={data:t,width:e,height:n},this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}};var Xa=class extends Vn{constructor(t,e,n,s=1){super(t,e,n),this.isInstancedBufferAttribute=!0,this.meshPerAttribute=s}copy(t){return super.copy(t),this.meshPerAttribute=t.meshPerAttribute,this}toJSON(){let t=super.toJSON();return t.meshPerAttribute=this.meshPerAttribute,t.isInstancedBufferAttribute=!0,t}},mr=new ve,uf=new ve,Ma=[],df=new Jn,PM=new ve,po=new zn,mo=new li,Lr=class extends zn{constructor(t,e,n){super(t,e),this.isInstancedMesh=!0,this.instanceMatrix=new Xa(new Float32Array(n*16),16),this.instanceColor=null,this.morphTexture=null,this.count=n,this.boundingBox=null,this.boundingSphere=null;for(let s=0;s<n;s++)this.setMatrixAt(s,PM)}computeBoundingBox(){let t=this.geometry,e=this.count;this.boundingBox===null&&(this.boundingBox=new Jn),t.boundingBox===null&&t.computeBoundingBox(),this.boundingBox.makeEmpty();for(let n=0;n<e;n++)this.getMatrixAt(n,mr),df.copy(t.boundingBox).applyMatrix4(mr),this.boundingBox.union(df)}computeBoundingSphere(){let t=this.geometry,e=this.count;this.boundingSphere===null&&(this.boundingSphere=new li),t.boundingSphere===null&&t.computeBoundingSphere(),this.boundingSphere.makeEmpty();for(let n=0;n<e;n++)this.getMatrixAt(n,mr),mo.copy(t.boundingSphere).applyMatrix4(mr),this.boundingSphere.union(mo)}copy(t,e){return super.copy(t,e),this.instanceMatrix.copy(t.instanceMatrix),t.morphTexture!==null&&(this.morphTexture=t.morphTexture.clone()),t.instanceColor!==null&&(this.instanceColor=t.instanceColor.clone()),this.count=t.count,t.boundingBox!==null&&(this.boundingBox=t.boundingBox.clone()),t.boundingSphere!==null&&(this.boundingSphere=t.boundingSphere.clone()),this}getColorAt(t,e){e.fromArray(this.instanceColor.array,t*3)}getMatrixAt(t,e){e.fromArray(this.instanceMatrix.array,t*16)}getMorphAt(t,e){let n=e.morphTargetInfluences,s=this.morphTexture.source.data.data,r=n.length+1,o=t*r+1;for(let a=0;a<n.length;a++)n[a]=s[o+a]}raycast(t,e){let n=this.matrixWorld,s=this.count;if(po.geometry=this.geometry,po.material=this.material,po.material!==void 0&&(this.boundingSphere===null&&this.computeBoundingSphere(),mo.copy(this.boundingSphere),mo.applyMatrix4(n),t.ray.intersectsSphere(mo)!==!1))for(let r=0;r<s;r++){this.getMatrixAt(r,mr),uf.multiplyMatrices(n,mr),po.matrixWorld=uf,po.raycast(t,Ma);for(let o=0,a=Ma.length;o<a;o++){let l=Ma[o];l.instanceId=r,l.object=this,e.push(l)}Ma.length=0}}setColorAt(t,e){this.instanceColor===null&&(this.instanceColor=new Xa(new Float32Array(this.instanceMatrix.count*3),3)),e.toArray(this.instanceColor.array,t*3)}setMatrixAt(t,e){e.toArray(this.instanceMatrix.array,t*16)}setMorphAt(t,e){let n=e.morphTargetInfluences,s=n.length+1;this.morphTexture===null&&(this.morphTexture=new Kc(new Float32Array(s*this.count),s,this.count,Sf,Oi));let r=this.morphTexture.source.data.data,o=0;for(let c=0;c<n.length;c++)o+=n[c];let a=this.geometry.morphTargetsRelative?1:1-o,l=s*t;r[l]=a,r.set(n,l+1)}updateMorphTargets(){}dispose(){return this.dispatchEvent({type:"dispose"}),this.morphTexture!==null&&(this.morphTexture.dispose(),this.morphTexture=null),this}};var Ir=class extends os{constructor(t){super(),this.isLineBasicMaterial=!0,this.type="LineBasicMaterial",this.color=new ce(16777215),this.map=null,this.linewidth=1,this.linecap="round",this.linejoin="round",this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.linewidth=t.linewidth,this.linecap=t.linecap,this.linejoin=t.linejoin,this.fog=t.fog,this}},$a=new V,qa=new V,ff=new ve,go=new Ar,ba=new li,Tc=new V,pf=new V,wo=class extends Je{constructor(t=new Cn,e=new Ir){super(),this.isLine=!0,this.type="Line",this.geometry=t,this.material=e,this.updateMorphTargets()}copy(t,e){return super.copy(t,e),this.material=Array.isArray(t.material)?t.material.slice():t.material,this.geometry=t.geometry,this}computeLineDistances(){let t=this.geometry;if(t.index===null){let e=t.attributes.position,n=[0];for(let s=1,r=e.count;s<r;s++)$a.fromBufferAttribute(e,s-1),qa.fromBufferAttribute(e,s),n[s]=n[s-1],n[s]+=$a.distanceTo(qa);t.setAttribute("lineDistance",new en(n,1))}else console.warn("THREE.Line.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}raycast(t,e){let n=this.geometry,s=this.matrixWorld,r=t.params.Line.threshold,o=n.drawRange;if(n.boundingSphere===null&&n.computeBoundingSphere(),ba.copy(n.boundingSphere),ba.applyMatrix4(s),ba.radius+=r,t.ray.intersectsSphere(ba)===!1)return;ff.copy(s).invert(),go.copy(t.ray).applyMatrix4(ff);let a=r/((this.scale.x+this.scale.y+this.scale.z)/3),l=a*a,c=this.isLineSegments?2:1,u=n.index,h=n.attributes.position;if(u!==null){let p=Math.max(0,o.start),g=Math.min(u.count,o.start+o.count);for(let v=p,m=g-1;v<m;v+=c){let f=u.getX(v),T=u.getX(v+1),b=wa(this,t,go,l,f,T);b&&e.push(b)}if(this.isLineLoop){let v=u.getX(g-1),m=u.getX(p),f=wa(this,t,go,l,v,m);f&&e.push(f)}}else{let p=Math.max(0,o.start),g=Math.min(h.count,o.start+o.count);for(let v=p,m=g-1;v<m;v+=c){let f=wa(this,t,go,l,v,v+1);f&&e.push(f)}if(this.isLineLoop){let v=wa(this,t,go,l,g-1,p);v&&e.push(v)}}}updateMorphTargets(){let e=this.geometry.morphAttributes,n=Object.keys(e);if(n.length>0){let s=e[n[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}};function wa(i,t,e,n,s,r){let o=i.geometry.attributes.position;if($a.fromBufferAttribute(o,s),qa.fromBufferAttribute(o,r),e.distanceSqToSegment($a,qa,Tc,pf)>n)return;Tc.applyMatrix4(i.matrixWorld);let l=t.ray.origin.distanceTo(Tc);if(!(l<t.near||l>t.far))return{distance:l,point:pf.clone().applyMatrix4(i.matrixWorld),index:s,face:null,faceIndex:null,object:i}}var mf=new V,gf=new V,jc=class extends wo{constructor(t,e){super(t,e),this.isLineSegments=!0,this.type="LineSegments"}computeLineDistances(){let t=this.geometry;if(t.index===null){let e=t.attributes.position,n=[];for(let s=0,r=e.count;s<r;s+=2)mf.fromBufferAttribute(e,s),gf.fromBufferAttribute(e,s+1),n[s]=s===0?0:n[s-1],n[s+1]=n[s]+mf.distanceTo(gf);t.setAttribute("lineDistance",new en(n,1))}else console.warn("THREE.LineSegments.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}};var as=class extends Cn{constructor(t=1,e=1,n=1,s=32,r=1,o=!1,a=0,l=Math.PI*2){super(),this.type="CylinderGeometry",this.parameters={radiusTop:t,radiusBottom:e,height:n,radialSegments:s,heightSegments:r,openEnded:o,thetaStart:a,thetaLength:l};let c=this;s=Math.floor(s),r=Math.floor(r);let u=[],d=[],h=[],p=[],g=0,v=[],m=n/2,f=0;T(),o===!1&&(t>0&&b(!0),e>0&&b(!1)),this.setIndex(u),this.setAttribute("position",new en(d,3)),this.setAttribute("normal",new en(h,3)),this.setAttribute("uv",new en(p,2));function T(){let A=new V,N=new V,L=0,C=(e-t)/n;for(let F=0;F<=r;F++){let S=[],x=F/r,R=x*(e-t)+t;for(let z=0;z<=s;z++){let B=z/s,X=B*l+a,J=Math.sin(X),q=Math.cos(X);N.x=R*J,N.y=-x*n+m,N.z=R*q,d.push(N.x,N.y,N.z),A.set(J,C,q).normalize(),h.push(A.x,A.y,A.z),p.push(B,1-x),S.push(g++)}v.push(S)}for(let F=0;F<s;F++)for(let S=0;S<r;S++){let x=v[S][F],R=v[S+1][F],z=v[S+1][F+1],B=v[S][F+1];u.push(x,R,B),u.push(R,z,B),L+=6}c.addGroup(f,L,0),f+=L}function b(A){let N=g,L=new Jt,C=new V,F=0,S=A===!0?t:e,x=A===!0?1:-1;for(let z=1;z<=s;z++)d.push(0,m*x,0),h.push(0,x,0),p.push(.5,.5),g++;let R=g;for(let z=0;z<=s;z++){let X=z/s*l+a,J=Math.cos(X),q=Math.sin(X);C.x=S*q,C.y=m*x,C.z=S*J,d.push(C.x,C.y,C.z),h.push(0,x,0),L.x=J*.5+.5,L.y=q*.5*x+.5,p.push(L.x,L.y),g++}for(let z=0;z<s;z++){let B=N+z,X=R+z;A===!0?u.push(X,X+1,B):u.push(X+1,X,B),F+=3}c.addGroup(f,F,A===!0?1:2),f+=F}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new as(t.radiusTop,t.radiusBottom,t.height,t.radialSegments,t.heightSegments,t.openEnded,t.thetaStart,t.thetaLength)}};var Dr=class extends Cn{constructor(t=1,e=32,n=16,s=0,r=Math.PI*2,o=0,a=Math.PI){super(),this.type="SphereGeometry",this.parameters={radius:t,widthSegments:e,heightSegments:n,phiStart:s,phiLength:r,thetaStart:o,thetaLength:a},e=Math.max(3,Math.floor(e)),n=Math.max(2,Math.floor(n));let l=Math.min(o+a,Math.PI),c=0,u=[],d=new V,h=new V,p=[],g=[],v=[],m=[];for(let f=0;f<=n;f++){let T=[],b=f/n,A=0;f===0&&o===0?A=.5/e:f===n&&l===Math.PI&&(A=-.5/e);for(let N=0;N<=e;N++){let L=N/e;d.x=-t*Math.cos(s+L*r)*Math.sin(o+b*a),d.y=t*Math.cos(o+b*a),d.z=t*Math.sin(s+L*r)*Math.sin(o+b*a),g.push(d.x,d.y,d.z),h.copy(d).normalize(),v.push(h.x,h.y,h.z),m.push(L+A,1-b),T.push(c++)}u.push(T)}for(let f=0;f<n;f++)for(let T=0;T<e;T++){let b=u[f][T+1],A=u[f][T],N=u[f+1][T],L=u[f+1][T+1];(f!==0||o>0)&&p.push(b,A,L),(f!==n-1||l<Math.PI)&&p.push(A,N,L)}this.setIndex(p),this.setAttribute("position",new en(g,3)),this.setAttribute("normal",new en(v,3)),this.setAttribute("uv",new en(m,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new Dr(t.radius,t.widthSegments,t.heightSegments,t.phiStart,t.phiLength,t.thetaStart,t.thetaLength)}};var Ya=class extends os{constructor(t){super(),this.isMeshLambertMaterial=!0,this.type="MeshLambertMaterial",this.color=new ce(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.emissive=new ce(0),this.emissiveIntensity=1,this.emissiveMap=null,this.bumpMap=null,this.bumpScale=1,this.normalMap=null,this.normalMapType=Cf,this.normalScale=new Jt(1,1),this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new Kn,this.combine=dh,this.reflectivity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.flatShading=!1,this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.lightMap=t.lightMap,this.lightMapIntensity=t.lightMapIntensity,this.aoMap=t.aoMap,this.aoMapIntensity=t.aoMapIntensity,this.emissive.copy(t.emissive),this.emissiveMap=t.emissiveMap,this.emissiveIntensity=t.emissiveIntensity,this.bumpMap=t.bumpMap,this.bumpScale=t.bumpScale,this.normalMap=t.normalMap,this.normalMapType=t.normalMapType,this.normalScale.copy(t.normalScale),this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this.specularMap=t.specularMap,this.alphaMap=t.alphaMap,this.envMap=t.envMap,this.envMapRotation.copy(t.envMapRotation),this.combine=t.combine,this.reflectivity=t.reflectivity,this.refractionRatio=t.refractionRatio,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.wireframeLinecap=t.wireframeLinecap,this.wireframeLinejoin=t.wireframeLinejoin,this.flatShading=t.flatShading,this.fog=t.fog,this}};function Sa(i,t,e){return!i||!e&&i.constructor===t?i:typeof t.BYTES_PER_ELEMENT=="number"?new t(i):Array.prototype.slice.call(i)}function LM(i){return ArrayBuffer.isView(i)&&!(i instanceof DataView)}var Nr=class{constructor(t,e,n,s){this.parameterPositions=t,this._cachedIndex=0,this.resultBuffer=s!==void 0?s:new e.constructor(n),this.sampleValues=e,this.valueSize=n,this.settings=null,this.DefaultSettings_={}}evaluate(t){let e=this.parameterPositions,n=this._cachedIndex,s=e[n],r=e[n-1];n:{t:{let o;e:{i:if(!(t<s)){for(let a=n+2;;){if(s===void 0){if(t<r)break i;return n=e.length,this._cachedIndex=n,this.copySampleValue_(n-1)}if(n===a)break;if(r=s,s=e[++n],t<s)break t}o=e.length;break e}if(!(t>=r)){let a=e[1];t<a&&(n=2,r=a);for(let l=n-2;;){if(r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(n===l)break;if(s=r,r=e[--n-1],t>=r)break t}o=n,n=0;break e}break n}for(;n<o;){let a=n+o>>>1;t<e[a]?o=a:n=a+1}if(s=e[n],r=e[n-1],r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(s===void 0)return n=e.length,this._cachedIndex=n,this.copySampleValue_(n-1)}this._cachedIndex=n,this.intervalChanged_(n,r,s)}return this.interpolate_(n,r,t,s)}getSettings_(){return this.settings||this.DefaultSettings_}copySampleValue_(t){let e=this.resultBuffer,n=this.sampleValues,s=this.valueSize,r=t*s;for(let o=0;o!==s;++o)e[o]=n[r+o];return e}interpolate_(){throw new Error("call to abstract method")}intervalChanged_(){}},Qc=class extends Nr{constructor(t,e,n,s){super(t,e,n,s),this._weightPrev=-0,this._offsetPrev=-0,this._weightNext=-0,this._offsetNext=-0,this.DefaultSettings_={endingStart:_d,endingEnd:_d}}intervalChanged_(t,e,n){let s=this.parameterPositions,r=t-2,o=t+1,a=s[r],l=s[o];if(a===void 0)switch(this.getSettings_().endingStart){case vd:r=t,a=2*e-n;break;case yd:r=s.length-2,a=e+s[r]-s[r+1];break;default:r=t,a=n}if(l===void 0)switch(this.getSettings_().endingEnd){case vd:o=t,l=2*n-e;break;case yd:o=1,l=n+s[1]-s[0];break;default:o=t-1,l=e}let c=(n-e)*.5,u=this.valueSize;this._weightPrev=c/(e-a),this._weightNext=c/(l-n),this._offsetPrev=r*u,this._offsetNext=o*u}interpolate_(t,e,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=t*a,c=l-a,u=this._offsetPrev,d=this._offsetNext,h=this._weightPrev,p=this._weightNext,g=(n-e)/(s-e),v=g*g,m=v*g,f=-h*m+2*h*v-h*g,T=(1+h)*m+(-1.5-2*h)*v+(-.5+h)*g+1,b=(-1-p)*m+(1.5+p)*v+.5*g,A=p*m-p*v;for(let N=0;N!==a;++N)r[N]=f*o[u+N]+T*o[c+N]+b*o[l+N]+A*o[d+N];return r}},th=class extends Nr{constructor(t,e,n,s){super(t,e,n,s)}interpolate_(t,e,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=t*a,c=l-a,u=(n-e)/(s-e),d=1-u;for(let h=0;h!==a;++h)r[h]=o[c+h]*d+o[l+h]*u;return r}},eh=class extends Nr{constructor(t,e,n,s){super(t,e,n,s)}interpolate_(t){return this.copySampleValue_(t-1)}},ci=class{constructor(t,e,n,s){if(t===void 0)throw new Error("THREE.KeyframeTrack: track name is undefined");if(e===void 0||e.length===0)throw new Error("THREE.KeyframeTrack: no keyframes in track named "+t);this.name=t,this.times=Sa(e,this.TimeBufferType),this.values=Sa(n,this.ValueBufferType),this.setInterpolation(s||this.DefaultInterpolation)}static toJSON(t){let e=t.constructor,n;if(e.toJSON!==this.toJSON)n=e.toJSON(t);else{n={name:t.name,times:Sa(t.times,Array),values:Sa(t.values,Array)};let s=t.getInterpolation();s!==t.DefaultInterpolation&&(n.interpolation=s)}return n.type=t.ValueTypeName,n}InterpolantFactoryMethodDiscrete(t){return new eh(this.times,this.values,this.getValueSize(),t)}InterpolantFactoryMethodLinear(t){return new th(this.times,this.values,this.getValueSize(),t)}InterpolantFactoryMethodSmooth(t){return new Qc(this.times,this.values,this.getValueSize(),t)}setInterpolation(t){let e;switch(t){case Aa:e=this.InterpolantFactoryMethodDiscrete;break;case Nc:e=this.InterpolantFactoryMethodLinear;break;case ec:e=this.InterpolantFactoryMethodSmooth;break}if(e===void 0){let n="unsupported interpolation for "+this.ValueTypeName+" keyframe track named "+this.name;if(this.createInterpolant===void 0)if(t!==this.DefaultInterpolation)this.setInterpolation(this.DefaultInterpolation);else throw new Error(n);return console.warn("THREE.KeyframeTrack:",n),this}return this.createInterpolant=e,this}getInterpolation(){switch(this.createInterpolant){case this.InterpolantFactoryMethodDiscrete:return Aa;case this.InterpolantFactoryMethodLinear:return Nc;case this.InterpolantFactoryMethodSmooth:return ec}}getValueSize(){return this.values.length/this.times.length}shift(t){if(t!==0){let e=this.times;for(let n=0,s=e.length;n!==s;++n)e[n]+=t}return this}scale(t){if(t!==1){let e=this.times;for(let n=0,s=e.length;n!==s;++n)e[n]*=t}return this}trim(t,e){let n=this.times,s=n.length,r=0,o=s-1;for(;r!==s&&n[r]<t;)++r;for(;o!==-1&&n[o]>e;)--o;if(++o,r!==0||o!==s){r>=o&&(o=Math.max(o,1),r=o-1);let a=this.getValueSize();this.times=n.slice(r,o),this.values=this.values.slice(r*a,o*a)}return this}validate(){let t=!0,e=this.getValueSize();e-Math.floor(e)!==0&&(console.error("THREE.KeyframeTrack: Invalid value size in track.",this),t=!1);let n=this.times,s=this.values,r=n.length;r===0&&(console.error("THREE.KeyframeTrack: Track is empty.",this),t=!1);let o=null;for(let a=0;a!==r;a++){let l=n[a];if(typeof l=="number"&&isNaN(l)){console.error("THREE.KeyframeTrack: Time is not a valid number.",this,a,l),t=!1;break}if(o!==null&&o>l){console.error("THREE.KeyframeTrack: Out of order keys.",this,a,l,o),t=!1;break}o=l}if(s!==void 0&&LM(s))for(let a=0,l=s.length;a!==l;++a){let c=s[a];if(isNaN(c)){console.error("THREE.KeyframeTrack: Value is not a valid number.",this,a,c),t=!1;break}}return t}optimize(){let t=this.times.slice(),e=this.values.slice(),n=this.getValueSize(),s=this.getInterpolation()===ec,r=t.length-1,o=1;for(let a=1;a<r;++a){let l=!1,c=t[a],u=t[a+1];if(c!==u&&(a!==1||c!==t[0]))if(s)l=!0;else{let d=a*n,h=d-n,p=d+n;for(let g=0;g!==n;++g){let v=e[d+g];if(v!==e[h+g]||v!==e[p+g]){l=!0;break}}}if(l){if(a!==o){t[o]=t[a];let d=a*n,h=o*n;for(let p=0;p!==n;++p)e[h+p]=e[d+p]}++o}}if(r>0){t[o]=t[r];for(let a=r*n,l=o*n,c=0;c!==n;++c)e[l+c]=e[a+c];++o}return o!==t.length?(this.times=t.slice(0,o),this.values=e.slice(0,o*n)):(this.times=t,this.values=e),this}clone(){let t=this.times.slice(),e=this.values.slice(),n=this.constructor,s=new n(this.name,t,e);return s.createInterpolant=this.createInterpolant,s}};ci.prototype.TimeBufferType=Float32Array;ci.prototype.ValueBufferType=Float32Array;ci.prototype.DefaultInterpolation=Nc;var Cs=class extends ci{constructor(t,e,n){super(t,e,n)}};Cs.prototype.ValueTypeName="bool";Cs.prototype.ValueBufferType=Array;Cs.prototype.DefaultInterpolation=Aa;Cs.prototype.InterpolantFactoryMethodLinear=void 0;Cs.prototype.InterpolantFactoryMethodSmooth=void 0;var nh=class extends ci{};nh.prototype.ValueTypeName="color";var ih=class extends ci{};ih.prototype.ValueTypeName="number";var sh=class extends Nr{constructor(t,e,n,s){super(t,e,n,s)}interpolate_(t,e,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=(n-e)/(s-e),c=t*a;for(let u=c+a;c!==u;c+=4)On.slerpFlat(r,0,o,c-a,o,c,l);return r}},Za=class extends ci{InterpolantFactoryMethodLinear(t){return new sh(this.times,this.values,this.getValueSize(),t)}};Za.prototype.ValueTypeName="quaternion";Za.prototype.InterpolantFactoryMethodSmooth=void 0;var Rs=class extends ci{constructor(t,e,n){super(t,e,n)}};Rs.prototype.ValueTypeName="string";Rs.prototype.ValueBufferType=Array;Rs.prototype.DefaultInterpolation=Aa;Rs.prototype.InterpolantFactoryMethodLinear=void 0;Rs.prototype.InterpolantFactoryMethodSmooth=void 0;var rh=class extends ci{};rh.prototype.ValueTypeName="vector";var oh=class{constructor(t,e,n){let s=this,r=!1,o=0,a=0,l,c=[];this.onStart=void 0,this.onLoad=t,this.onProgress=e,this.onError=n,this.itemStart=function(u){a++,r===!1&&s.onStart!==void 0&&s.onStart(u,o,a),r=!0},this.itemEnd=function(u){o++,s.onProgress!==void 0&&s.onProgress(u,o,a),o===a&&(r=!1,s.onLoad!==void 0&&s.onLoad())},this.itemError=function(u){s.onError!==void 0&&s.onError(u)},this.resolveURL=function(u){return l?l(u):u},this.setURLModifier=function(u){return l=u,this},this.addHandler=function(u,d){return c.push(u,d),this},this.removeHandler=function(u){let d=c.indexOf(u);return d!==-1&&c.splice(d,2),this},this.getHandler=function(u){for(let d=0,h=c.length;d<h;d+=2){let p=c[d],g=c[d+1];if(p.global&&(p.lastIndex=0),p.test(u))return g}return null}}},IM=new oh,ah=class{constructor(t){this.manager=t!==void 0?t:IM,this.crossOrigin="anonymous",this.withCredentials=!1,this.path="",this.resourcePath="",this.requestHeader={}}load(){}loadAsync(t,e){let n=this;return new Promise(function(s,r){n.load(t,s,e,r)})}parse(){}setCrossOrigin(t){return this.crossOrigin=t,this}setWithCredentials(t){return this.withCredentials=t,this}setPath(t){return this.path=t,this}setResourcePath(t){return this.resourcePath=t,this}setRequestHeader(t){return this.requestHeader=t,this}};ah.DEFAULT_MATERIAL_NAME="__DEFAULT";var Ja=class extends Je{constructor(t,e=1){super(),this.isLight=!0,this.type="Light",this.color=new ce(t),this.intensity=e}dispose(){}copy(t,e){return super.copy(t,e),this.color.copy(t.color),this.intensity=t.intensity,this}toJSON(t){let e=super.toJSON(t);return e.object.color=this.color.getHex(),e.object.intensity=this.intensity,this.groundColor!==void 0&&(e.object.groundColor=this.groundColor.getHex()),this.distance!==void 0&&(e.object.distance=this.distance),this.angle!==void 0&&(e.object.angle=this.angle),this.decay!==void 0&&(e.object.decay=this.decay),this.penumbra!==void 0&&(e.object.penumbra=this.penumbra),this.shadow!==void 0&&(e.object.shadow=this.shadow.toJSON()),e}},Ka=class extends Ja{constructor(t,e,n){super(t,n),this.isHemisphereLight=!0,this.type="HemisphereLight",this.position.copy(Je.DEFAULT_UP),this.updateMatrix(),this.groundColor=new ce(e)}copy(t,e){return super.copy(t,e),this.groundColor.copy(t.groundColor),this}},Ac=new ve,_f=new V,vf=new V,lh=class{constructor(t){this.camera=t,this.bias=0,this.normalBias=0,this.radius=1,this.blurSamples=8,this.mapSize=new Jt(512,512),this.map=null,this.mapPass=null,this.matrix=new ve,this.autoUpdate=!0,this.needsUpdate=!1,this._frustum=new bo,this._frameExtents=new Jt(1,1),this._viewportCount=1,this._viewports=[new Ze(0,0,1,1)]}getViewportCount(){return this._viewportCount}getFrustum(){return this._frustum}updateMatrices(t){let e=this.camera,n=this.matrix;_f.setFromMatrixPosition(t.matrixWorld),e.position.copy(_f),vf.setFromMatrixPosition(t.target.matrixWorld),e.lookAt(vf),e.updateMatrixWorld(),Ac.multiplyMatrices(e.projectionMatrix,e.matrixWorldInverse),this._frustum.setFromProjectionMatrix(Ac),n.set(.5,0,0,.5,0,.5,0,.5,0,0,.5,.5,0,0,0,1),n.multiply(Ac)}getViewport(t){return this._viewports[t]}getFrameExtents(){return this._frameExtents}dispose(){this.map&&this.map.dispose(),this.mapPass&&this.mapPass.dispose()}copy(t){return this.camera=t.camera.clone(),this.bias=t.bias,this.radius=t.radius,this.mapSize.copy(t.mapSize),this}clone(){return new this.constructor().copy(this)}toJSON(){let t={};return this.bias!==0&&(t.bias=this.bias),this.normalBias!==0&&(t.normalBias=this.normalBias),this.radius!==1&&(t.radius=this.radius),(this.mapSize.x!==512||this.mapSize.y!==512)&&(t.mapSize=this.mapSize.toArray()),t.camera=this.camera.toJSON(!1).object,delete t.camera.matrix,t}};var ch=class extends lh{constructor(){super(new za(-5,5,5,-5,.5,500)),this.isDirectionalLightShadow=!0}},ja=class extends Ja{constructor(t,e){super(t,e),this.isDirectionalLight=!0,this.type="DirectionalLight",this.position.copy(Je.DEFAULT_UP),this.updateMatrix(),this.target=new Je,this.shadow=new ch}dispose(){this.shadow.dispose()}copy(t){return super.copy(t),this.target=t.target.clone(),this.shadow=t.shadow.clone(),this}};var gh="\\[\\]\\.:\\/",DM=new RegExp("["+gh+"]","g"),_h="[^"+gh+"]",NM="[^"+gh.replace("\\.","")+"]",UM=/((?:WC+[\/:])*)/.source.replace("WC",_h),OM=/(WCOD+)?/.source.replace("WCOD",NM),FM=/(?:\.(WC+)(?:\[(.+)\])?)?/.source.replace("WC",_h),kM=/\.(WC+)(?:\[(.+)\])?/.source.replace("WC",_h),BM=new RegExp("^"+UM+OM+FM+kM+"$"),zM=["material","materials","bones","map"],hh=class{constructor(t,e,n){let s=n||Me.parseTrackName(e);this._targetGroup=t,this._bindings=t.subscribe_(e,s)}getValue(t,e){this.bind();let n=this._targetGroup.nCachedObjects_,s=this._bindings[n];s!==void 0&&s.getValue(t,e)}setValue(t,e){let n=this._bindings;for(let s=this._targetGroup.nCachedObjects_,r=n.length;s!==r;++s)n[s].setValue(t,e)}bind(){let t=this._bindings;for(let e=this._targetGroup.nCachedObjects_,n=t.length;e!==n;++e)t[e].bind()}unbind(){let t=this._bindings;for(let e=this._targetGroup.nCachedObjects_,n=t.length;e!==n;++e)t[e].unbind()}},Me=class{constructor(t,e,n){this.path=e,this.parsedPath=n||Me.parseTrackName(e),this.node=Me.findNode(t,this.parsedPath.nodeName),this.rootNode=t,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}static create(t,e,n){return t&&t.isAnimationObjectGroup?new Me.Composite(t,e,n):new Me(t,e,n)}static sanitizeNodeName(t){return t.replace(/\s/g,"_").replace(DM,"")}static parseTrackName(t){let e=BM.exec(t);if(e===null)throw new Error("PropertyBinding: Cannot parse trackName: "+t);let n={nodeName:e[2],objectName:e[3],objectIndex:e[4],propertyName:e[5],propertyIndex:e[6]},s=n.nodeName&&n.nodeName.lastIndexOf(".");if(s!==void 0&&s!==-1){let r=n.nodeName.substring(s+1);zM.indexOf(r)!==-1&&(n.nodeName=n.nodeName.substring(0,s),n.objectName=r)}if(n.propertyName===null||n.propertyName.length===0)throw new Error("PropertyBinding: can not parse propertyName from trackName: "+t);return n}static findNode(t,e){if(e===void 0||e===""||e==="."||e===-1||e===t.name||e===t.uuid)return t;if(t.skeleton){let n=t.skeleton.getBoneByName(e);if(n!==void 0)return n}if(t.children){let n=function(r){for(let o=0;o<r.length;o++){let a=r[o];if(a.name===e||a.uuid===e)return a;let l=n(a.children);if(l)return l}return null},s=n(t.children);if(s)return s}return null}_getValue_unavailable(){}_setValue_unavailable(){}_getValue_direct(t,e){t[e]=this.targetObject[this.propertyName]}_getValue_array(t,e){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)t[e++]=n[s]}_getValue_arrayElement(t,e){t[e]=this.resolvedProperty[this.propertyIndex]}_getValue_toArray(t,e){this.resolvedProperty.toArray(t,e)}_setValue_direct(t,e){this.targetObject[this.propertyName]=t[e]}_setValue_direct_setNeedsUpdate(t,e){this.targetObject[this.propertyName]=t[e],this.targetObject.needsUpdate=!0}_setValue_direct_setMatrixWorldNeedsUpdate(t,e){this.targetObject[this.propertyName]=t[e],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_array(t,e){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)n[s]=t[e++]}_setValue_array_setNeedsUpdate(t,e){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)n[s]=t[e++];this.targetObject.needsUpdate=!0}_setValue_array_setMatrixWorldNeedsUpdate(t,e){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)n[s]=t[e++];this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_arrayElement(t,e){this.resolvedProperty[this.propertyIndex]=t[e]}_setValue_arrayElement_setNeedsUpdate(t,e){this.resolvedProperty[this.propertyIndex]=t[e],this.targetObject.needsUpdate=!0}_setValue_arrayElement_setMatrixWorldNeedsUpdate(t,e){this.resolvedProperty[this.propertyIndex]=t[e],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_fromArray(t,e){this.resolvedProperty.fromArray(t,e)}_setValue_fromArray_setNeedsUpdate(t,e){this.resolvedProperty.fromArray(t,e),this.targetObject.needsUpdate=!0}_setValue_fromArray_setMatrixWorldNeedsUpdate(t,e){this.resolvedProperty.fromArray(t,e),this.targetObject.matrixWorldNeedsUpdate=!0}_getValue_unbound(t,e){this.bind(),this.getValue(t,e)}_setValue_unbound(t,e){this.bind(),this.setValue(t,e)}bind(){let t=this.node,e=this.parsedPath,n=e.objectName,s=e.propertyName,r=e.propertyIndex;if(t||(t=Me.findNode(this.rootNode,e.nodeName),this.node=t),this.getValue=this._getValue_unavailable,this.setValue=this._setValue_unavailable,!t){console.warn("THREE.PropertyBinding: No target node found for track: "+this.path+".");return}if(n){let c=e.objectIndex;switch(n){case"materials":if(!t.material){console.error("THREE.PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!t.material.materials){console.error("THREE.PropertyBinding: Can not bind to material.materials as node.material does not have a materials array.",this);return}t=t.material.materials;break;case"bones":if(!t.skeleton){console.error("THREE.PropertyBinding: Can not bind to bones as node does not have a skeleton.",this);return}t=t.skeleton.bones;for(let u=0;u<t.length;u++)if(t[u].name===c){c=u;break}break;case"map":if("map"in t){t=t.map;break}if(!t.material){console.error("THREE.PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!t.material.map){console.error("THREE.PropertyBinding: Can not bind to material.map as node.material does not have a map.",this);return}t=t.material.map;break;default:if(t[n]===void 0){console.error("THREE.PropertyBinding: Can not bind to objectName of node undefined.",this);return}t=t[n]}if(c!==void 0){if(t[c]===void 0){console.error("THREE.PropertyBinding: Trying to bind to objectIndex of objectName, but is undefined.",this,t);return}t=t[c]}}let o=t[s];if(o===void 0){let c=e.nodeName;console.error("THREE.PropertyBinding: Trying to update property for track: "+c+"."+s+" but it wasn't found.",t);return}let a=this.Versioning.None;this.targetObject=t,t.needsUpdate!==void 0?a=this.Versioning.NeedsUpdate:t.matrixWorldNeedsUpdate!==void 0&&(a=this.Versioning.MatrixWorldNeedsUpdate);let l=this.BindingType.Direct;if(r!==void 0){if(s==="morphTargetInfluences"){if(!t.geometry){console.error("THREE.PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.",this);return}if(!t.geometry.morphAttributes){console.error("THREE.PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.morphAttributes.",this);return}t.morphTargetDictionary[r]!==void 0&&(r=t.morphTargetDictionary[r])}l=this.BindingType.ArrayElement,this.resolvedProperty=o,this.propertyIndex=r}else o.fromArray!==void 0&&o.toArray!==void 0?(l=this.BindingType.HasFromToArray,this.resolvedProperty=o):Array.isArray(o)?(l=this.BindingType.EntireArray,this.resolvedProperty=o):this.propertyName=s;this.getValue=this.GetterByBindingType[l],this.setValue=this.SetterByBindingTypeAndVersioning[l][a]}unbind(){this.node=null,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}};Me.Composite=hh;Me.prototype.BindingType={Direct:0,EntireArray:1,ArrayElement:2,HasFromToArray:3};Me.prototype.Versioning={None:0,NeedsUpdate:1,MatrixWorldNeedsUpdate:2};Me.prototype.GetterByBindingType=[Me.prototype._getValue_direct,Me.prototype._getValue_array,Me.prototype._getValue_arrayElement,Me.prototype._getValue_toArray];Me.prototype.SetterByBindingTypeAndVersioning=[[Me.prototype._setValue_direct,Me.prototype._setValue_direct_setNeedsUpdate,Me.prototype._setValue_direct_setMatrixWorldNeedsUpdate],[Me.prototype._setValue_array,Me.prototype._setValue_array_setNeedsUpdate,Me.prototype._setValue_array_setMatrixWorldNeedsUpdate],[Me.prototype._setValue_arrayElement,Me.prototype._setValue_arrayElement_setNeedsUpdate,Me.prototype._setValue_arrayElement_setMatrixWorldNeedsUpdate],[Me.prototype._setValue_fromArray,Me.prototype._setValue_fromArray_setNeedsUpdate,Me.prototype._setValue_fromArray_setMatrixWorldNeedsUpdate]];var DS=new Float32Array(1);var So=class{constructor(t=1,e=0,n=0){return this.radius=t,this.phi=e,this.theta=n,this}set(t,e,n){return this.radius=t,this.phi=e,this.theta=n,this}copy(t){return this.radius=t.radius,this.phi=t.phi,this.theta=t.theta,this}makeSafe(){return this.phi=Math.max(1e-6,Math.min(Math.PI-1e-6,this.phi)),this}setFromVector3(t){return this.setFromCartesianCoords(t.x,t.y,t.z)}setFromCartesianCoords(t,e,n){return this.radius=Math.sqrt(t*t+e*e+n*n),this.radius===0?(this.theta=0,this.phi=0):(this.theta=Math.atan2(t,n),this.phi=Math.acos(vn(e/this.radius,-1,1))),this}clone(){return new this.constructor().copy(this)}};var Qa=class extends jc{constructor(t=10,e=10,n=4473924,s=8947848){n=new ce(n),s=new ce(s);let r=e/2,o=t/e,a=t/2,l=[],c=[];for(let h=0,p=0,g=-a;h<=e;h++,g+=o){l.push(-a,0,g,a,0,g),l.push(g,0,-a,g,0,a);let v=h===r?n:s;v.toArray(c,p),p+=3,v.toArray(c,p),p+=3,v.toArray(c,p),p+=3,v.toArray(c,p),p+=3}let u=new Cn;u.setAttribute("position",new en(l,3)),u.setAttribute("color",new en(c,3));let d=new Ir({vertexColors:!0,toneMapped:!1});super(u,d),this.type="GridHelper"}dispose(){this.geometry.dispose(),this.material.dispose()}};typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("register",{detail:{revision:uh}}));typeof window<"u"&&(window.__THREE__?console.warn("WARNING: Multiple instances of Three.js being imported."):window.__THREE__=uh);var Vf={type:"change"},vh={type:"start"},Hf={type:"end"},sl=new Ar,Gf=new oi,HM=Math.cos(70*Pf.DEG2RAD),rl=class extends bi{constructor(t,e){super(),this.object=t,this.domElement=e,this.domElement.style.touchAction="none",this.enabled=!0,this.target=new V,this.cursor=new V,this.minDistance=0,this.maxDistance=1/0,this.minZoom=0,this.maxZoom=1/0,this.minTargetRadius=0,this.maxTargetRadius=1/0,this.minPolarAngle=0,this.maxPolarAngle=Math.PI,this.minAzimuthAngle=-1/0,this.maxAzimuthAngle=1/0,this.enableDamping=!1,this.dampingFactor=.05,this.enableZoom=!0,this.zoomSpeed=1,this.enableRotate=!0,this.rotateSpeed=1,this.enablePan=!0,this.panSpeed=1,this.screenSpacePanning=!0,this.keyPanSpeed=7,this.zoomToCursor=!1,this.autoRotate=!1,this.autoRotateSpeed=2,this.keys={LEFT:"ArrowLeft",UP:"ArrowUp",RIGHT:"ArrowRight",BOTTOM:"ArrowDown"},this.mouseButtons={LEFT:Ps.ROTATE,MIDDLE:Ps.DOLLY,RIGHT:Ps.PAN},this.touches={ONE:Ls.ROTATE,TWO:Ls.DOLLY_PAN},this.target0=this.target.clone(),this.position0=this.object.position.clone(),this.zoom0=this.object.zoom,this._domElementKeyEvents=null,this.getPolarAngle=function(){return a.phi},this.getAzimuthalAngle=function(){return a.theta},this.getDistance=function(){return this.object.position.distanceTo(this.target)},this.listenToKeyEvents=function(y){y.addEventListener("keydown",yt),this._domElementKeyEvents=y},this.stopListenToKeyEvents=function(){this._domElementKeyEvents.removeEventListener("keydown",yt),this._domElementKeyEvents=null},this.saveState=function(){n.target0.copy(n.target),n.position0.copy(n.object.position),n.zoom0=n.object.zoom},this.reset=function(){n.target.copy(n.target0),n.object.position.copy(n.position0),n.object.zoom=n.zoom0,n.object.updateProjectionMatrix(),n.dispatchEvent(Vf),n.update(),r=s.NONE},this.update=function(){let y=new V,j=new On().setFromUnitVectors(t.up,new V(0,1,0)),Y=j.clone().invert(),it=new V,ht=new On,Ft=new V,Kt=2*Math.PI;return function(Be=null){let Mt=n.object.position;y.copy(Mt).sub(n.target),y.applyQuaternion(j),a.setFromVector3(y),n.autoRotate&&r===s.NONE&&z(x(Be)),n.enableDamping?(a.theta+=l.theta*n.dampingFactor,a.phi+=l.phi*n.dampingFactor):(a.theta+=l.theta,a.phi+=l.phi);let Ee=n.minAzimuthAngle,oe=n.maxAzimuthAngle;isFinite(Ee)&&isFinite(oe)&&(Ee<-Math.PI?Ee+=Kt:Ee>Math.PI&&(Ee-=Kt),oe<-Math.PI?oe+=Kt:oe>Math.PI&&(oe-=Kt),Ee<=oe?a.theta=Math.max(Ee,Math.min(oe,a.theta)):a.theta=a.theta>(Ee+oe)/2?Math.max(Ee,a.theta):Math.min(oe,a.theta)),a.phi=Math.max(n.minPolarAngle,Math.min(n.maxPolarAngle,a.phi)),a.makeSafe(),n.enableDamping===!0?n.target.addScaledVector(u,n.dampingFactor):n.target.add(u),n.target.sub(n.cursor),n.target.clampLength(n.minTargetRadius,n.maxTargetRadius),n.target.add(n.cursor);let ze=!1;if(n.zoomToCursor&&L||n.object.isOrthographicCamera)a.radius=dt(a.radius);else{let We=a.radius;a.radius=dt(a.radius*c),ze=We!=a.radius}if(y.setFromSpherical(a),y.applyQuaternion(Y),Mt.copy(n.target).add(y),n.object.lookAt(n.target),n.enableDamping===!0?(l.theta*=1-n.dampingFactor,l.phi*=1-n.dampingFactor,u.multiplyScalar(1-n.dampingFactor)):(l.set(0,0,0),u.set(0,0,0)),n.zoomToCursor&&L){let We=null;if(n.object.isPerspectiveCamera){let xn=y.length();We=dt(xn*c);let Xe=xn-We;n.object.position.addScaledVector(A,Xe),n.object.updateMatrixWorld(),ze=!!Xe}else if(n.object.isOrthographicCamera){let xn=new V(N.x,N.y,0);xn.unproject(n.object);let Xe=n.object.zoom;n.object.zoom=Math.max(n.minZoom,Math.min(n.maxZoom,n.object.zoom/c)),n.object.updateProjectionMatrix(),ze=Xe!==n.object.zoom;let Rn=new V(N.x,N.y,0);Rn.unproject(n.object),n.object.position.sub(Rn).add(xn),n.object.updateMatrixWorld(),We=y.length()}else console.warn("WARNING: OrbitControls.js encountered an unknown camera type - zoom to cursor disabled."),n.zoomToCursor=!1;We!==null&&(this.screenSpacePanning?n.target.set(0,0,-1).transformDirection(n.object.matrix).multiplyScalar(We).add(n.object.position):(sl.origin.copy(n.object.position),sl.direction.set(0,0,-1).transformDirection(n.object.matrix),Math.abs(n.object.up.dot(sl.direction))<HM?t.lookAt(n.target):(Gf.setFromNormalAndCoplanarPoint(n.object.up,n.target),sl.intersectPlane(Gf,n.target))))}else if(n.object.isOrthographicCamera){let We=n.object.zoom;n.object.zoom=Math.max(n.minZoom,Math.min(n.maxZoom,n.object.zoom/c)),We!==n.object.zoom&&(n.object.updateProjectionMatrix(),ze=!0)}return c=1,L=!1,ze||it.distanceToSquared(n.object.position)>o||8*(1-ht.dot(n.object.quaternion))>o||Ft.distanceToSquared(n.target)>o?(n.dispatchEvent(Vf),it.copy(n.object.position),ht.copy(n.object.quaternion),Ft.copy(n.target),!0):!1}}(),this.dispose=function(){n.domElement.removeEventListener("contextmenu",Et),n.domElement.removeEventListener("pointerdown",Se),n.domElement.removeEventListener("pointercancel",w),n.domElement.removeEventListener("wheel",rt),n.domElement.removeEventListener("pointermove",D),n.domElement.removeEventListener("pointerup",w),n.domElement.getRootNode().removeEventListener("keydown",At,{capture:!0}),n._domElementKeyEvents!==null&&(n._domElementKeyEvents.removeEventListener("keydown",yt),n._domElementKeyEvents=null)};let n=this,s={NONE:-1,ROTATE:0,DOLLY:1,PAN:2,TOUCH_ROTATE:3,TOUCH_PAN:4,TOUCH_DOLLY_PAN:5,TOUCH_DOLLY_ROTATE:6},r=s.NONE,o=1e-6,a=new So,l=new So,c=1,u=new V,d=new Jt,h=new Jt,p=new Jt,g=new Jt,v=new Jt,m=new Jt,f=new Jt,T=new Jt,b=new Jt,A=new V,N=new Jt,L=!1,C=[],F={},S=!1;function x(y){return y!==null?2*Math.PI/60*n.autoRotateSpeed*y:2*Math.PI/60/60*n.autoRotateSpeed}function R(y){let j=Math.abs(y*.01);return Math.pow(.95,n.zoomSpeed*j)}function z(y){l.theta-=y}function B(y){l.phi-=y}let X=function(){let y=new V;return function(Y,it){y.setFromMatrixColumn(it,0),y.multiplyScalar(-Y),u.add(y)}}(),J=function(){let y=new V;return function(Y,it){n.screenSpacePanning===!0?y.setFromMatrixColumn(it,1):(y.setFromMatrixColumn(it,0),y.crossVectors(n.object.up,y)),y.multiplyScalar(Y),u.add(y)}}(),q=function(){let y=new V;return function(Y,it){let ht=n.domElement;if(n.object.isPerspectiveCamera){let Ft=n.object.position;y.copy(Ft).sub(n.target);let Kt=y.length();Kt*=Math.tan(n.object.fov/2*Math.PI/180),X(2*Y*Kt/ht.clientHeight,n.object.matrix),J(2*it*Kt/ht.clientHeight,n.object.matrix)}else n.object.isOrthographicCamera?(X(Y*(n.object.right-n.object.left)/n.object.zoom/ht.clientWidth,n.object.matrix),J(it*(n.object.top-n.object.bottom)/n.object.zoom/ht.clientHeight,n.object.matrix)):(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - pan disabled."),n.enablePan=!1)}}();function st(y){n.object.isPerspectiveCamera||n.object.isOrthographicCamera?c/=y:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),n.enableZoom=!1)}function nt(y){n.object.isPerspectiveCamera||n.object.isOrthographicCamera?c*=y:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),n.enableZoom=!1)}function gt(y,j){if(!n.zoomToCursor)return;L=!0;let Y=n.domElement.getBoundingClientRect(),it=y-Y.left,ht=j-Y.top,Ft=Y.width,Kt=Y.height;N.x=it/Ft*2-1,N.y=-(ht/Kt)*2+1,A.set(N.x,N.y,1).unproject(n.object).sub(n.object.position).normalize()}function dt(y){return Math.max(n.minDistance,Math.min(n.maxDistance,y))}function pt(y){d.set(y.clientX,y.clientY)}function mt(y){gt(y.clientX,y.clientX),f.set(y.clientX,y.clientY)}function kt(y){g.set(y.clientX,y.clientY)}function Q(y){h.set(y.clientX,y.clientY),p.subVectors(h,d).multiplyScalar(n.rotateSpeed);let j=n.domElement;z(2*Math.PI*p.x/j.clientHeight),B(2*Math.PI*p.y/j.clientHeight),d.copy(h),n.update()}function ct(y){T.set(y.clientX,y.clientY),b.subVectors(T,f),b.y>0?st(R(b.y)):b.y<0&&nt(R(b.y)),f.copy(T),n.update()}function Rt(y){v.set(y.clientX,y.clientY),m.subVectors(v,g).multiplyScalar(n.panSpeed),q(m.x,m.y),g.copy(v),n.update()}function ft(y){gt(y.clientX,y.clientY),y.deltaY<0?nt(R(y.deltaY)):y.deltaY>0&&st(R(y.deltaY)),n.update()}function Ht(y){let j=!1;switch(y.code){case n.keys.UP:y.ctrlKey||y.metaKey||y.shiftKey?B(2*Math.PI*n.rotateSpeed/n.domElement.clientHeight):q(0,n.keyPanSpeed),j=!0;break;case n.keys.BOTTOM:y.ctrlKey||y.metaKey||y.shiftKey?B(-2*Math.PI*n.rotateSpeed/n.domElement.clientHeight):q(0,-n.keyPanSpeed),j=!0;break;case n.keys.LEFT:y.ctrlKey||y.metaKey||y.shiftKey?z(2*Math.PI*n.rotateSpeed/n.domElement.clientHeight):q(n.keyPanSpeed,0),j=!0;break;case n.keys.RIGHT:y.ctrlKey||y.metaKey||y.shiftKey?z(-2*Math.PI*n.rotateSpeed/n.domElement.clientHeight):q(-n.keyPanSpeed,0),j=!0;break}j&&(y.preventDefault(),n.update())}function Bt(y){if(C.length===1)d.set(y.pageX,y.pageY);else{let j=Zt(y),Y=.5*(y.pageX+j.x),it=.5*(y.pageY+j.y);d.set(Y,it)}}function Nt(y){if(C.length===1)g.set(y.pageX,y.pageY);else{let j=Zt(y),Y=.5*(y.pageX+j.x),it=.5*(y.pageY+j.y);g.set(Y,it)}}function O(y){let j=Zt(y),Y=y.pageX-j.x,it=y.pageY-j.y,ht=Math.sqrt(Y*Y+it*it);f.set(0,ht)}function jt(y){n.enableZoom&&O(y),n.enablePan&&Nt(y)}function te(y){n.enableZoom&&O(y),n.enableRotate&&Bt(y)}function fe(y){if(C.length==1)h.set(y.pageX,y.pageY);else{let Y=Zt(y),it=.5*(y.pageX+Y.x),ht=.5*(y.pageY+Y.y);h.set(it,ht)}p.subVectors(h,d).multiplyScalar(n.rotateSpeed);let j=n.domElement;z(2*Math.PI*p.x/j.clientHeight),B(2*Math.PI*p.y/j.clientHeight),d.copy(h)}function Ut(y){if(C.length===1)v.set(y.pageX,y.pageY);else{let j=Zt(y),Y=.5*(y.pageX+j.x),it=.5*(y.pageY+j.y);v.set(Y,it)}m.subVectors(v,g).multiplyScalar(n.panSpeed),q(m.x,m.y),g.copy(v)}function se(y){let j=Zt(y),Y=y.pageX-j.x,it=y.pageY-j.y,ht=Math.sqrt(Y*Y+it*it);T.set(0,ht),b.set(0,Math.pow(T.y/f.y,n.zoomSpeed)),st(b.y),f.copy(T);let Ft=(y.pageX+j.x)*.5,Kt=(y.pageY+j.y)*.5;gt(Ft,Kt)}function Yt(y){n.enableZoom&&se(y),n.enablePan&&Ut(y)}function zt(y){n.enableZoom&&se(y),n.enableRotate&&fe(y)}function Se(y){n.enabled!==!1&&(C.length===0&&(n.domElement.setPointerCapture(y.pointerId),n.domElement.addEventListener("pointermove",D),n.domElement.addEventListener("pointerup",w)),!xt(y)&&(Gt(y),y.pointerType==="touch"?Wt(y):G(y)))}function D(y){n.enabled!==!1&&(y.pointerType==="touch"?lt(y):tt(y))}function w(y){switch(It(y),C.length){case 0:n.domElement.releasePointerCapture(y.pointerId),n.domElement.removeEventListener("pointermove",D),n.domElement.removeEventListener("pointerup",w),n.dispatchEvent(Hf),r=s.NONE;break;case 1:let j=C[0],Y=F[j];Wt({pointerId:j,pageX:Y.x,pageY:Y.y});break}}function G(y){let j;switch(y.button){case 0:j=n.mouseButtons.LEFT;break;case 1:j=n.mouseButtons.MIDDLE;break;case 2:j=n.mouseButtons.RIGHT;break;default:j=-1}switch(j){case Ps.DOLLY:if(n.enableZoom===!1)return;mt(y),r=s.DOLLY;break;case Ps.ROTATE:if(y.ctrlKey||y.metaKey||y.shiftKey){if(n.enablePan===!1)return;kt(y),r=s.PAN}else{if(n.enableRotate===!1)return;pt(y),r=s.ROTATE}break;case Ps.PAN:if(y.ctrlKey||y.metaKey||y.shiftKey){if(n.enableRotate===!1)return;pt(y),r=s.ROTATE}else{if(n.enablePan===!1)return;kt(y),r=s.PAN}break;default:r=s.NONE}r!==s.NONE&&n.dispatchEvent(vh)}function tt(y){switch(r){case s.ROTATE:if(n.enableRotate===!1)return;Q(y);break;case s.DOLLY:if(n.enableZoom===!1)return;ct(y);break;case s.PAN:if(n.enablePan===!1)return;Rt(y);break}}function rt(y){n.enabled===!1||n.enableZoom===!1||r!==s.NONE||(y.preventDefault(),n.dispatchEvent(vh),ft(et(y)),n.dispatchEvent(Hf))}function et(y){let j=y.deltaMode,Y={clientX:y.clientX,clientY:y.clientY,deltaY:y.deltaY};switch(j){case 1:Y.deltaY*=16;break;case 2:Y.deltaY*=100;break}return y.ctrlKey&&!S&&(Y.deltaY*=10),Y}function At(y){y.key==="Control"&&(S=!0,n.domElement.getRootNode().addEventListener("keyup",vt,{passive:!0,capture:!0}))}function vt(y){y.key==="Control"&&(S=!1,n.domElement.getRootNode().removeEventListener("keyup",vt,{passive:!0,capture:!0}))}function yt(y){n.enabled===!1||n.enablePan===!1||Ht(y)}function Wt(y){switch(Xt(y),C.length){case 1:switch(n.touches.ONE){case Ls.ROTATE:if(n.enableRotate===!1)return;Bt(y),r=s.TOUCH_ROTATE;break;case Ls.PAN:if(n.enablePan===!1)return;Nt(y),r=s.TOUCH_PAN;break;default:r=s.NONE}break;case 2:switch(n.touches.TWO){case Ls.DOLLY_PAN:if(n.enableZoom===!1&&n.enablePan===!1)return;jt(y),r=s.TOUCH_DOLLY_PAN;break;case Ls.DOLLY_ROTATE:if(n.enableZoom===!1&&n.enableRotate===!1)return;te(y),r=s.TOUCH_DOLLY_ROTATE;break;default:r=s.NONE}break;default:r=s.NONE}r!==s.NONE&&n.dispatchEvent(vh)}function lt(y){switch(Xt(y),r){case s.TOUCH_ROTATE:if(n.enableRotate===!1)return;fe(y),n.update();break;case s.TOUCH_PAN:if(n.enablePan===!1)return;Ut(y),n.update();break;case s.TOUCH_DOLLY_PAN:if(n.enableZoom===!1&&n.enablePan===!1)return;Yt(y),n.update();break;case s.TOUCH_DOLLY_ROTATE:if(n.enableZoom===!1&&n.enableRotate===!1)return;zt(y),n.update();break;default:r=s.NONE}}function Et(y){n.enabled!==!1&&y.preventDefault()}function Gt(y){C.push(y.pointerId)}function It(y){delete F[y.pointerId];for(let j=0;j<C.length;j++)if(C[j]==y.pointerId){C.splice(j,1);return}}function xt(y){for(let j=0;j<C.length;j++)if(C[j]==y.pointerId)return!0;return!1}function Xt(y){let j=F[y.pointerId];j===void 0&&(j=new Jt,F[y.pointerId]=j),j.set(y.pageX,y.pageY)}function Zt(y){let j=y.pointerId===C[0]?C[1]:C[0];return F[j]}n.domElement.addEventListener("contextmenu",Et),n.domElement.addEventListener("pointerdown",Se),n.domElement.addEventListener("pointercancel",w),n.domElement.addEventListener("wheel",rt,{passive:!1}),n.domElement.getRootNode().addEventListener("keydown",At,{passive:!0,capture:!0}),this.update()}};function yh(i,t){if(i.isJoints)return i.told>0?[t[0],t[1],t[2]]:null;let e=[0,0,0],n=0;for(let s=0;s<i.points;++s)if(!(!i.isShown(s)||Number.isNaN(t[3*s]))){for(let r=0;r<3;++r)e[r]+=t[3*s+r];++n}return n>0?[e[0]/n,e[1]/n,e[2]/n]:null}function GM(i,t,[e,n,s]){let r=[];for(let a of t)for(let l=0;l<i.points;++l)i.isShown(l)&&!Number.isNaN(a[3*l])&&r.push(Math.hypot(a[3*l]-e,a[3*l+1]-n,a[3*l+2]-s));r.sort((a,l)=>a-l);let{height:o}=i.data.stage;for(let a=1;a<=Math.min(2,r.length-1);++a){let l=r.length-1-a;if(r[l+1]-r[l]>o)return r[l]}return r[r.length-1]??0}function Wf(i){let t=i.takes.map(()=>new Float32Array(3*i.points)),e=Math.max(1,Math.ceil(i.told/1e3)),n=0;for(let s=0;s<i.told;s+=e){i.takes.forEach((o,a)=>i.pose(s,o,t[a]));let r=yh(i,t[t.length-1]);r!==null&&(n=Math.max(n,GM(i,t,r)))}return 2*n+.15*i.data.stage.height}var Fr={x:new V(1,0,0),y:new V(0,1,0),z:new V(0,0,1)},WM=.5,xh=class{constructor(t,e,n,s){this.take=t;this.which=e;this.size=n;this.name=s;this.group=new Mi;this.bones=null;this.links=[];this.matrix=new ve;this.pose=new Float32Array(3*t.points);let r=e==="before"&&t.data.two;this.material=new Ya({transparent:r,opacity:r?.55:1});let o=n*(t.isJoints?.012:.011);this.balls=new Lr(new Dr(o,12,8),this.material,Math.max(1,t.points)),this.balls.frustumCulled=!1,this.group.add(this.balls);let a=t.data.skeleton;if(a?(a.parents.forEach((l,c)=>{l>=0&&this.links.push([l,c])}),a.ends.forEach((l,c)=>this.links.push([l.parent,a.parents.length+c]))):this.links.push(...t.data.links??[]),this.links.length>0){let l=a?new as(n*.004,n*.01,1,8):new as(n*.003,n*.003,1,6);l.translate(0,.5,0),this.bones=new Lr(l,this.material,this.links.length),this.bones.frustumCulled=!1,this.group.add(this.bones)}}paint(){this.material.color.set(Le(this.name))}at(t){let e=this.pose[3*t];return Number.isNaN(e)?null:new V(e,this.pose[3*t+1],this.pose[3*t+2])}show(t,e){this.take.pose(t,this.which,this.pose);let n=new ve().makeScale(0,0,0);for(let s=0;s<this.take.points;++s){let r=this.take.isShown(s)?this.at(s):null,o=e.includes(s)?1.9:1;this.balls.setMatrixAt(s,r===null?n:this.matrix.makeScale(o,o,o).setPosition(r))}this.balls.instanceMatrix.needsUpdate=!0,this.bones!==null&&(this.links.forEach(([s,r],o)=>this.bones?.setMatrixAt(o,this.bone(s,r)??n)),this.bones.instanceMatrix.needsUpdate=!0)}bone(t,e){let n=this.at(t),s=this.at(e);if(n===null||s===null)return null;let r=s.clone().sub(n),o=r.length();if(o<1e-9*this.size)return null;let a=new On().setFromUnitVectors(Fr.y,r.divideScalar(o));return this.matrix.compose(n,a,new V(1,o,1)).clone()}centre(){let t=yh(this.take,this.pose);return t===null?null:new V(...t)}},XM=null;function Xf(){try{return XM??=new Ga({antialias:!0,alpha:!0,preserveDrawingBuffer:!0})}catch{return null}}var ol=class{constructor(t,e,n,s){this.holder=t;this.take=e;this.player=n;this.options={before:!0,after:!0,apart:!1,follow:!0};this.figures=[];this.scene=new Wa;this.floor=new Mi;this.trails=new Mi;this.centre=new V;this.unseen=U("p",{class:"unseen",hidden:!0},"Every marker is missing in this frame.");this.tip=U("p",{class:"tip",hidden:!0});this.waiting=!1;this.ended=!1;this.distance=null;let{stage:r}=e.data;this.size=r.height,this.up=Fr[r.up].clone().multiplyScalar(r.sign),this.across=Fr[r.up==="x"?"y":"x"].clone(),this.ahead=this.across.clone().cross(this.up),this.renderer=s,this.renderer.setPixelRatio(Math.min(2,window.devicePixelRatio)),this.camera=new An(35,1,this.size/50,this.size*200),this.camera.up.copy(this.up),t.append(this.renderer.domElement),this.gizmo=document.createElementNS("http://www.w3.org/2000/svg","svg"),this.gizmo.setAttribute("class","axes"),this.gizmo.setAttribute("viewBox","-30 -30 60 60"),this.gizmo.setAttribute("aria-hidden","true"),t.append(this.gizmo,this.unseen,this.tip);let o=`${e.data.names.length} ${e.isJoints?"joints":"markers"}`;Zs(this.renderer.domElement,`The body in 3D, ${o}${e.data.two?`: ${e.data.labels.join(" and ")}`:""}`),t.addEventListener("pointermove",l=>this.point(l)),t.addEventListener("pointerleave",()=>{this.tip.hidden=!0}),this.controls=new rl(this.camera,this.renderer.domElement),this.controls.addEventListener("change",()=>{this.place(),this.draw()}),this.scene.add(new Ka(16777215,8947848,2.6));let a=new ja(16777215,1.2);a.position.copy(this.up).multiplyScalar(3).add(this.ahead).add(this.across),this.scene.add(a,this.floor,this.trails),this.soles=new Lr(new as(this.size*.035,this.size*.035,this.size*.002,20),new Cr({transparent:!0,opacity:.8}),64),this.soles.frustumCulled=!1,this.scene.add(this.soles);for(let l of e.takes)this.figures.push(new xh(e,l,this.size,e.data.two?l:"after"));for(let l of this.figures)this.scene.add(l.group);this.paint(),this.refresh(),this.look("orbit"),n.onMove(()=>this.refresh()),n.onChoice(()=>this.refresh()),new ResizeObserver(()=>this.resize()).observe(t),this.resize()}nameOf(t){let{names:e,skeleton:n}=this.take.data;if(t<e.length)return this.take.nameOf(t);let s=n?.ends[t-e.length]?.parent??0;return`end of ${e[s]}`}point(t){let{left:n,top:s,width:r,height:o}=this.holder.getBoundingClientRect(),[a,l]=[t.clientX-n,t.clientY-s];this.camera.updateMatrixWorld();let c=14,u="";for(let d of this.figures)if(this.isOn(d))for(let h=0;h<this.take.points;++h){let p=this.take.isShown(h)?d.at(h):null;if(p===null)continue;p.add(d.group.position).project(this.camera);let g=Math.hypot((p.x+1)/2*r-a,(1-p.y)/2*o-l);p.z>1||g>=c||(c=g,u=this.nameOf(h))}this.tip.hidden=u==="",u!==""&&(this.tip.textContent=u,this.tip.style.transform=`translate(${a}px, ${l}px) translate(${a>r/2?"calc(-100% - 12px)":"12px"}, ${l>o/2?"-100%":"0"})`)}get main(){return this.figures[this.figures.length-1]}isOn(t){return!this.take.data.two||this.options[t.which]}get apart(){return!this.options.apart||!this.take.data.two?0:this.distance??=Wf(this.take)}place(){let t=new V(0,1,0).applyQuaternion(this.camera.quaternion),e=this.centre.clone().sub(this.camera.position).cross(t).normalize();for(let n of this.figures)n.group.position.copy(e).multiplyScalar((n.which==="before"?-.5:.5)*this.apart);this.soles.position.copy(this.main.group.position);for(let n of this.trails.children)n.position.copy(n.userData.figure.group.position)}setApart(t){let e=this.ball().radius;this.options.apart=t;let n=this.camera.position.clone().sub(this.controls.target).multiplyScalar(this.ball().radius/e);this.camera.position.copy(this.controls.target).add(n),this.controls.update(),this.refresh()}extent(){let t=new Jn,e=Math.min(60,this.take.told),n=new Float32Array(3*this.take.points);for(let s=0;s<e;++s){this.take.pose(Math.floor(s*this.take.told/e),this.take.last,n);for(let r=0;r<this.take.points;++r)this.take.isShown(r)&&!Number.isNaN(n[3*r])&&t.expandByPoint(new V(n[3*r],n[3*r+1],n[3*r+2]))}return t}ball(){let t=new Jn,e=this.main.centre()??new V;for(let s=0;s<this.take.points;++s){let r=this.take.isShown(s)?this.main.at(s):null;r!==null&&r.distanceTo(e)<1.5*this.size&&t.expandByPoint(r)}if(t.isEmpty())return new li(e,.6*this.size+this.apart/2);let n=t.getBoundingSphere(new li);return n.radius=Math.max(n.radius,.3*this.size)+this.apart/2,n}paint(){for(let a of this.figures)a.paint();this.soles.material.color.set(Le("held")),this.floor.clear();let t=this.extent(),e=t.isEmpty()?new V:t.getCenter(new V),n=t.isEmpty()?this.size:t.getSize(new V).length(),s=this.size/3.4,r=Math.min(120,2*Math.ceil((n*.6+1.5*this.size)/s)),o=new Qa(r*s,r,Le("grid-strong"),Le("grid"));o.quaternion.setFromUnitVectors(Fr.y,this.up),e.addScaledVector(this.up,this.take.data.stage.floor-e.dot(this.up)),o.position.copy(e),this.floor.add(o),this.trace(),this.draw()}resize(){let{clientWidth:t,clientHeight:e}=this.holder;t===0||e===0||(this.renderer.setSize(t,e,!1),this.camera.aspect=t/e,this.camera.updateProjectionMatrix(),this.draw())}look(t){let{center:e,radius:n}=this.ball(),s=Math.min(1,this.camera.aspect),r=1.1*n/(Math.sin(this.camera.fov*Math.PI/360)*s),o={orbit:this.ahead.clone().multiplyScalar(.8).addScaledVector(this.across,.6).addScaledVector(this.up,.22),front:this.ahead.clone(),side:this.across.clone(),top:this.up.clone().addScaledVector(this.ahead,.001)}[t].normalize();this.controls.target.copy(e),this.camera.position.copy(e).addScaledVector(o,r),this.centre=this.main.centre()??this.centre,this.controls.update(),this.place(),this.draw()}recentre(){let t=this.ball().center.sub(this.controls.target);this.camera.position.add(t),this.controls.target.add(t),this.draw()}follow(){let t=this.main.centre();if(t===null)return;let e=t.clone().sub(this.centre);e.addScaledVector(this.up,-e.dot(this.up)),this.centre=t,this.options.follow&&(this.camera.position.add(e),this.controls.target.add(e))}refresh(){for(let t of this.figures)t.group.visible=this.isOn(t),this.take.told>0&&t.show(this.player.shown,this.player.chosen);this.unseen.hidden=this.main.centre()!==null,this.stand(),this.follow(),this.trace(),this.place(),this.draw()}stand(){let t=this.player.shown*this.take.data.step,e=new On().setFromUnitVectors(Fr.y,this.up),{floor:n,contacts:s}=this.take.data.stage,r=0;for(let o of s)if(!(t<o.first||t>o.last))for(let a of o.points.slice(0,3)){let l=this.main.at(a);l===null||r>=64||(l.addScaledVector(this.up,n-l.dot(this.up)),this.soles.setMatrixAt(r++,new ve().compose(l,e,new V(1,1,1))))}this.soles.count=r,this.soles.instanceMatrix.needsUpdate=!0}trace(){for(let r of this.trails.children)r.geometry.dispose();if(this.trails.clear(),this.take.told===0||this.player.chosen.length===0)return;let t=Math.max(2,Math.round(WM*this.take.rate)),e=Math.max(0,this.player.shown-t),n=Math.min(this.take.told-1,this.player.shown+t),s=Math.max(1,Math.floor((n-e)/60));for(let r of this.figures){if(!this.isOn(r))continue;let o=this.player.chosen.map(()=>[]);for(let l=e;l<=n;l+=s){let c=this.take.pose(l,r.which);this.player.chosen.forEach((u,d)=>{Number.isNaN(c[3*u])||o[d].push(new V(c[3*u],c[3*u+1],c[3*u+2]))})}let a=new Ir({color:Le(this.take.data.two?r.which:"after")});for(let l of o){let c=new wo(new Cn().setFromPoints(l),a);c.userData={figure:r},c.position.copy(r.group.position),c.frustumCulled=!1,this.trails.add(c)}}}draw(){this.waiting||(this.waiting=!0,requestAnimationFrame(()=>{this.waiting=!1,!this.ended&&(this.renderer.render(this.scene,this.camera),this.drawAxes())}))}drawAxes(){let t=this.camera.quaternion.clone().invert();this.gizmo.replaceChildren();let e=[];for(let[n,s]of Object.entries(Fr)){let r=s.clone().applyQuaternion(t),o=(c,u,d="")=>{let h=document.createElementNS("http://www.w3.org/2000/svg",c);for(let[p,g]of Object.entries(u))h.setAttribute(p,String(g));h.textContent=d,this.gizmo.append(h)};o("line",{x1:0,y1:0,x2:17*r.x,y2:-17*r.y});let[a,l]=[23*r.x,-23*r.y];Math.hypot(r.x,r.y)<.15||e.some(c=>Math.hypot(c[0]-a,c[1]-l)<10)||(e.push([a,l]),o("text",{x:a,y:l},n.toUpperCase()))}}viewpoint(){return[this.camera.position.clone(),this.controls.target.clone(),this.centre.clone()]}seeFrom([t,e,n]){let s=this.centre.clone().sub(n);this.camera.position.copy(t).add(s),this.controls.target.copy(e).add(s),this.controls.update(),this.place(),this.draw()}dispose(){this.ended=!0,this.controls.dispose(),this.scene.traverse(t=>{let{geometry:e,material:n}=t;e?.dispose();for(let s of[n??[]].flat())s.dispose()})}seen(t,e=this.main){let n=e.at(t)?.add(e.group.position)??null;if(n===null)return null;this.camera.updateMatrixWorld();let s=n.project(this.camera);return[s.x,s.y]}};var an="u-",$M="uplot",qM=an+"hz",YM=an+"vt",ZM=an+"title",JM=an+"wrap",KM=an+"under",jM=an+"over",QM=an+"axis",Ns=an+"off",tb=an+"select",eb=an+"cursor-x",nb=an+"cursor-y",ib=an+"cursor-pt",sb=an+"legend",rb=an+"live",ob=an+"inline",ab=an+"series",lb=an+"marker",$f=an+"label",cb=an+"value",Ao="width",Co="height",Eo="top",qf="bottom",kr="left",Mh="right",Fh="#000",Yf=Fh+"0",Zf="mousemove",Jf="mousedown",bh="mouseup",Kf="mouseenter",jf="mouseleave",Qf="dblclick",hb="resize",ub="scroll",tp="change",ul="dppxchange",kh="--",$r=typeof window<"u",Ah=$r?document:null,zr=$r?window:null,db=$r?navigator:null,ye,al;function Ch(){let i=devicePixelRatio;ye!=i&&(ye=i,al&&Ph(tp,al,Ch),al=matchMedia(`(min-resolution: ${ye-.001}dppx) and (max-resolution: ${ye+.001}dppx)`),Us(tp,al,Ch),zr.dispatchEvent(new CustomEvent(ul)))}function Hn(i,t){if(t!=null){let e=i.classList;!e.contains(t)&&e.add(t)}}function Rh(i,t){let e=i.classList;e.contains(t)&&e.remove(t)}function Oe(i,t,e){i.style[t]=e+"px"}function hi(i,t,e,n){let s=Ah.createElement(i);return t!=null&&Hn(s,t),e?.insertBefore(s,n),s}function jn(i,t){return hi("div",i,t)}var ep=new WeakMap;function Si(i,t,e,n,s){let r="translate("+t+"px,"+e+"px)",o=ep.get(i);r!=o&&(i.style.transform=r,ep.set(i,r),t<0||e<0||t>n||e>s?Hn(i,Ns):Rh(i,Ns))}var np=new WeakMap;function ip(i,t,e){let n=t+e,s=np.get(i);n!=s&&(np.set(i,n),i.style.background=t,i.style.borderColor=e)}var sp=new WeakMap;function rp(i,t,e,n){let s=t+""+e,r=sp.get(i);s!=r&&(sp.set(i,s),i.style.height=e+"px",i.style.width=t+"px",i.style.marginLeft=n?-t/2+"px":0,i.style.marginTop=n?-e/2+"px":0)}var Bh={passive:!0},fb={...Bh,capture:!0};function Us(i,t,e,n){t.addEventListener(i,e,n?fb:Bh)}function Ph(i,t,e,n){t.removeEventListener(i,e,Bh)}$r&&Ch();function ui(i,t,e,n){let s;e=e||0,n=n||t.length-1;let r=n<=2147483647;for(;n-e>1;)s=r?e+n>>1:Gn((e+n)/2),t[s]<i?e=s:n=s;return i-t[e]<=t[n]-i?e:n}function Vr(i,t,e,n){for(let s=n==1?t:e;s>=t&&s<=e;s+=n)if(i[s]!=null)return s;return-1}function pb(i,t,e,n){let s=ue,r=-ue;if(n==1)s=i[t],r=i[e];else if(n==-1)s=i[e],r=i[t];else for(let o=t;o<=e;o++){let a=i[o];a!=null&&(a<s&&(s=a),a>r&&(r=a))}return[s,r]}function mb(i,t,e){let n=ue,s=-ue;for(let r=t;r<=e;r++){let o=i[r];o!=null&&o>0&&(o<n&&(n=o),o>s&&(s=o))}return[n,s]}function pl(i,t,e,n){let s=lp(i),r=lp(t);i==t&&(s==-1?(i*=e,t/=e):(i/=e,t*=e));let o=e==10?Bi:Dp,a=s==1?Gn:Qn,l=r==1?Qn:Gn,c=a(o(on(i))),u=l(o(on(t))),d=Hr(e,c),h=Hr(e,u);return e==10&&(c<0&&(d=Ce(d,-c)),u<0&&(h=Ce(h,-u))),n||e==2?(i=d*s,t=h*r):(i=Op(i,d),t=ml(t,h)),[i,t]}function zh(i,t,e,n){let s=pl(i,t,e,n);return i==0&&(s[0]=0),t==0&&(s[1]=0),s}var Vh=.1,op={mode:3,pad:Vh},Po={pad:0,soft:null,mode:0},gb={min:Po,max:Po};function dl(i,t,e,n){return gl(e)?ap(i,t,e):(Po.pad=e,Po.soft=n?0:null,Po.mode=n?3:0,ap(i,t,gb))}function _e(i,t){return i??t}function _b(i,t,e){for(t=_e(t,0),e=_e(e,i.length-1);t<=e;){if(i[t]!=null)return!0;t++}return!1}function ap(i,t,e){let n=e.min,s=e.max,r=_e(n.pad,0),o=_e(s.pad,0),a=_e(n.hard,-ue),l=_e(s.hard,ue),c=_e(n.soft,ue),u=_e(s.soft,-ue),d=_e(n.mode,0),h=_e(s.mode,0),p=t-i,g=Bi(p),v=yn(on(i),on(t)),m=Bi(v),f=on(m-g);(p<1e-24||f>10)&&(p=0,(i==0||t==0)&&(p=1e-24,d==2&&c!=ue&&(r=0),h==2&&u!=-ue&&(o=0)));let T=p||v||1e3,b=Bi(T),A=Hr(10,Gn(b)),N=T*(p==0?i==0?.1:1:r),L=Ce(Op(i-N,A/10),24),C=i>=c&&(d==1||d==3&&L<=c||d==2&&L>=c)?c:ue,F=yn(a,L<C&&i>=C?C:ti(C,L)),S=T*(p==0?t==0?.1:1:o),x=Ce(ml(t+S,A/10),24),R=t<=u&&(h==1||h==3&&x>=u||h==2&&x<=u)?u:-ue,z=ti(l,x>R&&t<=R?R:yn(R,x));return F==z&&F==0&&(z=100),[F,z]}var vb=new Intl.NumberFormat($r?db.language:"en-US"),Hh=i=>vb.format(i),Wn=Math,hl=Wn.PI,on=Wn.abs,Gn=Wn.floor,rn=Wn.round,Qn=Wn.ceil,ti=Wn.min,yn=Wn.max,Hr=Wn.pow,lp=Wn.sign,Bi=Wn.log10,Dp=Wn.log2,yb=(i,t=1)=>Wn.sinh(i)*t,wh=(i,t=1)=>Wn.asinh(i/t),ue=1/0;function cp(i){return(Bi((i^i>>31)-(i>>31))|0)+1}function Lh(i,t,e){return ti(yn(i,t),e)}function he(i){return typeof i=="function"?i:()=>i}var xb=()=>{},Np=i=>i,Up=(i,t)=>t,Mb=i=>null,hp=i=>!0,up=(i,t)=>i==t,bb=/\.\d*?(?=9{6,}|0{6,})/gm,Os=i=>{if(kp(i)||hs.has(i))return i;let t=`${i}`,e=t.match(bb);if(e==null)return i;let n=e[0].length-1;if(t.indexOf("e-")!=-1){let[s,r]=t.split("e");return+`${Os(s)}e${r}`}return Ce(i,n)};function Is(i,t){return Os(Ce(Os(i/t))*t)}function ml(i,t){return Os(Qn(Os(i/t))*t)}function Op(i,t){return Os(Gn(Os(i/t))*t)}function Ce(i,t=0){if(kp(i))return i;let e=10**t,n=i*e*(1+Number.EPSILON);return rn(n)/e}var hs=new Map;function Fp(i){return((""+i).split(".")[1]||"").length}function Io(i,t,e,n){let s=[],r=n.map(Fp);for(let o=t;o<e;o++){let a=on(o),l=Ce(Hr(i,o),a);for(let c=0;c<n.length;c++){let u=i==10?+`${n[c]}e${o}`:n[c]*l,d=(o>=0?0:a)+(o>=r[c]?0:r[c]),h=i==10?u:Ce(u,d);s.push(h),hs.set(h,d)}}return s}var Lo={},Gh=[],Gr=[null,null],cs=Array.isArray,kp=Number.isInteger,wb=i=>i===void 0;function dp(i){return typeof i=="string"}function gl(i){let t=!1;if(i!=null){let e=i.constructor;t=e==null||e==Object}return t}function Sb(i){return i!=null&&typeof i=="object"}var Eb=Object.getPrototypeOf(Uint8Array),Bp="__proto__";function Wr(i,t=gl){let e;if(cs(i)){let n=i.find(s=>s!=null);if(cs(n)||t(n)){e=Array(i.length);for(let s=0;s<i.length;s++)e[s]=Wr(i[s],t)}else e=i.slice()}else if(i instanceof Eb)e=i.slice();else if(t(i)){e={};for(let n in i)n!=Bp&&(e[n]=Wr(i[n],t))}else e=i;return e}function Ke(i){let t=arguments;for(let e=1;e<t.length;e++){let n=t[e];for(let s in n)s!=Bp&&(gl(i[s])?Ke(i[s],Wr(n[s])):i[s]=Wr(n[s]))}return i}var Tb=0,Ab=1,Cb=2;function Rb(i,t,e){for(let n=0,s,r=-1;n<t.length;n++){let o=t[n];if(o>r){for(s=o-1;s>=0&&i[s]==null;)i[s--]=null;for(s=o+1;s<e&&i[s]==null;)i[r=s++]=null}}}function Pb(i,t){if(Db(i)){let o=i[0].slice();for(let a=1;a<i.length;a++)o.push(...i[a].slice(1));return Nb(o[0])||(o=Ib(o)),o}let e=new Set;for(let o=0;o<i.length;o++){let l=i[o][0],c=l.length;for(let u=0;u<c;u++)e.add(l[u])}let n=[Array.from(e).sort((o,a)=>o-a)],s=n[0].length,r=new Map;for(let o=0;o<s;o++)r.set(n[0][o],o);for(let o=0;o<i.length;o++){let a=i[o],l=a[0];for(let c=1;c<a.length;c++){let u=a[c],d=Array(s).fill(void 0),h=t?t[o][c]:Ab,p=[];for(let g=0;g<u.length;g++){let v=u[g],m=r.get(l[g]);v===null?h!=Tb&&(d[m]=v,h==Cb&&p.push(m)):d[m]=v}Rb(d,p,s),n.push(d)}}return n}var Lb=typeof queueMicrotask>"u"?i=>Promise.resolve().then(i):queueMicrotask;function Ib(i){let t=i[0],e=t.length,n=Array(e);for(let r=0;r<n.length;r++)n[r]=r;n.sort((r,o)=>t[r]-t[o]);let s=[];for(let r=0;r<i.length;r++){let o=i[r],a=Array(e);for(let l=0;l<e;l++)a[l]=o[n[l]];s.push(a)}return s}function Db(i){let t=i[0][0],e=t.length;for(let n=1;n<i.length;n++){let s=i[n][0];if(s.length!=e)return!1;if(s!=t){for(let r=0;r<e;r++)if(s[r]!=t[r])return!1}}return!0}function Nb(i,t=100){let e=i.length;if(e<=1)return!0;let n=0,s=e-1;for(;n<=s&&i[n]==null;)n++;for(;s>=n&&i[s]==null;)s--;if(s<=n)return!0;let r=yn(1,Gn((s-n+1)/t));for(let o=i[n],a=n+r;a<=s;a+=r){let l=i[a];if(l!=null){if(l<=o)return!1;o=l}}return!0}var zp=["January","February","March","April","May","June","July","August","September","October","November","December"],Vp=["Sunday","Monday","Tuesday","Wednesday","Thursday","Friday","Saturday"];function Hp(i){return i.slice(0,3)}var Ub=Vp.map(Hp),Ob=zp.map(Hp),Fb={MMMM:zp,MMM:Ob,WWWW:Vp,WWW:Ub};function To(i){return(i<10?"0":"")+i}function kb(i){return(i<10?"00":i<100?"0":"")+i}var Bb={YYYY:i=>i.getFullYear(),YY:i=>(i.getFullYear()+"").slice(2),MMMM:(i,t)=>t.MMMM[i.getMonth()],MMM:(i,t)=>t.MMM[i.getMonth()],MM:i=>To(i.getMonth()+1),M:i=>i.getMonth()+1,DD:i=>To(i.getDate()),D:i=>i.getDate(),WWWW:(i,t)=>t.WWWW[i.getDay()],WWW:(i,t)=>t.WWW[i.getDay()],HH:i=>To(i.getHours()),H:i=>i.getHours(),h:i=>{let t=i.getHours();return t==0?12:t>12?t-12:t},AA:i=>i.getHours()>=12?"PM":"AM",aa:i=>i.getHours()>=12?"pm":"am",a:i=>i.getHours()>=12?"p":"a",mm:i=>To(i.getMinutes()),m:i=>i.getMinutes(),ss:i=>To(i.getSeconds()),s:i=>i.getSeconds(),fff:i=>kb(i.getMilliseconds())};function Wh(i,t){t=t||Fb;let e=[],n=/\{([a-z]+)\}|[^{]+/gi,s;for(;s=n.exec(i);)e.push(s[0][0]=="{"?Bb[s[1]]:s[0]);return r=>{let o="";for(let a=0;a<e.length;a++)o+=typeof e[a]=="string"?e[a]:e[a](r,t);return o}}var zb=new Intl.DateTimeFormat().resolvedOptions().timeZone;function Vb(i,t){let e;return t=="UTC"||t=="Etc/UTC"?e=new Date(+i+i.getTimezoneOffset()*6e4):t==zb?e=i:(e=new Date(i.toLocaleString("en-US",{timeZone:t})),e.setMilliseconds(i.getMilliseconds())),e}var Gp=i=>i%1==0,fl=[1,2,2.5,5],Hb=Io(10,-32,0,fl),Wp=Io(10,0,32,fl),Gb=Wp.filter(Gp),Ds=Hb.concat(Wp),Xh=`
`,Xp="{YYYY}",fp=Xh+Xp,$p="{M}/{D}",Ro=Xh+$p,ll=Ro+"/{YY}",qp="{aa}",Wb="{h}:{mm}",Br=Wb+qp,pp=Xh+Br,mp=":{ss}",be=null;function Yp(i){let t=i*1e3,e=t*60,n=e*60,s=n*24,r=s*30,o=s*365,l=(i==1?Io(10,0,3,fl).filter(Gp):Io(10,-3,0,fl)).concat([t,t*5,t*10,t*15,t*30,e,e*5,e*10,e*15,e*30,n,n*2,n*3,n*4,n*6,n*8,n*12,s,s*2,s*3,s*4,s*5,s*6,s*7,s*8,s*9,s*10,s*15,r,r*2,r*3,r*4,r*6,o,o*2,o*5,o*10,o*25,o*50,o*100]),c=[[o,Xp,be,be,be,be,be,be,1],[s*28,"{MMM}",fp,be,be,be,be,be,1],[s,$p,fp,be,be,be,be,be,1],[n,"{h}"+qp,ll,be,Ro,be,be,be,1],[e,Br,ll,be,Ro,be,be,be,1],[t,mp,ll+" "+Br,be,Ro+" "+Br,be,pp,be,1],[i,mp+".{fff}",ll+" "+Br,be,Ro+" "+Br,be,pp,be,1]];function u(d){return(h,p,g,v,m,f)=>{let T=[],b=m>=o,A=m>=r&&m<o,N=d(g),L=Ce(N*i,3),C=Sh(N.getFullYear(),b?0:N.getMonth(),A||b?1:N.getDate()),F=Ce(C*i,3);if(A||b){let S=A?m/r:0,x=b?m/o:0,R=L==F?L:Ce(Sh(C.getFullYear()+x,C.getMonth()+S,1)*i,3),z=new Date(rn(R/i)),B=z.getFullYear(),X=z.getMonth();for(let J=0;R<=v;J++){let q=Sh(B+x*J,X+S*J,1),st=q-d(Ce(q*i,3));R=Ce((+q+st)*i,3),R<=v&&T.push(R)}}else{let S=m>=s?s:m,x=Gn(g)-Gn(L),R=F+x+ml(L-F,S);T.push(R);let z=d(R),B=z.getHours()+z.getMinutes()/e+z.getSeconds()/n,X=m/n,J=h.axes[p]._space,q=f/J;for(;R=Ce(R+m,i==1?0:3),!(R>v);)if(X>1){let st=Gn(Ce(B+X,6))%24,dt=d(R).getHours()-st;dt>1&&(dt=-1),R-=dt*n,B=(B+X)%24;let pt=T[T.length-1];Ce((R-pt)/m,3)*q>=.7&&T.push(R)}else T.push(R)}return T}}return[l,c,u]}var[Xb,$b,qb]=Yp(1),[Yb,Zb,Jb]=Yp(.001);Io(2,-53,53,[1]);function gp(i,t){return i.map(e=>e.map((n,s)=>s==0||s==8||n==null?n:t(s==1||e[8]==0?n:e[1]+n)))}function _p(i,t){return(e,n,s,r,o)=>{let a=t.find(g=>o>=g[0])||t[t.length-1],l,c,u,d,h,p;return n.map(g=>{let v=i(g),m=v.getFullYear(),f=v.getMonth(),T=v.getDate(),b=v.getHours(),A=v.getMinutes(),N=v.getSeconds(),L=m!=l&&a[2]||f!=c&&a[3]||T!=u&&a[4]||b!=d&&a[5]||A!=h&&a[6]||N!=p&&a[7]||a[1];return l=m,c=f,u=T,d=b,h=A,p=N,L(v)})}}function Kb(i,t){let e=Wh(t);return(n,s,r,o,a)=>s.map(l=>e(i(l)))}function Sh(i,t,e){return new Date(i,t,e)}function vp(i,t){return t(i)}var jb="{YYYY}-{MM}-{DD} {h}:{mm}{aa}";function yp(i,t){return(e,n,s,r)=>r==null?kh:t(i(n))}function Qb(i,t){let e=i.series[t];return e.width?e.stroke(i,t):e.points.width?e.points.stroke(i,t):null}function tw(i,t){return i.series[t].fill(i,t)}var ew={show:!0,live:!0,isolate:!1,mount:xb,markers:{show:!0,width:2,stroke:Qb,fill:tw,dash:"solid"},idx:null,idxs:null,values:[]};function nw(i,t){let e=i.cursor.points,n=jn(),s=e.size(i,t);Oe(n,Ao,s),Oe(n,Co,s);let r=s/-2;Oe(n,"marginLeft",r),Oe(n,"marginTop",r);let o=e.width(i,t,s);return o&&Oe(n,"borderWidth",o),n}function iw(i,t){let e=i.series[t].points;return e._fill||e._stroke}function sw(i,t){let e=i.series[t].points;return e._stroke||e._fill}function rw(i,t){return i.series[t].points.size}var Eh=[0,0];function ow(i,t,e){return Eh[0]=t,Eh[1]=e,Eh}function cl(i,t,e,n=!0){return s=>{s.button==0&&(!n||s.target==t)&&e(s)}}function Th(i,t,e,n=!0){return s=>{(!n||s.target==t)&&e(s)}}var aw={show:!0,x:!0,y:!0,lock:!1,move:ow,points:{one:!1,show:nw,size:rw,width:0,stroke:sw,fill:iw},bind:{mousedown:cl,mouseup:cl,click:cl,dblclick:cl,mousemove:Th,mouseleave:Th,mouseenter:Th},drag:{setScale:!0,x:!0,y:!1,dist:0,uni:null,click:(i,t)=>{t.stopPropagation(),t.stopImmediatePropagation()},_x:!1,_y:!1},focus:{dist:(i,t,e,n,s)=>n-s,prox:-1,bias:0},hover:{skip:[void 0],prox:null,bias:0},left:-10,top:-10,idx:null,dataIdx:null,idxs:null,event:null},Zp={show:!0,stroke:"rgba(0,0,0,0.07)",width:2},$h=Ke({},Zp,{filter:Up}),Jp=Ke({},$h,{size:10}),Kp=Ke({},Zp,{show:!1}),qh='12px system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, "Noto Sans", sans-serif, "Apple Color Emoji", "Segoe UI Emoji", "Segoe UI Symbol", "Noto Color Emoji"',jp="bold "+qh,Qp=1.5,xp={show:!0,scale:"x",stroke:Fh,space:50,gap:5,size:50,labelGap:0,labelSize:30,labelFont:jp,side:2,grid:$h,ticks:Jp,border:Kp,font:qh,lineGap:Qp,rotate:0},lw="Value",cw="Time",Mp={show:!0,scale:"x",auto:!1,sorted:1,min:ue,max:-ue,idxs:[]};function hw(i,t,e,n,s){return t.map(r=>r==null?"":Hh(r))}function uw(i,t,e,n,s,r,o){let a=[],l=hs.get(s)||0;e=o?e:Ce(ml(e,s),l);for(let c=e;c<=n;c=Ce(c+s,l))a.push(Object.is(c,-0)?0:c);return a}function Ih(i,t,e,n,s,r,o){let a=[],l=i.scales[i.axes[t].scale].log,c=l==10?Bi:Dp,u=Gn(c(e));s=Hr(l,u),l==10&&(s=Ds[ui(s,Ds)]);let d=e,h=s*l;l==10&&(h=Ds[ui(h,Ds)]);do a.push(d),d=d+s,l==10&&!hs.has(d)&&(d=Ce(d,hs.get(s))),d>=h&&(s=d,h=s*l,l==10&&(h=Ds[ui(h,Ds)]));while(d<=n);return a}function dw(i,t,e,n,s,r,o){let l=i.scales[i.axes[t].scale].asinh,c=n>l?Ih(i,t,yn(l,e),n,s):[l],u=n>=0&&e<=0?[0]:[];return(e<-l?Ih(i,t,yn(l,-n),-e,s):[l]).reverse().map(h=>-h).concat(u,c)}var tm=/./,fw=/[12357]/,pw=/[125]/,bp=/1/,Dh=(i,t,e,n)=>i.map((s,r)=>t==4&&s==0||r%n==0&&e.test(s.toExponential()[s<0?1:0])?s:null);function mw(i,t,e,n,s){let r=i.axes[e],o=r.scale,a=i.scales[o],l=i.valToPos,c=r._space,u=l(10,o),d=l(9,o)-u>=c?tm:l(7,o)-u>=c?fw:l(5,o)-u>=c?pw:bp;if(d==bp){let h=on(l(1,o)-u);if(h<c)return Dh(t.slice().reverse(),a.distr,d,Qn(c/h)).reverse()}return Dh(t,a.distr,d,1)}function gw(i,t,e,n,s){let r=i.axes[e],o=r.scale,a=r._space,l=i.valToPos,c=on(l(1,o)-l(2,o));return c<a?Dh(t.slice().reverse(),3,tm,Qn(a/c)).reverse():t}function _w(i,t,e,n){return n==null?kh:t==null?"":Hh(t)}var wp={show:!0,scale:"y",stroke:Fh,space:30,gap:5,size:50,labelGap:0,labelSize:30,labelFont:jp,side:3,grid:$h,ticks:Jp,border:Kp,font:qh,lineGap:Qp,rotate:0};function vw(i,t){let e=3+(i||1)*2;return Ce(e*t,3)}function yw(i,t){let{scale:e,idxs:n}=i.series[0],s=i._data[0],r=i.valToPos(s[n[0]],e,!0),o=i.valToPos(s[n[1]],e,!0),a=on(o-r),l=i.series[t],c=a/(l.points.space*ye);return n[1]-n[0]<=c}var Sp={scale:null,auto:!0,sorted:0,min:ue,max:-ue},em=(i,t,e,n,s)=>s,Ep={show:!0,auto:!0,sorted:0,gaps:em,alpha:1,facets:[Ke({},Sp,{scale:"x"}),Ke({},Sp,{scale:"y"})]},Tp={scale:"y",auto:!0,sorted:0,show:!0,spanGaps:!1,gaps:em,alpha:1,points:{show:yw,filter:null},values:null,min:ue,max:-ue,idxs:[],path:null,clip:null};function xw(i,t,e,n,s){return e/10}var nm={time:!0,auto:!0,distr:1,log:10,asinh:1,min:null,max:null,dir:1,ori:0},Mw=Ke({},nm,{time:!1,ori:1}),Ap={};function im(i,t){let e=Ap[i];return e||(e={key:i,plots:[],sub(n){e.plots.push(n)},unsub(n){e.plots=e.plots.filter(s=>s!=n)},pub(n,s,r,o,a,l,c){for(let u=0;u<e.plots.length;u++)e.plots[u]!=s&&e.plots[u].pub(n,s,r,o,a,l,c)}},i!=null&&(Ap[i]=e)),e}var Xr=1<<0,Nh=1<<1;function Fs(i,t,e){let n=i.mode,s=i.series[t],r=n==2?i._data[t]:i._data,o=i.scales,a=i.bbox,l=r[0],c=n==2?r[1]:r[t],u=n==2?o[s.facets[0].scale]:o[i.series[0].scale],d=n==2?o[s.facets[1].scale]:o[s.scale],h=a.left,p=a.top,g=a.width,v=a.height,m=i.valToPosH,f=i.valToPosV;return u.ori==0?e(s,l,c,u,d,m,f,h,p,g,v,vl,qr,xl,rm,am):e(s,l,c,u,d,f,m,p,h,v,g,yl,Yr,Jh,om,lm)}function Yh(i,t){let e=0,n=0,s=_e(i.bands,Gh);for(let r=0;r<s.length;r++){let o=s[r];o.series[0]==t?e=o.dir:o.series[1]==t&&(o.dir==1?n|=1:n|=2)}return[e,n==1?-1:n==2?1:n==3?2:0]}function bw(i,t,e,n,s){let r=i.mode,o=i.series[t],a=r==2?o.facets[1].scale:o.scale,l=i.scales[a];return s==-1?l.min:s==1?l.max:l.distr==3?l.dir==1?l.min:l.max:0}function zi(i,t,e,n,s,r){return Fs(i,t,(o,a,l,c,u,d,h,p,g,v,m)=>{let f=o.pxRound,T=c.dir*(c.ori==0?1:-1),b=c.ori==0?qr:Yr,A,N;T==1?(A=e,N=n):(A=n,N=e);let L=f(d(a[A],c,v,p)),C=f(h(l[A],u,m,g)),F=f(d(a[N],c,v,p)),S=f(h(r==1?u.max:u.min,u,m,g)),x=new Path2D(s);return b(x,F,S),b(x,L,S),b(x,L,C),x})}function _l(i,t,e,n,s,r){let o=null;if(i.length>0){o=new Path2D;let a=t==0?xl:Jh,l=e;for(let d=0;d<i.length;d++){let h=i[d];if(h[1]>h[0]){let p=h[0]-l;p>0&&a(o,l,n,p,n+r),l=h[1]}}let c=e+s-l,u=10;c>0&&a(o,l,n-u/2,c,n+r+u)}return o}function ww(i,t,e){let n=i[i.length-1];n&&n[0]==t?n[1]=e:i.push([t,e])}function Zh(i,t,e,n,s,r,o){let a=[],l=i.length;for(let c=s==1?e:n;c>=e&&c<=n;c+=s)if(t[c]===null){let d=c,h=c;if(s==1)for(;++c<=n&&t[c]===null;)h=c;else for(;--c>=e&&t[c]===null;)h=c;let p=r(i[d]),g=h==d?p:r(i[h]),v=d-s;p=o<=0&&v>=0&&v<l?r(i[v]):p;let f=h+s;g=o>=0&&f>=0&&f<l?r(i[f]):g,g>=p&&a.push([p,g])}return a}function Cp(i){return i==0?Np:i==1?rn:t=>Is(t,i)}function sm(i){let t=i==0?vl:yl,e=i==0?(s,r,o,a,l,c)=>{s.arcTo(r,o,a,l,c)}:(s,r,o,a,l,c)=>{s.arcTo(o,r,l,a,c)},n=i==0?(s,r,o,a,l)=>{s.rect(r,o,a,l)}:(s,r,o,a,l)=>{s.rect(o,r,l,a)};return(s,r,o,a,l,c=0,u=0)=>{c==0&&u==0?n(s,r,o,a,l):(c=ti(c,a/2,l/2),u=ti(u,a/2,l/2),t(s,r+c,o),e(s,r+a,o,r+a,o+l,c),e(s,r+a,o+l,r,o+l,u),e(s,r,o+l,r,o,u),e(s,r,o,r+a,o,c),s.closePath())}}var vl=(i,t,e)=>{i.moveTo(t,e)},yl=(i,t,e)=>{i.moveTo(e,t)},qr=(i,t,e)=>{i.lineTo(t,e)},Yr=(i,t,e)=>{i.lineTo(e,t)},xl=sm(0),Jh=sm(1),rm=(i,t,e,n,s,r)=>{i.arc(t,e,n,s,r)},om=(i,t,e,n,s,r)=>{i.arc(e,t,n,s,r)},am=(i,t,e,n,s,r,o)=>{i.bezierCurveTo(t,e,n,s,r,o)},lm=(i,t,e,n,s,r,o)=>{i.bezierCurveTo(e,t,s,n,o,r)};function cm(i){return(t,e,n,s,r)=>Fs(t,e,(o,a,l,c,u,d,h,p,g,v,m)=>{let{pxRound:f,points:T}=o,b,A;c.ori==0?(b=vl,A=rm):(b=yl,A=om);let N=Ce(T.width*ye,3),L=(T.size-T.width)/2*ye,C=Ce(L*2,3),F=new Path2D,S=new Path2D,{left:x,top:R,width:z,height:B}=t.bbox;xl(S,x-C,R-C,z+C*2,B+C*2);let X=J=>{if(l[J]!=null){let q=f(d(a[J],c,v,p)),st=f(h(l[J],u,m,g));b(F,q+L,st),A(F,q,st,L,0,hl*2)}};if(r)r.forEach(X);else for(let J=n;J<=s;J++)X(J);return{stroke:N>0?F:null,fill:F,clip:S,flags:Xr|Nh}})}function hm(i){return(t,e,n,s,r,o)=>{n!=s&&(r!=n&&o!=n&&i(t,e,n),r!=s&&o!=s&&i(t,e,s),i(t,e,o))}}var Sw=hm(qr),Ew=hm(Yr);function um(i){let t=_e(i?.alignGaps,0);return(e,n,s,r)=>Fs(e,n,(o,a,l,c,u,d,h,p,g,v,m)=>{let f=o.pxRound,T=mt=>f(d(mt,c,v,p)),b=mt=>f(h(mt,u,m,g)),A,N;c.ori==0?(A=qr,N=Sw):(A=Yr,N=Ew);let L=c.dir*(c.ori==0?1:-1),C={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:Xr},F=C.stroke,S=ue,x=-ue,R,z,B,X=T(a[L==1?s:r]),J=Vr(l,s,r,1*L),q=Vr(l,s,r,-1*L),st=T(a[J]),nt=T(a[q]),gt=!1;for(let mt=L==1?s:r;mt>=s&&mt<=r;mt+=L){let kt=T(a[mt]),Q=l[mt];kt==X?Q!=null?(z=b(Q),S==ue&&(A(F,kt,z),R=z),S=ti(z,S),x=yn(z,x)):Q===null&&(gt=!0):(S!=ue&&(N(F,X,S,x,R,z),B=X),Q!=null?(z=b(Q),A(F,kt,z),S=x=R=z):(S=ue,x=-ue,Q===null&&(gt=!0)),X=kt)}S!=ue&&S!=x&&B!=X&&N(F,X,S,x,R,z);let[dt,pt]=Yh(e,n);if(o.fill!=null||dt!=0){let mt=C.fill=new Path2D(F),kt=o.fillTo(e,n,o.min,o.max,dt),Q=b(kt);A(mt,nt,Q),A(mt,st,Q)}if(!o.spanGaps){let mt=[];gt&&mt.push(...Zh(a,l,s,r,L,T,t)),C.gaps=mt=o.gaps(e,n,s,r,mt),C.clip=_l(mt,c.ori,p,g,v,m)}return pt!=0&&(C.band=pt==2?[zi(e,n,s,r,F,-1),zi(e,n,s,r,F,1)]:zi(e,n,s,r,F,pt)),C})}function Tw(i){let t=_e(i.align,1),e=_e(i.ascDesc,!1),n=_e(i.alignGaps,0),s=_e(i.extend,!1);return(r,o,a,l)=>Fs(r,o,(c,u,d,h,p,g,v,m,f,T,b)=>{let A=c.pxRound,{left:N,width:L}=r.bbox,C=dt=>A(g(dt,h,T,m)),F=dt=>A(v(dt,p,b,f)),S=h.ori==0?qr:Yr,x={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:Xr},R=x.stroke,z=h.dir*(h.ori==0?1:-1);a=Vr(d,a,l,1),l=Vr(d,a,l,-1);let B=F(d[z==1?a:l]),X=C(u[z==1?a:l]),J=X,q=X;s&&t==-1&&(q=N,S(R,q,B)),S(R,X,B);for(let dt=z==1?a:l;dt>=a&&dt<=l;dt+=z){let pt=d[dt];if(pt==null)continue;let mt=C(u[dt]),kt=F(pt);t==1?S(R,mt,B):S(R,J,kt),S(R,mt,kt),B=kt,J=mt}let st=J;s&&t==1&&(st=N+L,S(R,st,B));let[nt,gt]=Yh(r,o);if(c.fill!=null||nt!=0){let dt=x.fill=new Path2D(R),pt=c.fillTo(r,o,c.min,c.max,nt),mt=F(pt);S(dt,st,mt),S(dt,q,mt)}if(!c.spanGaps){let dt=[];dt.push(...Zh(u,d,a,l,z,C,n));let pt=c.width*ye/2,mt=e||t==1?pt:-pt,kt=e||t==-1?-pt:pt;dt.forEach(Q=>{Q[0]+=mt,Q[1]+=kt}),x.gaps=dt=c.gaps(r,o,a,l,dt),x.clip=_l(dt,h.ori,m,f,T,b)}return gt!=0&&(x.band=gt==2?[zi(r,o,a,l,R,-1),zi(r,o,a,l,R,1)]:zi(r,o,a,l,R,gt)),x})}function Rp(i,t,e,n,s,r,o=ue){if(i.length>1){let a=null;for(let l=0,c=1/0;l<i.length;l++)if(t[l]!==void 0){if(a!=null){let u=on(i[l]-i[a]);u<c&&(c=u,o=on(e(i[l],n,s,r)-e(i[a],n,s,r)))}a=l}}return o}function Aw(i){i=i||Lo;let t=_e(i.size,[.6,ue,1]),e=i.align||0,n=i.gap||0,s=i.radius;s=s==null?[0,0]:typeof s=="number"?[s,0]:s;let r=he(s),o=1-t[0],a=_e(t[1],ue),l=_e(t[2],1),c=_e(i.disp,Lo),u=_e(i.each,p=>{}),{fill:d,stroke:h}=c;return(p,g,v,m)=>Fs(p,g,(f,T,b,A,N,L,C,F,S,x,R)=>{let z=f.pxRound,B=e,X=n*ye,J=a*ye,q=l*ye,st,nt;A.ori==0?[st,nt]=r(p,g):[nt,st]=r(p,g);let gt=A.dir*(A.ori==0?1:-1),dt=A.ori==0?xl:Jh,pt=A.ori==0?u:(et,At,vt,yt,Wt,lt,Et)=>{u(et,At,vt,Wt,yt,Et,lt)},mt=_e(p.bands,Gh).find(et=>et.series[0]==g),kt=mt!=null?mt.dir:0,Q=f.fillTo(p,g,f.min,f.max,kt),ct=z(C(Q,N,R,S)),Rt,ft,Ht,Bt=x,Nt=z(f.width*ye),O=!1,jt=null,te=null,fe=null,Ut=null;d!=null&&(Nt==0||h!=null)&&(O=!0,jt=d.values(p,g,v,m),te=new Map,new Set(jt).forEach(et=>{et!=null&&te.set(et,new Path2D)}),Nt>0&&(fe=h.values(p,g,v,m),Ut=new Map,new Set(fe).forEach(et=>{et!=null&&Ut.set(et,new Path2D)})));let{x0:se,size:Yt}=c;if(se!=null&&Yt!=null){B=1,T=se.values(p,g,v,m),se.unit==2&&(T=T.map(vt=>p.posToVal(F+vt*x,A.key,!0)));let et=Yt.values(p,g,v,m);Yt.unit==2?ft=et[0]*x:ft=L(et[0],A,x,F)-L(0,A,x,F),Bt=Rp(T,b,L,A,x,F,Bt),Ht=Bt-ft+X}else Bt=Rp(T,b,L,A,x,F,Bt),Ht=Bt*o+X,ft=Bt-Ht;Ht<1&&(Ht=0),Nt>=ft/2&&(Nt=0),Ht<5&&(z=Np);let zt=Ht>0,Se=Bt-Ht-(zt?Nt:0);ft=z(Lh(Se,q,J)),Rt=(B==0?ft/2:B==gt?0:ft)-B*gt*((B==0?X/2:0)+(zt?Nt/2:0));let D={stroke:null,fill:null,clip:null,band:null,gaps:null,flags:0},w=O?null:new Path2D,G=null;if(mt!=null)G=p.data[mt.series[1]];else{let{y0:et,y1:At}=c;et!=null&&At!=null&&(b=At.values(p,g,v,m),G=et.values(p,g,v,m))}let tt=st*ft,rt=nt*ft;for(let et=gt==1?v:m;et>=v&&et<=m;et+=gt){let At=b[et];if(At==null)continue;if(G!=null){let xt=G[et]??0;if(At-xt==0)continue;ct=C(xt,N,R,S)}let vt=A.distr!=2||c!=null?T[et]:et,yt=L(vt,A,x,F),Wt=C(_e(At,Q),N,R,S),lt=z(yt-Rt),Et=z(yn(Wt,ct)),Gt=z(ti(Wt,ct)),It=Et-Gt;if(At!=null){let xt=At<0?rt:tt,Xt=At<0?tt:rt;O?(Nt>0&&fe[et]!=null&&dt(Ut.get(fe[et]),lt,Gt+Gn(Nt/2),ft,yn(0,It-Nt),xt,Xt),jt[et]!=null&&dt(te.get(jt[et]),lt,Gt+Gn(Nt/2),ft,yn(0,It-Nt),xt,Xt)):dt(w,lt,Gt+Gn(Nt/2),ft,yn(0,It-Nt),xt,Xt),pt(p,g,et,lt-Nt/2,Gt,ft+Nt,It)}}return Nt>0?D.stroke=O?Ut:w:O||(D._fill=f.width==0?f._fill:f._stroke??f._fill,D.width=0),D.fill=O?te:w,D})}function Cw(i,t){let e=_e(t?.alignGaps,0);return(n,s,r,o)=>Fs(n,s,(a,l,c,u,d,h,p,g,v,m,f)=>{let T=a.pxRound,b=st=>T(h(st,u,m,g)),A=st=>T(p(st,d,f,v)),N,L,C;u.ori==0?(N=vl,C=qr,L=am):(N=yl,C=Yr,L=lm);let F=u.dir*(u.ori==0?1:-1);r=Vr(c,r,o,1),o=Vr(c,r,o,-1);let S=b(l[F==1?r:o]),x=S,R=[],z=[];for(let st=F==1?r:o;st>=r&&st<=o;st+=F)if(c[st]!=null){let gt=l[st],dt=b(gt);R.push(x=dt),z.push(A(c[st]))}let B={stroke:i(R,z,N,C,L,T),fill:null,clip:null,band:null,gaps:null,flags:Xr},X=B.stroke,[J,q]=Yh(n,s);if(a.fill!=null||J!=0){let st=B.fill=new Path2D(X),nt=a.fillTo(n,s,a.min,a.max,J),gt=A(nt);C(st,x,gt),C(st,S,gt)}if(!a.spanGaps){let st=[];st.push(...Zh(l,c,r,o,F,b,e)),B.gaps=st=a.gaps(n,s,r,o,st),B.clip=_l(st,u.ori,g,v,m,f)}return q!=0&&(B.band=q==2?[zi(n,s,r,o,X,-1),zi(n,s,r,o,X,1)]:zi(n,s,r,o,X,q)),B})}function Rw(i){return Cw(Pw,i)}function Pw(i,t,e,n,s,r){let o=i.length;if(o<2)return null;let a=new Path2D;if(e(a,i[0],t[0]),o==2)n(a,i[1],t[1]);else{let l=Array(o),c=Array(o-1),u=Array(o-1),d=Array(o-1);for(let h=0;h<o-1;h++)u[h]=t[h+1]-t[h],d[h]=i[h+1]-i[h],c[h]=u[h]/d[h];l[0]=c[0];for(let h=1;h<o-1;h++)c[h]===0||c[h-1]===0||c[h-1]>0!=c[h]>0?l[h]=0:(l[h]=3*(d[h-1]+d[h])/((2*d[h]+d[h-1])/c[h-1]+(d[h]+2*d[h-1])/c[h]),isFinite(l[h])||(l[h]=0));l[o-1]=c[o-2];for(let h=0;h<o-1;h++)s(a,i[h]+d[h]/3,t[h]+l[h]*d[h]/3,i[h+1]-d[h]/3,t[h+1]-l[h+1]*d[h]/3,i[h+1],t[h+1])}return a}var Uh=new Set;function Pp(){for(let i of Uh)i.syncRect(!0)}$r&&(Us(hb,zr,Pp),Us(ub,zr,Pp,!0),Us(ul,zr,()=>{je.pxRatio=ye}));var Lw=um(),Iw=cm();function Lp(i,t,e,n){return(n?[i[0],i[1]].concat(i.slice(2)):[i[0]].concat(i.slice(1))).map((r,o)=>Oh(r,o,t,e))}function Dw(i,t){return i.map((e,n)=>n==0?{}:Ke({},t,e))}function Oh(i,t,e,n){return Ke({},t==0?e:n,i)}function dm(i,t,e){return t==null?Gr:[t,e]}var Nw=dm;function Uw(i,t,e){return t==null?Gr:dl(t,e,Vh,!0)}function fm(i,t,e,n){return t==null?Gr:pl(t,e,i.scales[n].log,!1)}var Ow=fm;function pm(i,t,e,n){return t==null?Gr:zh(t,e,i.scales[n].log,!1)}var Fw=pm;function kw(i,t,e,n,s){let r=yn(cp(i),cp(t)),o=t-i,a=ui(s/n*o,e);do{let l=e[a],c=n*l/o;if(c>=s&&r+(l<5?hs.get(l):0)<=17)return[l,c]}while(++a<e.length);return[0,0]}function Ip(i){let t,e;return i=i.replace(/(\d+)px/,(n,s)=>(t=rn((e=+s)*ye))+"px"),[i,t,e]}function Bw(i){i.show&&[i.font,i.labelFont].forEach(t=>{let e=Ce(t[2]*ye,1);t[0]=t[0].replace(/[0-9.]+px/,e+"px"),t[1]=e})}function je(i,t,e){let n={mode:_e(i.mode,1)},s=n.mode;function r(_,M){return((M.distr==3?Bi(_>0?_:M.clamp(n,_,M.min,M.max,M.key)):M.distr==4?wh(_,M.asinh):M.distr==100?M.fwd(_):_)-M._min)/(M._max-M._min)}function o(_,M,P,I){let k=r(_,M);return I+P*(M.dir==-1?1-k:k)}function a(_,M,P,I){let k=r(_,M);return I+P*(M.dir==-1?k:1-k)}function l(_,M,P,I){return M.ori==0?o(_,M,P,I):a(_,M,P,I)}n.valToPosH=o,n.valToPosV=a;let c=!1;n.status=0;let u=n.root=jn($M);if(i.id!=null&&(u.id=i.id),Hn(u,i.class),i.title){let _=jn(ZM,u);_.textContent=i.title}let d=hi("canvas"),h=n.ctx=d.getContext("2d"),p=jn(JM,u);Us("click",p,_=>{_.target===v&&(Ie!=Gs||ke!=Ws)&&pn.click(n,_)},!0);let g=n.under=jn(KM,p);p.appendChild(d);let v=n.over=jn(jM,p);i=Wr(i);let m=+_e(i.pxAlign,1),f=Cp(m);(i.plugins||[]).forEach(_=>{_.opts&&(i=_.opts(n,i)||i)});let T=i.ms||.001,b=n.series=s==1?Lp(i.series||[],Mp,Tp,!1):Dw(i.series||[null],Ep),A=n.axes=Lp(i.axes||[],xp,wp,!0),N=n.scales={},L=n.bands=i.bands||[];L.forEach(_=>{_.fill=he(_.fill||null),_.dir=_e(_.dir,-1)});let C=s==2?b[1].facets[0].scale:b[0].scale,F={axes:$m,series:Pn},S=(i.drawOrder||["axes","series"]).map(_=>F[_]);function x(_){let M=N[_];if(M==null){let P=(i.scales||Lo)[_]||Lo;if(P.from!=null)x(P.from),N[_]=Ke({},N[P.from],P,{key:_});else{M=N[_]=Ke({},_==C?nm:Mw,P),M.key=_;let I=M.time,k=M.range,K=cs(k);if((_!=C||s==2&&!I)&&(K&&(k[0]==null||k[1]==null)&&(k={min:k[0]==null?op:{mode:1,hard:k[0],soft:k[0]},max:k[1]==null?op:{mode:1,hard:k[1],soft:k[1]}},K=!1),!K&&gl(k))){let ot=k;k=(ut,_t,Tt)=>_t==null?Gr:dl(_t,Tt,ot)}M.range=he(k||(I?Nw:_==C?M.distr==3?Ow:M.distr==4?Fw:dm:M.distr==3?fm:M.distr==4?pm:Uw)),M.auto=he(K?!1:M.auto),M.clamp=he(M.clamp||xw),M._min=M._max=null}}}x("x"),x("y"),s==1&&b.forEach(_=>{x(_.scale)}),A.forEach(_=>{x(_.scale)});for(let _ in i.scales)x(_);let R=N[C],z=R.distr,B,X;R.ori==0?(Hn(u,qM),B=o,X=a):(Hn(u,YM),B=a,X=o);let J={};for(let _ in N){let M=N[_];(M.min!=null||M.max!=null)&&(J[_]={min:M.min,max:M.max},M.min=M.max=null)}let q=i.tzDate||(_=>new Date(rn(_/T))),st=i.fmtDate||Wh,nt=T==1?qb(q):Jb(q),gt=_p(q,gp(T==1?$b:Zb,st)),dt=yp(q,vp(jb,st)),pt=[],mt=n.legend=Ke({},ew,i.legend),kt=mt.show,Q=mt.markers;mt.idxs=pt,Q.width=he(Q.width),Q.dash=he(Q.dash),Q.stroke=he(Q.stroke),Q.fill=he(Q.fill);let ct,Rt,ft,Ht=[],Bt=[],Nt,O=!1,jt={};if(mt.live){let _=b[1]?b[1].values:null;O=_!=null,Nt=O?_(n,1,0):{_:0};for(let M in Nt)jt[M]=kh}if(kt)if(ct=hi("table",sb,u),ft=hi("tbody",null,ct),mt.mount(n,ct),O){Rt=hi("thead",null,ct,ft);let _=hi("tr",null,Rt);hi("th",null,_);for(var te in Nt)hi("th",$f,_).textContent=te}else Hn(ct,ob),mt.live&&Hn(ct,rb);let fe={show:!0},Ut={show:!1};function se(_,M){if(M==0&&(O||!mt.live||s==2))return Gr;let P=[],I=hi("tr",ab,ft,ft.childNodes[M]);Hn(I,_.class),_.show||Hn(I,Ns);let k=hi("th",null,I);if(Q.show){let ut=jn(lb,k);if(M>0){let _t=Q.width(n,M);_t&&(ut.style.border=_t+"px "+Q.dash(n,M)+" "+Q.stroke(n,M)),ut.style.background=Q.fill(n,M)}}let K=jn($f,k);K.textContent=_.label,M>0&&(Q.show||(K.style.color=_.width>0?Q.stroke(n,M):Q.fill(n,M)),zt("click",k,ut=>{if(Mt._lock)return;Ee(ut);let _t=b.indexOf(_);if((ut.ctrlKey||ut.metaKey)!=mt.isolate){let Tt=b.some((Ct,Pt)=>Pt>0&&Pt!=_t&&Ct.show);b.forEach((Ct,Pt)=>{Pt>0&&pi(Pt,Tt?Pt==_t?fe:Ut:fe,!0,$e.setSeries)})}else pi(_t,{show:!_.show},!0,$e.setSeries)},!1),We&&zt(Kf,k,ut=>{Mt._lock||(Ee(ut),pi(b.indexOf(_),$s,!0,$e.setSeries))},!1));for(var ot in Nt){let ut=hi("td",cb,I);ut.textContent="--",P.push(ut)}return[I,P]}let Yt=new Map;function zt(_,M,P,I=!0){let k=Yt.get(M)||{},K=Mt.bind[_](n,M,P,I);K&&(Us(_,M,k[_]=K),Yt.set(M,k))}function Se(_,M,P){let I=Yt.get(M)||{};for(let k in I)(_==null||k==_)&&(Ph(k,M,I[k]),delete I[k]);_==null&&Yt.delete(M)}let D=0,w=0,G=0,tt=0,rt=0,et=0,At=rt,vt=et,yt=G,Wt=tt,lt=0,Et=0,Gt=0,It=0;n.bbox={};let xt=!1,Xt=!1,Zt=!1,xe=!1,y=!1,j=!1;function Y(_,M,P){(P||_!=n.width||M!=n.height)&&it(_,M),Bs(!1),Zt=!0,Xt=!0,zs()}function it(_,M){n.width=D=G=_,n.height=w=tt=M,rt=et=0,Fe(),Be();let P=n.bbox;lt=P.left=Is(rt*ye,.5),Et=P.top=Is(et*ye,.5),Gt=P.width=Is(G*ye,.5),It=P.height=Is(tt*ye,.5)}let ht=3;function Ft(){let _=!1,M=0;for(;!_;){M++;let P=Wm(M),I=Xm(M);_=M==ht||P&&I,_||(it(n.width,n.height),Xt=!0)}}function Kt({width:_,height:M}){Y(_,M)}n.setSize=Kt;function Fe(){let _=!1,M=!1,P=!1,I=!1;A.forEach((k,K)=>{if(k.show&&k._show){let{side:ot,_size:ut}=k,_t=ot%2,Tt=k.label!=null?k.labelSize:0,Ct=ut+Tt;Ct>0&&(_t?(G-=Ct,ot==3?(rt+=Ct,I=!0):P=!0):(tt-=Ct,ot==0?(et+=Ct,_=!0):M=!0))}}),Ti[0]=_,Ti[1]=P,Ti[2]=M,Ti[3]=I,G-=Z[1]+Z[3],rt+=Z[3],tt-=Z[2]+Z[0],et+=Z[0]}function Be(){let _=rt+G,M=et+tt,P=rt,I=et;function k(K,ot){switch(K){case 1:return _+=ot,_-ot;case 2:return M+=ot,M-ot;case 3:return P-=ot,P+ot;case 0:return I-=ot,I+ot}}A.forEach((K,ot)=>{if(K.show&&K._show){let ut=K.side;K._pos=k(ut,K._size),K.label!=null&&(K._lpos=k(ut,K.labelSize))}})}let Mt=n.cursor=Ke({},aw,{drag:{y:s==2}},i.cursor);if(Mt.dataIdx==null){let _=Mt.hover,M=_.skip=new Set(_.skip??[]);M.add(void 0);let P=_.prox=he(_.prox),I=_.bias??=0;Mt.dataIdx=(k,K,ot,ut)=>{if(K==0)return ot;let _t=ot,Tt=P(k,K,ot,ut)??ue,Ct=Tt>=0&&Tt<ue,Pt=R.ori==0?G:tt,Qt=Mt.left,Ae=t[0],de=t[K];if(M.has(de[ot])){_t=null;let le=null,ne=null,Dt;if(I==0||I==-1)for(Dt=ot;le==null&&Dt-- >0;)M.has(de[Dt])||(le=Dt);if(I==0||I==1)for(Dt=ot;ne==null&&Dt++<de.length;)M.has(de[Dt])||(ne=Dt);if(le!=null||ne!=null)if(Ct){let Te=le==null?-1/0:B(Ae[le],R,Pt,0),Ge=ne==null?1/0:B(Ae[ne],R,Pt,0),Ve=Qt-Te,Ne=Ge-Qt;Ve<=Ne?Ve<=Tt&&(_t=le):Ne<=Tt&&(_t=ne)}else _t=ne==null?le:le==null?ne:ot-le<=ne-ot?le:ne}else Ct&&on(Qt-B(Ae[ot],R,Pt,0))>Tt&&(_t=null);return _t}}let Ee=_=>{Mt.event=_};Mt.idxs=pt,Mt._lock=!1;let oe=Mt.points;oe.show=he(oe.show),oe.size=he(oe.size),oe.stroke=he(oe.stroke),oe.width=he(oe.width),oe.fill=he(oe.fill);let ze=n.focus=Ke({},i.focus||{alpha:.3},Mt.focus),We=ze.prox>=0,xn=We&&oe.one,Xe=[],Rn=[],Ei=[];function us(_,M){let P=oe.show(n,M);if(P)return Hn(P,ib),Hn(P,_.class),Si(P,-10,-10,G,tt),v.insertBefore(P,Xe[M]),P}function no(_,M){if(s==1||M>0){let P=s==1&&N[_.scale].time,I=_.value;_.value=P?dp(I)?yp(q,vp(I,st)):I||dt:I||_w,_.label=_.label||(P?cw:lw)}if(xn||M>0){_.width=_.width==null?1:_.width,_.paths=_.paths||Lw||Mb,_.fillTo=he(_.fillTo||bw),_.pxAlign=+_e(_.pxAlign,m),_.pxRound=Cp(_.pxAlign),_.stroke=he(_.stroke||null),_.fill=he(_.fill||null),_._stroke=_._fill=_._paths=_._focus=null;let P=vw(yn(1,_.width),1),I=_.points=Ke({},{size:P,width:yn(1,P*.2),stroke:_.stroke,space:P*2,paths:Iw,_stroke:null,_fill:null},_.points);I.show=he(I.show),I.filter=he(I.filter),I.fill=he(I.fill),I.stroke=he(I.stroke),I.paths=he(I.paths),I.pxAlign=_.pxAlign}if(kt){let P=se(_,M);Ht.splice(M,0,P[0]),Bt.splice(M,0,P[1]),mt.values.push(null)}if(Mt.show){pt.splice(M,0,null);let P=null;xn?M==0&&(P=us(_,M)):M>0&&(P=us(_,M)),Xe.splice(M,0,P),Rn.splice(M,0,0),Ei.splice(M,0,0)}hn("addSeries",M)}function Fo(_,M){M=M??b.length,_=s==1?Oh(_,M,Mp,Tp):Oh(_,M,{},Ep),b.splice(M,0,_),no(b[M],M)}n.addSeries=Fo;function Dl(_){if(b.splice(_,1),kt){mt.values.splice(_,1),Bt.splice(_,1);let M=Ht.splice(_,1)[0];Se(null,M.firstChild),M.remove()}Mt.show&&(pt.splice(_,1),Xe.splice(_,1)[0].remove(),Rn.splice(_,1),Ei.splice(_,1)),hn("delSeries",_)}n.delSeries=Dl;let Ti=[!1,!1,!1,!1];function Nl(_,M){if(_._show=_.show,_.show){let P=_.side%2,I=N[_.scale];I==null&&(_.scale=P?b[1].scale:C,I=N[_.scale]);let k=I.time;_.size=he(_.size),_.space=he(_.space),_.rotate=he(_.rotate),cs(_.incrs)&&_.incrs.forEach(ot=>{!hs.has(ot)&&hs.set(ot,Fp(ot))}),_.incrs=he(_.incrs||(I.distr==2?Gb:k?T==1?Xb:Yb:Ds)),_.splits=he(_.splits||(k&&I.distr==1?nt:I.distr==3?Ih:I.distr==4?dw:uw)),_.stroke=he(_.stroke),_.grid.stroke=he(_.grid.stroke),_.ticks.stroke=he(_.ticks.stroke),_.border.stroke=he(_.border.stroke);let K=_.values;_.values=cs(K)&&!cs(K[0])?he(K):k?cs(K)?_p(q,gp(K,st)):dp(K)?Kb(q,K):K||gt:K||hw,_.filter=he(_.filter||(I.distr>=3&&I.log==10?mw:I.distr==3&&I.log==2?gw:Up)),_.font=Ip(_.font),_.labelFont=Ip(_.labelFont),_._size=_.size(n,null,M,0),_._space=_._rotate=_._incrs=_._found=_._splits=_._values=null,_._size>0&&(Ti[M]=!0,_._el=jn(QM,p))}}function E(_,M,P,I){let[k,K,ot,ut]=P,_t=M%2,Tt=0;return _t==0&&(ut||K)&&(Tt=M==0&&!k||M==2&&!ot?rn(xp.size/3):0),_t==1&&(k||ot)&&(Tt=M==1&&!K||M==3&&!ut?rn(wp.size/2):0),Tt}let W=n.padding=(i.padding||[E,E,E,E]).map(_=>he(_e(_,E))),Z=n._padding=W.map((_,M)=>_(n,M,Ti,0)),$,H=null,at=null,St=s==1?b[0].idxs:null,wt=null,Lt=!1;function $t(_,M){if(t=_??[],n.data=n._data=t,s==2){$=0;for(let P=1;P<b.length;P++)$+=t[P][0].length}else{t.length==0&&(n.data=n._data=t=[[]]),wt=t[0],$=wt.length;let P=t;if(z==2){P=t.slice();let I=P[0]=Array($);for(let k=0;k<$;k++)I[k]=k}n._data=t=P}if(Bs(!0),hn("setData"),z==2&&(Zt=!0),M!==!1){let P=R;P.auto(n,Lt)?qt():Hi(C,P.min,P.max),xe=xe||Mt.left>=0,j=!0,zs()}}n.setData=$t;function qt(){Lt=!0;let _,M;s==1&&($>0?(H=St[0]=0,at=St[1]=$-1,_=t[0][H],M=t[0][at],z==2?(_=H,M=at):_==M&&(z==3?[_,M]=pl(_,_,R.log,!1):z==4?[_,M]=zh(_,_,R.log,!1):R.time?M=_+rn(86400/T):[_,M]=dl(_,M,Vh,!0))):(H=St[0]=_=null,at=St[1]=M=null)),Hi(C,_,M)}let Vt,ae,Re,Pe,fn,pe,Ot,Qe,ge,tn;function ds(_,M,P,I,k,K){_??=Yf,P??=Gh,I??="butt",k??=Yf,K??="round",_!=Vt&&(h.strokeStyle=Vt=_),k!=ae&&(h.fillStyle=ae=k),M!=Re&&(h.lineWidth=Re=M),K!=fn&&(h.lineJoin=fn=K),I!=pe&&(h.lineCap=pe=I),P!=Pe&&h.setLineDash(Pe=P)}function di(_,M,P,I){M!=ae&&(h.fillStyle=ae=M),_!=Ot&&(h.font=Ot=_),P!=Qe&&(h.textAlign=Qe=P),I!=ge&&(h.textBaseline=ge=I)}function fs(_,M,P,I,k=0){if(I.length>0&&_.auto(n,Lt)&&(M==null||M.min==null)){let K=_e(H,0),ot=_e(at,I.length-1),ut=P.min==null?_.distr==3?mb(I,K,ot):pb(I,K,ot,k):[P.min,P.max];_.min=ti(_.min,P.min=ut[0]),_.max=yn(_.max,P.max=ut[1])}}let He={min:null,max:null};function fi(){for(let I in N){let k=N[I];J[I]==null&&(k.min==null||J[C]!=null&&k.auto(n,Lt))&&(J[I]=He)}for(let I in N){let k=N[I];J[I]==null&&k.from!=null&&J[k.from]!=null&&(J[I]=He)}J[C]!=null&&Bs(!0);let _={};for(let I in J){let k=J[I];if(k!=null){let K=_[I]=Wr(N[I],Sb);if(k.min!=null)Ke(K,k);else if(I!=C||s==2)if($==0&&K.from==null){let ot=K.range(n,null,null,I);K.min=ot[0],K.max=ot[1]}else K.min=ue,K.max=-ue}}if($>0){b.forEach((I,k)=>{if(s==1){let K=I.scale,ot=J[K];if(ot==null)return;let ut=_[K];if(k==0){let _t=ut.range(n,ut.min,ut.max,K);ut.min=_t[0],ut.max=_t[1],H=ui(ut.min,t[0]),at=ui(ut.max,t[0]),at-H>1&&(t[0][H]<ut.min&&H++,t[0][at]>ut.max&&at--),I.min=wt[H],I.max=wt[at]}else I.show&&I.auto&&fs(ut,ot,I,t[k],I.sorted);I.idxs[0]=H,I.idxs[1]=at}else if(k>0&&I.show&&I.auto){let[K,ot]=I.facets,ut=K.scale,_t=ot.scale,[Tt,Ct]=t[k],Pt=_[ut],Qt=_[_t];Pt!=null&&fs(Pt,J[ut],K,Tt,K.sorted),Qt!=null&&fs(Qt,J[_t],ot,Ct,ot.sorted),I.min=ot.min,I.max=ot.max}});for(let I in _){let k=_[I],K=J[I];if(k.from==null&&(K==null||K.min==null)){let ot=k.range(n,k.min==ue?null:k.min,k.max==-ue?null:k.max,I);k.min=ot[0],k.max=ot[1]}}}for(let I in _){let k=_[I];if(k.from!=null){let K=_[k.from];if(K.min==null)k.min=k.max=null;else{let ot=k.range(n,K.min,K.max,I);k.min=ot[0],k.max=ot[1]}}}let M={},P=!1;for(let I in _){let k=_[I],K=N[I];if(K.min!=k.min||K.max!=k.max){K.min=k.min,K.max=k.max;let ot=K.distr;K._min=ot==3?Bi(K.min):ot==4?wh(K.min,K.asinh):ot==100?K.fwd(K.min):K.min,K._max=ot==3?Bi(K.max):ot==4?wh(K.max,K.asinh):ot==100?K.fwd(K.max):K.max,M[I]=P=!0}}if(P){b.forEach((I,k)=>{s==2?k>0&&M.y&&(I._paths=null):M[I.scale]&&(I._paths=null)});for(let I in M)Zt=!0,hn("setScale",I);Mt.show&&Mt.left>=0&&(xe=j=!0)}for(let I in J)J[I]=null}function io(_){let M=Lh(H-1,0,$-1),P=Lh(at+1,0,$-1);for(;_[M]==null&&M>0;)M--;for(;_[P]==null&&P<$-1;)P++;return[M,P]}function Pn(){$>0&&(b.forEach((_,M)=>{if(M>0&&_.show&&(ks(M,!1),ks(M,!0),_._paths==null)){tn!=_.alpha&&(h.globalAlpha=tn=_.alpha);let P=s==2?[0,t[M][0].length-1]:io(t[M]);_._paths=_.paths(n,M,P[0],P[1]),tn!=1&&(h.globalAlpha=tn=1)}}),b.forEach((_,M)=>{if(M>0&&_.show){tn!=_.alpha&&(h.globalAlpha=tn=_.alpha),_._paths!=null&&ko(M,!1);{let P=_._paths!=null?_._paths.gaps:null,I=_.points.show(n,M,H,at,P),k=_.points.filter(n,M,I,P);(I||k)&&(_.points._paths=_.points.paths(n,M,H,at,k),ko(M,!0))}tn!=1&&(h.globalAlpha=tn=1),hn("drawSeries",M)}}))}function ks(_,M){let P=M?b[_].points:b[_];P._stroke=P.stroke(n,_),P._fill=P.fill(n,_)}function ko(_,M){let P=M?b[_].points:b[_],{stroke:I,fill:k,clip:K,flags:ot,_stroke:ut=P._stroke,_fill:_t=P._fill,_width:Tt=P.width}=P._paths;Tt=Ce(Tt*ye,3);let Ct=null,Pt=Tt%2/2;M&&_t==null&&(_t=Tt>0?"#fff":ut);let Qt=P.pxAlign==1&&Pt>0;if(Qt&&h.translate(Pt,Pt),!M){let Ae=lt-Tt/2,de=Et-Tt/2,le=Gt+Tt,ne=It+Tt;Ct=new Path2D,Ct.rect(Ae,de,le,ne)}M?Ul(ut,Tt,P.dash,P.cap,_t,I,k,ot,K):Bo(_,ut,Tt,P.dash,P.cap,_t,I,k,ot,Ct,K),Qt&&h.translate(-Pt,-Pt)}function Bo(_,M,P,I,k,K,ot,ut,_t,Tt,Ct){let Pt=!1;_t!=0&&L.forEach((Qt,Ae)=>{if(Qt.series[0]==_){let de=b[Qt.series[1]],le=t[Qt.series[1]],ne=(de._paths||Lo).band;cs(ne)&&(ne=Qt.dir==1?ne[0]:ne[1]);let Dt,Te=null;de.show&&ne&&_b(le,H,at)?(Te=Qt.fill(n,Ae)||K,Dt=de._paths.clip):ne=null,Ul(M,P,I,k,Te,ot,ut,_t,Tt,Ct,Dt,ne),Pt=!0}}),Pt||Ul(M,P,I,k,K,ot,ut,_t,Tt,Ct)}let au=Xr|Nh;function Ul(_,M,P,I,k,K,ot,ut,_t,Tt,Ct,Pt){ds(_,M,P,I,k),(_t||Tt||Pt)&&(h.save(),_t&&h.clip(_t),Tt&&h.clip(Tt)),Pt?(ut&au)==au?(h.clip(Pt),Ct&&h.clip(Ct),Vo(k,ot),zo(_,K,M)):ut&Nh?(Vo(k,ot),h.clip(Pt),zo(_,K,M)):ut&Xr&&(h.save(),h.clip(Pt),Ct&&h.clip(Ct),Vo(k,ot),h.restore(),zo(_,K,M)):(Vo(k,ot),zo(_,K,M)),(_t||Tt||Pt)&&h.restore()}function zo(_,M,P){P>0&&(M instanceof Map?M.forEach((I,k)=>{h.strokeStyle=Vt=k,h.stroke(I)}):M!=null&&_&&h.stroke(M))}function Vo(_,M){M instanceof Map?M.forEach((P,I)=>{h.fillStyle=ae=I,h.fill(P)}):M!=null&&_&&h.fill(M)}function Gm(_,M,P,I){let k=A[_],K;if(I<=0)K=[0,0];else{let ot=k._space=k.space(n,_,M,P,I),ut=k._incrs=k.incrs(n,_,M,P,I,ot);K=kw(M,P,ut,I,ot)}return k._found=K}function Ol(_,M,P,I,k,K,ot,ut,_t,Tt){let Ct=ot%2/2;m==1&&h.translate(Ct,Ct),ds(ut,ot,_t,Tt,ut),h.beginPath();let Pt,Qt,Ae,de,le=k+(I==0||I==3?-K:K);P==0?(Qt=k,de=le):(Pt=k,Ae=le);for(let ne=0;ne<_.length;ne++)M[ne]!=null&&(P==0?Pt=Ae=_[ne]:Qt=de=_[ne],h.moveTo(Pt,Qt),h.lineTo(Ae,de));h.stroke(),m==1&&h.translate(-Ct,-Ct)}function Wm(_){let M=!0;return A.forEach((P,I)=>{if(!P.show)return;let k=N[P.scale];if(k.min==null){P._show&&(M=!1,P._show=!1,Bs(!1));return}else P._show||(M=!1,P._show=!0,Bs(!1));let K=P.side,ot=K%2,{min:ut,max:_t}=k,[Tt,Ct]=Gm(I,ut,_t,ot==0?G:tt);if(Ct==0)return;let Pt=k.distr==2,Qt=P._splits=P.splits(n,I,ut,_t,Tt,Ct,Pt),Ae=k.distr==2?Qt.map(Dt=>wt[Dt]):Qt,de=k.distr==2?wt[Qt[1]]-wt[Qt[0]]:Tt,le=P._values=P.values(n,P.filter(n,Ae,I,Ct,de),I,Ct,de);P._rotate=K==2?P.rotate(n,le,I,Ct):0;let ne=P._size;P._size=Qn(P.size(n,le,I,_)),ne!=null&&P._size!=ne&&(M=!1)}),M}function Xm(_){let M=!0;return W.forEach((P,I)=>{let k=P(n,I,Ti,_);k!=Z[I]&&(M=!1),Z[I]=k}),M}function $m(){for(let _=0;_<A.length;_++){let M=A[_];if(!M.show||!M._show)continue;let P=M.side,I=P%2,k,K,ot=M.stroke(n,_),ut=P==0||P==3?-1:1;if(M.label){let wn=M.labelGap*ut,Fn=rn((M._lpos+wn)*ye);di(M.labelFont[0],ot,"center",P==2?Eo:qf),h.save(),I==1?(k=K=0,h.translate(Fn,rn(Et+It/2)),h.rotate((P==3?-hl:hl)/2)):(k=rn(lt+Gt/2),K=Fn),h.fillText(M.label,k,K),h.restore()}let[_t,Tt]=M._found;if(Tt==0)continue;let Ct=N[M.scale],Pt=I==0?Gt:It,Qt=I==0?lt:Et,Ae=rn(M.gap*ye),de=M._splits,le=Ct.distr==2?de.map(wn=>wt[wn]):de,ne=Ct.distr==2?wt[de[1]]-wt[de[0]]:_t,Dt=M.ticks,Te=M.border,Ge=Dt.show?rn(Dt.size*ye):0,Ve=M._rotate*-hl/180,Ne=f(M._pos*ye),qe=(Ge+Ae)*ut,Ln=Ne+qe;K=I==0?Ln:0,k=I==1?Ln:0;let In=M.font[0],Xn=M.align==1?kr:M.align==2?Mh:Ve>0?kr:Ve<0?Mh:I==0?"center":P==3?Mh:kr,ei=Ve||I==1?"middle":P==2?Eo:qf;di(In,ot,Xn,ei);let ni=M.font[1]*M.lineGap,Mn=de.map(wn=>f(l(wn,Ct,Pt,Qt))),gi=M._values;for(let wn=0;wn<gi.length;wn++){let Fn=gi[wn];if(Fn!=null){I==0?k=Mn[wn]:K=Mn[wn],Fn=""+Fn;let Ys=Fn.indexOf(`
`)==-1?[Fn]:Fn.split(/\n/gm);for(let Xi=0;Xi<Ys.length;Xi++){let $n=Ys[Xi];Ve?(h.save(),h.translate(k,K+Xi*ni),h.rotate(Ve),h.fillText($n,0,0),h.restore()):h.fillText($n,k,K+Xi*ni)}}}Dt.show&&Ol(Mn,Dt.filter(n,le,_,Tt,ne),I,P,Ne,Ge,Ce(Dt.width*ye,3),Dt.stroke(n,_),Dt.dash,Dt.cap);let bn=M.grid;bn.show&&Ol(Mn,bn.filter(n,le,_,Tt,ne),I,I==0?2:1,I==0?Et:lt,I==0?It:Gt,Ce(bn.width*ye,3),bn.stroke(n,_),bn.dash,bn.cap),Te.show&&Ol([Ne],[1],I==0?1:0,I==0?1:2,I==1?Et:lt,I==1?It:Gt,Ce(Te.width*ye,3),Te.stroke(n,_),Te.dash,Te.cap)}hn("drawAxes")}function Bs(_){b.forEach((M,P)=>{P>0&&(M._paths=null,_&&(s==1?(M.min=null,M.max=null):M.facets.forEach(I=>{I.min=null,I.max=null})))})}let Ho=!1,Fl=!1,so=[];function qm(){Fl=!1;for(let _=0;_<so.length;_++)hn(...so[_]);so.length=0}function zs(){Ho||(Lb(lu),Ho=!0)}function Ym(_,M=!1){Ho=!0,Fl=M,_(n),lu(),M&&so.length>0&&queueMicrotask(qm)}n.batch=Ym;function lu(){if(xt&&(fi(),xt=!1),Zt&&(Ft(),Zt=!1),Xt){if(Oe(g,kr,rt),Oe(g,Eo,et),Oe(g,Ao,G),Oe(g,Co,tt),Oe(v,kr,rt),Oe(v,Eo,et),Oe(v,Ao,G),Oe(v,Co,tt),Oe(p,Ao,D),Oe(p,Co,w),d.width=rn(D*ye),d.height=rn(w*ye),A.forEach(({_el:_,_show:M,_size:P,_pos:I,side:k})=>{if(_!=null)if(M){let K=k===3||k===0?P:0,ot=k%2==1;Oe(_,ot?"left":"top",I-K),Oe(_,ot?"width":"height",P),Oe(_,ot?"top":"left",ot?et:rt),Oe(_,ot?"height":"width",ot?tt:G),Rh(_,Ns)}else Hn(_,Ns)}),Vt=ae=Re=fn=pe=Ot=Qe=ge=Pe=null,tn=1,ao(!0),rt!=At||et!=vt||G!=yt||tt!=Wt){Bs(!1);let _=G/yt,M=tt/Wt;if(Mt.show&&!xe&&Mt.left>=0){Mt.left*=_,Mt.top*=M,Vs&&Si(Vs,rn(Mt.left),0,G,tt),Hs&&Si(Hs,0,rn(Mt.top),G,tt);for(let P=0;P<Xe.length;P++){let I=Xe[P];I!=null&&(Rn[P]*=_,Ei[P]*=M,Si(I,Qn(Rn[P]),Qn(Ei[P]),G,tt))}}if(De.show&&!y&&De.left>=0&&De.width>0){De.left*=_,De.width*=_,De.top*=M,De.height*=M;for(let P in Gl)Oe(Xs,P,De[P])}At=rt,vt=et,yt=G,Wt=tt}hn("setSize"),Xt=!1}D>0&&w>0&&(h.clearRect(0,0,d.width,d.height),hn("drawClear"),S.forEach(_=>_()),hn("draw")),De.show&&y&&(Go(De),y=!1),Mt.show&&xe&&(ms(null,!0,!1),xe=!1),mt.show&&mt.live&&j&&(Vl(),j=!1),c||(c=!0,n.status=1,hn("ready")),Lt=!1,Ho=!1}n.redraw=(_,M)=>{Zt=M||!1,_!==!1?Hi(C,R.min,R.max):zs()};function kl(_,M){let P=N[_];if(P.from==null){if($==0){let I=P.range(n,M.min,M.max,_);M.min=I[0],M.max=I[1]}if(M.min>M.max){let I=M.min;M.min=M.max,M.max=I}if($>1&&M.min!=null&&M.max!=null&&M.max-M.min<1e-16)return;_==C&&P.distr==2&&$>0&&(M.min=ui(M.min,t[0]),M.max=ui(M.max,t[0]),M.min==M.max&&M.max++),J[_]=M,xt=!0,zs()}}n.setScale=kl;let Bl,zl,Vs,Hs,cu,hu,Gs,Ws,uu,du,Ie,ke,Vi=!1,pn=Mt.drag,ln=pn.x,cn=pn.y;Mt.show&&(Mt.x&&(Bl=jn(eb,v)),Mt.y&&(zl=jn(nb,v)),R.ori==0?(Vs=Bl,Hs=zl):(Vs=zl,Hs=Bl),Ie=Mt.left,ke=Mt.top);let De=n.select=Ke({show:!0,over:!0,left:0,width:0,top:0,height:0},i.select),Xs=De.show?jn(tb,De.over?v:g):null;function Go(_,M){if(De.show){for(let P in _)De[P]=_[P],P in Gl&&Oe(Xs,P,_[P]);M!==!1&&hn("setSelect")}}n.setSelect=Go;function Zm(_,M){let P=b[_],I=kt?Ht[_]:null;if(P.show)I&&Rh(I,Ns);else{I&&Hn(I,Ns);let k=xn?Xe[0]:Xe[_];Si(k,-10,-10,G,tt)}}function Hi(_,M,P){kl(_,{min:M,max:P})}function pi(_,M,P,I){M.focus!=null&&tg(_),M.show!=null&&b.forEach((k,K)=>{K>0&&(_==K||_==null)&&(k.show=M.show,Zm(K,M.show),s==2?(Hi(k.facets[0].scale,null,null),Hi(k.facets[1].scale,null,null)):Hi(k.scale,null,null),zs())}),P!==!1&&hn("setSeries",_,M),I&&lo("setSeries",n,_,M)}n.setSeries=pi;function Jm(_,M){Ke(L[_],M)}function Km(_,M){_.fill=he(_.fill||null),_.dir=_e(_.dir,-1),M=M??L.length,L.splice(M,0,_)}function jm(_){_==null?L.length=0:L.splice(_,1)}n.addBand=Km,n.setBand=Jm,n.delBand=jm;function Qm(_,M){b[_].alpha=M,Mt.show&&Xe[_]&&(Xe[_].style.opacity=M),kt&&Ht[_]&&(Ht[_].style.opacity=M)}let Ai,Gi,ps,$s={focus:!0};function tg(_){if(_!=ps){let M=_==null,P=ze.alpha!=1;b.forEach((I,k)=>{if(s==1||k>0){let K=M||k==0||k==_;I._focus=M?null:K,P&&Qm(k,K?1:ze.alpha)}}),ps=_,P&&zs()}}kt&&We&&zt(jf,ct,_=>{Mt._lock||(Ee(_),ps!=null&&pi(null,$s,!0,$e.setSeries))});function mi(_,M,P){let I=N[M];P&&(_=_/ye-(I.ori==1?et:rt));let k=G;I.ori==1&&(k=tt,_=k-_),I.dir==-1&&(_=k-_);let K=I._min,ot=I._max,ut=_/k,_t=K+(ot-K)*ut,Tt=I.distr;return Tt==3?Hr(10,_t):Tt==4?yb(_t,I.asinh):Tt==100?I.bwd(_t):_t}function eg(_,M){let P=mi(_,C,M);return ui(P,t[0],H,at)}n.valToIdx=_=>ui(_,t[0]),n.posToIdx=eg,n.posToVal=mi,n.valToPos=(_,M,P)=>N[M].ori==0?o(_,N[M],P?Gt:G,P?lt:0):a(_,N[M],P?It:tt,P?Et:0),n.setCursor=(_,M,P)=>{Ie=_.left,ke=_.top,ms(null,M,P)};function fu(_,M){Oe(Xs,kr,De.left=_),Oe(Xs,Ao,De.width=M)}function pu(_,M){Oe(Xs,Eo,De.top=_),Oe(Xs,Co,De.height=M)}let ro=R.ori==0?fu:pu,oo=R.ori==1?fu:pu;function ng(){if(kt&&mt.live)for(let _=s==2?1:0;_<b.length;_++){if(_==0&&O)continue;let M=mt.values[_],P=0;for(let I in M)Bt[_][P++].firstChild.nodeValue=M[I]}}function Vl(_,M){if(_!=null&&(_.idxs?_.idxs.forEach((P,I)=>{pt[I]=P}):wb(_.idx)||pt.fill(_.idx),mt.idx=pt[0]),kt&&mt.live){for(let P=0;P<b.length;P++)(P>0||s==1&&!O)&&ig(P,pt[P]);ng()}j=!1,M!==!1&&hn("setLegend")}n.setLegend=Vl;function ig(_,M){let P=b[_],I=_==0&&z==2?wt:t[_],k;O?k=P.values(n,_,M)??jt:(k=P.value(n,M==null?null:I[M],_,M),k=k==null?jt:{_:k}),mt.values[_]=k}function ms(_,M,P){uu=Ie,du=ke,[Ie,ke]=Mt.move(n,Ie,ke),Mt.left=Ie,Mt.top=ke,Mt.show&&(Vs&&Si(Vs,rn(Ie),0,G,tt),Hs&&Si(Hs,0,rn(ke),G,tt));let I,k=H>at;Ai=ue,Gi=null;let K=R.ori==0?G:tt,ot=R.ori==1?G:tt;if(Ie<0||$==0||k){I=Mt.idx=null;for(let ut=0;ut<b.length;ut++){let _t=Xe[ut];_t!=null&&Si(_t,-10,-10,G,tt)}We&&pi(null,$s,!0,_==null&&$e.setSeries),mt.live&&(pt.fill(I),j=!0)}else{let ut,_t,Tt;s==1&&(ut=R.ori==0?Ie:ke,_t=mi(ut,C),I=Mt.idx=ui(_t,t[0],H,at),Tt=B(t[0][I],R,K,0));let Ct=-10,Pt=-10,Qt=0,Ae=0,de=!0,le="",ne="";for(let Dt=s==2?1:0;Dt<b.length;Dt++){let Te=b[Dt],Ge=pt[Dt],Ve=Ge==null?null:s==1?t[Dt][Ge]:t[Dt][1][Ge],Ne=Mt.dataIdx(n,Dt,I,_t),qe=Ne==null?null:s==1?t[Dt][Ne]:t[Dt][1][Ne];j=j||qe!=Ve||Ne!=Ge,pt[Dt]=Ne;let Ln=Ne==I?Tt:B(s==1?t[0][Ne]:t[Dt][0][Ne],R,K,0);if(Dt>0&&Te.show){let In=qe==null?-10:X(qe,s==1?N[Te.scale]:N[Te.facets[1].scale],ot,0);if(We&&qe!=null){let Xn=R.ori==1?Ie:ke,ei=on(ze.dist(n,Dt,Ne,In,Xn));if(ei<Ai){let ni=ze.bias;if(ni!=0){let Mn=mi(Xn,Te.scale),gi=qe>=0?1:-1,bn=Mn>=0?1:-1;bn==gi&&(bn==1?ni==1?qe>=Mn:qe<=Mn:ni==1?qe<=Mn:qe>=Mn)&&(Ai=ei,Gi=Dt)}else Ai=ei,Gi=Dt}}if(j||xn){let Xn,ei;R.ori==0?(Xn=Ln,ei=In):(Xn=In,ei=Ln);let ni,Mn,gi,bn,wn,Fn,Ys=!0,Xi=oe.bbox;if(Xi!=null){Ys=!1;let $n=Xi(n,Dt);gi=$n.left,bn=$n.top,ni=$n.width,Mn=$n.height}else gi=Xn,bn=ei,ni=Mn=oe.size(n,Dt);if(Fn=oe.fill(n,Dt),wn=oe.stroke(n,Dt),xn)Dt==Gi&&Ai<=ze.prox&&(Ct=gi,Pt=bn,Qt=ni,Ae=Mn,de=Ys,le=Fn,ne=wn);else{let $n=Xe[Dt];$n!=null&&(Rn[Dt]=gi,Ei[Dt]=bn,rp($n,ni,Mn,Ys),ip($n,Fn,wn),Si($n,Qn(gi),Qn(bn),G,tt))}}}}if(xn){let Dt=ze.prox,Te=ps==null?Ai<=Dt:Ai>Dt||Gi!=ps;if(j||Te){let Ge=Xe[0];Rn[0]=Ct,Ei[0]=Pt,rp(Ge,Qt,Ae,de),ip(Ge,le,ne),Si(Ge,Qn(Ct),Qn(Pt),G,tt)}}}if(De.show&&Vi)if(_!=null){let[ut,_t]=$e.scales,[Tt,Ct]=$e.match,[Pt,Qt]=_.cursor.sync.scales,Ae=_.cursor.drag;if(ln=Ae._x,cn=Ae._y,ln||cn){let{left:de,top:le,width:ne,height:Dt}=_.select,Te=_.scales[Pt].ori,Ge=_.posToVal,Ve,Ne,qe,Ln,In,Xn=ut!=null&&Tt(ut,Pt),ei=_t!=null&&Ct(_t,Qt);Xn&&ln?(Te==0?(Ve=de,Ne=ne):(Ve=le,Ne=Dt),qe=N[ut],Ln=B(Ge(Ve,Pt),qe,K,0),In=B(Ge(Ve+Ne,Pt),qe,K,0),ro(ti(Ln,In),on(In-Ln))):ro(0,K),ei&&cn?(Te==1?(Ve=de,Ne=ne):(Ve=le,Ne=Dt),qe=N[_t],Ln=X(Ge(Ve,Qt),qe,ot,0),In=X(Ge(Ve+Ne,Qt),qe,ot,0),oo(ti(Ln,In),on(In-Ln))):oo(0,ot)}else Wo()}else{let ut=on(uu-cu),_t=on(du-hu);if(R.ori==1){let Qt=ut;ut=_t,_t=Qt}ln=pn.x&&ut>=pn.dist,cn=pn.y&&_t>=pn.dist;let Tt=pn.uni;Tt!=null?ln&&cn&&(ln=ut>=Tt,cn=_t>=Tt,!ln&&!cn&&(_t>ut?cn=!0:ln=!0)):pn.x&&pn.y&&(ln||cn)&&(ln=cn=!0);let Ct,Pt;ln&&(R.ori==0?(Ct=Gs,Pt=Ie):(Ct=Ws,Pt=ke),ro(ti(Ct,Pt),on(Pt-Ct)),cn||oo(0,ot)),cn&&(R.ori==1?(Ct=Gs,Pt=Ie):(Ct=Ws,Pt=ke),oo(ti(Ct,Pt),on(Pt-Ct)),ln||ro(0,K)),!ln&&!cn&&(ro(0,0),oo(0,0))}if(pn._x=ln,pn._y=cn,_==null){if(P){if(Eu!=null){let[ut,_t]=$e.scales;$e.values[0]=ut!=null?mi(R.ori==0?Ie:ke,ut):null,$e.values[1]=_t!=null?mi(R.ori==1?Ie:ke,_t):null}lo(Zf,n,Ie,ke,G,tt,I)}if(We){let ut=P&&$e.setSeries,_t=ze.prox;ps==null?Ai<=_t&&pi(Gi,$s,!0,ut):Ai>_t?pi(null,$s,!0,ut):Gi!=ps&&pi(Gi,$s,!0,ut)}}j&&(mt.idx=I,Vl()),M!==!1&&hn("setCursor")}let Wi=null;Object.defineProperty(n,"rect",{get(){return Wi==null&&ao(!1),Wi}});function ao(_=!1){_?Wi=null:(Wi=v.getBoundingClientRect(),hn("syncRect",Wi))}function mu(_,M,P,I,k,K,ot){Mt._lock||Vi&&_!=null&&_.movementX==0&&_.movementY==0||(Hl(_,M,P,I,k,K,ot,!1,_!=null),_!=null?ms(null,!0,!0):ms(M,!0,!1))}function Hl(_,M,P,I,k,K,ot,ut,_t){if(Wi==null&&ao(!1),Ee(_),_!=null)P=_.clientX-Wi.left,I=_.clientY-Wi.top;else{if(P<0||I<0){Ie=-10,ke=-10;return}let[Tt,Ct]=$e.scales,Pt=M.cursor.sync,[Qt,Ae]=Pt.values,[de,le]=Pt.scales,[ne,Dt]=$e.match,Te=M.axes[0].side%2==1,Ge=R.ori==0?G:tt,Ve=R.ori==1?G:tt,Ne=Te?K:k,qe=Te?k:K,Ln=Te?I:P,In=Te?P:I;if(de!=null?P=ne(Tt,de)?l(Qt,N[Tt],Ge,0):-10:P=Ge*(Ln/Ne),le!=null?I=Dt(Ct,le)?l(Ae,N[Ct],Ve,0):-10:I=Ve*(In/qe),R.ori==1){let Xn=P;P=I,I=Xn}}_t&&((P<=1||P>=G-1)&&(P=Is(P,G)),(I<=1||I>=tt-1)&&(I=Is(I,tt))),ut?(cu=P,hu=I,[Gs,Ws]=Mt.move(n,P,I)):(Ie=P,ke=I)}let Gl={width:0,height:0,left:0,top:0};function Wo(){Go(Gl,!1)}let gu,_u,vu,yu;function xu(_,M,P,I,k,K,ot){Vi=!0,ln=cn=pn._x=pn._y=!1,Hl(_,M,P,I,k,K,ot,!0,!1),_!=null&&(zt(bh,Ah,Mu,!1),lo(Jf,n,Gs,Ws,G,tt,null));let{left:ut,top:_t,width:Tt,height:Ct}=De;gu=ut,_u=_t,vu=Tt,yu=Ct,Wo()}function Mu(_,M,P,I,k,K,ot){Vi=pn._x=pn._y=!1,Hl(_,M,P,I,k,K,ot,!1,!0);let{left:ut,top:_t,width:Tt,height:Ct}=De,Pt=Tt>0||Ct>0,Qt=gu!=ut||_u!=_t||vu!=Tt||yu!=Ct;if(Pt&&Qt&&Go(De),pn.setScale&&Pt&&Qt){let Ae=ut,de=Tt,le=_t,ne=Ct;if(R.ori==1&&(Ae=_t,de=Ct,le=ut,ne=Tt),ln&&Hi(C,mi(Ae,C),mi(Ae+de,C)),cn)for(let Dt in N){let Te=N[Dt];Dt!=C&&Te.from==null&&Te.min!=ue&&Hi(Dt,mi(le+ne,Dt),mi(le,Dt))}Wo()}else Mt.lock&&(Mt._lock=!Mt._lock,ms(null,!0,!1));_!=null&&(Se(bh,Ah),lo(bh,n,Ie,ke,G,tt,null))}function sg(_,M,P,I,k,K,ot){if(Mt._lock)return;Ee(_);let ut=Vi;if(Vi){let _t=!0,Tt=!0,Ct=10,Pt,Qt;R.ori==0?(Pt=ln,Qt=cn):(Pt=cn,Qt=ln),Pt&&Qt&&(_t=Ie<=Ct||Ie>=G-Ct,Tt=ke<=Ct||ke>=tt-Ct),Pt&&_t&&(Ie=Ie<Gs?0:G),Qt&&Tt&&(ke=ke<Ws?0:tt),ms(null,!0,!0),Vi=!1}Ie=-10,ke=-10,ms(null,!0,!0),ut&&(Vi=ut)}function bu(_,M,P,I,k,K,ot){Mt._lock||(Ee(_),qt(),Wo(),_!=null&&lo(Qf,n,Ie,ke,G,tt,null))}function wu(){A.forEach(Bw),Y(n.width,n.height,!0)}Us(ul,zr,wu);let qs={};qs.mousedown=xu,qs.mousemove=mu,qs.mouseup=Mu,qs.dblclick=bu,qs.setSeries=(_,M,P,I)=>{let k=$e.match[2];P=k(n,M,P),P!=-1&&pi(P,I,!0,!1)},Mt.show&&(zt(Jf,v,xu),zt(Zf,v,mu),zt(Kf,v,_=>{Ee(_),ao(!1)}),zt(jf,v,sg),zt(Qf,v,bu),Uh.add(n),n.syncRect=ao);let Xo=n.hooks=i.hooks||{};function hn(_,M,P){Fl?so.push([_,M,P]):_ in Xo&&Xo[_].forEach(I=>{I.call(null,n,M,P)})}(i.plugins||[]).forEach(_=>{for(let M in _.hooks)Xo[M]=(Xo[M]||[]).concat(_.hooks[M])});let Su=(_,M,P)=>P,$e=Ke({key:null,setSeries:!1,filters:{pub:hp,sub:hp},scales:[C,b[1]?b[1].scale:null],match:[up,up,Su],values:[null,null]},Mt.sync);$e.match.length==2&&$e.match.push(Su),Mt.sync=$e;let Eu=$e.key,Wl=im(Eu);function lo(_,M,P,I,k,K,ot){$e.filters.pub(_,M,P,I,k,K,ot)&&Wl.pub(_,M,P,I,k,K,ot)}Wl.sub(n);function rg(_,M,P,I,k,K,ot){$e.filters.sub(_,M,P,I,k,K,ot)&&qs[_](null,M,P,I,k,K,ot)}n.pub=rg;function og(){Wl.unsub(n),Uh.delete(n),Yt.clear(),Ph(ul,zr,wu),u.remove(),ct?.remove(),hn("destroy")}n.destroy=og;function Xl(){hn("init",i,t),$t(t||i.data,!1),J[C]?kl(C,J[C]):qt(),y=De.show&&(De.width>0||De.height>0),xe=j=!0,Y(i.width,i.height)}return b.forEach(no),A.forEach(Nl),e?e instanceof HTMLElement?(e.appendChild(u),Xl()):e(n,Xl):Xl(),n}je.assign=Ke;je.fmtNum=Hh;je.rangeNum=dl;je.rangeLog=pl;je.rangeAsinh=zh;je.orient=Fs;je.pxRatio=ye;je.join=Pb;je.fmtDate=Wh,je.tzDate=Vb;je.sync=im;{je.addGap=ww,je.clipGaps=_l;let i=je.paths={points:cm};i.linear=um,i.stepped=Tw,i.bars=Aw,i.spline=Rw}function Kh(i,t){return i.map(e=>e===null?null:Math.hypot(...e)*t)}function mm(i){let t=i[0]?.length??0;return Array.from({length:Math.max(0,t-1)},(e,n)=>{let s=[];for(let r of i){let o=r[n],a=r[n+1];if(o===null||a===null)return null;s.push(a-o)}return s})}function gm(i,t){return Qh(Kh(mm(i),t),i[0]?.length??0)}function _m(i,t){return jh(mm(i),t,i[0]?.length??0)}function vm(i,t,e){return Qh(Kh(i,t),e)}function jh(i,t,e){let n=i.slice(1).map((s,r)=>{let o=i[r];return s===null||o===null?null:s.map((a,l)=>a-o[l])});return Qh([null,...Kh(n,t*t)],e)}function Qh(i,t){let e=i.slice(0,t);for(;e.length<t;)e.push(e.length>1?e[e.length-1]:null);return e}function zw(i,t){let e=i.length;for(let n=1,s=0;n<e;++n){let r=e>>1;for(;s&r;r>>=1)s^=r;s^=r,n<s&&([i[n],i[s]]=[i[s],i[n]],[t[n],t[s]]=[t[s],t[n]])}for(let n=2;n<=e;n*=2){let s=-2*Math.PI/n;for(let r=0;r<e;r+=n)for(let o=0;o<n/2;++o){let a=Math.cos(s*o),l=Math.sin(s*o),c=r+o,u=c+n/2,d=i[u]*a-t[u]*l,h=i[u]*l+t[u]*a;i[u]=i[c]-d,t[u]=t[c]-h,i[c]+=d,t[c]+=h}}}function ym(i,t,e=1024){let n=i[0]?.length??0,s=8;for(;s*2<=Math.min(e,n);)s*=2;let r=new Float64Array(s/2+1),o=Float64Array.from({length:s},(d,h)=>.5-.5*Math.cos(2*Math.PI*h/s)),a=o.reduce((d,h)=>d+h*h,0),l=0;for(let d of i)for(let h=0;h+s<=n;h+=s/2){let p=d.slice(h,h+s);if(p.some(f=>f===null))continue;let g=p.reduce((f,T)=>f+T,0)/s,v=Float64Array.from(p,(f,T)=>(f-g)*o[T]),m=new Float64Array(s);zw(v,m);for(let f=0;f<r.length;++f){let T=f===0||f===s/2?1:2;r[f]+=T*(v[f]**2+m[f]**2)/(t*a)}++l}let c=l/Math.max(1,i.length),u=l>0?r.length-1:0;return{hertz:Array.from({length:u},(d,h)=>(h+1)*t/s),density:Array.from({length:u},(d,h)=>r[h+1]/c)}}var Vw=1e4,Hw=100,Gw=["axis-1","axis-2","axis-3"],xm="\xB2",Mm={show:()=>U("i")};function Ww(i){let t=Math.max(1e-15,1e-12*Math.max(...i));return i.map(e=>e>t?e:null)}var eu=[1,2,5].flatMap(i=>Array.from({length:9},(t,e)=>i*10**e)).sort((i,t)=>i-t);function Xw(i){let t=Number(i.toPrecision(10));return Math.abs(t)>=1e5?`${(t/1e3).toLocaleString("en-US")}k`:t.toLocaleString("en-US",{maximumFractionDigits:6})}var tu=class{constructor(t,e,n){this.take=t;this.track=e;this.quantity=n;this.axes=new Map;let s=n==="rotation";this.names=s?[...t.order(e)]:["X","Y","Z"],this.unit=s?"deg":t.data.unit||"units";for(let r of t.takes)this.axes.set(r,s?t.angles(e,r):t.path(e,r))}of(t){return this.axes.get(t)??[]}turns(t){let{take:e,track:n}=this;return Array.from({length:Math.max(0,e.told-1)},(s,r)=>e.isMissing(n,r,t)||e.isMissing(n,r+1,t)?null:zu(e.rotation(n,r,t),e.rotation(n,r+1,t)))}speed(t){return this.quantity==="position"?gm(this.of(t),this.take.rate):vm(this.turns(t),this.take.rate,this.take.told)}acceleration(t){return this.quantity==="position"?_m(this.of(t),this.take.rate):jh(this.turns(t),this.take.rate,this.take.told)}difference(){let{take:t,track:e}=this;if(this.quantity==="rotation")return t.turnsApart(e);let n=this.of("before"),s=this.of("after");return Array.from({length:t.told},(r,o)=>n.some(a=>a[o]===null)||s.some(a=>a[o]===null)?null:Math.hypot(...n.map((a,l)=>s[l][o]-a[o])))}},Ml=class{constructor(t,e,n){this.holder=t;this.take=e;this.player=n;this.kinds=new Set(["values","difference"]);this.plots=[];this.signals=new Map;this.isStarted=!1;this.isZooming=!1;this.turn=0;this.whole=Promise.resolve();this.told=0;this.spectra=[];this.quantity=e.isJoints?"rotation":"position",e.data.two||(this.kinds=new Set(["values"])),n.onChoice(()=>this.rebuild()),n.onZoom(()=>this.rescale()),n.onMove(()=>this.drawCursor()),new ResizeObserver(()=>this.resize()).observe(t)}forget(){this.signals.clear(),this.rebuild()}signal(t){let e=`${this.quantity} ${t}`,n=this.signals.get(e);if(n)return n;let s=new tu(this.take,t,this.quantity);return this.signals.set(e,s),s}label(t){return this.take.data.labels[t==="before"?0:1]}pair(t){return this.take.takes.map(e=>({label:this.take.data.two?this.label(e):"value",values:t(e),colour:this.take.data.two?e:"after",width:e===this.take.last?1.5:1}))}lines(t,e){if(e==="speed")return this.pair(s=>t.speed(s));if(e==="acceleration")return this.pair(s=>t.acceleration(s));if(e==="difference")return[{label:"difference",values:t.difference(),colour:"text",width:1.25}];let n=[];for(let s of this.take.takes){let r=s==="before"&&this.take.data.two;t.of(s).forEach((o,a)=>n.push({label:this.take.data.two?`${t.names[a]} ${this.label(s)}`:t.names[a],values:o,colour:Gw[a]+(r?"-faint":""),width:r?1:1.6}))}return n}unit(t,e){return e==="speed"?`${t.unit}/s`:e==="acceleration"?`${t.unit}/s${xm}`:t.unit}start(){this.isStarted=!0,this.rebuild()}rebuild(){if(!this.isStarted)return;++this.turn;for(let e of this.plots)e.destroy();if(this.plots=[],this.holder.replaceChildren(),this.take.told===0){this.holder.append(U("p",{class:"empty"},"The take has no frames."));return}if(this.player.chosen.length===0){let e=this.take.isJoints?"joint":"marker";this.holder.append(U("p",{class:"empty"},`Choose a ${e} in the table to show its curves.`));return}let t=this.player.chosen.flatMap(e=>this.panelsOf(e));if(this.take.told<=Vw){for(let e of t)e();this.rescale(),this.drawCursor(),this.whole=Promise.resolve()}else this.whole=this.addInTurn(t,this.turn)}async addInTurn(t,e){for(let n of t){if(await Ks(),e!==this.turn)return;n(),this.rescale(),this.drawCursor()}}panelsOf(t){let n=["values","difference","speed","acceleration","spectrum"].filter(r=>this.kinds.has(r)&&(r!=="difference"||this.take.data.two)),s=!1;return[()=>{s=this.addWords(t)},...n.map(r=>()=>{s||this.addKind(t,r)})]}addWords(t){let e=this.signal(t),n=this.take.nameOf(t);return e.names.length===0?(this.holder.append(U("p",{class:"empty"},`${n} has no rotation in this take.`)),!0):this.take.takes.every(s=>e.of(s).every(r=>r.every(o=>o===null)))?(this.holder.append(U("p",{class:"empty"},`${$i(n)} is missing in every frame.`)),!0):!1}addKind(t,e){let n=this.signal(t),s=this.take.nameOf(t),r=e==="values"?this.quantity==="rotation"?"angles":"position":e,o=e==="spectrum"?`${n.unit}${xm}/Hz`:this.unit(n,e),a=U("figure",{class:"panel"},U("figcaption",{},U("b",{},$i(s)),` ${r}, ${o}`));this.holder.append(a),e==="spectrum"?this.addSpectrum(a,n):this.addPanel(a,this.lines(n,e)),Zs(a.querySelector("canvas"),`${s}, ${r} in ${o}${this.take.data.two?`: ${this.take.data.labels.join(" and ")}`:""}`)}common(t){return{width:t,height:150,axis:{stroke:Le("quiet"),grid:{stroke:Le("grid"),width:1},ticks:{stroke:Le("grid"),width:1},font:"11px system-ui, sans-serif"}}}get width(){return Math.max(200,this.holder.clientWidth-2)}addPanel(t,e){let{axis:n,...s}=this.common(this.width),r=Array.from({length:this.take.told},(a,l)=>this.take.number(l)),o={...s,padding:[6,22,0,0],scales:{x:{time:!1}},cursor:{y:!1,sync:{key:"kinemend"},drag:{x:!0,y:!1,setScale:!0},points:Mm},series:[{label:"frame"},...e.map(a=>({label:a.label,stroke:Le(a.colour),width:a.width,points:{show:this.take.told<3}}))],axes:[{...n,size:30,incrs:eu},{...n,size:68,values:(a,l)=>l.map(Xw)}],hooks:{setScale:[(a,l)=>{l==="x"&&this.takeZoom(a)}],draw:[a=>this.cursorIn(a)],ready:[a=>this.listen(a)]}};this.plots.push(new je(o,[r,...e.map(a=>a.values)],t))}listen(t){t.over.append(U("i",{class:"time-cursor"})),this.cursorIn(t);let e=0;t.over.addEventListener("mousedown",n=>{e=n.clientX}),t.over.addEventListener("click",n=>{Math.abs(n.clientX-e)<3&&this.player.seek(this.take.frameOf(t.posToVal(n.offsetX,"x")))}),t.over.addEventListener("dblclick",()=>this.player.zoom(0,this.take.told-1)),t.over.addEventListener("wheel",n=>{if(!n.ctrlKey&&!n.shiftKey)return;n.preventDefault();let s=this.take.frameOf(t.posToVal(n.offsetX,"x"));this.player.zoomBy(n.deltaY+n.deltaX>0?1.25:.8,s)},{passive:!1})}takeZoom(t){let{min:e,max:n}=t.scales.x;if(this.isZooming||e===void 0||n===void 0||e===null||n===null||t.status!==1)return;let{step:s,first_frame:r}=this.take.data;this.player.zoom((e-r)/s,(n-r)/s)}rescale(){this.isZooming=!0;let t=this.take.number(this.player.from),e=this.take.number(this.player.to);for(let n of this.plots)n.setScale("x",{min:t,max:e});queueMicrotask(()=>queueMicrotask(()=>{this.isZooming=!1}))}cursorIn(t){let e=t.over.querySelector(".time-cursor");if(e===null)return;let n=t.valToPos(this.take.number(this.player.shown),"x");e.hidden=!(n>=0&&n<=t.over.clientWidth),e.hidden||(e.style.transform=`translateX(${n}px)`)}drawCursor(){for(let e of this.plots)this.cursorIn(e);let t=performance.now();if(!(this.player.playing&&t-this.told<Hw)){this.told=t;for(let e of this.plots)queueMicrotask(()=>{(e.cursor.left??-1)<0&&e.setLegend({idx:this.player.shown},!1)})}}addSpectrum(t,e){let{axis:n,...s}=this.common(this.width),r=this.take.takes.map(c=>ym(e.of(c),this.take.rate));if(r.every(c=>c.hertz.length===0)){t.append(U("p",{class:"empty"},"A spectrum needs more samples without a gap."));return}let o=r.find(c=>c.hertz.length>0)?.hertz??[],a=this.take.takes.map(c=>({label:this.take.data.two?this.label(c):"density",stroke:Le(this.take.data.two?c:"after"),width:1.5})),l=new je({...s,padding:[6,22,0,0],scales:{x:{time:!1},y:{distr:3}},cursor:{y:!1,points:Mm},series:[{label:"Hz"},...a],axes:[{...n,size:30,values:(c,u)=>u.map(d=>`${d} Hz`)},{...n,size:68,values:(c,u)=>u.map(d=>d===null||Math.log10(d)%1?"":d.toExponential(0))}]},[o,...r.map(({density:c})=>Ww(c))],t);t.dataset.spectrum="true",this.spectra.push(l)}resize(){for(let t of[...this.plots,...this.spectra])Math.abs(t.width-this.width)>1&&t.setSize({width:this.width,height:150})}};var $w=/filled|refused|count|frames|gap|spikes|frozen|bridged|swaps|flips|percent|samples|above_6_hz|_s$|_s2$|_hz$|_deg$|_cm$|missing/,qw={noise:"How strongly the {track} trembles before cleaning: standard deviation on each axis, in {unit}.",expected_noise:"How much noise the model of the method expects in the {track} and takes out: standard deviation on each axis, in {unit}.",rms_change:"How much cleaning changed the {track}: root mean square over all frames, in {unit}.",max_change:"The largest change in any frame, in {unit}.",frames_changed:"Number of frames in which the {track} was changed.",frames_repaired:"Number of frames in which a spike was repaired or a gap filled.",peak_speed_before:"The highest speed before cleaning, in {unit} per second, spikes left out.",peak_speed_after:"The highest speed after cleaning, in {unit} per second. Much less than before: real motion may be lost.",peak_frames:"Number of frames for which the peak of speed lasts. A short one is more likely to be lost.",left:"The error that is expected to be left after cleaning: standard deviation on each axis, in {unit}.",gaps_left:"Number of gaps that stay open.",frames_missing:"Number of frames in which the {track} is still missing.",gaps:"Number of gaps: spans of frames in which samples are missing.",longest_gap:"Length of the longest gap, in frames.",missing_frames:"Number of frames in which the {track} is missing.",spikes:"Number of spikes: leaps away from the motion and back within a few frames.",frozen:"Number of spans in which the {track} does not change at all while others move.",bridged:"Number of spans that another program seems to have filled by a straight line.",swaps:"Number of spans in which two markers have each other\u2019s label.",flips:"Number of frames at which Euler angles leap although the rotation does not.",peak_speed_deg_s:"The highest speed, in degrees per second.",peak_acceleration_deg_s2:"The largest acceleration, in degrees per second squared.",filled:"Number of gaps that were filled.","filled frames":"Number of frames that were filled.",refused:"Number of gaps that stay open, because a fill would be a guess.","refused frames":"Number of frames in these gaps.",geodesic_rms_deg:"Angle between the rotations of the two takes: root mean square over all frames, in degrees.",geodesic_max_deg:"The largest angle between the two takes in any frame, in degrees.",peak_speed_reference_deg_s:"The highest speed in the reference, in degrees per second.",peak_speed_other_deg_s:"The highest speed in the other take, in degrees per second.",samples:"Number of frames in which both takes have the {track}.",rms_distance:"Distance between the two takes: root mean square over all frames, in {unit}.",max_distance:"The largest distance between the two takes in any frame, in {unit}.",rms_axis:"Difference along one axis: root mean square over all frames and axes, in {unit}.",velocity_rms:"Difference of velocities: root mean square over all frames, in {unit} per second.",above_6_hz:"How much of the motion faster than 6 Hz the other take has, as a share of the reference; 1: the same."},bm={slide_cm:["slide of a standing foot","cm","The farthest that a foot travels over the floor while it should stand."],sink_cm:["depth below the floor","cm","How far a standing foot is below the floor at most."],foot_slide:["slide a frame, of the other take","","Mean distance that a standing foot travels over the floor from one frame to the next, in units of the file."],foot_slide_reference:["slide a frame, of the reference","","The same in the reference."]};function nu(i){return i in bm}function wm(i){return bm[i]}function Sm(i,t,e){return(qw[i]??"").replaceAll("{track}",t).replaceAll("{unit}",e==="deg"?"degrees":e||"units of the file")}function Em(i,t){return!t||$w.test(i)?"":/^(peak_speed|velocity)/.test(i)?`${t}/s`:t}var Tm=["rms_change","geodesic_rms_deg","rms_distance","noise","gaps","filled frames"];function bl(i){let t=U("dl");for(let[e,n,s]of i)t.append(U("div",{title:s},U("dt",{},e),U("dd",{},n)));return t}function Zr(i,...t){return U("section",{class:"box"},U("h2",{},i),...t)}function Yw(i){let t=new Set;for(let{first_frame:e,last_frame:n}of i)for(let s=e;s<=n;++s)t.add(s);return t.size}function Am({reason:i}){return i?.startsWith("stands still")?"stand still already":i?.endsWith("intended")?"slide on purpose":i?.endsWith("farther than an error does")?"uncertain: slide too far for an error":`left: ${i??""}`}function Zw(i){let t=Object.entries(i.figures).filter(([h,p])=>nu(h)&&p!==null).map(([h,p])=>{let[g,v,m]=wm(h);return[g,`${me(p)} ${v}`.trim(),m]}),{feet:e}=i;if(!e)return t;let n=e.contacts??[],s=n.filter(({held:h})=>!h),r=h=>`${Dn(h.length,"contact")}, ${me(Yw(h)/(i.frame_rate_hz||1))} s`;if(t.push(["feet stand",n.length===0?"no contacts found":r(n),"Times in which a heel or a toe is on the floor, and seconds in which at least one is."],["expected",`about ${me(e.time.expected_s)} s`,"The time in which feet likely stand, from the motion of the whole body, summed over feet. Much more than is found: contacts are missing."]),n.length===0)return t;t.push(["confidence",me(e.time.confidence),"How likely feet stand in the contacts, on average; 1 is certain."]),t.push(["held",r(n.filter(({held:h})=>h)),"Contacts whose sliding was taken out."]);let o=new Map;for(let h of s)o.set(Am(h),[...o.get(Am(h))??[],h]);for(let[h,p]of o)t.push([h,r(p),"Contacts that were left as they are."]);t.push(["frames adjusted",un(e.frames_adjusted),"Frames in which a leg or the root was moved to hold a foot."]);let{before:a,after:l}=e;if(!a||!l)return t;let c=e.metres_per_unit?100*e.metres_per_unit:1,u=e.metres_per_unit?"cm":"units",d=(h,p,g)=>`${me(p*a[h])} \u2192 ${me(p*l[h])} ${g}`;return t.push(["slide a frame",d("slide",c,u),"Mean distance that a standing foot travels over the floor from one frame to the next, before and after."],["slide at most",d("most_slide",c,u),"The farthest that a standing foot travels from where it began to stand, before and after."],["depth below the floor",d("sink",c,u),"How far a standing foot is below the floor at most, before and after."],["knee pop",d("knee_pop_deg",1,"deg"),"The largest sudden change of a knee\u2019s angle from frame to frame, before and after. Much more than before: holding the feet jerks the knees."]),t}function Cm(i){let t=U("ul");for(let e of i)t.append(U("li",{},e));return t}function Jw(i,t){let{data:e}=i,n=[["input",t.input==="-"?"standard input":t.input]];t.reference&&n.push(["reference",t.reference]),t.output&&n.push(["output",t.output]),t.format&&n.push(["format",t.format.toUpperCase()]),n.push([e.kind,un(e.names.length)]);let s=t.frame_rate_hz>0?t.frames/t.frame_rate_hz:0;return n.push(["frames",`${un(t.frames)} at ${me(t.frame_rate_hz)} Hz, ${me(s)} s`]),t.frames>0&&n.push(["frame numbers",` ${t.first_frame} to ${t.first_frame+t.frames-1}`]),t.source&&n.push(["source",t.source==="unknown"?String(t.source_reason):`${t.source} (${t.source_reason})`]),t.calibration_frames&&n.push(["calibration frames",un(t.calibration_frames)]),n.push(["length unit",t.unit??(t.metres_per_unit?`${me(t.metres_per_unit)} m`:"not stated")]),n.push(["up axis",`${e.stage.sign<0?"\u2212":""}${e.stage.up.toUpperCase()}`]),e.step>1&&n.push(["on this page",`1 frame in ${e.step}`]),n}function Rm(i,t,e,n){let s=Object.entries(n.figures).filter(([u])=>!nu(u)).map(([u,d])=>[qn(u),me(d)]);s.length>0&&i.append(Zr("Figures",bl(s)));let r=Zw(n);if(r.length>0){let u=Zr("Feet",bl(r));u.classList.add("feet"),i.append(u)}i.append(Zr("Take",bl(Jw(t,n))));let o=Zr("Made by",U("p",{},`kinemend ${e.kinemend}`),U("code",{tabindex:"0"},t.data.command_line)),a=Object.entries(n.options??{}).filter(([,u])=>u!=="");n.method&&o.append(U("p",{},`method ${n.method}`)),a.length>0&&o.append(bl(a.map(([u,d])=>[qn(u),typeof d=="number"?me(d):String(d)]))),i.append(o);let l=[...n.warnings,...n.diagnostics.map(u=>u.count>1?`${u.message} (${un(u.count)} times)`:u.message),...(n.fall_backs??[]).map(u=>`cleaned by ${u.method} instead, because ${u.reason}: ${u.tracks.map(d=>d.name).join(", ")}`)];l.length>0&&i.append(Zr("Warnings",Cm(l)));let c=[...(n.leftovers??[]).map(u=>`${u.what}: ${u.mend}`),...n.notes??[]];c.length>0&&i.append(Zr("Not changed",Cm(c)))}var wl=class{constructor(t,e){this.frames=t;this.rate=e;this.frame=0;this.playing=!1;this.speed=1;this.loop=!0;this.from=0;this.chosen=[];this.moved=[];this.zoomed=[];this.changed=[];this.last=0;this.tick=t=>{if(!this.playing)return;let e=this.frame+(t-this.last)/1e3*this.rate*this.speed;if(this.last=t,e>this.frames-1){if(!this.loop)return this.seek(this.frames-1),this.pause();e%=this.frames}this.seek(e),requestAnimationFrame(this.tick)};this.to=Math.max(1,t-1)}onMove(t){this.moved.push(t)}onZoom(t){this.zoomed.push(t)}onChoice(t){this.changed.push(t)}tell(t){for(let e of t)e()}get shown(){return Math.max(0,Math.min(this.frames-1,Math.floor(this.frame+1e-6)))}seek(t){this.frame=Math.max(0,Math.min(Math.max(0,this.frames-1),t)),this.tell(this.moved)}jump(t){if(this.seek(Math.round(t)),this.frame>=this.from&&this.frame<=this.to)return;let e=this.to-this.from;this.zoom(this.frame-e/2,this.frame+e/2)}step(t){this.pause(),this.jump(this.shown+t)}zoom(t,e){let n=Math.max(1,this.frames-1),s=Math.max(Math.min(4,n),Math.min(n,e-t));this.from=Math.max(0,Math.min(n-s,t)),this.to=this.from+s,this.tell(this.zoomed)}zoomBy(t,e=this.frame){let n=e>=this.from&&e<=this.to?e:(this.from+this.to)/2;this.zoom(n-(n-this.from)*t,n+(this.to-n)*t)}choose(t){this.chosen=t,this.tell(this.changed)}toggleTrack(t,e=4){let n=this.chosen.filter(s=>s!==t);this.choose(n.length<this.chosen.length?n:[...this.chosen,t].slice(-e))}refresh(){this.tell(this.changed),this.tell(this.moved)}play(){this.playing||this.frames<2||(this.shown>=this.frames-1&&(this.frame=0),this.playing=!0,this.last=performance.now(),requestAnimationFrame(this.tick),this.tell(this.moved))}pause(){this.playing=!1,this.tell(this.moved)}};function Kw(i,t){return i.map(e=>{let n=t.filter(a=>a.track===e),s=a=>a.reduce((l,c)=>l+c.last_frame-c.first_frame+1,0),r=n.filter(a=>a.verdict==="refused"),o=n.filter(a=>a.verdict!=="refused");return{name:e,filled:o.length,"filled frames":s(o),refused:r.length,"refused frames":s(r)}})}var Sl=class{constructor(t,e,n,s){this.take=e;this.player=n;this.column=null;this.falling=!0;this.rows=[];this.body=U("tbody");this.heads=new Map;let r=s.tracks.length>0||s.findings.length===0?s.tracks:Kw(e.data.names,s.findings),o=new Map(r.map(g=>[String(g.name),g])),a=r.length===e.data.names.length,l=r.length>0?Object.keys(r[0]).filter(g=>g!=="name"):[],c=e.isJoints?"joint":"marker",u=U("input",{type:"search",placeholder:`find a ${c}`,"aria-label":`find a ${c}`});u.addEventListener("input",()=>this.filter(u.value));let d=U("tr",{},this.head("name",c,`Names of the ${c}s, as the file spells them.`));for(let g of l){let v=Em(g,s.track_unit);d.append(this.head(g,qn(g)+(v&&`, ${v}`),Sm(g,c,s.track_unit)))}if(e.data.names.forEach((g,v)=>{let m=(a?r[v]:o.get(g))??{},f=U("tr",{},U("th",{scope:"row"},ee(e.shortName(v),`${e.nameOf(v)}: show its curves and its path`,()=>n.toggleTrack(v))));for(let T of l)f.append(U("td",{},me(m[T])));this.rows.push({track:v,figures:{...m,name:g},row:f})}),e.data.names.length===0){t.append(U("p",{class:"empty"},`The take has no ${c}s.`));return}let h=U("table",{},U("thead",{},d),this.body);t.append(u,U("div",{class:"scroll"},h));let p=Tm.find(g=>l.includes(g));this.sort(p??null),n.onChoice(()=>this.mark()),this.mark(),qi(h,"tr")}get worst(){return this.rows[0]?.track??0}reveal(){let t=this.rows.find(({track:n})=>this.player.chosen.includes(n))?.row,e=t?.closest(".scroll");t&&e&&(e.scrollTop=Math.max(0,t.offsetTop+t.offsetHeight-e.clientHeight))}head(t,e,n){let s=ee(e,`${n} Click to sort by this column.`.trim(),()=>this.sort(t));s.setAttribute("aria-description",n);let r=U("th",{scope:"col"},s);return this.heads.set(t,r),r}sort(t){if(t!==null){this.falling=this.column===t?!this.falling:t!=="name",this.column=t;let e=this.falling?-1:1,n=s=>Number(s.figures[t]??-1/0);this.rows.sort((s,r)=>t==="name"?e*String(s.figures.name).localeCompare(String(r.figures.name)):e*(n(s)-n(r)||0)||s.track-r.track)}for(let[e,n]of this.heads)n.setAttribute("aria-sort",e!==this.column?"none":this.falling?"descending":"ascending");this.body.replaceChildren(...this.rows.map(({row:e})=>e))}filter(t){let e=t.toLowerCase();for(let{track:n,row:s}of this.rows)s.hidden=!(this.take.data.names[n]??"").toLowerCase().includes(e)}mark(){for(let{track:t,row:e}of this.rows){let n=this.player.chosen.includes(t);e.classList.toggle("chosen",n),e.querySelector("button")?.setAttribute("aria-pressed",String(n))}}};var El=16,Pm=.15,Tl=class{constructor(t,e,n){this.take=e;this.player=n;this.canvas=U("canvas",{role:"img","aria-label":"Times in which feet stand; stronger bars are surer"});this.cursor=U("i",{class:"time-cursor"});this.width=1;if(this.contacts=e.data.stage.contacts,this.feet=[...new Set(this.contacts.map(({foot:r})=>r))].sort((r,o)=>r.localeCompare(o)),this.feet.length===0){t.append(U("p",{class:"empty"},"No contacts of feet with the floor were found."));return}let s=U("div",{class:"lanes"});for(let r of this.feet){let o=this.contacts.filter(l=>l.foot===r),a=o.reduce((l,{first:c,last:u})=>l+(u-c+1)/this.rate,0);s.append(U("p",{class:"lane",title:`${r}: ${o.length} times, ${me(a)} s`},U("span",{},r),U("span",{class:"count"},`${me(a)} s`)))}this.canvas.style.height=`${El*this.feet.length}px`,t.append(U("div",{class:"stand-lanes"},s,U("div",{class:"lane-field"},this.canvas,this.cursor))),this.canvas.addEventListener("click",r=>{let o=this.player.to-this.player.from;this.player.seek(Math.round(this.player.from+r.offsetX/this.canvas.clientWidth*o))}),this.canvas.addEventListener("mousemove",r=>{this.canvas.title=this.textAt(r.offsetX,r.offsetY)}),n.onMove(()=>this.drawCursor()),n.onZoom(()=>this.draw()),new ResizeObserver(()=>this.draw()).observe(this.canvas.parentElement),this.draw()}get rate(){return(this.take.rate||1)*this.take.data.step}x(t){return(t/this.take.data.step-this.player.from)/(this.player.to-this.player.from)*this.width}textAt(t,e){let n=this.feet[Math.floor(e/El)],s=this.contacts.find(o=>o.foot===n&&t>=this.x(o.first)&&t<=this.x(o.last+1));if(!s)return"";let{first_frame:r}=this.take.data;return`${n} stands in frames ${s.first+r} to ${s.last+r}, confidence ${me(s.confidence)}`}draw(){let t=qo(this.canvas);if(t===null)return;let{clientWidth:e}=this.canvas;this.width=e,t.fillStyle=Le("held");let n=new Map(this.feet.map((s,r)=>[s,r]));for(let s of this.contacts){let r=this.x(s.first),o=this.x(s.last+1);o<0||r>e||(t.globalAlpha=Pm+(1-Pm)*s.confidence,t.fillRect(r,(n.get(s.foot)??0)*El+3,Math.max(o-r,1.5),El-6))}t.globalAlpha=1,this.drawCursor()}drawCursor(){Yo(this.cursor,this.x(this.player.shown*this.take.data.step),this.width)}};var Lm=["warning","gap","spike","swap","frozen","bridged","slide","sink","length","euler_flip","repeated_frames","zero_frames","noise"];function Do(i){let t=Lm.indexOf(i);return t<0?Lm.length-1.5:t}var jw=400;function Im(i){let t=i.filter(({kind:r})=>r!=="warning"),e=r=>r.last_frame-r.first_frame,[n,...s]=t.length>0?t:i;return s.reduce((r,o)=>(Do(r.kind)-Do(o.kind)||Number(o.verdict==="refused")-Number(r.verdict==="refused")||(o.unit===r.unit?Math.abs(o.amount??0)-Math.abs(r.amount??0):0)||e(o)-e(r))>0?o:r,n)??null}function Dm(i,t){let e=i.frameOf(t.first_frame),n=i.frameOf(t.last_frame),s=Math.floor((e+n)/2),r=0;if(!i.data.two||n-e<1)return s;let o=Math.max(i.whole?1:i.data.stride,Math.ceil((n-e)/jw));for(let a=e;a<=n;a+=o){let l=i.distance(a);l<=r||(r=l,s=a)}return s}var Jr=18,iu=200;function Kr(i,t){let e=i.first_frame===i.last_frame?`frame ${i.first_frame}`:`frames ${i.first_frame} to ${i.last_frame}`,n=[`${qn(i.kind)} ${qn(i.verdict)}`.trim()],s=t?.tracksOf(i.track)??[];return i.track&&n.push(s.length>0?s.map(r=>$i(t.shortName(r))).join(", "):$i(i.track)),n.push(e),i.method&&n.push(`by ${i.method}`),i.amount!==null&&n.push(`${me(i.amount)} ${i.unit??""}`.trim()),i.reason&&n.push(i.reason),n.join(" \xB7 ")}var Al=class{constructor(t,e,n,s,r){this.take=e;this.player=n;this.onSelect=r;this.selected=-1;this.width=1;this.hidden=new Set;this.canvas=U("canvas",{tabindex:"0",role:"slider","aria-valuemin":"0","aria-label":"Findings over time: arrow keys step from one to the next"});this.lanes=U("div",{class:"lanes"});this.cursor=U("i",{class:"time-cursor"});this.words=U("p",{class:"selected",role:"status"});this.tally=U("span",{class:"tally"});this.list=U("ol",{class:"findings"});if(this.all=s.map((l,c)=>({finding:l,i:c})).sort((l,c)=>l.finding.first_frame-c.finding.first_frame||l.i-c.i).map(({finding:l})=>l),this.shown=[...this.all],this.kinds=[...new Set(s.map(l=>l.kind))].sort((l,c)=>Do(l)-Do(c)||l.localeCompare(c)),this.kinds.length>1&&this.kinds.includes("noise")&&this.hidden.add("noise"),s.length===0){t.append(U("p",{class:"empty"},"Nothing was found, and nothing was changed."));return}let o=ee("\u2039","previous finding (,)",()=>this.go(-1)),a=ee("\u203A","next finding (.)",()=>this.go(1));t.append(U("div",{class:"timeline"},this.lanes,U("div",{class:"lane-field"},this.canvas,this.cursor)),U("div",{class:"finding"},o,a,this.words,this.tally),U("details",{},U("summary",{},"List of findings"),this.list)),this.addLanes(),qi(this.list,"li"),this.filter(),this.canvas.addEventListener("click",l=>this.click(l)),this.canvas.addEventListener("mousemove",l=>{let c=this.at(l);this.canvas.title=c===null?"":Kr(c)}),this.canvas.addEventListener("keydown",l=>{l.key!=="ArrowRight"&&l.key!=="ArrowLeft"||(l.preventDefault(),l.stopPropagation(),this.go(l.key==="ArrowRight"?1:-1))}),n.onMove(()=>this.drawCursor()),n.onZoom(()=>this.draw()),new ResizeObserver(()=>this.draw()).observe(this.canvas.parentElement),this.describe(),this.draw()}addLanes(){for(let t of this.kinds){let e=this.all.filter(r=>r.kind===t).length,n=ee("",`show ${qn(t)} in the list, and stop at it with the arrows`,()=>{this.hidden.delete(t)||this.hidden.add(t),n.setAttribute("aria-pressed",String(!this.hidden.has(t))),this.filter()},!this.hidden.has(t)),s=U("i",{class:"swatch"});s.style.background=`var(--kind-${t}, var(--kind-other))`,n.append(s,U("span",{},qn(t)),U("span",{class:"count"},String(e))),this.lanes.append(n)}this.canvas.style.height=`${Jr*this.kinds.length}px`}filter(){let t=this.shown[this.selected];this.shown.splice(0,this.shown.length,...this.all.filter(e=>!this.hidden.has(e.kind))),this.selected=t?this.shown.indexOf(t):-1,this.list.replaceChildren(...this.shown.slice(0,iu).map((e,n)=>{let s=U("button",{type:"button",title:Kr(e)},Kr(e,this.take));return s.addEventListener("click",()=>this.select(n)),U("li",{},s)})),this.shown.length>iu&&this.list.append(U("li",{class:"empty"},`and ${Dn(this.shown.length-iu,"more finding")}`)),this.describe(),this.draw()}counts(){let t=s=>this.all.filter(r=>r.kind===s).length,e=t("warning"),n=t("noise");return[Dn(this.all.length-e-n,"finding"),...e>0?[Dn(e,"warning")]:[],...n>0?[Dn(n,"smoothed span")]:[]].join(", ")}describe(){let t=this.shown[this.selected];this.canvas.setAttribute("aria-valuemax",String(this.shown.length)),this.canvas.setAttribute("aria-valuenow",String(this.selected+1)),this.canvas.setAttribute("aria-valuetext",t?Kr(t):`${Dn(this.shown.length,"finding")}, none is chosen`),this.words.textContent=t?Kr(t,this.take):"Click a bar to go to its frame.",this.words.title=t?Kr(t):"",this.tally.textContent=this.counts(),this.list.querySelector("[aria-current]")?.removeAttribute("aria-current"),this.list.children[this.selected]?.setAttribute("aria-current","true");let e=this.list.children[this.selected];e&&(this.list.scrollTop=Math.max(0,e.offsetTop-this.list.offsetTop-this.list.clientHeight/2))}showWorst(){let t=Im(this.all);return t===null?null:(this.unhide(t.kind),this.select(this.shown.indexOf(t)),this.player.jump(Dm(this.take,t)),t)}go(t){if(this.shown.length!==0){if(this.selected<0){let e=this.take.number(this.player.shown),n=this.shown.findIndex(r=>r.first_frame>e),s=t>0?n:(n<0?this.shown.length:n)-1;return this.select((s+this.shown.length)%this.shown.length)}this.select((this.selected+t+this.shown.length)%this.shown.length)}}select(t){let e=this.shown[t];e&&(this.selected=t,this.player.pause(),this.player.jump(this.take.frameOf(e.first_frame)),this.onSelect(e),this.describe(),this.draw())}x(t){return(t-this.player.from)/(this.player.to-this.player.from)*this.width}span(t){let{step:e,first_frame:n}=this.take.data,s=this.x((t.first_frame-n)/e),r=this.x((t.last_frame-n+1)/e);return[s,Math.max(r,s+3)]}at(t){let e=this.kinds[Math.floor(t.offsetY/Jr)],n=null,s=1/0;for(let r of this.all){if(r.kind!==e)continue;let[o,a]=this.span(r);t.offsetX<o-2||t.offsetX>a+2||a-o>=s||(n=r,s=a-o)}return n}unhide(t){this.hidden.delete(t)&&(this.lanes.children[this.kinds.indexOf(t)]?.setAttribute("aria-pressed","true"),this.filter())}click(t){let e=this.at(t);if(e===null){let n=this.player.to-this.player.from;return this.player.seek(Math.round(this.player.from+t.offsetX/this.canvas.clientWidth*n))}this.unhide(e.kind),this.select(this.shown.indexOf(e))}draw(){let t=qo(this.canvas);if(t===null)return;let{clientWidth:e}=this.canvas;this.width=e,t.strokeStyle=Le("grid");for(let r=1;r<this.kinds.length;++r)t.beginPath(),t.moveTo(0,r*Jr-.5),t.lineTo(e,r*Jr-.5),t.stroke();let n=this.kinds.map(r=>Le(`kind-${r}`)||Le("kind-other")),s=new Map(this.kinds.map((r,o)=>[r,o]));for(let r of this.all){let[o,a]=this.span(r);if(a<0||o>e)continue;let l=s.get(r.kind)??0,c=r===this.shown[this.selected];this.bar(t,o,l*Jr+3,a-o,n[l],r.verdict==="refused",c)}this.drawCursor()}drawCursor(){Yo(this.cursor,this.x(this.player.shown),this.width)}bar(t,e,n,s,r,o,a){let l=Jr-7;t.globalAlpha=a||o?1:.75,t.fillStyle=r,t.strokeStyle=a?Le("text"):r,t.lineWidth=a?2:1.5,o||t.fillRect(e,n,s,l),(o||a)&&t.strokeRect(e+.75,n+.75,Math.max(1.5,s-1.5),l-1.5),t.globalAlpha=1}};function Nm(i,t,e){let n=ee("Play","play or pause (space)",()=>e.playing?e.pause():e.play());n.className="play";let s=U("input",{type:"range",min:"0",max:String(Math.max(0,t.told-1)),step:"1",value:"0","aria-label":"frame"});s.addEventListener("input",()=>{let h=Number(s.value);e.pause(),e.seek(h)});let r=U("input",{type:"number",class:"number","aria-label":"frame number",min:String(t.number(0)),max:String(t.number(Math.max(0,t.told-1))),step:String(t.data.step)});r.addEventListener("change",()=>e.jump(t.frameOf(Number(r.value))));let o=U("span",{class:"time"}),a=["0.1","0.25","0.5","1","2","4"].map(h=>[h,`${h}\xD7`]),l=U("div",{class:"controls"},n,ee("\u2039","previous frame (left arrow)",()=>e.step(-1)),ee("\u203A","next frame (right arrow)",()=>e.step(1)),Sn("speed",a,"1",h=>{e.speed=Number(h)}),Ci("Loop","start again at the end (L)",!0,h=>{e.loop=h}),U("label",{},"frame ",r),o);i.append(l,s);let c=t.rate>0?(t.told/t.rate).toFixed(2):"0",u=()=>{n.textContent=e.playing?"Pause":"Play",s.value=String(e.shown),document.activeElement!==r&&(r.value=String(t.told>0?t.number(e.shown):t.data.first_frame));let h=t.rate>0?e.shown/t.rate:0;o.textContent=`${h.toFixed(2)} of ${c} s`,s.setAttribute("aria-valuetext",`frame ${un(t.number(e.shown))}`)};e.onMove(u),u();let d=t.told<2;for(let h of l.querySelectorAll("button, select, input"))h.disabled=d;s.disabled=d}var Qw="Keys: Space plays and pauses \xB7 left and right arrow step one frame, with Shift ten \xB7 Home and End go to the first and last frame \xB7 comma and full stop go to the previous and next finding \xB7 + and \u2212 zoom, 0 shows the whole take \xB7 1 front, 2 side, 3 top, 4 orbit \xB7 F follows the body \xB7 L loops \xB7 in a table the arrow keys move between its controls";function tS(i){return i==="-"?"standard input":i.split(/[\\/]/).pop()||i}function No(i,t){let e=U("div",{class:"head"},U("h2",{},i));return[U("section",{class:t,"aria-label":i},e),e]}function eS(i,t){let[e,n]=No("Motion","body"),s=U("div",{class:"view"});if(e.append(s),!i.isEverSeen)return s.append(U("p",{class:"empty"},i.told===0?"The take has no frames.":i.points===0?"The take has no positions.":"Every marker is missing in every frame.")),[e,null];let r=Xf();if(r===null)return s.replaceChildren(U("p",{class:"empty"},"This browser cannot show the body in 3D, because WebGL is off. The rest of the page works.")),[e,null];let o=new ol(s,i,t,r),a=[["front","Front","1"],["side","Side","2"],["top","Top","3"],["orbit","Orbit","4"]];for(let[c,u,d]of a)n.append(ee(u,`view from ${{front:"the front",side:"the side",top:"the top",orbit:"a corner"}[c]} (${d})`,()=>o.look(c)));let l=[["follow","Follow","move the camera with the body (F)"]];i.data.two&&(l.push(["apart","Apart","show the two side by side"]),l.push(["before",i.data.labels[0],`show ${i.data.labels[0]}`],["after",i.data.labels[1],`show ${i.data.labels[1]}`]));for(let[c,u,d]of l){let h=Ci(u,d,o.options[c],p=>{if(c==="apart")return o.setApart(p);o.options[c]=p,o.refresh(),c==="follow"&&p&&o.recentre()});h.dataset.option=c,(c==="before"||c==="after")&&h.classList.add(c),n.append(h)}return[e,o]}function nS(i,t){let[e,n]=No("Curves","curves"),s=U("div",{class:"panels"}),r=new Ml(s,i,t);if(i.isJoints){let a=[["rotation","angles"],["position","position"]];n.append(Sn("curves of",a,"rotation",l=>{r.quantity=l,r.rebuild()}))}let o=[["values","Values"],["difference","Difference"],["speed","Speed"],["acceleration","Acceleration"],["spectrum","Spectrum"]];for(let[a,l]of o)a==="difference"&&!i.data.two||n.append(Ci(l,`show the ${l.toLowerCase()} of the chosen ${i.isJoints?"joints":"markers"}`,r.kinds.has(a),c=>{c?r.kinds.add(a):r.kinds.delete(a),r.rebuild()}));return n.append(U("span",{class:"gap"}),ee("\u2212","zoom out (-)",()=>t.zoomBy(1.6)),ee("+","zoom in (+)",()=>t.zoomBy(.625)),ee("\u2039","earlier",()=>t.zoom(t.from-(t.to-t.from)/2,(t.from+t.to)/2)),ee("\u203A","later",()=>t.zoom((t.from+t.to)/2,t.to+(t.to-t.from)/2)),ee("All","show the whole take (0)",()=>t.zoom(0,i.told-1))),e.append(s),[e,r]}function Um(i){document.querySelector(`[data-option="${i}"]`)?.click()}function iS(i,t,e,n,s){let r={" ":()=>i.playing?i.pause():i.play(),ArrowLeft:o=>i.step(o.shiftKey?-10:-1),ArrowRight:o=>i.step(o.shiftKey?10:1),Home:()=>i.jump(0),End:()=>i.jump(t.told-1),",":()=>e.go(-1),".":()=>e.go(1),"+":()=>i.zoomBy(.625),"=":()=>i.zoomBy(.625),"-":()=>i.zoomBy(1.6),0:()=>i.zoom(0,t.told-1),1:()=>n?.look("front"),2:()=>n?.look("side"),3:()=>n?.look("top"),4:()=>n?.look("orbit"),f:()=>Um("follow"),l:()=>[...document.querySelectorAll("button")].find(o=>o.textContent==="Loop")?.click()};document.addEventListener("keydown",o=>{let a=o.target;if(o.ctrlKey||o.altKey||o.metaKey||/^(INPUT|SELECT|TEXTAREA)$/.test(a.tagName)||o.key===" "&&/^(BUTTON|SUMMARY)$/.test(a.tagName))return;let l=r[o.key.length===1?o.key.toLowerCase():o.key];l&&(o.preventDefault(),l(o))},{signal:s})}function sS(i,t){if(!(t.take.told!==i.take.told||t.take.data.names.length!==i.take.data.names.length)&&(i.player.speed=t.player.speed,i.player.loop=t.player.loop,i.player.zoom(t.player.from,t.player.to),i.player.choose(t.player.chosen),i.player.seek(t.player.frame),i.body&&t.body)){for(let[e,n]of Object.entries(t.body.options))i.body.options[e]!==n&&Um(e);i.body.seeFrom(t.body.viewpoint())}}function rS(i,t){let e=i.first_frame+Math.max(0,i.frames-1);return i.frames===0?[]:i.warnings.map(n=>{let s=/\bframes? (-?\d+)(?: to (-?\d+))?/.exec(n),r=/\bat (\d+(?:\.\d+)?) s\b/.exec(n),o=s?Number(s[1]):r?i.first_frame+Math.round(Number(r[1])*i.frame_rate_hz):null,a=o===null?i.first_frame:Math.min(e,Math.max(i.first_frame,o)),l=o===null?e:Math.min(e,Math.max(a,Number(s?.[2]??o)));return{kind:"warning",verdict:"",track:t.find(u=>n.startsWith(`${u}: `))??null,first_frame:a,last_frame:l,amount:null,unit:null,reason:n}})}async function Uo(i,t,e,{panel:n=[],before:s=null,onTheme:r,isOver:o=()=>!1}={}){let a=new AbortController,l=t.takes[0],{data:c}=e,u=new wl(e.told,e.rate||1),d=U("span",{class:"loading"},e.whole?"":"loading the remaining frames\u2026"),h=U("h1",{},tS(l.input)),p=U("p",{class:"verdict"},l.verdict??""),[g]=No(e.isJoints?"Joints":"Markers","tracks"),v=new Sl(g,e,u,l),[m]=No("Findings and changes","found"),f=new Al(m,e,u,[...l.findings,...rS(l,c.names)],X=>{let J=e.tracksOf(X.track);J.length>0&&u.choose(J.slice(0,4))}),[T]=No("Standing feet","stands"),b=c.stage.contacts.length>0?new Tl(T,e,u):null;if(await Ks(),o())throw new Error("another result replaces this one");let[A,N]=eS(e,u),L=U("div",{class:"transport"});Nm(L,e,u),A.append(L);let[C,F]=nS(e,u),S=U("div",{class:"facts"});Rm(S,e,t,l);let x=Js(()=>{N?.paint(),f.draw(),b?.draw(),F.rebuild(),r?.()},a.signal),R=U("header",{},U("div",{},h,p),d,x),z=[U("div",{class:"top"},A,g),m,...b===null?[]:[T],C,S,U("footer",{},U("p",{},Qw))];for(let X of[...i.children])n.includes(X)||X.remove();i.prepend(R),i.append(...n.filter(X=>X.parentNode!==i),...z),c.step>1&&i.querySelector("header")?.after(U("p",{class:"note"},`This take is long: the page shows 1 frame in ${c.step}. The findings cover all ${Dn(c.frames,"frame")}.`)),e.told>0&&c.names.length>0?u.choose([v.worst]):u.choose([]),u.seek(Math.max(e.firstSeen(),e.frameOf(c.first_frame+(l.calibration_frames??0)))),s===null&&f.showWorst()!==null&&v.reveal(),N?.resize(),N?.look("orbit"),iS(u,e,f,N,a.signal);let B={take:e,player:u,body:N,curves:F,timeline:f,stands:b,dispose:()=>{a.abort(),u.pause(),N?.dispose()}};return Object.assign(window,{kinemend:B}),s!==null&&(sS(B,s),s.dispose()),await Ks(),F.start(),await e.loadRest(),d.remove(),c.stride>1&&!a.signal.aborted&&(F.forget(),u.refresh()),await F.whole,B}var jr=class{constructor(t,e,n){this.form=t;this.sight=e;this.again=n;this.element=U("div");this.edited=!1;this.words=U("p",{class:"status",role:"status"});this.head=U("div",{class:"head"});this.area=U("textarea",{rows:"6",spellcheck:"false","aria-label":t.label});let s=0;this.area.addEventListener("input",()=>{window.clearTimeout(s),s=window.setTimeout(()=>this.changed(),300)}),this.element.append(this.head,this.area)}text(){return this.area.value.endsWith(`
`)||this.area.value===""?this.area.value:`${this.area.value}
`}changed(){let e=this.area.value.split(`
`).findIndex(n=>!/^\s*(#|$)/.test(n)&&!this.form.line.test(n));this.words.textContent=e<0?"":`line ${e+1}: expected ${this.form.expected}`,!(e>=0)&&(this.edited=!0,this.again())}async load(t){try{let e=await t;if(!e.ok){this.words.textContent=(await e.json()).error;return}this.area.disabled=!1,this.area.value=await e.text(),this.changed()}catch{this.words.textContent="kinemend view has ended"}}dropButton(t){return ee("Clear",t,()=>{this.edited=!1,this.area.value="",this.words.textContent="",this.again()})}endButton(t){return ee("End here",t,()=>this.put(this.form.last))}put(t){let e=this.sight();if(e===null)return;let n=this.area.value.slice(0,this.area.selectionStart).split(`
`).length-1,s=this.area.value.split(`
`),r=this.form.line.exec(s[n]??"");if(r===null){this.words.textContent="place the text cursor in the line to change";return}r[t]=String(e.take.number(e.player.shown)),s[n]=this.form.joined(r.slice(1)),this.area.value=s.join(`
`),this.cursorTo(n),this.changed()}cursorTo(t){let n=this.area.value.split(`
`).slice(0,t).join(`
`).length+(t>0?1:0);this.area.setSelectionRange(n,n)}};var Om={line:/^\s*(\S+)\s+(\S+)\s+(-?\d+)\s+(-?\d+)\s*(?:#.*)?$/,expected:"SIDE PART FIRST LAST",label:"contacts, one per line: side, part, first and last frame",first:3,last:4,joined:i=>i.slice(0,4).join(" ")},Cl=class extends jr{constructor(t,e,n){super(Om,t,n);let s=ee("Find contacts","load the contacts file, or find contacts in the take",()=>void this.load(e()));s.dataset.action="contacts",this.area.disabled=!0,this.head.append(s,ee("Begin here","set the first frame of the line with the text cursor to the current frame",()=>this.put(Om.first)),this.endButton("set the last frame of the line with the text cursor to the current frame"),this.dropButton("remove all lines; feet are no longer held by them"),this.words)}};var Fm=170,Rl=class{constructor(t,e){this.choose=t;this.element=U("section",{class:"gap-preview",hidden:!0,tabindex:"-1"});this.head=U("h3");this.words=U("p",{class:"status",role:"status"});this.plots=U("div",{class:"gap-plots"});this.methods=U("div",{class:"gap-methods",role:"group","aria-label":"method of this gap"});this.shown=[];this.curves=null;this.gap=null;this.take=null;let n=ee("Close","close the comparison",()=>{this.hide(),e()});this.element.append(U("div",{class:"head"},this.head,U("span",{class:"gap"}),n),this.words,this.methods,this.plots),new ResizeObserver(()=>this.resize()).observe(this.plots)}get open(){return this.element.hidden?null:this.gap}hide(){this.element.hidden=!0,this.gap=null,this.clear()}wait(t){this.gap!==null&&this.gap.name===t.name&&this.gap.quantity===t.quantity&&this.gap.first_frame===t.first_frame||this.clear(),this.gap=t,this.element.hidden=!1,this.head.textContent=`${$i(t.name)}, frames ${t.first_frame} to ${t.last_frame}`,this.say("trying every method\u2026"),this.curves!==null&&this.mark()}say(t){this.words.textContent=t}show(t,e){this.curves=t,this.take=e,this.say("Click a curve or a name to fill the gap by that method. Dotted: the method refuses this gap."),this.mark(),this.redraw()}clear(){this.curves=null;for(let t of this.shown)t.destroy();this.shown=[],this.plots.replaceChildren(),this.methods.replaceChildren()}stroke(t){return`method-${t%10+1}`}mark(){let{gap:t,curves:e}=this;if(t===null||e===null)return;let n=document.activeElement?.dataset.method;this.methods.replaceChildren(...e.curves.map((s,r)=>{let o=s.method===t.method&&t.verdict!=="refuse",a=ee("",s.filled?`fill the gap by ${s.method}`:`fill the gap by ${s.method}, although the method refuses it`,()=>this.choose(t,s.method,!s.filled),o);a.dataset.method=s.method,a.dataset.filled=String(s.filled);let l=U("i",{class:"swatch"});return l.style.background=this.isDrawn(s)?`var(--${this.stroke(r)})`:"none",a.append(l,U("span",{class:"name"},s.method),U("span",{class:"told"},this.told(s,t))),a.addEventListener("focus",()=>this.stress(r)),a.addEventListener("mouseenter",()=>this.stress(r)),a.addEventListener("mouseleave",()=>this.stress(null)),a.addEventListener("blur",()=>this.stress(null)),a})),n!==void 0&&this.methods.querySelector(`[data-method="${n}"]`)?.focus()}isDrawn(t){let e=this.gap,n=this.curves;if(e===null||n===null||this.take===null)return!1;let s=e.first_frame-this.take.data.first_frame-n.first;return t.values.some(r=>r[s]!==null&&r[s]!==void 0)}told(t,e){if(!t.filled)return`refused: ${t.reason}`;let n=[];return t.expected_error!==null&&n.push(`expected error ${me(t.expected_error)} ${e.unit}`.trim()),t.distance!==null&&t.distance>0&&n.push(`${me(t.distance)} ${e.unit}`.trim()+" from the fill of the plan"),n.join(", ")}stress(t){for(let e of this.shown)e.setSeries(t===null?null:t+1,{focus:!0})}get width(){let t=Math.max(1,Math.min(this.curves?.axes.length??1,Math.floor(this.plots.clientWidth/260)));return Math.max(180,Math.floor(this.plots.clientWidth/t)-12)}resize(){for(let t of this.shown)Math.abs(t.width-this.width)>1&&t.setSize({width:this.width,height:Fm})}redraw(){let{gap:t,curves:e,take:n}=this;if(!(t===null||e===null||n===null)){for(let s of this.shown)s.destroy();this.shown=[],this.plots.replaceChildren(...e.axes.map(s=>U("figure",{class:"panel"},U("figcaption",{},U("b",{},s),` ${t.unit}`)))),e.axes.forEach((s,r)=>this.addPlot(this.plots.children[r],t,e,n,r))}}addPlot(t,e,n,s,r){let o=n.first+s.data.first_frame,a=Array.from({length:n.last-n.first+1},(g,v)=>o+v),l=g=>g>=e.first_frame&&g<=e.last_frame,c=n.curves.map(g=>g.values[r].map((v,m)=>l(a[m]+1)||l(a[m]-1)||l(a[m])?v:null)),u=(n.curves[0]?.values[r]??[]).map((g,v)=>l(a[v])?null:g),d={stroke:Le("quiet"),grid:{stroke:Le("grid"),width:1},ticks:{stroke:Le("grid"),width:1},font:"11px system-ui, sans-serif"},h=-1,p=new je({width:this.width,height:Fm,padding:[6,22,0,0],legend:{show:!1},scales:{x:{time:!1}},cursor:{y:!1,drag:{x:!1,y:!1},points:{show:!1},focus:{prox:14}},focus:{alpha:.2},series:[{label:"frame"},...n.curves.map((g,v)=>({label:g.method,stroke:Le(this.stroke(v)),width:g.method===e.method?3:1.5,dash:g.method===e.method?void 0:g.filled?[6,3]:[2,4],points:{show:!1}})),{label:"measured",stroke:Le("text"),width:2,points:{show:e.length_frames<3}}],axes:[{...d,size:28,incrs:eu},{...d,size:60}],hooks:{drawClear:[g=>this.shade(g,e)],setSeries:[(g,v)=>{h=v===null?-1:v-1}]}},[a,...c,u],t);p.over.addEventListener("click",()=>{let g=n.curves[h];g&&this.choose(this.gap??e,g.method,!g.filled)}),Zs(t.querySelector("canvas"),`${e.name}, ${n.axes[r]}${e.unit?` in ${e.unit}`:""}: curves of ${n.curves.map(({method:g})=>g).join(", ")} over frames ${e.first_frame} to ${e.last_frame}`),this.shown.push(p)}shade(t,e){let n=t.valToPos(e.first_frame-.5,"x",!0),s=t.valToPos(e.last_frame+.5,"x",!0);t.ctx.save(),t.ctx.fillStyle=Le("chosen"),t.ctx.fillRect(n,t.bbox.top,s-n,t.bbox.height),t.ctx.restore()}};var Qr=300,Pl=class{constructor(t,e,n,s,r){this.session=t;this.isJoints=e;this.goTo=n;this.again=s;this.curves=r;this.element=U("div");this.edited=!1;this.preview=!1;this.plan={schema:"",gaps:[]};this.body=U("tbody");this.words=U("p",{class:"empty"});this.take=null;this.from=0;this.pages=U("span",{class:"controls",hidden:!0});this.looked=new Rl((c,u,d)=>this.setMethod(c,u,d),()=>this.body.querySelector("[data-gap=curves]")?.focus());let o=$o([[e?"joint":"marker","Click a name to go to the gap."],["frames","First and last frame of the gap, as the file numbers them."],["length","Length of the gap in frames and seconds."],["verdict","fill: filled where the rules allow it; force: filled against the rules; refuse: stays open."],["method","How the gap is filled."],["curves","Compares the curves of all methods over the gap."],["filled by","The method that has filled the gap."],["expected error","How far the fill is expected to be from the truth, with its unit."],["why refused","Why the gap stays open."]]);o[o.length-1].className="words";let a=Ci("Try every method","show how far the fill of each method is from the one in use",!1,c=>{this.preview=c,s()});a.dataset.action="preview",this.pages.append(ee("\u2039","previous gaps",()=>this.turn(-Qr)),ee("\u203A","next gaps",()=>this.turn(Qr)));let l=U("table",{},U("thead",{},U("tr",{},...o)),this.body);this.element.append(U("div",{class:"head"},a,ee("Discard edits","fill by the controls above again",()=>{this.edited=!1,s()}),this.words,this.pages),U("p",{class:"empty"},"Arrow keys move in the table. In a list of choices the up and down arrows change the choice; hold Ctrl to move."),U("div",{class:"scroll"},l),this.looked.element),qi(l,"tr")}text(){return JSON.stringify(this.plan)}show(t,e){this.plan=t,this.take=e,this.list();let n=this.looked.open;if(n===null)return;let s=t.gaps.findIndex(r=>r.name===n.name&&r.quantity===n.quantity&&r.first_frame===n.first_frame&&r.last_frame===n.last_frame);s<0?this.looked.hide():this.look(s)}turn(t){this.from+=t,this.list()}list(){let{gaps:t}=this.plan,e=Math.floor(Math.max(0,t.length-1)/Qr)*Qr;this.from=Math.max(0,Math.min(e,this.from));let n=Math.min(t.length,this.from+Qr);this.pages.hidden=t.length<=Qr,this.words.textContent=t.length===0?"The take has no gaps.":this.pages.hidden?"":`gaps ${un(this.from+1)} to ${un(n)} of ${un(t.length)}`;let s=document.activeElement?.dataset;this.body.replaceChildren(...t.slice(this.from,n).map((r,o)=>this.row(r,this.from+o))),s?.gap!==void 0&&this.body.querySelector(`[data-gap="${s.gap}"][data-row="${s.row}"]`)?.focus()}redraw(){this.looked.redraw()}async look(t){let e=this.plan.gaps[t];this.looked.wait(e);try{let n=await this.curves(this.text(),t);n!==null&&this.take!==null&&this.looked.open===e&&this.looked.show(n,this.take)}catch(n){this.looked.say(n instanceof TypeError?"kinemend view has ended":n instanceof Error?n.message:String(n))}}setMethod(t,e,n){t.method=e,n!==void 0?t.verdict=n?"force":"fill":t.verdict==="refuse"&&(t.verdict="fill"),this.change()}change(){this.edited=!0,this.again()}row(t,e){let n=ee(t.name,"go to this gap",()=>this.goTo(t.name,t.first_frame)),s=Sn(`verdict of ${t.name}, frames ${t.first_frame} to ${t.last_frame}`,[["fill","fill"],["force","force"],["refuse","refuse"]],t.verdict,h=>{t.verdict=h,h==="refuse"&&(t.reason=""),this.change()});s.dataset.gap="verdict";let r=this.session.controls.fill_methods.filter(h=>this.isJoints?h.joints:h.markers).map(({name:h})=>[h,this.told(t,h)]),o=Sn(`method of ${t.name}, frames ${t.first_frame} to ${t.last_frame}`,r,t.method,h=>this.setMethod(t,h));o.dataset.gap="method";let a=ee("Compare",`compare the curves of every method over ${t.name}, frames ${t.first_frame} to ${t.last_frame}`,()=>void this.look(e));a.dataset.gap="curves";for(let h of[n,s,o,a])h.dataset.row=String(e);n.dataset.gap="name";let l=t.expected_error===null?"\u2013":`${me(t.expected_error)} ${t.unit}`.trim(),c=[`${t.first_frame}\u2013${t.last_frame}`,`${un(t.length_frames)} (${me(t.length_s)} s)`,s,o,a,t.verdict==="refuse"?"\u2013":t.filled_by,l,t.reason],u=U("th",{scope:"row"},n,t.quantity==="position"&&this.isJoints?" (position)":""),d=U("tr",{class:t.reason===""?"":"failed"},u,...c.map((h,p)=>U("td",{class:p===c.length-1?"words":""},h)));return t.evidence.length>0&&(d.title=`filled from ${t.evidence.join(", ")}`),d}told(t,e){let n=t.previews?.find(s=>s.method===e);return!n||e===t.method&&n.filled?e:n.filled?n.distance===null?e:`${e} (differs by ${`${me(n.distance)} ${t.unit}`.trim()})`:`${e} (refused)`}};var oS={line:/^\s*("(?:[^"]|"")*"|[^",]+)\s*,\s*(-?\d+)\s*,\s*(-?\d+)\s*(?:#.*)?$/,expected:"NAME,FIRST,LAST",label:"missing samples, one per line: name, first and last frame",first:2,last:3,joined:i=>`${i[0]},${i[1]},${i[2]}`};function aS(i){return/[",#\n]|^\s|\s$/.test(i)?`"${i.replace(/"/g,'""')}"`:i}var Ll=class extends jr{constructor(t,e,n,s){super(oS,t,n);let r=ee("Load the file","load the gaps that were saved before",()=>void this.load(e())),o=ee("Begin here",`add a line for each chosen ${s}: missing from the current frame on`,()=>this.begin(s));o.dataset.action="missing",this.head.append(o,this.endButton("set the last frame of the line with the text cursor to the current frame"),r,this.dropButton("remove all lines; these samples are used again"),this.words)}async start(t){try{let e=await t;e.ok&&this.area.value===""&&(this.area.value=await e.text())}catch{}}begin(t){let e=this.sight(),n=e?.player.chosen??[];if(e===null||n.length===0){this.words.textContent=`choose a ${t} in the table first`;return}let s=e.take.number(e.player.shown),r=this.area.value.split(`
`).filter(o=>o.trim()!=="");r.push(...n.map(o=>`${aS(e.take.data.names[o])},${s},${s}`)),this.area.value=`${r.join(`
`)}
`,this.cursorTo(r.length-1),this.changed()}};function Oo(i,t,e){return U("label",{class:"field",title:t},U("span",{},i),e,U("span",{class:"problem",role:"alert"}))}function to(i,t){let e=i.closest(".field")?.querySelector(".problem");return e?(e.textContent=t,t===""?i.removeAttribute("aria-invalid"):i.setAttribute("aria-invalid","true"),!0):!1}function lS({minimum:i,maximum:t,unit:e,kind:n}){let s=i!==void 0&&t!==void 0?`${i} to ${t}`:i!==void 0?`${i} or more`:t!==void 0?`${t} or less`:"a number";return`${n==="whole"?"whole numbers, ":""}${s}${e?` ${e}`:""}`}function cS({name:i,unit:t}){let e=(t?i.replace(/_(hz|s|deg)$/,""):i).replace(/_/g," ");return t?`${e} (${t})`:e}function su(i,t,{change:e,refuse:n},s=""){let r=s||cS(i),o=t??i.default;if(i.kind==="switch"){let l=Ci(r,i.help,o===!0,c=>e(c===i.default?void 0:c));return l.dataset.flag=i.name,l}if(i.choices){let l=Sn(r,i.choices.map(c=>[c,c]),String(o),c=>e(c===i.default?void 0:c));return l.dataset.flag=i.name,Oo(r,i.help,l)}let a=U("input",{type:"number",class:"number",value:String(o),min:i.minimum,max:i.maximum,step:i.kind==="whole"?1:"any",placeholder:String(i.default),"aria-label":r});return a.dataset.flag=i.name,a.addEventListener("input",()=>{if(!a.checkValidity())return to(a,`${a.validity.badInput?"This is not a number":a.value} \u2013 not used. Allowed: ${lS(i)}.`),n(r);to(a,""),n(null),e(a.value===""||Number(a.value)===i.default?void 0:Number(a.value))}),Oo(r,i.help,a)}var Il=class{constructor(t,e,n){this.ask=t;this.done=e;this.transport=n;this.element=U("dialog",{class:"save","aria-labelledby":"save-title"});this.name=U("input",{type:"text",name:"file",required:!0,spellcheck:"false",autocomplete:"off","aria-label":"file name"});this.place=U("p",{class:"empty"});this.words=U("p",{class:"problem",role:"alert"});this.accept=U("button",{type:"submit","data-action":"accept"},"Save");this.mayReplace=!1;let s=U("form",{},U("h2",{id:"save-title"},"Save as"),U("label",{class:"field"},U("span",{},"file name"),this.name),this.place,this.words,U("div",{class:"controls"},this.accept,ee("Cancel","save nothing",()=>this.element.close())));s.addEventListener("submit",r=>{r.preventDefault(),this.save()}),this.name.addEventListener("input",()=>this.forget()),this.element.append(s)}open(t){let[,e,n]=/^(.*[\\/])?([^\\/]*)$/.exec(t)??[];this.place.textContent=this.transport.placeOf(e),this.name.value=n??"",this.forget(),this.element.showModal(),this.name.setSelectionRange(0,Math.max(0,this.name.value.lastIndexOf(".")))}forget(){this.mayReplace=!1,this.words.textContent="",this.accept.textContent="Save"}async save(){this.accept.disabled=!0;try{let t=await this.ask(this.name.value.trim(),this.mayReplace);t.existing!==void 0?(this.mayReplace=!0,this.words.textContent=`${t.existing.join(", ")}: exists already. Replace ${t.existing.length>1?"these files":"it"}, or choose another name.`,this.accept.textContent="Replace"):t.error!==void 0?this.words.textContent=t.error:(this.element.close(),this.done(t))}catch(t){this.words.textContent=this.transport.inWords(t)}finally{this.accept.disabled=!1}}};function ru(i){let t=new Uint8Array(i),e=t.indexOf(10)+1,n=new Map;for(let[s,r]of JSON.parse(new TextDecoder().decode(t.subarray(0,e))))n.set(s,t.subarray(e,e+r)),e+=r;return s=>Promise.resolve(n.get(s)??null)}var km=Array.from(crypto.getRandomValues(new Uint32Array(4)),i=>i.toString(16)).join("-"),eo={ask:(i,t={})=>fetch(i,{method:"POST",headers:{"Content-Type":"application/json"},body:JSON.stringify({tab:km,...t})}),stop:()=>void eo.ask("leave").catch(()=>{}),leave:()=>void navigator.sendBeacon("leave",new Blob([JSON.stringify({tab:km})],{type:"application/json"})),placeOf:i=>i===void 0||i==="./"?"In the folder in which kinemend view was started.":`In the folder ${i}`,inWords:i=>i instanceof TypeError?"kinemend view has ended":i instanceof Error?i.message:String(i)};var hS=150,uS=600;function Bm(i,t){let e=window.setInterval(()=>{i.ask("progress").then(s=>s.json()).then(({stage:s,done:r})=>{!n&&s!==""&&t(r>0?`${s}, ${Math.round(100*r)} %`:`${s}\u2026`)}).catch(()=>{})},uS),n=!1;return()=>{n=!0,window.clearInterval(e)}}async function zm(i){let t=await _i("report",i),e=await _i("take",i);if(t===null||e===null)throw new Error("the answer contains no report");return[t,await Yi.load(e,i)]}function Vm(i,t,...e){let n=t.input.split(/[\\/]/).pop()??t.input;i.replaceChildren(U("header",{},U("div",{},U("h1",{},n)),Js(()=>{})),...e),i.dataset.ready="running"}var ou=class{constructor(t,e,n,{flags:s={},onFirst:r}={}){this.page=t;this.session=e;this.transport=n;this.element=U("section",{class:"view-controls","aria-label":"Controls"});this.command="clean";this.general={clean:{},fill:{}};this.preset=null;this.refused=new Map;this.options={};this.status=U("p",{class:"status",role:"status"},"reading\u2026");this.first=U("section",{},U("p",{class:"empty"},"The take is being read and cleaned. The result appears here."));this.line=U("code",{class:"line",tabindex:"0"});this.rows={clean:U("div",{class:"fields"}),fill:U("div",{class:"fields"})};this.optionRow=U("div",{class:"fields own"});this.presets=Sn("preset",[["","no preset"]],"",t=>this.choosePreset(t));this.methods=null;this.whyNot={};this.unable=U("details",{class:"unable",hidden:!0});this.about=U("p",{class:"empty"});this.byPlan=U("p",{class:"empty"},"The gap plan below says how each gap is filled.");this.stopping=ee("Stop","end this run",()=>this.stop());this.names={clean:"",fill:""};this.saved=U("p",{class:"saved",role:"status"});this.timer=0;this.turn=0;this.shown=null;this.general.clean={...s},this.onFirst=r,this.method=this.presetMethod,this.dialog=new Il((u,d)=>this.save(u,d),u=>this.afterSaving(u),n),this.isJoints=e.kind==="joints";let o=()=>this.later(),a=()=>this.shown;this.contacts=this.isJoints?new Cl(a,()=>n.ask("contacts"),o):null,this.missing=new Ll(a,()=>n.ask("gaps"),()=>this.afterMarking(),this.isJoints?"joint":"marker"),e.with_gaps&&this.missing.start(n.ask("gaps")),this.gaps=new Pl(e,this.isJoints,(u,d)=>this.goTo(u,d),o,(u,d)=>this.curves(u,d));let l=Sn("what to do",[["clean","Clean"],["fill","Fill gaps only"]],"clean",u=>{this.command=u,this.draw(),this.later()});l.dataset.flag="command",this.contactBox=U("details",{class:"editor"},U("summary",{},"Contacts"),this.contacts?.element??""),this.gapBox=U("details",{class:"editor"},U("summary",{},"Gap plan"),this.gaps.element),this.presets.dataset.flag="preset",this.presets.title="settings of a live stream or of a gait laboratory",this.presets.append(...e.controls.presets.map(({name:u,summary:d})=>U("option",{value:u,title:d},u)));let c=ee("Save as\u2026","choose a file name and save the take",()=>this.dialog.open(this.names[this.command]||(this.command==="clean"?e.cleaned:e.filled)));c.dataset.action="save",this.stopping.dataset.action="stop",this.stopping.hidden=!0,this.element.append(U("div",{class:"head"},U("h2",{},"Controls"),l,this.presets,c,U("span",{class:"gap"}),this.status,this.stopping),this.about,this.rows.clean,this.rows.fill,this.contactBox,U("details",{class:"editor"},U("summary",{},"Missing samples"),this.missing.element),this.gapBox,this.line,this.saved,this.dialog.element),this.addClean(),this.addFill(),this.draw(),Vm(t,e,this.element,this.first),this.run()}set(t,e,n){let s=this.general[t];n===void 0||n===""?delete s[e]:s[e]=n,this.later()}text(t,e,n,s,r){let o=U("input",{type:"text",placeholder:s,value:String(this.general[t][e]??""),"aria-label":n});return o.dataset.flag=e,o.addEventListener("input",()=>{to(o,""),this.set(t,e,o.value.trim())}),Oo(n,r,o)}option(t,e,n,s={}){let r=this.session.controls.flags[t].find(l=>l.name===n);if(r===void 0)throw new Error(`the program has no flag ${n}`);let o=t==="clean"?this.preset?.values[n]:void 0,a={...r,...s};return su(o===void 0?a:{...a,default:o},this.general[t][n],{change:l=>this.set(t,n,l),refuse:l=>this.refuse(`${t}.${n}`,l)},e)}refuse(t,e){e===null?this.refused.delete(t):this.refused.set(t,e),this.sayRefused()}sayRefused(){let t=[...this.refused].filter(([e])=>e.startsWith(`${this.command}.`)).map(([,e])=>e);return t.length===0?!1:(window.clearTimeout(this.timer),++this.turn,this.status.textContent=`not used: ${t.join(", ")}. The page shows the last result with valid values.`,this.status.classList.add("error"),this.page.dataset.ready="error",!0)}choosePreset(t){let e=this.general.clean;for(let n of Object.keys(this.preset?.values??{}))delete e[n];this.preset=this.session.controls.presets.find(n=>n.name===t)??null;for(let n of Object.keys(this.preset?.values??{}))delete e[n];for(let n of Object.keys(this.preset?.options??{}))delete this.options[n];this.method=this.presetMethod,this.addClean(),this.draw(),this.later()}get presetMethod(){return String(this.preset?.values.method??this.session.default_method)}fillMethods(){return this.session.controls.fill_methods.filter(t=>this.isJoints?t.joints:t.markers).map(({name:t})=>t)}addClean(){let t=Sn("method",this.session.controls.methods.map(({name:s})=>[s,s]),this.method,s=>{this.method=s,this.drawOptions(),this.later()});t.dataset.flag="method",this.methods=t,this.offerMethods();let e=this.isJoints?"joints":"markers",n=this.isJoints?"Left*":"L*";for(let s of this.refused.keys())s.startsWith("clean.")&&this.refused.delete(s);this.rows.clean.replaceChildren(Oo("method","how to clean",t),this.option("clean","source","source",{default:this.session.source}),this.option("clean","strength","strength"),this.text("clean","joints",`${e} to clean`,`${n} (all)`,`names or patterns, separated by commas; empty: all ${e}`),this.text("clean","exclude",`${e} to leave out`,"none",`names or patterns of ${e} that are not changed`),this.text("clean","range","frames","121:240 or 1s:2.5s","clean only these frames, by their numbers or in seconds; empty: all frames"),this.option("clean","fill gaps","fill",{choices:["off",...this.fillMethods()]})),this.isJoints?this.rows.clean.append(this.option("clean","hold feet","feet"),this.option("clean","largest change (deg)","max_change_deg"),this.option("clean","clean the root\u2019s position","root_position")):this.rows.clean.append(this.option("clean","undo label swaps","fix_swaps")),this.rows.clean.append(this.optionRow,this.unable),this.drawOptions()}offerMethods(){let t=Object.entries(this.whyNot);for(let e of this.methods?.options??[])e.disabled=e.value in this.whyNot,e.title=this.whyNot[e.value]??"";this.unable.hidden=t.length===0,this.unable.replaceChildren(U("summary",{},`${Dn(t.length,"method")} cannot clean this take`),U("ul",{},...t.map(([e,n])=>U("li",{},U("b",{},e),`: ${n}`))))}drawOptions(){let t=this.session.controls.methods.find(({name:s})=>s===this.method),e=this.options[this.method]??={},n=this.preset?.options[this.method]??{};for(let s of this.session.controls.methods)for(let{name:r}of s.options)this.refused.delete(`clean.${r}`);this.optionRow.replaceChildren(U("p",{class:"empty"},t?.summary??""),...(t?.options??[]).map(s=>su({...s,default:n[s.name]??s.default},e[s.name],{change:r=>{r===void 0?delete e[s.name]:e[s.name]=r,this.later()},refuse:r=>this.refuse(`clean.${s.name}`,r)})))}addFill(){let t=this.isJoints?"joints":"markers";this.rows.fill.append(this.option("fill","method","method",{choices:this.fillMethods()}),this.text("fill","joints",`${t} to fill`,`${this.isJoints?"Left*":"L*"} (all)`,`names or patterns, separated by commas; empty: all ${t}`),this.text("fill","range","frames","121:240 or 1s:2.5s","fill only gaps in these frames, by their numbers or in seconds; empty: all frames"),this.option("fill","fill every gap","fill_all")),this.isJoints||this.rows.fill.append(this.text("fill","donor","donor marker","LASI","the marker whose motion the method pattern copies")),this.rows.fill.append(this.byPlan)}draw(){for(let t of["clean","fill"])this.rows[t].hidden=t!==this.command;for(let t of this.rows.fill.querySelectorAll("input, select, button"))t.disabled=this.gaps.edited;this.byPlan.hidden=!this.gaps.edited,this.presets.hidden=this.command!=="clean",this.about.hidden=this.command!=="clean"||this.preset===null,this.about.textContent=this.preset===null?"":`Preset ${this.preset.name}: ${this.preset.summary}.`,this.contactBox.hidden=this.contacts===null||this.command!=="clean",this.gapBox.hidden=this.command!=="fill"}asked(){let t=this.missing.edited?this.missing.text():void 0;if(this.command==="fill"){let n=this.gaps.edited?this.gaps.text():void 0;return{command:"fill",flags:n===void 0?this.general.fill:{},plan:n,gaps:t,preview:this.gaps.preview}}let e={...this.general.clean,...this.options[this.method]};return this.preset!==null&&(e.preset=this.preset.name),this.method!==this.presetMethod&&(e.method=this.method),{command:"clean",flags:e,gaps:t,contacts:this.contacts?.edited?this.contacts.text():void 0}}async curves(t,e){let{gaps:n}=this.asked(),s=await this.transport.ask("curves",{command:"fill",flags:{},plan:t,row:e,gaps:n});if(s.status===409)return null;let r=await s.json();if(!s.ok)throw new Error(r.error);return r}afterMarking(){this.gaps.edited=!1,this.later()}later(){this.sayRefused()||(window.clearTimeout(this.timer),this.status.textContent="running\u2026",this.page.dataset.ready="running",this.timer=window.setTimeout(()=>void this.run(),hS))}fail(t){this.status.textContent=t,this.status.classList.add("error"),this.page.dataset.ready="error",this.page.dataset.runs=String(this.turn);let e=/--([a-z][a-z-]*)/.exec(t)?.[1].replace(/-/g,"_"),n=e===void 0?null:this.rows[this.command].querySelector(`[data-flag="${e}"]`);n!==null&&to(n,t),this.shown===null&&this.first.replaceChildren(U("p",{class:"empty"},"There is nothing to show. The message above says why."))}async run(){let t=++this.turn;this.stopping.hidden=!1;let e=performance.now(),n=r=>((performance.now()-r)/1e3).toFixed(2),s=Bm(this.transport,r=>{t===this.turn&&(this.status.textContent=r)});try{let r=await this.transport.ask("run",this.asked());if(t!==this.turn)return;if(!r.ok)return this.fail((await r.json()).error);let o=ru(await r.arrayBuffer());if(t!==this.turn)return;let a=n(e);s();let[l,c]=await zm(o);if(t!==this.turn||(await this.take(l,c,await _i("plan",o),()=>t!==this.turn),t!==this.turn))return;let u=await _i("why_not",o);u!==null&&(this.whyNot=u),this.offerMethods(),this.page.dataset.ready="true";for(let d of this.rows[this.command].querySelectorAll("[aria-invalid]"))to(d,"");this.status.classList.remove("error"),this.status.textContent="done",this.page.dataset.runs=String(t),this.shown!==null&&this.onFirst?.(this.shown),this.onFirst=void 0,this.status.title=`shown after ${n(e)} s, ${a} s of them in the program`}catch(r){t===this.turn&&this.fail(this.transport.inWords(r))}finally{s(),t===this.turn&&(this.stopping.hidden=!0)}}stop(){window.clearTimeout(this.timer),++this.turn,this.transport.stop(),this.stopping.hidden=!0,this.status.textContent="stopped: the page shows the result before",this.page.dataset.ready="stopped",this.shown===null&&this.first.replaceChildren(U("p",{class:"empty"},"The run was stopped. Change a control to run again."))}dispose(){window.clearTimeout(this.timer),++this.turn,this.shown?.dispose()}async take(t,e,n,s){this.line.textContent=e.data.command_line;let r=window.scrollY;this.shown=await Uo(this.page,t,e,{panel:[this.element],before:this.shown,isOver:s,onTheme:()=>this.gaps.redraw()}),n!==null&&(this.gaps.show(n,this.shown.take),this.draw()),window.scrollTo(0,r)}goTo(t,e){let n=this.shown?.take.data.names.indexOf(t)??-1;this.shown===null||n<0||(this.shown.player.choose([n]),this.shown.player.jump(this.shown.take.frameOf(e)))}async save(t,e){if(this.refused.size>0&&this.sayRefused())return{error:"A value of the controls is not allowed: correct it first."};this.saved.textContent="saving\u2026";try{let n=await(await this.transport.ask("save",{...this.asked(),file:t,replace:e})).json();return n.written===void 0&&(this.saved.textContent=""),n}catch(n){throw this.saved.textContent="",n}}afterSaving(t){let e=t.written??[];this.names[this.command]=e[e.length-1]??"",this.saved.textContent=`saved ${e.join(", ")}`,this.line.textContent=t.command_line??""}};async function dS(i,t){let e=U("p",{class:"empty",role:"status"},"reading\u2026");Vm(i,t,U("section",{},e));let n=Bm(eo,s=>{e.textContent=s});try{let s=await eo.ask("run");if(!s.ok)throw new Error((await s.json()).error);let[r,o]=await zm(ru(await s.arrayBuffer()));n(),await Uo(i,r,o),i.dataset.ready="true"}catch(s){e.textContent=eo.inWords(s),i.dataset.ready="error"}finally{n()}}function Hm(i,t,e=eo,n={}){return window.addEventListener("pagehide",()=>e.leave()),t.other===""?new ou(i,t,e,n):(dS(i,t),{dispose:()=>{}})}async function fS(){let i=document.getElementById("page");try{let t=await _i("batch");if(t!==null)return Ru(i,t);let e=await _i("view");if(e!==null){Hm(i,e);return}let n=await _i("report"),s=await _i("take");if(n===null||s===null)throw new Error("the page contains no report");await Uo(i,n,await Yi.load(s)),i.dataset.ready="true"}catch(t){i.replaceChildren(U("h1",{},"This report cannot be shown"),U("p",{},String(t)),U("p",{},"The page needs a browser of 2023 or later, and the file must be complete.")),i.dataset.ready="failed"}}fS();})();
