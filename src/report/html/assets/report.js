/* poseshift report. Bundled libraries, each under the licence named; texts in docs/reports.md: @observablehq/plot 0.6.17 (ISC), d3-array 3.2.5 (ISC), d3-axis 3.0.1 (ISC), d3-color 3.1.1 (ISC), d3-format 3.1.3 (ISC), d3-geo 3.1.2 (ISC), d3-interpolate 3.0.2 (ISC), d3-path 3.1.1 (ISC), d3-scale 4.0.3 (ISC), d3-scale-chromatic 3.1.1 (ISC), d3-selection 3.0.1 (ISC), d3-shape 3.2.1 (ISC), d3-time 3.1.1 (ISC), d3-time-format 4.1.1 (ISC), isoformat 0.2.1 (ISC), three 0.187.0 (MIT) */
(()=>{function oe(e,t){let n=e.values;if(Array.isArray(n))return n[t];let i=n.index[t];return i==null?null:n.names[i]}function ai(e){let t=e.columns[0];return t?Array.isArray(t.values)?t.values.length:t.values.index.length:0}function Ws(e){return e.unit?`${e.label}, ${e.unit}`:e.label}function pc(e){if(e==null)return"\u2013";if(typeof e=="boolean")return e?"yes":"no";if(typeof e!="number")return String(e);if(e===0)return"0";let t=Math.abs(e);return t>=1e7||t<1e-4?e.toExponential().replace("-","\u2212").replace("-","\u2212"):String(e).replace("-","\u2212")}function t3(e){let t=r=>{if(r==null)return"";let s=String(r),o=typeof r=="string"&&/^[=+\-@\t\r]/.test(s)?`'${s}`:s;return/[",\n\r]/.test(o)?`"${o.replaceAll('"','""')}"`:o},n=[e.columns.map(r=>t(Ws(r))).join(",")],i=ai(e);for(let r=0;r<i;r+=1)n.push(e.columns.map(s=>t(oe(s,r))).join(","));return`${n.join(`\r
`)}\r
`}function St(e,t={},...n){let i=document.createElement(e);for(let[r,s]of Object.entries(t))s==null||s===!1||(r.startsWith("on")?i.addEventListener(r.slice(2),s):r in i&&r!=="list"&&!r.startsWith("aria")?i[r]=s:i.setAttribute(r,s===!0?"":s));return i.append(...n.filter(r=>r!=null)),i}function Zx(e,t){return St("button",{type:"button",className:"save",onclick:()=>{let i=new Blob([t3(e)],{type:"text/csv;charset=utf-8"}),r=St("a",{href:URL.createObjectURL(i),download:`${t}.csv`});document.body.append(r),r.click(),r.remove(),setTimeout(()=>URL.revokeObjectURL(r.href),1e3)}},"Save CSV")}function Jx(e){return e.toLowerCase().replace(/[^a-z0-9]+/g,"-").replace(/^-|-$/g,"")||"table"}function vn(e,t){return e==null||t==null?NaN:e<t?-1:e>t?1:e>=t?0:NaN}function Mr(e,t){return e==null||t==null?NaN:t<e?-1:t>e?1:t>=e?0:NaN}function Fo(e){let t,n,i;e.length!==2?(t=vn,n=(a,c)=>vn(e(a),c),i=(a,c)=>e(a)-c):(t=e===vn||e===Mr?e:e3,n=e,i=e);function r(a,c,l=0,u=a.length){if(l<u){if(t(c,c)!==0)return u;do{let h=l+u>>>1;n(a[h],c)<0?l=h+1:u=h}while(l<u)}return l}function s(a,c,l=0,u=a.length){if(l<u){if(t(c,c)!==0)return u;do{let h=l+u>>>1;n(a[h],c)<=0?l=h+1:u=h}while(l<u)}return l}function o(a,c,l=0,u=a.length){let h=r(a,c,l,u-1);return h>l&&i(a[h-1],c)>-i(a[h],c)?h-1:h}return{left:r,center:o,right:s}}function e3(){return 0}function Kx(e){return e===null?NaN:+e}function*n3(e,t){if(t===void 0)for(let n of e)n!=null&&(n=+n)>=n&&(yield n);else{let n=-1;for(let i of e)(i=t(i,++n,e))!=null&&(i=+i)>=i&&(yield i)}}var jx=Fo(vn),yu=jx.right,R6=jx.left,P6=Fo(Kx).center;var I6=Qx(tv),L6=Qx(i3);function Qx(e){return function(t,n,i=n){if(!((n=+n)>=0))throw new RangeError("invalid rx");if(!((i=+i)>=0))throw new RangeError("invalid ry");let{data:r,width:s,height:o}=t;if(!((s=Math.floor(s))>=0))throw new RangeError("invalid width");if(!((o=Math.floor(o!==void 0?o:r.length/s))>=0))throw new RangeError("invalid height");if(!s||!o||!n&&!i)return t;let a=n&&e(n),c=i&&e(i),l=r.slice();return a&&c?(Do(a,l,r,s,o),Do(a,r,l,s,o),Do(a,l,r,s,o),Uo(c,r,l,s,o),Uo(c,l,r,s,o),Uo(c,r,l,s,o)):a?(Do(a,r,l,s,o),Do(a,l,r,s,o),Do(a,r,l,s,o)):c&&(Uo(c,r,l,s,o),Uo(c,l,r,s,o),Uo(c,r,l,s,o)),t}}function Do(e,t,n,i,r){for(let s=0,o=i*r;s<o;)e(t,n,s,s+=i,1)}function Uo(e,t,n,i,r){for(let s=0,o=i*r;s<i;++s)e(t,n,s,s+o,i)}function i3(e){let t=tv(e);return(n,i,r,s,o)=>{r<<=2,s<<=2,o<<=2,t(n,i,r+0,s+0,o),t(n,i,r+1,s+1,o),t(n,i,r+2,s+2,o),t(n,i,r+3,s+3,o)}}function tv(e){let t=Math.floor(e);if(t===e)return r3(e);let n=e-t,i=2*e+1;return(r,s,o,a,c)=>{if(!((a-=c)>=o))return;let l=t*s[o],u=c*t,h=u+c;for(let f=o,d=o+u;f<d;f+=c)l+=s[Math.min(a,f)];for(let f=o,d=a;f<=d;f+=c)l+=s[Math.min(a,f+u)],r[f]=(l+n*(s[Math.max(o,f-h)]+s[Math.min(a,f+h)]))/i,l-=s[Math.max(o,f-u)]}}function r3(e){let t=2*e+1;return(n,i,r,s,o)=>{if(!((s-=o)>=r))return;let a=e*i[r],c=o*e;for(let l=r,u=r+c;l<u;l+=o)a+=i[Math.min(s,l)];for(let l=r,u=s;l<=u;l+=o)a+=i[Math.min(s,l+c)],n[l]=a/t,a-=i[Math.max(r,l-c)]}}function s3(e){return e.length|0}function o3(e){return!(e>0)}function a3(e){return typeof e!="object"||"length"in e?e:Array.from(e)}function c3(e){return t=>e(...t)}function ev(...e){let t=typeof e[e.length-1]=="function"&&c3(e.pop());e=e.map(a3);let n=e.map(s3),i=e.length-1,r=new Array(i+1).fill(0),s=[];if(i<0||n.some(o3))return s;for(;;){s.push(r.map((a,c)=>e[c][a]));let o=i;for(;++r[o]===n[o];){if(o===0)return t?s.map(t):s;r[o--]=0}}}function nv(e,t){var n=0,i=0;return Float64Array.from(e,t===void 0?r=>n+=+r||0:r=>n+=+t(r,i++,e)||0)}function Np(e,t){let n=0,i,r=0,s=0;if(t===void 0)for(let o of e)o!=null&&(o=+o)>=o&&(i=o-r,r+=i/++n,s+=i*(o-r));else{let o=-1;for(let a of e)(a=t(a,++o,e))!=null&&(a=+a)>=a&&(i=a-r,r+=i/++n,s+=i*(a-r))}if(n>1)return s/(n-1)}function iv(e,t){let n=Np(e,t);return n&&Math.sqrt(n)}function fi(e,t){let n,i;if(t===void 0)for(let r of e)r!=null&&(n===void 0?r>=r&&(n=i=r):(n>r&&(n=r),i<r&&(i=r)));else{let r=-1;for(let s of e)(s=t(s,++r,e))!=null&&(n===void 0?s>=s&&(n=i=s):(n>s&&(n=s),i<s&&(i=s)))}return[n,i]}var ci=class{constructor(){this._partials=new Float64Array(32),this._n=0}add(t){let n=this._partials,i=0;for(let r=0;r<this._n&&r<32;r++){let s=n[r],o=t+s,a=Math.abs(t)<Math.abs(s)?t-(o-s):s-(o-t);a&&(n[i++]=a),t=o}return n[i]=t,this._n=i+1,this}valueOf(){let t=this._partials,n=this._n,i,r,s,o=0;if(n>0){for(o=t[--n];n>0&&(i=o,r=t[--n],o=i+r,s=r-(o-i),!s););n>0&&(s<0&&t[n-1]<0||s>0&&t[n-1]>0)&&(r=s*2,i=o+r,r==i-o&&(o=i))}return o}};var li=class extends Map{constructor(t,n=ov){if(super(),Object.defineProperties(this,{_intern:{value:new Map},_key:{value:n}}),t!=null)for(let[i,r]of t)this.set(i,r)}get(t){return super.get(Ip(this,t))}has(t){return super.has(Ip(this,t))}set(t,n){return super.set(rv(this,t),n)}delete(t){return super.delete(sv(this,t))}},qi=class extends Set{constructor(t,n=ov){if(super(),Object.defineProperties(this,{_intern:{value:new Map},_key:{value:n}}),t!=null)for(let i of t)this.add(i)}has(t){return super.has(Ip(this,t))}add(t){return super.add(rv(this,t))}delete(t){return super.delete(sv(this,t))}};function Ip({_intern:e,_key:t},n){let i=t(n);return e.has(i)?e.get(i):n}function rv({_intern:e,_key:t},n){let i=t(n);return e.has(i)?e.get(i):(e.set(i,n),n)}function sv({_intern:e,_key:t},n){let i=t(n);return e.has(i)&&(n=e.get(i),e.delete(i)),n}function ov(e){return e!==null&&typeof e=="object"?e.valueOf():e}function Lp(e){return e}function Oo(e,...t){return Dp(e,Lp,Lp,t)}function es(e,t,...n){return Dp(e,Lp,t,n)}function av(e,t,...n){return Dp(e,Array.from,t,n)}function Dp(e,t,n,i){return(function r(s,o){if(o>=i.length)return n(s);let a=new li,c=i[o++],l=-1;for(let u of s){let h=c(u,++l,s),f=a.get(h);f?f.push(u):a.set(h,[u])}for(let[u,h]of a)a.set(u,r(h,o));return t(a)})(e,0)}function l3(e,t){return Array.from(t,n=>e[n])}function gc(e,...t){if(typeof e[Symbol.iterator]!="function")throw new TypeError("values is not iterable");e=Array.from(e);let[n]=t;if(n&&n.length!==2||t.length>1){let i=Uint32Array.from(e,(r,s)=>s);return t.length>1?(t=t.map(r=>e.map(r)),i.sort((r,s)=>{for(let o of t){let a=pu(o[r],o[s]);if(a)return a}})):(n=e.map(n),i.sort((r,s)=>pu(n[r],n[s]))),l3(e,i)}return e.sort(cv(n))}function cv(e=vn){if(e===vn)return pu;if(typeof e!="function")throw new TypeError("compare is not a function");return(t,n)=>{let i=e(t,n);return i||i===0?i:(e(n,n)===0)-(e(t,t)===0)}}function pu(e,t){return(e==null||!(e>=e))-(t==null||!(t>=t))||(e<t?-1:e>t?1:0)}function _u(e,t,n){return(t.length!==2?gc(es(e,t,n),(([i,r],[s,o])=>vn(r,o)||vn(i,s))):gc(Oo(e,n),(([i,r],[s,o])=>t(r,o)||vn(i,s)))).map(([i])=>i)}var u3=Array.prototype,N6=u3.slice;var f3=Math.sqrt(50),h3=Math.sqrt(10),d3=Math.sqrt(2);function mu(e,t,n){let i=(t-e)/Math.max(0,n),r=Math.floor(Math.log10(i)),s=i/Math.pow(10,r),o=s>=f3?10:s>=h3?5:s>=d3?2:1,a,c,l;return r<0?(l=Math.pow(10,-r)/o,a=Math.round(e*l),c=Math.round(t*l),a/l<e&&++a,c/l>t&&--c,l=-l):(l=Math.pow(10,r)*o,a=Math.round(e/l),c=Math.round(t/l),a*l<e&&++a,c*l>t&&--c),c<a&&.5<=n&&n<2?mu(e,t,n*2):[a,c,l]}function Bo(e,t,n){if(t=+t,e=+e,n=+n,!(n>0))return[];if(e===t)return[e];let i=t<e,[r,s,o]=i?mu(t,e,n):mu(e,t,n);if(!(s>=r))return[];let a=s-r+1,c=new Array(a);if(i)if(o<0)for(let l=0;l<a;++l)c[l]=(s-l)/-o;else for(let l=0;l<a;++l)c[l]=(s-l)*o;else if(o<0)for(let l=0;l<a;++l)c[l]=(r+l)/-o;else for(let l=0;l<a;++l)c[l]=(r+l)*o;return c}function gu(e,t,n){return t=+t,e=+e,n=+n,mu(e,t,n)[2]}function yc(e,t,n){t=+t,e=+e,n=+n;let i=t<e,r=i?gu(t,e,n):gu(e,t,n);return(i?-1:1)*(r<0?1/-r:r)}function An(e,t){let n;if(t===void 0)for(let i of e)i!=null&&(n<i||n===void 0&&i>=i)&&(n=i);else{let i=-1;for(let r of e)(r=t(r,++i,e))!=null&&(n<r||n===void 0&&r>=r)&&(n=r)}return n}function lv(e,t){let n,i=-1,r=-1;if(t===void 0)for(let s of e)++r,s!=null&&(n<s||n===void 0&&s>=s)&&(n=s,i=r);else for(let s of e)(s=t(s,++r,e))!=null&&(n<s||n===void 0&&s>=s)&&(n=s,i=r);return i}function ui(e,t){let n;if(t===void 0)for(let i of e)i!=null&&(n>i||n===void 0&&i>=i)&&(n=i);else{let i=-1;for(let r of e)(r=t(r,++i,e))!=null&&(n>r||n===void 0&&r>=r)&&(n=r)}return n}function uv(e,t){let n,i=-1,r=-1;if(t===void 0)for(let s of e)++r,s!=null&&(n>s||n===void 0&&s>=s)&&(n=s,i=r);else for(let s of e)(s=t(s,++r,e))!=null&&(n>s||n===void 0&&s>=s)&&(n=s,i=r);return i}function fv(e,t,n=0,i=1/0,r){if(t=Math.floor(t),n=Math.floor(Math.max(0,n)),i=Math.floor(Math.min(e.length-1,i)),!(n<=t&&t<=i))return e;for(r=r===void 0?pu:cv(r);i>n;){if(i-n>600){let c=i-n+1,l=t-n+1,u=Math.log(c),h=.5*Math.exp(2*u/3),f=.5*Math.sqrt(u*h*(c-h)/c)*(l-c/2<0?-1:1),d=Math.max(n,Math.floor(t-l*h/c+f)),p=Math.min(i,Math.floor(t+(c-l)*h/c+f));fv(e,t,d,p,r)}let s=e[t],o=n,a=i;for(mc(e,n,t),r(e[i],s)>0&&mc(e,n,i);o<a;){for(mc(e,o,a),++o,--a;r(e[o],s)<0;)++o;for(;r(e[a],s)>0;)--a}r(e[n],s)===0?mc(e,n,a):(++a,mc(e,a,i)),a<=t&&(n=a+1),t<=a&&(i=a-1)}return e}function mc(e,t,n){let i=e[t];e[t]=e[n],e[n]=i}function Up(e,t=vn){let n,i=!1;if(t.length===1){let r;for(let s of e){let o=t(s);(i?vn(o,r)>0:vn(o,o)===0)&&(n=s,r=o,i=!0)}}else for(let r of e)(i?t(r,n)>0:t(r,r)===0)&&(n=r,i=!0);return n}function $s(e,t,n){if(e=Float64Array.from(n3(e,n)),!(!(i=e.length)||isNaN(t=+t))){if(t<=0||i<2)return ui(e);if(t>=1)return An(e);var i,r=(i-1)*t,s=Math.floor(r),o=An(fv(e,s).subarray(0,s+1)),a=ui(e.subarray(s+1));return o+(a-o)*(r-s)}}function hv(e,t,n=Kx){if(!(!(i=e.length)||isNaN(t=+t))){if(t<=0||i<2)return+n(e[0],0,e);if(t>=1)return+n(e[i-1],i-1,e);var i,r=(i-1)*t,s=Math.floor(r),o=+n(e[s],s,e),a=+n(e[s+1],s+1,e);return o+(a-o)*(r-s)}}function dv(e,t){let n=0,i=0;if(t===void 0)for(let r of e)r!=null&&(r=+r)>=r&&(++n,i+=r);else{let r=-1;for(let s of e)(s=t(s,++r,e))!=null&&(s=+s)>=s&&(++n,i+=s)}if(n)return i/n}function _c(e,t){return $s(e,.5,t)}function*p3(e){for(let t of e)yield*t}function Fp(e){return Array.from(p3(e))}function pv(e,t){let n=new li;if(t===void 0)for(let s of e)s!=null&&s>=s&&n.set(s,(n.get(s)||0)+1);else{let s=-1;for(let o of e)(o=t(o,++s,e))!=null&&o>=o&&n.set(o,(n.get(o)||0)+1)}let i,r=0;for(let[s,o]of n)o>r&&(r=o,i=s);return i}function mv(e,t=m3){let n=[],i,r=!1;for(let s of e)r&&n.push(t(i,s)),i=s,r=!0;return n}function m3(e,t){return[e,t]}function ko(e,t,n){e=+e,t=+t,n=(r=arguments.length)<2?(t=e,e=0,1):r<3?1:+n;for(var i=-1,r=Math.max(0,Math.ceil((t-e)/n))|0,s=new Array(r);++i<r;)s[i]=e+i*n;return s}var D6=g3(Math.random);function g3(e){return function(n,i=0,r=n.length){let s=r-(i=+i);for(;s;){let o=e()*s--|0,a=n[s+i];n[s+i]=n[o+i],n[o+i]=a}return n}}function Yi(e,t){let n=0;if(t===void 0)for(let i of e)(i=+i)&&(n+=i);else{let i=-1;for(let r of e)(r=+t(r,++i,e))&&(n+=r)}return n}function zo(e){if(typeof e[Symbol.iterator]!="function")throw new TypeError("values is not iterable");return Array.from(e).reverse()}function y3(e){return e}var Op=1,Bp=2,kp=3,xu=4,gv=1e-6;function _3(e){return"translate("+e+",0)"}function x3(e){return"translate(0,"+e+")"}function v3(e){return t=>+e(t)}function b3(e,t){return t=Math.max(0,e.bandwidth()-t*2)/2,e.round()&&(t=Math.round(t)),n=>+e(n)+t}function M3(){return!this.__axis}function S3(e,t){var n=[],i=null,r=null,s=6,o=6,a=3,c=typeof window<"u"&&window.devicePixelRatio>1?0:.5,l=e===Op||e===xu?-1:1,u=e===xu||e===Bp?"x":"y",h=e===Op||e===kp?_3:x3;function f(d){var p=i??(t.ticks?t.ticks.apply(t,n):t.domain()),y=r??(t.tickFormat?t.tickFormat.apply(t,n):y3),m=Math.max(s,0)+a,g=t.range(),x=+g[0]+c,S=+g[g.length-1]+c,v=(t.bandwidth?b3:v3)(t.copy(),c),w=d.selection?d.selection():d,b=w.selectAll(".domain").data([null]),_=w.selectAll(".tick").data(p,t).order(),M=_.exit(),C=_.enter().append("g").attr("class","tick"),E=_.select("line"),I=_.select("text");b=b.merge(b.enter().insert("path",".tick").attr("class","domain").attr("stroke","currentColor")),_=_.merge(C),E=E.merge(C.append("line").attr("stroke","currentColor").attr(u+"2",l*s)),I=I.merge(C.append("text").attr("fill","currentColor").attr(u,l*m).attr("dy",e===Op?"0em":e===kp?"0.71em":"0.32em")),d!==w&&(b=b.transition(d),_=_.transition(d),E=E.transition(d),I=I.transition(d),M=M.transition(d).attr("opacity",gv).attr("transform",function(R){return isFinite(R=v(R))?h(R+c):this.getAttribute("transform")}),C.attr("opacity",gv).attr("transform",function(R){var U=this.parentNode.__axis;return h((U&&isFinite(U=U(R))?U:v(R))+c)})),M.remove(),b.attr("d",e===xu||e===Bp?o?"M"+l*o+","+x+"H"+c+"V"+S+"H"+l*o:"M"+c+","+x+"V"+S:o?"M"+x+","+l*o+"V"+c+"H"+S+"V"+l*o:"M"+x+","+c+"H"+S),_.attr("opacity",1).attr("transform",function(R){return h(v(R)+c)}),E.attr(u+"2",l*s),I.attr(u,l*m).text(y),w.filter(M3).attr("fill","none").attr("font-size",10).attr("font-family","sans-serif").attr("text-anchor",e===Bp?"start":e===xu?"end":"middle"),w.each(function(){this.__axis=v})}return f.scale=function(d){return arguments.length?(t=d,f):t},f.ticks=function(){return n=Array.from(arguments),f},f.tickArguments=function(d){return arguments.length?(n=d==null?[]:Array.from(d),f):n.slice()},f.tickValues=function(d){return arguments.length?(i=d==null?null:Array.from(d),f):i&&i.slice()},f.tickFormat=function(d){return arguments.length?(r=d,f):r},f.tickSize=function(d){return arguments.length?(s=o=+d,f):s},f.tickSizeInner=function(d){return arguments.length?(s=+d,f):s},f.tickSizeOuter=function(d){return arguments.length?(o=+d,f):o},f.tickPadding=function(d){return arguments.length?(a=+d,f):a},f.offset=function(d){return arguments.length?(c=+d,f):c},f}function yv(e){return S3(kp,e)}var zp="http://www.w3.org/1999/xhtml",ns={svg:"http://www.w3.org/2000/svg",xhtml:zp,xlink:"http://www.w3.org/1999/xlink",xml:"http://www.w3.org/XML/1998/namespace",xmlns:"http://www.w3.org/2000/xmlns/"};function _v(e){var t=e+="",n=t.indexOf(":");return n>=0&&(t=e.slice(0,n))!=="xmlns"&&(e=e.slice(n+1)),ns.hasOwnProperty(t)?{space:ns[t],local:e}:e}function w3(e){return function(){var t=this.ownerDocument,n=this.namespaceURI;return n===zp&&t.documentElement.namespaceURI===zp?t.createElement(e):t.createElementNS(n,e)}}function T3(e){return function(){return this.ownerDocument.createElementNS(e.space,e.local)}}function Go(e){var t=_v(e);return(t.local?T3:w3)(t)}function A3(){}function xv(e){return e==null?A3:function(){return this.querySelector(e)}}function E3(e){typeof e!="function"&&(e=xv(e));for(var t=this._groups,n=t.length,i=new Array(n),r=0;r<n;++r)for(var s=t[r],o=s.length,a=i[r]=new Array(o),c,l,u=0;u<o;++u)(c=s[u])&&(l=e.call(c,c.__data__,u,s))&&("__data__"in c&&(l.__data__=c.__data__),a[u]=l);return new $n(i,this._parents)}function C3(e){return e==null?[]:Array.isArray(e)?e:Array.from(e)}function R3(){return[]}function P3(e){return e==null?R3:function(){return this.querySelectorAll(e)}}function I3(e){return function(){return C3(e.apply(this,arguments))}}function L3(e){typeof e=="function"?e=I3(e):e=P3(e);for(var t=this._groups,n=t.length,i=[],r=[],s=0;s<n;++s)for(var o=t[s],a=o.length,c,l=0;l<a;++l)(c=o[l])&&(i.push(e.call(c,c.__data__,l,o)),r.push(c));return new $n(i,r)}function N3(e){return function(){return this.matches(e)}}function vv(e){return function(t){return t.matches(e)}}var D3=Array.prototype.find;function U3(e){return function(){return D3.call(this.children,e)}}function F3(){return this.firstElementChild}function O3(e){return this.select(e==null?F3:U3(typeof e=="function"?e:vv(e)))}var B3=Array.prototype.filter;function k3(){return Array.from(this.children)}function z3(e){return function(){return B3.call(this.children,e)}}function G3(e){return this.selectAll(e==null?k3:z3(typeof e=="function"?e:vv(e)))}function V3(e){typeof e!="function"&&(e=N3(e));for(var t=this._groups,n=t.length,i=new Array(n),r=0;r<n;++r)for(var s=t[r],o=s.length,a=i[r]=[],c,l=0;l<o;++l)(c=s[l])&&e.call(c,c.__data__,l,s)&&a.push(c);return new $n(i,this._parents)}function bv(e){return new Array(e.length)}function H3(){return new $n(this._enter||this._groups.map(bv),this._parents)}function vu(e,t){this.ownerDocument=e.ownerDocument,this.namespaceURI=e.namespaceURI,this._next=null,this._parent=e,this.__data__=t}vu.prototype={constructor:vu,appendChild:function(e){return this._parent.insertBefore(e,this._next)},insertBefore:function(e,t){return this._parent.insertBefore(e,t)},querySelector:function(e){return this._parent.querySelector(e)},querySelectorAll:function(e){return this._parent.querySelectorAll(e)}};function W3(e){return function(){return e}}function $3(e,t,n,i,r,s){for(var o=0,a,c=t.length,l=s.length;o<l;++o)(a=t[o])?(a.__data__=s[o],i[o]=a):n[o]=new vu(e,s[o]);for(;o<c;++o)(a=t[o])&&(r[o]=a)}function X3(e,t,n,i,r,s,o){var a,c,l=new Map,u=t.length,h=s.length,f=new Array(u),d;for(a=0;a<u;++a)(c=t[a])&&(f[a]=d=o.call(c,c.__data__,a,t)+"",l.has(d)?r[a]=c:l.set(d,c));for(a=0;a<h;++a)d=o.call(e,s[a],a,s)+"",(c=l.get(d))?(i[a]=c,c.__data__=s[a],l.delete(d)):n[a]=new vu(e,s[a]);for(a=0;a<u;++a)(c=t[a])&&l.get(f[a])===c&&(r[a]=c)}function q3(e){return e.__data__}function Y3(e,t){if(!arguments.length)return Array.from(this,q3);var n=t?X3:$3,i=this._parents,r=this._groups;typeof e!="function"&&(e=W3(e));for(var s=r.length,o=new Array(s),a=new Array(s),c=new Array(s),l=0;l<s;++l){var u=i[l],h=r[l],f=h.length,d=Z3(e.call(u,u&&u.__data__,l,i)),p=d.length,y=a[l]=new Array(p),m=o[l]=new Array(p),g=c[l]=new Array(f);n(u,h,y,m,g,d,t);for(var x=0,S=0,v,w;x<p;++x)if(v=y[x]){for(x>=S&&(S=x+1);!(w=m[S])&&++S<p;);v._next=w||null}}return o=new $n(o,i),o._enter=a,o._exit=c,o}function Z3(e){return typeof e=="object"&&"length"in e?e:Array.from(e)}function J3(){return new $n(this._exit||this._groups.map(bv),this._parents)}function K3(e,t,n){var i=this.enter(),r=this,s=this.exit();return typeof e=="function"?(i=e(i),i&&(i=i.selection())):i=i.append(e+""),t!=null&&(r=t(r),r&&(r=r.selection())),n==null?s.remove():n(s),i&&r?i.merge(r).order():r}function j3(e){for(var t=e.selection?e.selection():e,n=this._groups,i=t._groups,r=n.length,s=i.length,o=Math.min(r,s),a=new Array(r),c=0;c<o;++c)for(var l=n[c],u=i[c],h=l.length,f=a[c]=new Array(h),d,p=0;p<h;++p)(d=l[p]||u[p])&&(f[p]=d);for(;c<r;++c)a[c]=n[c];return new $n(a,this._parents)}function Q3(){for(var e=this._groups,t=-1,n=e.length;++t<n;)for(var i=e[t],r=i.length-1,s=i[r],o;--r>=0;)(o=i[r])&&(s&&o.compareDocumentPosition(s)^4&&s.parentNode.insertBefore(o,s),s=o);return this}function tC(e){e||(e=eC);function t(h,f){return h&&f?e(h.__data__,f.__data__):!h-!f}for(var n=this._groups,i=n.length,r=new Array(i),s=0;s<i;++s){for(var o=n[s],a=o.length,c=r[s]=new Array(a),l,u=0;u<a;++u)(l=o[u])&&(c[u]=l);c.sort(t)}return new $n(r,this._parents).order()}function eC(e,t){return e<t?-1:e>t?1:e>=t?0:NaN}function nC(){var e=arguments[0];return arguments[0]=this,e.apply(null,arguments),this}function iC(){return Array.from(this)}function rC(){for(var e=this._groups,t=0,n=e.length;t<n;++t)for(var i=e[t],r=0,s=i.length;r<s;++r){var o=i[r];if(o)return o}return null}function sC(){let e=0;for(let t of this)++e;return e}function oC(){return!this.node()}function aC(e){for(var t=this._groups,n=0,i=t.length;n<i;++n)for(var r=t[n],s=0,o=r.length,a;s<o;++s)(a=r[s])&&e.call(a,a.__data__,s,r);return this}function cC(e){return function(){this.removeAttribute(e)}}function lC(e){return function(){this.removeAttributeNS(e.space,e.local)}}function uC(e,t){return function(){this.setAttribute(e,t)}}function fC(e,t){return function(){this.setAttributeNS(e.space,e.local,t)}}function hC(e,t){return function(){var n=t.apply(this,arguments);n==null?this.removeAttribute(e):this.setAttribute(e,n)}}function dC(e,t){return function(){var n=t.apply(this,arguments);n==null?this.removeAttributeNS(e.space,e.local):this.setAttributeNS(e.space,e.local,n)}}function pC(e,t){var n=_v(e);if(arguments.length<2){var i=this.node();return n.local?i.getAttributeNS(n.space,n.local):i.getAttribute(n)}return this.each((t==null?n.local?lC:cC:typeof t=="function"?n.local?dC:hC:n.local?fC:uC)(n,t))}function Mv(e){return e.ownerDocument&&e.ownerDocument.defaultView||e.document&&e||e.defaultView}function mC(e){return function(){this.style.removeProperty(e)}}function gC(e,t,n){return function(){this.style.setProperty(e,t,n)}}function yC(e,t,n){return function(){var i=t.apply(this,arguments);i==null?this.style.removeProperty(e):this.style.setProperty(e,i,n)}}function _C(e,t,n){return arguments.length>1?this.each((t==null?mC:typeof t=="function"?yC:gC)(e,t,n??"")):xC(this.node(),e)}function xC(e,t){return e.style.getPropertyValue(t)||Mv(e).getComputedStyle(e,null).getPropertyValue(t)}function vC(e){return function(){delete this[e]}}function bC(e,t){return function(){this[e]=t}}function MC(e,t){return function(){var n=t.apply(this,arguments);n==null?delete this[e]:this[e]=n}}function SC(e,t){return arguments.length>1?this.each((t==null?vC:typeof t=="function"?MC:bC)(e,t)):this.node()[e]}function Sv(e){return e.trim().split(/^|\s+/)}function Vp(e){return e.classList||new wv(e)}function wv(e){this._node=e,this._names=Sv(e.getAttribute("class")||"")}wv.prototype={add:function(e){var t=this._names.indexOf(e);t<0&&(this._names.push(e),this._node.setAttribute("class",this._names.join(" ")))},remove:function(e){var t=this._names.indexOf(e);t>=0&&(this._names.splice(t,1),this._node.setAttribute("class",this._names.join(" ")))},contains:function(e){return this._names.indexOf(e)>=0}};function Tv(e,t){for(var n=Vp(e),i=-1,r=t.length;++i<r;)n.add(t[i])}function Av(e,t){for(var n=Vp(e),i=-1,r=t.length;++i<r;)n.remove(t[i])}function wC(e){return function(){Tv(this,e)}}function TC(e){return function(){Av(this,e)}}function AC(e,t){return function(){(t.apply(this,arguments)?Tv:Av)(this,e)}}function EC(e,t){var n=Sv(e+"");if(arguments.length<2){for(var i=Vp(this.node()),r=-1,s=n.length;++r<s;)if(!i.contains(n[r]))return!1;return!0}return this.each((typeof t=="function"?AC:t?wC:TC)(n,t))}function CC(){this.textContent=""}function RC(e){return function(){this.textContent=e}}function PC(e){return function(){var t=e.apply(this,arguments);this.textContent=t??""}}function IC(e){return arguments.length?this.each(e==null?CC:(typeof e=="function"?PC:RC)(e)):this.node().textContent}function LC(){this.innerHTML=""}function NC(e){return function(){this.innerHTML=e}}function DC(e){return function(){var t=e.apply(this,arguments);this.innerHTML=t??""}}function UC(e){return arguments.length?this.each(e==null?LC:(typeof e=="function"?DC:NC)(e)):this.node().innerHTML}function FC(){this.nextSibling&&this.parentNode.appendChild(this)}function OC(){return this.each(FC)}function BC(){this.previousSibling&&this.parentNode.insertBefore(this,this.parentNode.firstChild)}function kC(){return this.each(BC)}function zC(e){var t=typeof e=="function"?e:Go(e);return this.select(function(){return this.appendChild(t.apply(this,arguments))})}function GC(){return null}function VC(e,t){var n=typeof e=="function"?e:Go(e),i=t==null?GC:typeof t=="function"?t:xv(t);return this.select(function(){return this.insertBefore(n.apply(this,arguments),i.apply(this,arguments)||null)})}function HC(){var e=this.parentNode;e&&e.removeChild(this)}function WC(){return this.each(HC)}function $C(){var e=this.cloneNode(!1),t=this.parentNode;return t?t.insertBefore(e,this.nextSibling):e}function XC(){var e=this.cloneNode(!0),t=this.parentNode;return t?t.insertBefore(e,this.nextSibling):e}function qC(e){return this.select(e?XC:$C)}function YC(e){return arguments.length?this.property("__data__",e):this.node().__data__}function ZC(e){return function(t){e.call(this,t,this.__data__)}}function JC(e){return e.trim().split(/^|\s+/).map(function(t){var n="",i=t.indexOf(".");return i>=0&&(n=t.slice(i+1),t=t.slice(0,i)),{type:t,name:n}})}function KC(e){return function(){var t=this.__on;if(t){for(var n=0,i=-1,r=t.length,s;n<r;++n)s=t[n],(!e.type||s.type===e.type)&&s.name===e.name?this.removeEventListener(s.type,s.listener,s.options):t[++i]=s;++i?t.length=i:delete this.__on}}}function jC(e,t,n){return function(){var i=this.__on,r,s=ZC(t);if(i){for(var o=0,a=i.length;o<a;++o)if((r=i[o]).type===e.type&&r.name===e.name){this.removeEventListener(r.type,r.listener,r.options),this.addEventListener(r.type,r.listener=s,r.options=n),r.value=t;return}}this.addEventListener(e.type,s,n),r={type:e.type,name:e.name,value:t,listener:s,options:n},i?i.push(r):this.__on=[r]}}function QC(e,t,n){var i=JC(e+""),r,s=i.length,o;if(arguments.length<2){var a=this.node().__on;if(a){for(var c=0,l=a.length,u;c<l;++c)for(r=0,u=a[c];r<s;++r)if((o=i[r]).type===u.type&&o.name===u.name)return u.value}return}for(a=t?jC:KC,r=0;r<s;++r)this.each(a(i[r],t,n));return this}function Ev(e,t,n){var i=Mv(e),r=i.CustomEvent;typeof r=="function"?r=new r(t,n):(r=i.document.createEvent("Event"),n?(r.initEvent(t,n.bubbles,n.cancelable),r.detail=n.detail):r.initEvent(t,!1,!1)),e.dispatchEvent(r)}function tR(e,t){return function(){return Ev(this,e,t)}}function eR(e,t){return function(){return Ev(this,e,t.apply(this,arguments))}}function nR(e,t){return this.each((typeof t=="function"?eR:tR)(e,t))}function*iR(){for(var e=this._groups,t=0,n=e.length;t<n;++t)for(var i=e[t],r=0,s=i.length,o;r<s;++r)(o=i[r])&&(yield o)}var Cv=[null];function $n(e,t){this._groups=e,this._parents=t}function rR(){return new $n([[document.documentElement]],Cv)}function sR(){return this}$n.prototype=rR.prototype={constructor:$n,select:E3,selectAll:L3,selectChild:O3,selectChildren:G3,filter:V3,data:Y3,enter:H3,exit:J3,join:K3,merge:j3,selection:sR,order:Q3,sort:tC,call:nC,nodes:iC,node:rC,size:sC,empty:oC,each:aC,attr:pC,style:_C,property:SC,classed:EC,text:IC,html:UC,raise:OC,lower:kC,append:zC,insert:VC,remove:WC,clone:qC,datum:YC,on:QC,dispatch:nR,[Symbol.iterator]:iR};function Ii(e){return typeof e=="string"?new $n([[document.querySelector(e)]],[document.documentElement]):new $n([[e]],Cv)}var oR=0;function aR(){return new Gp}function Gp(){this._="@"+(++oR).toString(36)}Gp.prototype=aR.prototype={constructor:Gp,get:function(e){for(var t=this._;!(t in e);)if(!(e=e.parentNode))return;return e[t]},set:function(e,t){return e[this._]=t},remove:function(e){return this._ in e&&delete e[this._]},toString:function(){return this._}};function cR(e){let t;for(;t=e.sourceEvent;)e=t;return e}function Rv(e,t){if(e=cR(e),t===void 0&&(t=e.currentTarget),t){var n=t.ownerSVGElement||t;if(n.createSVGPoint){var i=n.createSVGPoint();return i.x=e.clientX,i.y=e.clientY,i=i.matrixTransform(t.getScreenCTM().inverse()),[i.x,i.y]}if(t.getBoundingClientRect){var r=t.getBoundingClientRect();return[e.clientX-r.left-t.clientLeft,e.clientY-r.top-t.clientTop]}}return[e.pageX,e.pageY]}function $o(e,t,n){e.prototype=t.prototype=n,n.constructor=e}function bc(e,t){var n=Object.create(e.prototype);for(var i in t)n[i]=t[i];return n}function is(){}var Zs=.7,Wo=1/Zs,Vo="\\s*([+-]?\\d+)\\s*",xc="\\s*([+-]?(?:\\d*\\.)?\\d+(?:[eE][+-]?\\d+)?)\\s*",Zi="\\s*([+-]?(?:\\d*\\.)?\\d+(?:[eE][+-]?\\d+)?)%\\s*",lR=/^#([0-9a-f]{3,8})$/,uR=new RegExp(`^rgb\\(${Vo},${Vo},${Vo}\\)$`),fR=new RegExp(`^rgb\\(${Zi},${Zi},${Zi}\\)$`),hR=new RegExp(`^rgba\\(${Vo},${Vo},${Vo},${xc}\\)$`),dR=new RegExp(`^rgba\\(${Zi},${Zi},${Zi},${xc}\\)$`),pR=new RegExp(`^hsl\\(${xc},${Zi},${Zi}\\)$`),mR=new RegExp(`^hsla\\(${xc},${Zi},${Zi},${xc}\\)$`),Pv={aliceblue:15792383,antiquewhite:16444375,aqua:65535,aquamarine:8388564,azure:15794175,beige:16119260,bisque:16770244,black:0,blanchedalmond:16772045,blue:255,blueviolet:9055202,brown:10824234,burlywood:14596231,cadetblue:6266528,chartreuse:8388352,chocolate:13789470,coral:16744272,cornflowerblue:6591981,cornsilk:16775388,crimson:14423100,cyan:65535,darkblue:139,darkcyan:35723,darkgoldenrod:12092939,darkgray:11119017,darkgreen:25600,darkgrey:11119017,darkkhaki:12433259,darkmagenta:9109643,darkolivegreen:5597999,darkorange:16747520,darkorchid:10040012,darkred:9109504,darksalmon:15308410,darkseagreen:9419919,darkslateblue:4734347,darkslategray:3100495,darkslategrey:3100495,darkturquoise:52945,darkviolet:9699539,deeppink:16716947,deepskyblue:49151,dimgray:6908265,dimgrey:6908265,dodgerblue:2003199,firebrick:11674146,floralwhite:16775920,forestgreen:2263842,fuchsia:16711935,gainsboro:14474460,ghostwhite:16316671,gold:16766720,goldenrod:14329120,gray:8421504,green:32768,greenyellow:11403055,grey:8421504,honeydew:15794160,hotpink:16738740,indianred:13458524,indigo:4915330,ivory:16777200,khaki:15787660,lavender:15132410,lavenderblush:16773365,lawngreen:8190976,lemonchiffon:16775885,lightblue:11393254,lightcoral:15761536,lightcyan:14745599,lightgoldenrodyellow:16448210,lightgray:13882323,lightgreen:9498256,lightgrey:13882323,lightpink:16758465,lightsalmon:16752762,lightseagreen:2142890,lightskyblue:8900346,lightslategray:7833753,lightslategrey:7833753,lightsteelblue:11584734,lightyellow:16777184,lime:65280,limegreen:3329330,linen:16445670,magenta:16711935,maroon:8388608,mediumaquamarine:6737322,mediumblue:205,mediumorchid:12211667,mediumpurple:9662683,mediumseagreen:3978097,mediumslateblue:8087790,mediumspringgreen:64154,mediumturquoise:4772300,mediumvioletred:13047173,midnightblue:1644912,mintcream:16121850,mistyrose:16770273,moccasin:16770229,navajowhite:16768685,navy:128,oldlace:16643558,olive:8421376,olivedrab:7048739,orange:16753920,orangered:16729344,orchid:14315734,palegoldenrod:15657130,palegreen:10025880,paleturquoise:11529966,palevioletred:14381203,papayawhip:16773077,peachpuff:16767673,peru:13468991,pink:16761035,plum:14524637,powderblue:11591910,purple:8388736,rebeccapurple:6697881,red:16711680,rosybrown:12357519,royalblue:4286945,saddlebrown:9127187,salmon:16416882,sandybrown:16032864,seagreen:3050327,seashell:16774638,sienna:10506797,silver:12632256,skyblue:8900331,slateblue:6970061,slategray:7372944,slategrey:7372944,snow:16775930,springgreen:65407,steelblue:4620980,tan:13808780,teal:32896,thistle:14204888,tomato:16737095,turquoise:4251856,violet:15631086,wheat:16113331,white:16777215,whitesmoke:16119285,yellow:16776960,yellowgreen:10145074};$o(is,Xo,{copy(e){return Object.assign(new this.constructor,this,e)},displayable(){return this.rgb().displayable()},hex:Iv,formatHex:Iv,formatHex8:gR,formatHsl:yR,formatRgb:Lv,toString:Lv});function Iv(){return this.rgb().formatHex()}function gR(){return this.rgb().formatHex8()}function yR(){return Gv(this).formatHsl()}function Lv(){return this.rgb().formatRgb()}function Xo(e){var t,n;return e=(e+"").trim().toLowerCase(),(t=lR.exec(e))?(n=t[1].length,t=parseInt(t[1],16),n===6?Nv(t):n===3?new je(t>>8&15|t>>4&240,t>>4&15|t&240,(t&15)<<4|t&15,1):n===8?bu(t>>24&255,t>>16&255,t>>8&255,(t&255)/255):n===4?bu(t>>12&15|t>>8&240,t>>8&15|t>>4&240,t>>4&15|t&240,((t&15)<<4|t&15)/255):null):(t=uR.exec(e))?new je(t[1],t[2],t[3],1):(t=fR.exec(e))?new je(t[1]*255/100,t[2]*255/100,t[3]*255/100,1):(t=hR.exec(e))?bu(t[1],t[2],t[3],t[4]):(t=dR.exec(e))?bu(t[1]*255/100,t[2]*255/100,t[3]*255/100,t[4]):(t=pR.exec(e))?Fv(t[1],t[2]/100,t[3]/100,1):(t=mR.exec(e))?Fv(t[1],t[2]/100,t[3]/100,t[4]):Pv.hasOwnProperty(e)?Nv(Pv[e]):e==="transparent"?new je(NaN,NaN,NaN,0):null}function Nv(e){return new je(e>>16&255,e>>8&255,e&255,1)}function bu(e,t,n,i){return i<=0&&(e=t=n=NaN),new je(e,t,n,i)}function Yp(e){return e instanceof is||(e=Xo(e)),e?(e=e.rgb(),new je(e.r,e.g,e.b,e.opacity)):new je}function Ni(e,t,n,i){return arguments.length===1?Yp(e):new je(e,t,n,i??1)}function je(e,t,n,i){this.r=+e,this.g=+t,this.b=+n,this.opacity=+i}$o(je,Ni,bc(is,{brighter(e){return e=e==null?Wo:Math.pow(Wo,e),new je(this.r*e,this.g*e,this.b*e,this.opacity)},darker(e){return e=e==null?Zs:Math.pow(Zs,e),new je(this.r*e,this.g*e,this.b*e,this.opacity)},rgb(){return this},clamp(){return new je(qs(this.r),qs(this.g),qs(this.b),Su(this.opacity))},displayable(){return-.5<=this.r&&this.r<255.5&&-.5<=this.g&&this.g<255.5&&-.5<=this.b&&this.b<255.5&&0<=this.opacity&&this.opacity<=1},hex:Dv,formatHex:Dv,formatHex8:_R,formatRgb:Uv,toString:Uv}));function Dv(){return`#${Xs(this.r)}${Xs(this.g)}${Xs(this.b)}`}function _R(){return`#${Xs(this.r)}${Xs(this.g)}${Xs(this.b)}${Xs((isNaN(this.opacity)?1:this.opacity)*255)}`}function Uv(){let e=Su(this.opacity);return`${e===1?"rgb(":"rgba("}${qs(this.r)}, ${qs(this.g)}, ${qs(this.b)}${e===1?")":`, ${e})`}`}function Su(e){return isNaN(e)?1:Math.max(0,Math.min(1,e))}function qs(e){return Math.max(0,Math.min(255,Math.round(e)||0))}function Xs(e){return e=qs(e),(e<16?"0":"")+e.toString(16)}function Fv(e,t,n,i){return i<=0?e=t=n=NaN:n<=0||n>=1?e=t=NaN:t<=0&&(e=NaN),new Li(e,t,n,i)}function Gv(e){if(e instanceof Li)return new Li(e.h,e.s,e.l,e.opacity);if(e instanceof is||(e=Xo(e)),!e)return new Li;if(e instanceof Li)return e;e=e.rgb();var t=e.r/255,n=e.g/255,i=e.b/255,r=Math.min(t,n,i),s=Math.max(t,n,i),o=NaN,a=s-r,c=(s+r)/2;return a?(t===s?o=(n-i)/a+(n<i)*6:n===s?o=(i-t)/a+2:o=(t-n)/a+4,a/=c<.5?s+r:2-s-r,o*=60):a=c>0&&c<1?0:o,new Li(o,a,c,e.opacity)}function Tu(e,t,n,i){return arguments.length===1?Gv(e):new Li(e,t,n,i??1)}function Li(e,t,n,i){this.h=+e,this.s=+t,this.l=+n,this.opacity=+i}$o(Li,Tu,bc(is,{brighter(e){return e=e==null?Wo:Math.pow(Wo,e),new Li(this.h,this.s,this.l*e,this.opacity)},darker(e){return e=e==null?Zs:Math.pow(Zs,e),new Li(this.h,this.s,this.l*e,this.opacity)},rgb(){var e=this.h%360+(this.h<0)*360,t=isNaN(e)||isNaN(this.s)?0:this.s,n=this.l,i=n+(n<.5?n:1-n)*t,r=2*n-i;return new je(Hp(e>=240?e-240:e+120,r,i),Hp(e,r,i),Hp(e<120?e+240:e-120,r,i),this.opacity)},clamp(){return new Li(Ov(this.h),Mu(this.s),Mu(this.l),Su(this.opacity))},displayable(){return(0<=this.s&&this.s<=1||isNaN(this.s))&&0<=this.l&&this.l<=1&&0<=this.opacity&&this.opacity<=1},formatHsl(){let e=Su(this.opacity);return`${e===1?"hsl(":"hsla("}${Ov(this.h)}, ${Mu(this.s)*100}%, ${Mu(this.l)*100}%${e===1?")":`, ${e})`}`}}));function Ov(e){return e=(e||0)%360,e<0?e+360:e}function Mu(e){return Math.max(0,Math.min(1,e||0))}function Hp(e,t,n){return(e<60?t+(n-t)*e/60:e<180?n:e<240?t+(n-t)*(240-e)/60:t)*255}var Vv=Math.PI/180,Hv=180/Math.PI,wu=18,Wv=.96422,$v=1,Xv=.82521,qv=4/29,Ho=6/29,Yv=3*Ho*Ho,xR=Ho*Ho*Ho;function Zv(e){if(e instanceof Ji)return new Ji(e.l,e.a,e.b,e.opacity);if(e instanceof Sr)return Jv(e);e instanceof je||(e=Yp(e));var t=qp(e.r),n=qp(e.g),i=qp(e.b),r=Wp((.2225045*t+.7168786*n+.0606169*i)/$v),s,o;return t===n&&n===i?s=o=r:(s=Wp((.4360747*t+.3850649*n+.1430804*i)/Wv),o=Wp((.0139322*t+.0971045*n+.7141733*i)/Xv)),new Ji(116*r-16,500*(s-r),200*(r-o),e.opacity)}function Au(e,t,n,i){return arguments.length===1?Zv(e):new Ji(e,t,n,i??1)}function Ji(e,t,n,i){this.l=+e,this.a=+t,this.b=+n,this.opacity=+i}$o(Ji,Au,bc(is,{brighter(e){return new Ji(this.l+wu*(e??1),this.a,this.b,this.opacity)},darker(e){return new Ji(this.l-wu*(e??1),this.a,this.b,this.opacity)},rgb(){var e=(this.l+16)/116,t=isNaN(this.a)?e:e+this.a/500,n=isNaN(this.b)?e:e-this.b/200;return t=Wv*$p(t),e=$v*$p(e),n=Xv*$p(n),new je(Xp(3.1338561*t-1.6168667*e-.4906146*n),Xp(-.9787684*t+1.9161415*e+.033454*n),Xp(.0719453*t-.2289914*e+1.4052427*n),this.opacity)}}));function Wp(e){return e>xR?Math.pow(e,1/3):e/Yv+qv}function $p(e){return e>Ho?e*e*e:Yv*(e-qv)}function Xp(e){return 255*(e<=.0031308?12.92*e:1.055*Math.pow(e,1/2.4)-.055)}function qp(e){return(e/=255)<=.04045?e/12.92:Math.pow((e+.055)/1.055,2.4)}function vR(e){if(e instanceof Sr)return new Sr(e.h,e.c,e.l,e.opacity);if(e instanceof Ji||(e=Zv(e)),e.a===0&&e.b===0)return new Sr(NaN,0<e.l&&e.l<100?0:NaN,e.l,e.opacity);var t=Math.atan2(e.b,e.a)*Hv;return new Sr(t<0?t+360:t,Math.sqrt(e.a*e.a+e.b*e.b),e.l,e.opacity)}function Eu(e,t,n,i){return arguments.length===1?vR(e):new Sr(e,t,n,i??1)}function Sr(e,t,n,i){this.h=+e,this.c=+t,this.l=+n,this.opacity=+i}function Jv(e){if(isNaN(e.h))return new Ji(e.l,0,0,e.opacity);var t=e.h*Vv;return new Ji(e.l,Math.cos(t)*e.c,Math.sin(t)*e.c,e.opacity)}$o(Sr,Eu,bc(is,{brighter(e){return new Sr(this.h,this.c,this.l+wu*(e??1),this.opacity)},darker(e){return new Sr(this.h,this.c,this.l-wu*(e??1),this.opacity)},rgb(){return Jv(this).rgb()}}));var Kv=-.14861,Zp=1.78277,Jp=-.29227,Cu=-.90649,vc=1.97294,Bv=vc*Cu,kv=vc*Zp,zv=Zp*Jp-Cu*Kv;function bR(e){if(e instanceof Ys)return new Ys(e.h,e.s,e.l,e.opacity);e instanceof je||(e=Yp(e));var t=e.r/255,n=e.g/255,i=e.b/255,r=(zv*i+Bv*t-kv*n)/(zv+Bv-kv),s=i-r,o=(vc*(n-r)-Jp*s)/Cu,a=Math.sqrt(o*o+s*s)/(vc*r*(1-r)),c=a?Math.atan2(o,s)*Hv-120:NaN;return new Ys(c<0?c+360:c,a,r,e.opacity)}function hi(e,t,n,i){return arguments.length===1?bR(e):new Ys(e,t,n,i??1)}function Ys(e,t,n,i){this.h=+e,this.s=+t,this.l=+n,this.opacity=+i}$o(Ys,hi,bc(is,{brighter(e){return e=e==null?Wo:Math.pow(Wo,e),new Ys(this.h,this.s,this.l*e,this.opacity)},darker(e){return e=e==null?Zs:Math.pow(Zs,e),new Ys(this.h,this.s,this.l*e,this.opacity)},rgb(){var e=isNaN(this.h)?0:(this.h+120)*Vv,t=+this.l,n=isNaN(this.s)?0:this.s*t*(1-t),i=Math.cos(e),r=Math.sin(e);return new je(255*(t+n*(Kv*i+Zp*r)),255*(t+n*(Jp*i+Cu*r)),255*(t+n*(vc*i)),this.opacity)}}));function tb(e,t,n,i,r){var s=e*e,o=s*e;return((1-3*e+3*s-o)*t+(4-6*s+3*o)*n+(1+3*e+3*s-3*o)*i+o*r)/6}function MR(e){var t=e.length-1;return function(n){var i=n<=0?n=0:n>=1?(n=1,t-1):Math.floor(n*t),r=e[i],s=e[i+1],o=i>0?e[i-1]:2*r-s,a=i<t-1?e[i+2]:2*s-r;return tb((n-i/t)*t,o,r,s,a)}}function SR(e){var t=e.length;return function(n){var i=Math.floor(((n%=1)<0?++n:n)*t),r=e[(i+t-1)%t],s=e[i%t],o=e[(i+1)%t],a=e[(i+2)%t];return tb((n-i/t)*t,r,s,o,a)}}var Pu=e=>()=>e;function eb(e,t){return function(n){return e+n*t}}function wR(e,t,n){return e=Math.pow(e,n),t=Math.pow(t,n)-e,n=1/n,function(i){return Math.pow(e+i*t,n)}}function tm(e,t){var n=t-e;return n?eb(e,n>180||n<-180?n-360*Math.round(n/360):n):Pu(isNaN(e)?t:e)}function TR(e){return(e=+e)==1?Qe:function(t,n){return n-t?wR(t,n,e):Pu(isNaN(t)?n:t)}}function Qe(e,t){var n=t-e;return n?eb(e,n):Pu(isNaN(e)?t:e)}var Js=(function e(t){var n=TR(t);function i(r,s){var o=n((r=Ni(r)).r,(s=Ni(s)).r),a=n(r.g,s.g),c=n(r.b,s.b),l=Qe(r.opacity,s.opacity);return function(u){return r.r=o(u),r.g=a(u),r.b=c(u),r.opacity=l(u),r+""}}return i.gamma=e,i})(1);function nb(e){return function(t){var n=t.length,i=new Array(n),r=new Array(n),s=new Array(n),o,a;for(o=0;o<n;++o)a=Ni(t[o]),i[o]=a.r||0,r[o]=a.g||0,s[o]=a.b||0;return i=e(i),r=e(r),s=e(s),a.opacity=1,function(c){return a.r=i(c),a.g=r(c),a.b=s(c),a+""}}}var ib=nb(MR),z6=nb(SR);function AR(e,t){t||(t=[]);var n=e?Math.min(t.length,e.length):0,i=t.slice(),r;return function(s){for(r=0;r<n;++r)i[r]=e[r]*(1-s)+t[r]*s;return i}}function ER(e){return ArrayBuffer.isView(e)&&!(e instanceof DataView)}function CR(e,t){var n=t?t.length:0,i=e?Math.min(n,e.length):0,r=new Array(i),s=new Array(n),o;for(o=0;o<i;++o)r[o]=qo(e[o],t[o]);for(;o<n;++o)s[o]=t[o];return function(a){for(o=0;o<i;++o)s[o]=r[o](a);return s}}function RR(e,t){var n=new Date;return e=+e,t=+t,function(i){return n.setTime(e*(1-i)+t*i),n}}function Ve(e,t){return e=+e,t=+t,function(n){return e*(1-n)+t*n}}function PR(e,t){var n={},i={},r;(e===null||typeof e!="object")&&(e={}),(t===null||typeof t!="object")&&(t={});for(r in t)r in e?n[r]=qo(e[r],t[r]):i[r]=t[r];return function(s){for(r in n)i[r]=n[r](s);return i}}var jp=/[-+]?(?:\d+\.?\d*|\.?\d+)(?:[eE][-+]?\d+)?/g,Kp=new RegExp(jp.source,"g");function IR(e){return function(){return e}}function LR(e){return function(t){return e(t)+""}}function NR(e,t){var n=jp.lastIndex=Kp.lastIndex=0,i,r,s,o=-1,a=[],c=[];for(e=e+"",t=t+"";(i=jp.exec(e))&&(r=Kp.exec(t));)(s=r.index)>n&&(s=t.slice(n,s),a[o]?a[o]+=s:a[++o]=s),(i=i[0])===(r=r[0])?a[o]?a[o]+=r:a[++o]=r:(a[++o]=null,c.push({i:o,x:Ve(i,r)})),n=Kp.lastIndex;return n<t.length&&(s=t.slice(n),a[o]?a[o]+=s:a[++o]=s),a.length<2?c[0]?LR(c[0].x):IR(t):(t=c.length,function(l){for(var u=0,h;u<t;++u)a[(h=c[u]).i]=h.x(l);return a.join("")})}function qo(e,t){var n=typeof t,i;return t==null||n==="boolean"?Pu(t):(n==="number"?Ve:n==="string"?(i=Xo(t))?(t=i,Js):NR:t instanceof Xo?Js:t instanceof Date?RR:ER(t)?AR:Array.isArray(t)?CR:typeof t.valueOf!="function"&&typeof t.toString!="function"||isNaN(t)?PR:Ve)(e,t)}function Mc(e,t){return e=+e,t=+t,function(n){return Math.round(e*(1-n)+t*n)}}var jv=180/Math.PI,Qp={translateX:0,translateY:0,rotate:0,skewX:0,scaleX:1,scaleY:1};function rb(e,t,n,i,r,s){var o,a,c;return(o=Math.sqrt(e*e+t*t))&&(e/=o,t/=o),(c=e*n+t*i)&&(n-=e*c,i-=t*c),(a=Math.sqrt(n*n+i*i))&&(n/=a,i/=a,c/=a),e*i<t*n&&(e=-e,t=-t,c=-c,o=-o),{translateX:r,translateY:s,rotate:Math.atan2(t,e)*jv,skewX:Math.atan(c)*jv,scaleX:o,scaleY:a}}var Ru;function DR(e){let t=new(typeof DOMMatrix=="function"?DOMMatrix:WebKitCSSMatrix)(e+"");return t.isIdentity?Qp:rb(t.a,t.b,t.c,t.d,t.e,t.f)}function UR(e){return e==null||(Ru||(Ru=document.createElementNS("http://www.w3.org/2000/svg","g")),Ru.setAttribute("transform",e),!(e=Ru.transform.baseVal.consolidate()))?Qp:(e=e.matrix,rb(e.a,e.b,e.c,e.d,e.e,e.f))}function sb(e,t,n,i){function r(l){return l.length?l.pop()+" ":""}function s(l,u,h,f,d,p){if(l!==h||u!==f){var y=d.push("translate(",null,t,null,n);p.push({i:y-4,x:Ve(l,h)},{i:y-2,x:Ve(u,f)})}else(h||f)&&d.push("translate("+h+t+f+n)}function o(l,u,h,f){l!==u?(l-u>180?u+=360:u-l>180&&(l+=360),f.push({i:h.push(r(h)+"rotate(",null,i)-2,x:Ve(l,u)})):u&&h.push(r(h)+"rotate("+u+i)}function a(l,u,h,f){l!==u?f.push({i:h.push(r(h)+"skewX(",null,i)-2,x:Ve(l,u)}):u&&h.push(r(h)+"skewX("+u+i)}function c(l,u,h,f,d,p){if(l!==h||u!==f){var y=d.push(r(d)+"scale(",null,",",null,")");p.push({i:y-4,x:Ve(l,h)},{i:y-2,x:Ve(u,f)})}else(h!==1||f!==1)&&d.push(r(d)+"scale("+h+","+f+")")}return function(l,u){var h=[],f=[];return l=e(l),u=e(u),s(l.translateX,l.translateY,u.translateX,u.translateY,h,f),o(l.rotate,u.rotate,h,f),a(l.skewX,u.skewX,h,f),c(l.scaleX,l.scaleY,u.scaleX,u.scaleY,h,f),l=u=null,function(d){for(var p=-1,y=f.length,m;++p<y;)h[(m=f[p]).i]=m.x(d);return h.join("")}}}var G6=sb(DR,"px, ","px)","deg)"),V6=sb(UR,", ",")",")"),FR=1e-12;function Qv(e){return((e=Math.exp(e))+1/e)/2}function OR(e){return((e=Math.exp(e))-1/e)/2}function BR(e){return((e=Math.exp(2*e))-1)/(e+1)}var H6=(function e(t,n,i){function r(s,o){var a=s[0],c=s[1],l=s[2],u=o[0],h=o[1],f=o[2],d=u-a,p=h-c,y=d*d+p*p,m,g;if(y<FR)g=Math.log(f/l)/t,m=function(_){return[a+_*d,c+_*p,l*Math.exp(t*_*g)]};else{var x=Math.sqrt(y),S=(f*f-l*l+i*y)/(2*l*n*x),v=(f*f-l*l-i*y)/(2*f*n*x),w=Math.log(Math.sqrt(S*S+1)-S),b=Math.log(Math.sqrt(v*v+1)-v);g=(b-w)/t,m=function(_){var M=_*g,C=Qv(w),E=l/(n*x)*(C*BR(t*M+w)-OR(w));return[a+E*d,c+E*p,l*C/Qv(t*M+w)]}}return m.duration=Math.abs(g)*1e3*t/Math.SQRT2,m}return r.rho=function(s){var o=Math.max(.001,+s),a=o*o,c=a*a;return e(o,a,c)},r})(Math.SQRT2,2,4);function ob(e){return function(t,n){var i=e((t=Tu(t)).h,(n=Tu(n)).h),r=Qe(t.s,n.s),s=Qe(t.l,n.l),o=Qe(t.opacity,n.opacity);return function(a){return t.h=i(a),t.s=r(a),t.l=s(a),t.opacity=o(a),t+""}}}var ab=ob(tm),W6=ob(Qe);function cb(e,t){var n=Qe((e=Au(e)).l,(t=Au(t)).l),i=Qe(e.a,t.a),r=Qe(e.b,t.b),s=Qe(e.opacity,t.opacity);return function(o){return e.l=n(o),e.a=i(o),e.b=r(o),e.opacity=s(o),e+""}}function lb(e){return function(t,n){var i=e((t=Eu(t)).h,(n=Eu(n)).h),r=Qe(t.c,n.c),s=Qe(t.l,n.l),o=Qe(t.opacity,n.opacity);return function(a){return t.h=i(a),t.c=r(a),t.l=s(a),t.opacity=o(a),t+""}}}var ub=lb(tm),$6=lb(Qe);function fb(e){return(function t(n){n=+n;function i(r,s){var o=e((r=hi(r)).h,(s=hi(s)).h),a=Qe(r.s,s.s),c=Qe(r.l,s.l),l=Qe(r.opacity,s.opacity);return function(u){return r.h=o(u),r.s=a(u),r.l=c(Math.pow(u,n)),r.opacity=l(u),r+""}}return i.gamma=t,i})(1)}var X6=fb(tm),Iu=fb(Qe);function rs(e,t){t===void 0&&(t=e,e=qo);for(var n=0,i=t.length-1,r=t[0],s=new Array(i<0?0:i);n<i;)s[n]=e(r,r=t[++n]);return function(o){var a=Math.max(0,Math.min(i-1,Math.floor(o*=i)));return s[a](o-a)}}function En(e,t){for(var n=new Array(t),i=0;i<t;++i)n[i]=e(i/(t-1));return n}var Sc=Math.PI,em=2*Sc,Ks=1e-6,kR=em-Ks;function hb(e){this._+=e[0];for(let t=1,n=e.length;t<n;++t)this._+=arguments[t]+e[t]}function zR(e){let t=Math.floor(e);if(!(t>=0))throw new Error(`invalid digits: ${e}`);if(t>15)return hb;let n=10**t;return function(i){this._+=i[0];for(let r=1,s=i.length;r<s;++r)this._+=Math.round(arguments[r]*n)/n+i[r]}}function db(e,t,n,i){return e===n&&t===i}function GR(e){let t=Math.floor(e);if(!(t<=15))return db;let n=10**t,i=function(r){return Math.round(r*n)};return function(r,s,o,a){return i(r)===i(o)&&i(s)===i(a)}}var js=class{constructor(t){this._x0=this._y0=this._x1=this._y1=null,this._="",this._append=t==null?hb:zR(t),this._equal=t==null?db:GR(t)}moveTo(t,n){this._append`M${this._x0=this._x1=+t},${this._y0=this._y1=+n}`}closePath(){this._x1!==null&&(this._x1=this._x0,this._y1=this._y0,this._append`Z`)}lineTo(t,n){this._append`L${this._x1=+t},${this._y1=+n}`}quadraticCurveTo(t,n,i,r){this._append`Q${+t},${+n},${this._x1=+i},${this._y1=+r}`}bezierCurveTo(t,n,i,r,s,o){this._append`C${+t},${+n},${+i},${+r},${this._x1=+s},${this._y1=+o}`}arcTo(t,n,i,r,s){if(t=+t,n=+n,i=+i,r=+r,s=+s,s<0)throw new Error(`negative radius: ${s}`);let o=this._x1,a=this._y1,c=i-t,l=r-n,u=o-t,h=a-n,f=u*u+h*h;if(this._x1===null)this._append`M${this._x1=t},${this._y1=n}`;else if(f>Ks)if(!(Math.abs(h*c-l*u)>Ks)||!s)this._append`L${this._x1=t},${this._y1=n}`;else{let d=i-o,p=r-a,y=c*c+l*l,m=d*d+p*p,g=Math.sqrt(y),x=Math.sqrt(f),S=s*Math.tan((Sc-Math.acos((y+f-m)/(2*g*x)))/2),v=S/x,w=S/g;Math.abs(v-1)>Ks&&this._append`L${t+v*u},${n+v*h}`,this._append`A${s},${s},0,0,${+(h*d>u*p)},${this._x1=t+w*c},${this._y1=n+w*l}`}}arc(t,n,i,r,s,o){if(t=+t,n=+n,i=+i,o=!!o,i<0)throw new Error(`negative radius: ${i}`);let a=i*Math.cos(r),c=i*Math.sin(r),l=t+a,u=n+c,h=1^o,f=o?r-s:s-r;if(this._x1===null?this._append`M${l},${u}`:(Math.abs(this._x1-l)>Ks||Math.abs(this._y1-u)>Ks)&&this._append`L${l},${u}`,!!i){if(f<0&&(f=f%em+em),f>kR)this._append`A${i},${i},0,1,${h},${t-a},${n-c}A${i},${i},0,1,${h},${this._x1=l},${this._y1=u}`;else if(f>Ks){let d=t+i*Math.cos(s),p=n+i*Math.sin(s);if(f>=Sc&&this._equal(l,u,d,p)){f/=2;let y=r+f;this._append`A${i},${i},0,${+(f>=Sc)},${h},${t+i*Math.cos(y)},${n+i*Math.sin(y)}`}this._append`A${i},${i},0,${+(f>=Sc)},${h},${this._x1=d},${this._y1=p}`}}}rect(t,n,i,r){this._append`M${this._x0=this._x1=+t},${this._y0=this._y1=+n}h${i=+i}v${+r}h${-i}Z`}toString(){return this._}};function VR(){return new js}VR.prototype=js.prototype;function Ki(e=3){return new js(+e)}function HR(e){return Math.abs(e=Math.round(e))>=1e21?e.toLocaleString("en").replace(/,/g,""):e.toString(10)}function Nu(e,t){if(!isFinite(e)||e===0)return null;var n=(e=t?e.toExponential(t-1):e.toExponential()).indexOf("e"),i=e.slice(0,n);return[i.length>1?i[0]+i.slice(2):i,+e.slice(n+1)]}function Yo(e){return e=Nu(Math.abs(e)),e?e[1]:NaN}function WR(e,t){return function(n,i){for(var r=n.length,s=[],o=0,a=e[0],c=0;r>0&&a>0&&(c+a+1>i&&(a=Math.max(1,i-c)),s.push(n.substring(r-=a,r+a)),!((c+=a+1)>i));)a=e[o=(o+1)%e.length];return s.reverse().join(t)}}function $R(e){return function(t){return t.replace(/[0-9]/g,function(n){return e[+n]})}}var XR=/^(?:(.)?([<>=^]))?([+\-( ])?([$#])?(0)?(\d+)?(,)?(\.\d+)?(~)?([a-z%])?$/i;function Zo(e){if(!(t=XR.exec(e)))throw new Error("invalid format: "+e);var t;return new nm({fill:t[1],align:t[2],sign:t[3],symbol:t[4],zero:t[5],width:t[6],comma:t[7],precision:t[8]&&t[8].slice(1),trim:t[9],type:t[10]})}Zo.prototype=nm.prototype;function nm(e){this.fill=e.fill===void 0?" ":e.fill+"",this.align=e.align===void 0?">":e.align+"",this.sign=e.sign===void 0?"-":e.sign+"",this.symbol=e.symbol===void 0?"":e.symbol+"",this.zero=!!e.zero,this.width=e.width===void 0?void 0:+e.width,this.comma=!!e.comma,this.precision=e.precision===void 0?void 0:+e.precision,this.trim=!!e.trim,this.type=e.type===void 0?"":e.type+""}nm.prototype.toString=function(){return this.fill+this.align+this.sign+this.symbol+(this.zero?"0":"")+(this.width===void 0?"":Math.max(1,this.width|0))+(this.comma?",":"")+(this.precision===void 0?"":"."+Math.max(0,this.precision|0))+(this.trim?"~":"")+this.type};function qR(e){t:for(var t=e.length,n=1,i=-1,r;n<t;++n)switch(e[n]){case".":i=r=n;break;case"0":i===0&&(i=n),r=n;break;default:if(!+e[n])break t;i>0&&(i=0);break}return i>0?e.slice(0,i)+e.slice(r+1):e}var Du;function YR(e,t){var n=Nu(e,t);if(!n)return Du=void 0,e.toPrecision(t);var i=n[0],r=n[1],s=r-(Du=Math.max(-8,Math.min(8,Math.floor(r/3)))*3)+1,o=i.length;return s===o?i:s>o?i+new Array(s-o+1).join("0"):s>0?i.slice(0,s)+"."+i.slice(s):"0."+new Array(1-s).join("0")+Nu(e,Math.max(0,t+s-1))[0]}function pb(e,t){var n=Nu(e,t);if(!n)return e+"";var i=n[0],r=n[1];return r<0?"0."+new Array(-r).join("0")+i:i.length>r+1?i.slice(0,r+1)+"."+i.slice(r+1):i+new Array(r-i.length+2).join("0")}var mb={"%":(e,t)=>(e*100).toFixed(t),b:e=>Math.round(e).toString(2),c:e=>e+"",d:HR,e:(e,t)=>e.toExponential(t),f:(e,t)=>e.toFixed(t),g:(e,t)=>e.toPrecision(t),o:e=>Math.round(e).toString(8),p:(e,t)=>pb(e*100,t),r:pb,s:YR,X:e=>Math.round(e).toString(16).toUpperCase(),x:e=>Math.round(e).toString(16)};function gb(e){return e}var yb=Array.prototype.map,_b=["y","z","a","f","p","n","\xB5","m","","k","M","G","T","P","E","Z","Y"];function ZR(e){var t=e.grouping===void 0||e.thousands===void 0?gb:WR(yb.call(e.grouping,Number),e.thousands+""),n=e.currency===void 0?"":e.currency[0]+"",i=e.currency===void 0?"":e.currency[1]+"",r=e.decimal===void 0?".":e.decimal+"",s=e.numerals===void 0?gb:$R(yb.call(e.numerals,String)),o=e.percent===void 0?"%":e.percent+"",a=e.minus===void 0?"\u2212":e.minus+"",c=e.nan===void 0?"NaN":e.nan+"";function l(h,f){h=Zo(h);var d=h.fill,p=h.align,y=h.sign,m=h.symbol,g=h.zero,x=h.width,S=h.comma,v=h.precision,w=h.trim,b=h.type;b==="n"?(S=!0,b="g"):mb[b]||(v===void 0&&(v=12),w=!0,b="g"),(g||d==="0"&&p==="=")&&(g=!0,d="0",p="=");var _=(f&&f.prefix!==void 0?f.prefix:"")+(m==="$"?n:m==="#"&&/[boxX]/.test(b)?"0"+b.toLowerCase():""),M=(m==="$"?i:/[%p]/.test(b)?o:"")+(f&&f.suffix!==void 0?f.suffix:""),C=mb[b],E=/[defgprs%]/.test(b);v=v===void 0?6:/[gprs]/.test(b)?Math.max(1,Math.min(21,v)):Math.max(0,Math.min(20,v));function I(R){var U=_,P=M,L,O,D;if(b==="c")P=C(R)+P,R="";else{R=+R;var Y=R<0||1/R<0;if(R=isNaN(R)?c:C(Math.abs(R),v),w&&(R=qR(R)),Y&&+R==0&&y!=="+"&&(Y=!1),U=(Y?y==="("?y:a:y==="-"||y==="("?"":y)+U,P=(b==="s"&&!isNaN(R)&&Du!==void 0?_b[8+Du/3]:"")+P+(Y&&y==="("?")":""),E){for(L=-1,O=R.length;++L<O;)if(D=R.charCodeAt(L),48>D||D>57){P=(D===46?r+R.slice(L+1):R.slice(L))+P,R=R.slice(0,L);break}}}S&&!g&&(R=t(R,1/0));var B=U.length+R.length+P.length,V=B<x?new Array(x-B+1).join(d):"";switch(S&&g&&(R=t(V+R,V.length?x-P.length:1/0),V=""),p){case"<":R=U+R+P+V;break;case"=":R=U+V+R+P;break;case"^":R=V.slice(0,B=V.length>>1)+U+R+P+V.slice(B);break;default:R=V+U+R+P;break}return s(R)}return I.toString=function(){return h+""},I}function u(h,f){var d=Math.max(-8,Math.min(8,Math.floor(Yo(f)/3)))*3,p=Math.pow(10,-d),y=l((h=Zo(h),h.type="f",h),{suffix:_b[8+d/3]});return function(m){return y(p*m)}}return{format:l,formatPrefix:u}}var Lu,ji,im;JR({thousands:",",grouping:[3],currency:["$",""]});function JR(e){return Lu=ZR(e),ji=Lu.format,im=Lu.formatPrefix,Lu}function xb(e){return Math.max(0,-Yo(Math.abs(e)))}function vb(e,t){return Math.max(0,Math.max(-8,Math.min(8,Math.floor(Yo(t)/3)))*3-Yo(Math.abs(e)))}function bb(e,t){return e=Math.abs(e),t=Math.abs(t)-e,Math.max(0,Yo(t)-Yo(e))+1}var Xt=1e-6,zb=1e-12,te=Math.PI,Pe=te/2,Mb=te/4,Xn=te*2,Cn=180/te,Re=te/180,he=Math.abs,Qo=Math.atan,Tr=Math.atan2,Qt=Math.cos;var Gb=Math.exp;var Gu=Math.log,rm=Math.pow,qt=Math.sin,pi=Math.sign||function(e){return e>0?1:e<0?-1:0},On=Math.sqrt,wm=Math.tan;function Vb(e){return e>1?0:e<-1?te:Math.acos(e)}function gi(e){return e>1?Pe:e<-1?-Pe:Math.asin(e)}function mi(){}function Vu(e,t){e&&wb.hasOwnProperty(e.type)&&wb[e.type](e,t)}var Sb={Feature:function(e,t){Vu(e.geometry,t)},FeatureCollection:function(e,t){for(var n=e.features,i=-1,r=n.length;++i<r;)Vu(n[i].geometry,t)}},wb={Sphere:function(e,t){t.sphere()},Point:function(e,t){e=e.coordinates,t.point(e[0],e[1],e[2])},MultiPoint:function(e,t){for(var n=e.coordinates,i=-1,r=n.length;++i<r;)e=n[i],t.point(e[0],e[1],e[2])},LineString:function(e,t){lm(e.coordinates,t,0)},MultiLineString:function(e,t){for(var n=e.coordinates,i=-1,r=n.length;++i<r;)lm(n[i],t,0)},Polygon:function(e,t){Tb(e.coordinates,t)},MultiPolygon:function(e,t){for(var n=e.coordinates,i=-1,r=n.length;++i<r;)Tb(n[i],t)},GeometryCollection:function(e,t){for(var n=e.geometries,i=-1,r=n.length;++i<r;)Vu(n[i],t)}};function lm(e,t,n){var i=-1,r=e.length-n,s;for(t.lineStart();++i<r;)s=e[i],t.point(s[0],s[1],s[2]);t.lineEnd()}function Tb(e,t){var n=-1,i=e.length;for(t.polygonStart();++n<i;)lm(e[n],t,1);t.polygonEnd()}function ss(e,t){e&&Sb.hasOwnProperty(e.type)?Sb[e.type](e,t):Vu(e,t)}var K6=new ci,j6=new ci;function um(e){return[Tr(e[1],e[0]),gi(e[2])]}function Ko(e){var t=e[0],n=e[1],i=Qt(n);return[i*Qt(t),i*qt(t),qt(n)]}function Uu(e,t){return e[0]*t[0]+e[1]*t[1]+e[2]*t[2]}function Hu(e,t){return[e[1]*t[2]-e[2]*t[1],e[2]*t[0]-e[0]*t[2],e[0]*t[1]-e[1]*t[0]]}function sm(e,t){e[0]+=t[0],e[1]+=t[1],e[2]+=t[2]}function Fu(e,t){return[e[0]*t,e[1]*t,e[2]*t]}function fm(e){var t=On(e[0]*e[0]+e[1]*e[1]+e[2]*e[2]);e[0]/=t,e[1]/=t,e[2]/=t}function hm(e,t){function n(i,r){return i=e(i,r),t(i[0],i[1])}return e.invert&&t.invert&&(n.invert=function(i,r){return i=t.invert(i,r),i&&e.invert(i[0],i[1])}),n}function dm(e,t){return he(e)>te&&(e-=Math.round(e/Xn)*Xn),[e,t]}dm.invert=dm;function Hb(e,t,n){return(e%=Xn)?t||n?hm(Eb(e),Cb(t,n)):Eb(e):t||n?Cb(t,n):dm}function Ab(e){return function(t,n){return t+=e,he(t)>te&&(t-=Math.round(t/Xn)*Xn),[t,n]}}function Eb(e){var t=Ab(e);return t.invert=Ab(-e),t}function Cb(e,t){var n=Qt(e),i=qt(e),r=Qt(t),s=qt(t);function o(a,c){var l=Qt(c),u=Qt(a)*l,h=qt(a)*l,f=qt(c),d=f*n+u*i;return[Tr(h*r-d*s,u*n-f*i),gi(d*r+h*s)]}return o.invert=function(a,c){var l=Qt(c),u=Qt(a)*l,h=qt(a)*l,f=qt(c),d=f*r-h*s;return[Tr(h*r+f*s,u*n+d*i),gi(d*n-u*i)]},o}function KR(e){e=Hb(e[0]*Re,e[1]*Re,e.length>2?e[2]*Re:0);function t(n){return n=e(n[0]*Re,n[1]*Re),n[0]*=Cn,n[1]*=Cn,n}return t.invert=function(n){return n=e.invert(n[0]*Re,n[1]*Re),n[0]*=Cn,n[1]*=Cn,n},t}function jR(e,t,n,i,r,s){if(n){var o=Qt(t),a=qt(t),c=i*n;r==null?(r=t+i*Xn,s=t-c/2):(r=Rb(o,r),s=Rb(o,s),(i>0?r<s:r>s)&&(r+=i*Xn));for(var l,u=r;i>0?u>s:u<s;u-=c)l=um([o,-a*Qt(u),-a*qt(u)]),e.point(l[0],l[1])}}function Rb(e,t){t=Ko(t),t[0]-=e,fm(t);var n=Vb(-t[1]);return((-t[2]<0?-n:n)+Xn-Xt)%Xn}function Wb(){var e=[],t;return{point:function(n,i,r){t.push([n,i,r])},lineStart:function(){e.push(t=[])},lineEnd:mi,rejoin:function(){e.length>1&&e.push(e.pop().concat(e.shift()))},result:function(){var n=e;return e=[],t=null,n}}}function zu(e,t){return he(e[0]-t[0])<Xt&&he(e[1]-t[1])<Xt}function Ou(e,t,n,i){this.x=e,this.z=t,this.o=n,this.e=i,this.v=!1,this.n=this.p=null}function $b(e,t,n,i,r){var s=[],o=[],a,c;if(e.forEach(function(p){if(!((y=p.length-1)<=0)){var y,m=p[0],g=p[y],x;if(zu(m,g)){if(!m[2]&&!g[2]){for(r.lineStart(),a=0;a<y;++a)r.point((m=p[a])[0],m[1]);r.lineEnd();return}g[0]+=2*Xt}s.push(x=new Ou(m,p,null,!0)),o.push(x.o=new Ou(m,null,x,!1)),s.push(x=new Ou(g,p,null,!1)),o.push(x.o=new Ou(g,null,x,!0))}}),!!s.length){for(o.sort(t),Pb(s),Pb(o),a=0,c=o.length;a<c;++a)o[a].e=n=!n;for(var l=s[0],u,h;;){for(var f=l,d=!0;f.v;)if((f=f.n)===l)return;u=f.z,r.lineStart();do{if(f.v=f.o.v=!0,f.e){if(d)for(a=0,c=u.length;a<c;++a)r.point((h=u[a])[0],h[1]);else i(f.x,f.n.x,1,r);f=f.n}else{if(d)for(u=f.p.z,a=u.length-1;a>=0;--a)r.point((h=u[a])[0],h[1]);else i(f.x,f.p.x,-1,r);f=f.p}f=f.o,u=f.z,d=!d}while(!f.v);r.lineEnd()}}}function Pb(e){if(t=e.length){for(var t,n=0,i=e[0],r;++n<t;)i.n=r=e[n],r.p=i,i=r;i.n=r=e[0],r.p=i}}function om(e){return he(e[0])<=te?e[0]:pi(e[0])*((he(e[0])+te)%Xn-te)}function QR(e,t){var n=om(t),i=t[1],r=qt(i),s=[qt(n),-Qt(n),0],o=0,a=0,c=new ci;r===1?i=Pe+Xt:r===-1&&(i=-Pe-Xt);for(var l=0,u=e.length;l<u;++l)if(f=(h=e[l]).length)for(var h,f,d=h[f-1],p=om(d),y=d[1]/2+Mb,m=qt(y),g=Qt(y),x=0;x<f;++x,p=v,m=b,g=_,d=S){var S=h[x],v=om(S),w=S[1]/2+Mb,b=qt(w),_=Qt(w),M=v-p,C=M>=0?1:-1,E=C*M,I=E>te,R=m*b;if(c.add(Tr(R*C*qt(E),g*_+R*Qt(E))),o+=I?M+C*Xn:M,I^p>=n^v>=n){var U=Hu(Ko(d),Ko(S));fm(U);var P=Hu(s,U);fm(P);var L=(I^M>=0?-1:1)*gi(P[2]);(i>L||i===L&&(U[0]||U[1]))&&(a+=I^M>=0?1:-1)}}return(o<-Xt||o<Xt&&c<-zb)^a&1}function Xb(e,t,n,i){return function(r){var s=t(r),o=Wb(),a=t(o),c=!1,l,u,h,f={point:d,lineStart:y,lineEnd:m,polygonStart:function(){f.point=g,f.lineStart=x,f.lineEnd=S,u=[],l=[]},polygonEnd:function(){f.point=d,f.lineStart=y,f.lineEnd=m,u=Fp(u);var v=QR(l,i);u.length?(c||(r.polygonStart(),c=!0),$b(u,eP,v,n,r)):v&&(c||(r.polygonStart(),c=!0),r.lineStart(),n(null,null,1,r),r.lineEnd()),c&&(r.polygonEnd(),c=!1),u=l=null},sphere:function(){r.polygonStart(),r.lineStart(),n(null,null,1,r),r.lineEnd(),r.polygonEnd()}};function d(v,w){e(v,w)&&r.point(v,w)}function p(v,w){s.point(v,w)}function y(){f.point=p,s.lineStart()}function m(){f.point=d,s.lineEnd()}function g(v,w){h.push([v,w]),a.point(v,w)}function x(){a.lineStart(),h=[]}function S(){g(h[0][0],h[0][1]),a.lineEnd();var v=a.clean(),w=o.result(),b,_=w.length,M,C,E;if(h.pop(),l.push(h),h=null,!!_){if(v&1){if(C=w[0],(M=C.length-1)>0){for(c||(r.polygonStart(),c=!0),r.lineStart(),b=0;b<M;++b)r.point((E=C[b])[0],E[1]);r.lineEnd()}return}_>1&&v&2&&w.push(w.pop().concat(w.shift())),u.push(w.filter(tP))}}return f}}function tP(e){return e.length>1}function eP(e,t){return((e=e.x)[0]<0?e[1]-Pe-Xt:Pe-e[1])-((t=t.x)[0]<0?t[1]-Pe-Xt:Pe-t[1])}var Ib=Xb(function(){return!0},nP,rP,[-te,-Pe]);function nP(e){var t=NaN,n=NaN,i=NaN,r;return{lineStart:function(){e.lineStart(),r=1},point:function(s,o){var a=s>0?te:-te,c=he(s-t);he(c-te)<Xt?(e.point(t,n=(n+o)/2>0?Pe:-Pe),e.point(i,n),e.lineEnd(),e.lineStart(),e.point(a,n),e.point(s,n),r=0):i!==a&&c>=te&&(he(t-i)<Xt&&(t-=i*Xt),he(s-a)<Xt&&(s-=a*Xt),n=iP(t,n,s,o),e.point(i,n),e.lineEnd(),e.lineStart(),e.point(a,n),r=0),e.point(t=s,n=o),i=a},lineEnd:function(){e.lineEnd(),t=n=NaN},clean:function(){return 2-r}}}function iP(e,t,n,i){var r,s,o=qt(e-n);return he(o)>Xt?Qo((qt(t)*(s=Qt(i))*qt(n)-qt(i)*(r=Qt(t))*qt(e))/(r*s*o)):(t+i)/2}function rP(e,t,n,i){var r;if(e==null)r=n*Pe,i.point(-te,r),i.point(0,r),i.point(te,r),i.point(te,0),i.point(te,-r),i.point(0,-r),i.point(-te,-r),i.point(-te,0),i.point(-te,r);else if(he(e[0]-t[0])>Xt){var s=e[0]<t[0]?te:-te;r=n*s/2,i.point(-s,r),i.point(0,r),i.point(s,r)}else i.point(t[0],t[1])}function sP(e){var t=Qt(e),n=2*Re,i=t>0,r=he(t)>Xt;function s(u,h,f,d){jR(d,e,n,f,u,h)}function o(u,h){return Qt(u)*Qt(h)>t}function a(u){var h,f,d,p,y;return{lineStart:function(){p=d=!1,y=1},point:function(m,g){var x=[m,g],S,v=o(m,g),w=i?v?0:l(m,g):v?l(m+(m<0?te:-te),g):0;if(!h&&(p=d=v)&&u.lineStart(),v!==d&&(S=c(h,x),(!S||zu(h,S)||zu(x,S))&&(x[2]=1)),v!==d)y=0,v?(u.lineStart(),S=c(x,h),u.point(S[0],S[1])):(S=c(h,x),u.point(S[0],S[1],2),u.lineEnd()),h=S;else if(r&&h&&i^v){var b;!(w&f)&&(b=c(x,h,!0))&&(y=0,i?(u.lineStart(),u.point(b[0][0],b[0][1]),u.point(b[1][0],b[1][1]),u.lineEnd()):(u.point(b[1][0],b[1][1]),u.lineEnd(),u.lineStart(),u.point(b[0][0],b[0][1],3)))}v&&(!h||!zu(h,x))&&u.point(x[0],x[1]),h=x,d=v,f=w},lineEnd:function(){d&&u.lineEnd(),h=null},clean:function(){return y|(p&&d)<<1}}}function c(u,h,f){var d=Ko(u),p=Ko(h),y=[1,0,0],m=Hu(d,p),g=Uu(m,m),x=m[0],S=g-x*x;if(!S)return!f&&u;var v=t*g/S,w=-t*x/S,b=Hu(y,m),_=Fu(y,v),M=Fu(m,w);sm(_,M);var C=b,E=Uu(_,C),I=Uu(C,C),R=E*E-I*(Uu(_,_)-1);if(!(R<0)){var U=On(R),P=Fu(C,(-E-U)/I);if(sm(P,_),P=um(P),!f)return P;var L=u[0],O=h[0],D=u[1],Y=h[1],B;O<L&&(B=L,L=O,O=B);var V=O-L,q=he(V-te)<Xt,rt=q||V<Xt;if(!q&&Y<D&&(B=D,D=Y,Y=B),rt?q?D+Y>0^P[1]<(he(P[0]-L)<Xt?D:Y):D<=P[1]&&P[1]<=Y:V>te^(L<=P[0]&&P[0]<=O)){var ct=Fu(C,(-E+U)/I);return sm(ct,_),[P,um(ct)]}}}function l(u,h){var f=i?e:te-e,d=0;return u<-f?d|=1:u>f&&(d|=2),h<-f?d|=4:h>f&&(d|=8),d}return Xb(o,a,s,i?[0,-e]:[-te,e-te])}function oP(e,t,n,i,r,s){var o=e[0],a=e[1],c=t[0],l=t[1],u=0,h=1,f=c-o,d=l-a,p;if(p=n-o,!(!f&&p>0)){if(p/=f,f<0){if(p<u)return;p<h&&(h=p)}else if(f>0){if(p>h)return;p>u&&(u=p)}if(p=r-o,!(!f&&p<0)){if(p/=f,f<0){if(p>h)return;p>u&&(u=p)}else if(f>0){if(p<u)return;p<h&&(h=p)}if(p=i-a,!(!d&&p>0)){if(p/=d,d<0){if(p<u)return;p<h&&(h=p)}else if(d>0){if(p>h)return;p>u&&(u=p)}if(p=s-a,!(!d&&p<0)){if(p/=d,d<0){if(p>h)return;p>u&&(u=p)}else if(d>0){if(p<u)return;p<h&&(h=p)}return u>0&&(e[0]=o+u*f,e[1]=a+u*d),h<1&&(t[0]=o+h*f,t[1]=a+h*d),!0}}}}}var wc=1e9,Bu=-wc;function Tm(e,t,n,i){function r(l,u){return e<=l&&l<=n&&t<=u&&u<=i}function s(l,u,h,f){var d=0,p=0;if(l==null||(d=o(l,h))!==(p=o(u,h))||c(l,u)<0^h>0)do f.point(d===0||d===3?e:n,d>1?i:t);while((d=(d+h+4)%4)!==p);else f.point(u[0],u[1])}function o(l,u){return he(l[0]-e)<Xt?u>0?0:3:he(l[0]-n)<Xt?u>0?2:1:he(l[1]-t)<Xt?u>0?1:0:u>0?3:2}function a(l,u){return c(l.x,u.x)}function c(l,u){var h=o(l,1),f=o(u,1);return h!==f?h-f:h===0?u[1]-l[1]:h===1?l[0]-u[0]:h===2?l[1]-u[1]:u[0]-l[0]}return function(l){var u=l,h=Wb(),f,d,p,y,m,g,x,S,v,w,b,_={point:M,lineStart:R,lineEnd:U,polygonStart:E,polygonEnd:I};function M(L,O){r(L,O)&&u.point(L,O)}function C(){for(var L=0,O=0,D=d.length;O<D;++O)for(var Y=d[O],B=1,V=Y.length,q=Y[0],rt,ct,$=q[0],ot=q[1];B<V;++B)rt=$,ct=ot,q=Y[B],$=q[0],ot=q[1],ct<=i?ot>i&&($-rt)*(i-ct)>(ot-ct)*(e-rt)&&++L:ot<=i&&($-rt)*(i-ct)<(ot-ct)*(e-rt)&&--L;return L}function E(){u=h,f=[],d=[],b=!0}function I(){var L=C(),O=b&&L,D=(f=Fp(f)).length;(O||D)&&(l.polygonStart(),O&&(l.lineStart(),s(null,null,1,l),l.lineEnd()),D&&$b(f,a,L,s,l),l.polygonEnd()),u=l,f=d=p=null}function R(){_.point=P,d&&d.push(p=[]),w=!0,v=!1,x=S=NaN}function U(){f&&(P(y,m),g&&v&&h.rejoin(),f.push(h.result())),_.point=M,v&&u.lineEnd()}function P(L,O){var D=r(L,O);if(d&&p.push([L,O]),w)y=L,m=O,g=D,w=!1,D&&(u.lineStart(),u.point(L,O));else if(D&&v)u.point(L,O);else{var Y=[x=Math.max(Bu,Math.min(wc,x)),S=Math.max(Bu,Math.min(wc,S))],B=[L=Math.max(Bu,Math.min(wc,L)),O=Math.max(Bu,Math.min(wc,O))];oP(Y,B,e,t,n,i)?(v||(u.lineStart(),u.point(Y[0],Y[1])),u.point(B[0],B[1]),D||u.lineEnd(),b=!1):D&&(u.lineStart(),u.point(L,O),b=!1)}x=L,S=O,v=D}return _}}var pm=e=>e,am=new ci,mm=new ci,qb,Yb,gm,ym,wr={point:mi,lineStart:mi,lineEnd:mi,polygonStart:function(){wr.lineStart=aP,wr.lineEnd=lP},polygonEnd:function(){wr.lineStart=wr.lineEnd=wr.point=mi,am.add(he(mm)),mm=new ci},result:function(){var e=am/2;return am=new ci,e}};function aP(){wr.point=cP}function cP(e,t){wr.point=Zb,qb=gm=e,Yb=ym=t}function Zb(e,t){mm.add(ym*e-gm*t),gm=e,ym=t}function lP(){Zb(qb,Yb)}var jo=1/0,Wu=jo,Nc=-jo,$u=Nc,Xu={point:uP,lineStart:mi,lineEnd:mi,polygonStart:mi,polygonEnd:mi,result:function(){var e=[[jo,Wu],[Nc,$u]];return Nc=$u=-(Wu=jo=1/0),e}};function uP(e,t){e<jo&&(jo=e),e>Nc&&(Nc=e),t<Wu&&(Wu=t),t>$u&&($u=t)}var _m=0,xm=0,Tc=0,qu=0,Yu=0,Jo=0,vm=0,bm=0,Ac=0,Jb,Kb,Qi,tr,di={point:Qs,lineStart:Lb,lineEnd:Nb,polygonStart:function(){di.lineStart=dP,di.lineEnd=pP},polygonEnd:function(){di.point=Qs,di.lineStart=Lb,di.lineEnd=Nb},result:function(){var e=Ac?[vm/Ac,bm/Ac]:Jo?[qu/Jo,Yu/Jo]:Tc?[_m/Tc,xm/Tc]:[NaN,NaN];return _m=xm=Tc=qu=Yu=Jo=vm=bm=Ac=0,e}};function Qs(e,t){_m+=e,xm+=t,++Tc}function Lb(){di.point=fP}function fP(e,t){di.point=hP,Qs(Qi=e,tr=t)}function hP(e,t){var n=e-Qi,i=t-tr,r=On(n*n+i*i);qu+=r*(Qi+e)/2,Yu+=r*(tr+t)/2,Jo+=r,Qs(Qi=e,tr=t)}function Nb(){di.point=Qs}function dP(){di.point=mP}function pP(){jb(Jb,Kb)}function mP(e,t){di.point=jb,Qs(Jb=Qi=e,Kb=tr=t)}function jb(e,t){var n=e-Qi,i=t-tr,r=On(n*n+i*i);qu+=r*(Qi+e)/2,Yu+=r*(tr+t)/2,Jo+=r,r=tr*e-Qi*t,vm+=r*(Qi+e),bm+=r*(tr+t),Ac+=r*3,Qs(Qi=e,tr=t)}function Qb(e){this._context=e}Qb.prototype={_radius:4.5,pointRadius:function(e){return this._radius=e,this},polygonStart:function(){this._line=0},polygonEnd:function(){this._line=NaN},lineStart:function(){this._point=0},lineEnd:function(){this._line===0&&this._context.closePath(),this._point=NaN},point:function(e,t){switch(this._point){case 0:{this._context.moveTo(e,t),this._point=1;break}case 1:{this._context.lineTo(e,t);break}default:{this._context.moveTo(e+this._radius,t),this._context.arc(e,t,this._radius,0,Xn);break}}},result:mi};var Mm=new ci,cm,t1,e1,Ec,Cc,Dc={point:mi,lineStart:function(){Dc.point=gP},lineEnd:function(){cm&&n1(t1,e1),Dc.point=mi},polygonStart:function(){cm=!0},polygonEnd:function(){cm=null},result:function(){var e=+Mm;return Mm=new ci,e}};function gP(e,t){Dc.point=n1,t1=Ec=e,e1=Cc=t}function n1(e,t){Ec-=e,Cc-=t,Mm.add(On(Ec*Ec+Cc*Cc)),Ec=e,Cc=t}var Db,Zu,Ub,Fb,Ju=class{constructor(t){this._append=t==null?i1:yP(t),this._radius=4.5,this._=""}pointRadius(t){return this._radius=+t,this}polygonStart(){this._line=0}polygonEnd(){this._line=NaN}lineStart(){this._point=0}lineEnd(){this._line===0&&(this._+="Z"),this._point=NaN}point(t,n){switch(this._point){case 0:{this._append`M${t},${n}`,this._point=1;break}case 1:{this._append`L${t},${n}`;break}default:{if(this._append`M${t},${n}`,this._radius!==Ub||this._append!==Zu){let i=this._radius,r=this._;this._="",this._append`m0,${i}a${i},${i} 0 1,1 0,${-2*i}a${i},${i} 0 1,1 0,${2*i}z`,Ub=i,Zu=this._append,Fb=this._,this._=r}this._+=Fb;break}}}result(){let t=this._;return this._="",t.length?t:null}};function i1(e){let t=1;this._+=e[0];for(let n=e.length;t<n;++t)this._+=arguments[t]+e[t]}function yP(e){let t=Math.floor(e);if(!(t>=0))throw new RangeError(`invalid digits: ${e}`);if(t>15)return i1;if(t!==Db){let n=10**t;Db=t,Zu=function(r){let s=1;this._+=r[0];for(let o=r.length;s<o;++s)this._+=Math.round(arguments[s]*n)/n+r[s]}}return Zu}function Fc(e,t){let n=3,i=4.5,r,s;function o(a){return a&&(typeof i=="function"&&s.pointRadius(+i.apply(this,arguments)),ss(a,r(s))),s.result()}return o.area=function(a){return ss(a,r(wr)),wr.result()},o.measure=function(a){return ss(a,r(Dc)),Dc.result()},o.bounds=function(a){return ss(a,r(Xu)),Xu.result()},o.centroid=function(a){return ss(a,r(di)),di.result()},o.projection=function(a){return arguments.length?(r=a==null?(e=null,pm):(e=a).stream,o):e},o.context=function(a){return arguments.length?(s=a==null?(t=null,new Ju(n)):new Qb(t=a),typeof i!="function"&&s.pointRadius(i),o):t},o.pointRadius=function(a){return arguments.length?(i=typeof a=="function"?a:(s.pointRadius(+a),+a),o):i},o.digits=function(a){if(!arguments.length)return n;if(a==null)n=null;else{let c=Math.floor(a);if(!(c>=0))throw new RangeError(`invalid digits: ${a}`);n=c}return t===null&&(s=new Ju(n)),o},o.projection(e).digits(n).context(t)}function Oc(e){return{stream:Qu(e)}}function Qu(e){return function(t){var n=new Sm;for(var i in e)n[i]=e[i];return n.stream=t,n}}function Sm(){}Sm.prototype={constructor:Sm,point:function(e,t){this.stream.point(e,t)},sphere:function(){this.stream.sphere()},lineStart:function(){this.stream.lineStart()},lineEnd:function(){this.stream.lineEnd()},polygonStart:function(){this.stream.polygonStart()},polygonEnd:function(){this.stream.polygonEnd()}};function Am(e,t,n){var i=e.clipExtent&&e.clipExtent();return e.scale(150).translate([0,0]),i!=null&&e.clipExtent(null),ss(n,e.stream(Xu)),t(Xu.result()),i!=null&&e.clipExtent(i),e}function Em(e,t,n){return Am(e,function(i){var r=t[1][0]-t[0][0],s=t[1][1]-t[0][1],o=Math.min(r/(i[1][0]-i[0][0]),s/(i[1][1]-i[0][1])),a=+t[0][0]+(r-o*(i[1][0]+i[0][0]))/2,c=+t[0][1]+(s-o*(i[1][1]+i[0][1]))/2;e.scale(150*o).translate([a,c])},n)}function r1(e,t,n){return Em(e,[[0,0],t],n)}function s1(e,t,n){return Am(e,function(i){var r=+t,s=r/(i[1][0]-i[0][0]),o=(r-s*(i[1][0]+i[0][0]))/2,a=-s*i[0][1];e.scale(150*s).translate([o,a])},n)}function o1(e,t,n){return Am(e,function(i){var r=+t,s=r/(i[1][1]-i[0][1]),o=-s*i[0][0],a=(r-s*(i[1][1]+i[0][1]))/2;e.scale(150*s).translate([o,a])},n)}var Ob=16,_P=Qt(30*Re);function Bb(e,t){return+t?vP(e,t):xP(e)}function xP(e){return Qu({point:function(t,n){t=e(t,n),this.stream.point(t[0],t[1])}})}function vP(e,t){function n(i,r,s,o,a,c,l,u,h,f,d,p,y,m){var g=l-i,x=u-r,S=g*g+x*x;if(S>4*t&&y--){var v=o+f,w=a+d,b=c+p,_=On(v*v+w*w+b*b),M=gi(b/=_),C=he(he(b)-1)<Xt||he(s-h)<Xt?(s+h)/2:Tr(w,v),E=e(C,M),I=E[0],R=E[1],U=I-i,P=R-r,L=x*U-g*P;(L*L/S>t||he((g*U+x*P)/S-.5)>.3||o*f+a*d+c*p<_P)&&(n(i,r,s,o,a,c,I,R,C,v/=_,w/=_,b,y,m),m.point(I,R),n(I,R,C,v,w,b,l,u,h,f,d,p,y,m))}}return function(i){var r,s,o,a,c,l,u,h,f,d,p,y,m={point:g,lineStart:x,lineEnd:v,polygonStart:function(){i.polygonStart(),m.lineStart=w},polygonEnd:function(){i.polygonEnd(),m.lineStart=x}};function g(M,C){M=e(M,C),i.point(M[0],M[1])}function x(){h=NaN,m.point=S,i.lineStart()}function S(M,C){var E=Ko([M,C]),I=e(M,C);n(h,f,u,d,p,y,h=I[0],f=I[1],u=M,d=E[0],p=E[1],y=E[2],Ob,i),i.point(h,f)}function v(){m.point=g,i.lineEnd()}function w(){x(),m.point=b,m.lineEnd=_}function b(M,C){S(r=M,C),s=h,o=f,a=d,c=p,l=y,m.point=S}function _(){n(h,f,u,d,p,y,s,o,r,a,c,l,Ob,i),m.lineEnd=v,v()}return m}}var bP=Qu({point:function(e,t){this.stream.point(e*Re,t*Re)}});function MP(e){return Qu({point:function(t,n){var i=e(t,n);return this.stream.point(i[0],i[1])}})}function SP(e,t,n,i,r){function s(o,a){return o*=i,a*=r,[t+e*o,n-e*a]}return s.invert=function(o,a){return[(o-t)/e*i,(n-a)/e*r]},s}function kb(e,t,n,i,r,s){if(!s)return SP(e,t,n,i,r);var o=Qt(s),a=qt(s),c=o*e,l=a*e,u=o/e,h=a/e,f=(a*n-o*t)/e,d=(a*t+o*n)/e;function p(y,m){return y*=i,m*=r,[c*y-l*m+t,n-l*y-c*m]}return p.invert=function(y,m){return[i*(u*y-h*m+f),r*(d-h*y-u*m)]},p}function os(e){return a1(function(){return e})()}function a1(e){var t,n=150,i=480,r=250,s=0,o=0,a=0,c=0,l=0,u,h=0,f=1,d=1,p=null,y=Ib,m=null,g,x,S,v=pm,w=.5,b,_,M,C,E;function I(L){return M(L[0]*Re,L[1]*Re)}function R(L){return L=M.invert(L[0],L[1]),L&&[L[0]*Cn,L[1]*Cn]}I.stream=function(L){return C&&E===L?C:C=bP(MP(u)(y(b(v(E=L)))))},I.preclip=function(L){return arguments.length?(y=L,p=void 0,P()):y},I.postclip=function(L){return arguments.length?(v=L,m=g=x=S=null,P()):v},I.clipAngle=function(L){return arguments.length?(y=+L?sP(p=L*Re):(p=null,Ib),P()):p*Cn},I.clipExtent=function(L){return arguments.length?(v=L==null?(m=g=x=S=null,pm):Tm(m=+L[0][0],g=+L[0][1],x=+L[1][0],S=+L[1][1]),P()):m==null?null:[[m,g],[x,S]]},I.scale=function(L){return arguments.length?(n=+L,U()):n},I.translate=function(L){return arguments.length?(i=+L[0],r=+L[1],U()):[i,r]},I.center=function(L){return arguments.length?(s=L[0]%360*Re,o=L[1]%360*Re,U()):[s*Cn,o*Cn]},I.rotate=function(L){return arguments.length?(a=L[0]%360*Re,c=L[1]%360*Re,l=L.length>2?L[2]%360*Re:0,U()):[a*Cn,c*Cn,l*Cn]},I.angle=function(L){return arguments.length?(h=L%360*Re,U()):h*Cn},I.reflectX=function(L){return arguments.length?(f=L?-1:1,U()):f<0},I.reflectY=function(L){return arguments.length?(d=L?-1:1,U()):d<0},I.precision=function(L){return arguments.length?(b=Bb(_,w=L*L),P()):On(w)},I.fitExtent=function(L,O){return Em(I,L,O)},I.fitSize=function(L,O){return r1(I,L,O)},I.fitWidth=function(L,O){return s1(I,L,O)},I.fitHeight=function(L,O){return o1(I,L,O)};function U(){var L=kb(n,0,0,f,d,h).apply(null,t(s,o)),O=kb(n,i-L[0],r-L[1],f,d,h);return u=Hb(a,c,l),_=hm(t,O),M=hm(u,_),b=Bb(_,w),P()}function P(){return C=E=null,I}return function(){return t=e.apply(this,arguments),I.invert=t.invert&&R,U()}}function Cm(e){var t=0,n=te/3,i=a1(e),r=i(t,n);return r.parallels=function(s){return arguments.length?i(t=s[0]*Re,n=s[1]*Re):[t*Cn,n*Cn]},r}function wP(e){var t=Qt(e);function n(i,r){return[i*t,qt(r)/t]}return n.invert=function(i,r){return[i/t,gi(r*t)]},n}function TP(e,t){var n=qt(e),i=(n+qt(t))/2;if(he(i)<Xt)return wP(e);var r=1+n*(2*i-n),s=On(r)/i;function o(a,c){var l=On(r-2*i*qt(c))/i;return[l*qt(a*=i),s-l*Qt(a)]}return o.invert=function(a,c){var l=s-c,u=Tr(a,he(l))*pi(l);return l*i<0&&(u-=te*pi(a)*pi(l)),[u/i,gi((r-(a*a+l*l)*i*i)/(2*i))]},o}function Uc(){return Cm(TP).scale(155.424).center([0,33.6442])}function Rm(){return Uc().parallels([29.5,45.5]).scale(1070).translate([480,250]).rotate([96,0]).center([-.6,38.7])}function AP(e){var t=e.length;return{point:function(n,i){for(var r=-1;++r<t;)e[r].point(n,i)},sphere:function(){for(var n=-1;++n<t;)e[n].sphere()},lineStart:function(){for(var n=-1;++n<t;)e[n].lineStart()},lineEnd:function(){for(var n=-1;++n<t;)e[n].lineEnd()},polygonStart:function(){for(var n=-1;++n<t;)e[n].polygonStart()},polygonEnd:function(){for(var n=-1;++n<t;)e[n].polygonEnd()}}}function c1(){var e,t,n=Rm(),i,r=Uc().rotate([154,0]).center([-2,58.5]).parallels([55,65]),s,o=Uc().rotate([157,0]).center([-3,19.9]).parallels([8,18]),a,c,l={point:function(f,d){c=[f,d]}};function u(f){var d=f[0],p=f[1];return c=null,i.point(d,p),c||(s.point(d,p),c)||(a.point(d,p),c)}u.invert=function(f){var d=n.scale(),p=n.translate(),y=(f[0]-p[0])/d,m=(f[1]-p[1])/d;return(m>=.12&&m<.234&&y>=-.425&&y<-.214?r:m>=.166&&m<.234&&y>=-.214&&y<-.115?o:n).invert(f)},u.stream=function(f){return e&&t===f?e:e=AP([n.stream(t=f),r.stream(f),o.stream(f)])},u.precision=function(f){return arguments.length?(n.precision(f),r.precision(f),o.precision(f),h()):n.precision()},u.scale=function(f){return arguments.length?(n.scale(f),r.scale(f*.35),o.scale(f),u.translate(n.translate())):n.scale()},u.translate=function(f){if(!arguments.length)return n.translate();var d=n.scale(),p=+f[0],y=+f[1];return i=n.translate(f).clipExtent([[p-.455*d,y-.238*d],[p+.455*d,y+.238*d]]).stream(l),s=r.translate([p-.307*d,y+.201*d]).clipExtent([[p-.425*d+Xt,y+.12*d+Xt],[p-.214*d-Xt,y+.234*d-Xt]]).stream(l),a=o.translate([p-.205*d,y+.212*d]).clipExtent([[p-.214*d+Xt,y+.166*d+Xt],[p-.115*d-Xt,y+.234*d-Xt]]).stream(l),h()},u.fitExtent=function(f,d){return Em(u,f,d)},u.fitSize=function(f,d){return r1(u,f,d)},u.fitWidth=function(f,d){return s1(u,f,d)},u.fitHeight=function(f,d){return o1(u,f,d)};function h(){return e=t=null,u}return u.scale(1070)}function l1(e){return function(t,n){var i=Qt(t),r=Qt(n),s=e(i*r);return s===1/0?[2,0]:[s*r*qt(t),s*qt(n)]}}function Bc(e){return function(t,n){var i=On(t*t+n*n),r=e(i),s=qt(r),o=Qt(r);return[Tr(t*s,i*o),gi(i&&n*s/i)]}}var u1=l1(function(e){return On(2/(1+e))});u1.invert=Bc(function(e){return 2*gi(e/2)});function f1(){return os(u1).scale(124.75).clipAngle(180-.001)}var h1=l1(function(e){return(e=Vb(e))&&e/qt(e)});h1.invert=Bc(function(e){return e});function d1(){return os(h1).scale(79.4188).clipAngle(180-.001)}function tf(e,t){return[e,Gu(wm((Pe+t)/2))]}tf.invert=function(e,t){return[e,2*Qo(Gb(t))-Pe]};function p1(){return m1(tf).scale(961/Xn)}function m1(e){var t=os(e),n=t.center,i=t.scale,r=t.translate,s=t.clipExtent,o=null,a,c,l;t.scale=function(h){return arguments.length?(i(h),u()):i()},t.translate=function(h){return arguments.length?(r(h),u()):r()},t.center=function(h){return arguments.length?(n(h),u()):n()},t.clipExtent=function(h){return arguments.length?(h==null?o=a=c=l=null:(o=+h[0][0],a=+h[0][1],c=+h[1][0],l=+h[1][1]),u()):o==null?null:[[o,a],[c,l]]};function u(){var h=te*i(),f=t(KR(t.rotate()).invert([0,0]));return s(o==null?[[f[0]-h,f[1]-h],[f[0]+h,f[1]+h]]:e===tf?[[Math.max(f[0]-h,o),a],[Math.min(f[0]+h,c),l]]:[[o,Math.max(f[1]-h,a)],[c,Math.min(f[1]+h,l)]])}return u()}function ku(e){return wm((Pe+e)/2)}function EP(e,t){var n=Qt(e),i=e===t?qt(e):Gu(n/Qt(t))/Gu(ku(t)/ku(e)),r=n*rm(ku(e),i)/i;if(!i)return tf;function s(o,a){r>0?a<-Pe+Xt&&(a=-Pe+Xt):a>Pe-Xt&&(a=Pe-Xt);var c=r/rm(ku(a),i);return[c*qt(i*o),r-c*Qt(i*o)]}return s.invert=function(o,a){var c=r-a,l=pi(i)*On(o*o+c*c),u=Tr(o,he(c))*pi(c);return c*i<0&&(u-=te*pi(o)*pi(c)),[u/i,2*Qo(rm(r/l,1/i))-Pe]},s}function g1(){return Cm(EP).scale(109.5).parallels([30,30])}function Ku(e,t){return[e,t]}Ku.invert=Ku;function y1(){return os(Ku).scale(152.63)}function CP(e,t){var n=Qt(e),i=e===t?qt(e):(n-Qt(t))/(t-e),r=n/i+e;if(he(i)<Xt)return Ku;function s(o,a){var c=r-a,l=i*o;return[c*qt(l),r-c*Qt(l)]}return s.invert=function(o,a){var c=r-a,l=Tr(o,he(c))*pi(c);return c*i<0&&(l-=te*pi(o)*pi(c)),[l/i,r-pi(i)*On(o*o+c*c)]},s}function _1(){return Cm(CP).scale(131.154).center([0,13.9389])}var Rc=1.340264,Pc=-.081106,Ic=893e-6,Lc=.003796,ju=On(3)/2,RP=12;function x1(e,t){var n=gi(ju*qt(t)),i=n*n,r=i*i*i;return[e*Qt(n)/(ju*(Rc+3*Pc*i+r*(7*Ic+9*Lc*i))),n*(Rc+Pc*i+r*(Ic+Lc*i))]}x1.invert=function(e,t){for(var n=t,i=n*n,r=i*i*i,s=0,o,a,c;s<RP&&(a=n*(Rc+Pc*i+r*(Ic+Lc*i))-t,c=Rc+3*Pc*i+r*(7*Ic+9*Lc*i),n-=o=a/c,i=n*n,r=i*i*i,!(he(o)<zb));++s);return[ju*e*(Rc+3*Pc*i+r*(7*Ic+9*Lc*i))/Qt(n),gi(qt(n)/ju)]};function v1(){return os(x1).scale(177.158)}function b1(e,t){var n=Qt(t),i=Qt(e)*n;return[n*qt(e)/i,qt(t)/i]}b1.invert=Bc(Qo);function M1(){return os(b1).scale(144.049).clipAngle(60)}function PP(e,t){var n=t*t,i=n*n;return[e*(.8707-.131979*n+i*(-.013791+i*(.003971*n-.001529*i))),t*(1.007226+n*(.015085+i*(-.044475+.028874*n-.005916*i)))]}PP.invert=function(e,t){var n=t,i=25,r;do{var s=n*n,o=s*s;n-=r=(n*(1.007226+s*(.015085+o*(-.044475+.028874*s-.005916*o)))-t)/(1.007226+s*(.015085*3+o*(-.044475*7+.028874*9*s-.005916*11*o)))}while(he(r)>Xt&&--i>0);return[e/(.8707+(s=n*n)*(-.131979+s*(-.013791+s*s*s*(.003971-.001529*s)))),n]};function S1(e,t){return[Qt(t)*qt(e),qt(t)]}S1.invert=Bc(gi);function w1(){return os(S1).scale(249.5).clipAngle(90+Xt)}function T1(e,t){var n=Qt(t),i=1+Qt(e)*n;return[n*qt(e)/i,qt(t)/i]}T1.invert=Bc(function(e){return 2*Qo(e)});function A1(){return os(T1).scale(250).clipAngle(142)}function E1(e,t){return[Gu(wm((Pe+t)/2)),-e]}E1.invert=function(e,t){return[-t,2*Qo(Gb(e))-Pe]};function C1(){var e=m1(E1),t=e.center,n=e.rotate;return e.center=function(i){return arguments.length?t([-i[1],i[0]]):(i=t(),[i[1],-i[0]])},e.rotate=function(i){return arguments.length?n([i[0],i[1],i.length>2?i[2]+90:90]):(i=n(),[i[0],i[1],i[2]-90])},n([0,0,90]).scale(159.155)}var Pm=new Date,Im=new Date;function He(e,t,n,i){function r(s){return e(s=arguments.length===0?new Date:new Date(+s)),s}return r.floor=s=>(e(s=new Date(+s)),s),r.ceil=s=>(e(s=new Date(s-1)),t(s,1),e(s),s),r.round=s=>{let o=r(s),a=r.ceil(s);return s-o<a-s?o:a},r.offset=(s,o)=>(t(s=new Date(+s),o==null?1:Math.floor(o)),s),r.range=(s,o,a)=>{let c=[];if(s=r.ceil(s),a=a==null?1:Math.floor(a),!(s<o)||!(a>0))return c;let l;do c.push(l=new Date(+s)),t(s,a),e(s);while(l<s&&s<o);return c},r.filter=s=>He(o=>{if(o>=o)for(;e(o),!s(o);)o.setTime(o-1)},(o,a)=>{if(o>=o)if(a<0)for(;++a<=0;)for(;t(o,-1),!s(o););else for(;--a>=0;)for(;t(o,1),!s(o););}),n&&(r.count=(s,o)=>(Pm.setTime(+s),Im.setTime(+o),e(Pm),e(Im),Math.floor(n(Pm,Im))),r.every=s=>(s=Math.floor(s),!isFinite(s)||!(s>0)?null:s>1?r.filter(i?o=>i(o)%s===0:o=>r.count(0,o)%s===0):r)),r}var ef=He(()=>{},(e,t)=>{e.setTime(+e+t)},(e,t)=>t-e);ef.every=e=>(e=Math.floor(e),!isFinite(e)||!(e>0)?null:e>1?He(t=>{t.setTime(Math.floor(t/e)*e)},(t,n)=>{t.setTime(+t+n*e)},(t,n)=>(n-t)/e):ef);var e8=ef.range,Ar=1e3,yi=Ar*60,Er=yi*60,Cr=Er*24,Nm=Cr*7,R1=Cr*30,Lm=Cr*365,Rn=He(e=>{e.setTime(e-e.getMilliseconds())},(e,t)=>{e.setTime(+e+t*Ar)},(e,t)=>(t-e)/Ar,e=>e.getUTCSeconds()),n8=Rn.range,to=He(e=>{e.setTime(e-e.getMilliseconds()-e.getSeconds()*Ar)},(e,t)=>{e.setTime(+e+t*yi)},(e,t)=>(t-e)/yi,e=>e.getMinutes()),i8=to.range,eo=He(e=>{e.setUTCSeconds(0,0)},(e,t)=>{e.setTime(+e+t*yi)},(e,t)=>(t-e)/yi,e=>e.getUTCMinutes()),r8=eo.range,no=He(e=>{e.setTime(e-e.getMilliseconds()-e.getSeconds()*Ar-e.getMinutes()*yi)},(e,t)=>{e.setTime(+e+t*Er)},(e,t)=>(t-e)/Er,e=>e.getHours()),s8=no.range,io=He(e=>{e.setUTCMinutes(0,0,0)},(e,t)=>{e.setTime(+e+t*Er)},(e,t)=>(t-e)/Er,e=>e.getUTCHours()),o8=io.range,er=He(e=>e.setHours(0,0,0,0),(e,t)=>e.setDate(e.getDate()+t),(e,t)=>(t-e-(t.getTimezoneOffset()-e.getTimezoneOffset())*yi)/Cr,e=>e.getDate()-1),a8=er.range,ta=He(e=>{e.setUTCHours(0,0,0,0)},(e,t)=>{e.setUTCDate(e.getUTCDate()+t)},(e,t)=>(t-e)/Cr,e=>e.getUTCDate()-1),c8=ta.range,kc=He(e=>{e.setUTCHours(0,0,0,0)},(e,t)=>{e.setUTCDate(e.getUTCDate()+t)},(e,t)=>(t-e)/Cr,e=>Math.floor(e/Cr)),l8=kc.range;function ro(e){return He(t=>{t.setDate(t.getDate()-(t.getDay()+7-e)%7),t.setHours(0,0,0,0)},(t,n)=>{t.setDate(t.getDate()+n*7)},(t,n)=>(n-t-(n.getTimezoneOffset()-t.getTimezoneOffset())*yi)/Nm)}var nr=ro(0),so=ro(1),Dm=ro(2),Um=ro(3),Rr=ro(4),Fm=ro(5),Om=ro(6),u8=nr.range,f8=so.range,h8=Dm.range,d8=Um.range,p8=Rr.range,m8=Fm.range,g8=Om.range;function oo(e){return He(t=>{t.setUTCDate(t.getUTCDate()-(t.getUTCDay()+7-e)%7),t.setUTCHours(0,0,0,0)},(t,n)=>{t.setUTCDate(t.getUTCDate()+n*7)},(t,n)=>(n-t)/Nm)}var ir=oo(0),ao=oo(1),Bm=oo(2),km=oo(3),Pr=oo(4),zm=oo(5),Gm=oo(6),y8=ir.range,_8=ao.range,x8=Bm.range,v8=km.range,b8=Pr.range,M8=zm.range,S8=Gm.range,co=He(e=>{e.setDate(1),e.setHours(0,0,0,0)},(e,t)=>{e.setMonth(e.getMonth()+t)},(e,t)=>t.getMonth()-e.getMonth()+(t.getFullYear()-e.getFullYear())*12,e=>e.getMonth()),w8=co.range,lo=He(e=>{e.setUTCDate(1),e.setUTCHours(0,0,0,0)},(e,t)=>{e.setUTCMonth(e.getUTCMonth()+t)},(e,t)=>t.getUTCMonth()-e.getUTCMonth()+(t.getUTCFullYear()-e.getUTCFullYear())*12,e=>e.getUTCMonth()),T8=lo.range,Bn=He(e=>{e.setMonth(0,1),e.setHours(0,0,0,0)},(e,t)=>{e.setFullYear(e.getFullYear()+t)},(e,t)=>t.getFullYear()-e.getFullYear(),e=>e.getFullYear());Bn.every=e=>!isFinite(e=Math.floor(e))||!(e>0)?null:He(t=>{t.setFullYear(Math.floor(t.getFullYear()/e)*e),t.setMonth(0,1),t.setHours(0,0,0,0)},(t,n)=>{t.setFullYear(t.getFullYear()+n*e)});var A8=Bn.range,kn=He(e=>{e.setUTCMonth(0,1),e.setUTCHours(0,0,0,0)},(e,t)=>{e.setUTCFullYear(e.getUTCFullYear()+t)},(e,t)=>t.getUTCFullYear()-e.getUTCFullYear(),e=>e.getUTCFullYear());kn.every=e=>!isFinite(e=Math.floor(e))||!(e>0)?null:He(t=>{t.setUTCFullYear(Math.floor(t.getUTCFullYear()/e)*e),t.setUTCMonth(0,1),t.setUTCHours(0,0,0,0)},(t,n)=>{t.setUTCFullYear(t.getUTCFullYear()+n*e)});var E8=kn.range;function P1(e,t,n,i,r,s){let o=[[Rn,1,Ar],[Rn,5,5*Ar],[Rn,15,15*Ar],[Rn,30,30*Ar],[s,1,yi],[s,5,5*yi],[s,15,15*yi],[s,30,30*yi],[r,1,Er],[r,3,3*Er],[r,6,6*Er],[r,12,12*Er],[i,1,Cr],[i,2,2*Cr],[n,1,Nm],[t,1,R1],[t,3,3*R1],[e,1,Lm]];function a(l,u,h){let f=u<l;f&&([l,u]=[u,l]);let d=h&&typeof h.range=="function"?h:c(l,u,h),p=d?d.range(l,+u+1):[];return f?p.reverse():p}function c(l,u,h){let f=Math.abs(u-l)/h,d=Fo(([,,m])=>m).right(o,f);if(d===o.length)return e.every(yc(l/Lm,u/Lm,h));if(d===0)return ef.every(Math.max(yc(l,u,h),1));let[p,y]=o[f/o[d-1][2]<o[d][2]/f?d-1:d];return p.every(y)}return[a,c]}var[I1,L1]=P1(kn,lo,ir,kc,io,eo),[N1,D1]=P1(Bn,co,nr,er,no,to);function Vm(e){if(0<=e.y&&e.y<100){var t=new Date(-1,e.m,e.d,e.H,e.M,e.S,e.L);return t.setFullYear(e.y),t}return new Date(e.y,e.m,e.d,e.H,e.M,e.S,e.L)}function Hm(e){if(0<=e.y&&e.y<100){var t=new Date(Date.UTC(-1,e.m,e.d,e.H,e.M,e.S,e.L));return t.setUTCFullYear(e.y),t}return new Date(Date.UTC(e.y,e.m,e.d,e.H,e.M,e.S,e.L))}function zc(e,t,n){return{y:e,m:t,d:n,H:0,M:0,S:0,L:0}}function IP(e){var t=e.dateTime,n=e.date,i=e.time,r=e.periods,s=e.days,o=e.shortDays,a=e.months,c=e.shortMonths,l=Gc(r),u=Vc(r),h=Gc(s),f=Vc(s),d=Gc(o),p=Vc(o),y=Gc(a),m=Vc(a),g=Gc(c),x=Vc(c),S={a:D,A:Y,b:B,B:V,c:null,d:z1,e:z1,f:tI,g:uI,G:hI,H:KP,I:jP,j:QP,L:$1,m:eI,M:nI,p:q,q:rt,Q:H1,s:W1,S:iI,u:rI,U:sI,V:oI,w:aI,W:cI,x:null,X:null,y:lI,Y:fI,Z:dI,"%":V1},v={a:ct,A:$,b:ot,B:ut,c:null,d:G1,e:G1,f:yI,g:EI,G:RI,H:pI,I:mI,j:gI,L:q1,m:_I,M:xI,p:st,q:at,Q:H1,s:W1,S:vI,u:bI,U:MI,V:SI,w:wI,W:TI,x:null,X:null,y:AI,Y:CI,Z:PI,"%":V1},w={a:E,A:I,b:R,B:U,c:P,d:B1,e:B1,f:qP,g:O1,G:F1,H:k1,I:k1,j:HP,L:XP,m:VP,M:WP,p:C,q:GP,Q:ZP,s:JP,S:$P,u:FP,U:OP,V:BP,w:UP,W:kP,x:L,X:O,y:O1,Y:F1,Z:zP,"%":YP};S.x=b(n,S),S.X=b(i,S),S.c=b(t,S),v.x=b(n,v),v.X=b(i,v),v.c=b(t,v);function b(J,_t){return function(lt){var K=[],Nt=-1,Mt=0,$t=J.length,Zt,ye,fe;for(lt instanceof Date||(lt=new Date(+lt));++Nt<$t;)J.charCodeAt(Nt)===37&&(K.push(J.slice(Mt,Nt)),(ye=U1[Zt=J.charAt(++Nt)])!=null?Zt=J.charAt(++Nt):ye=Zt==="e"?" ":"0",(fe=_t[Zt])&&(Zt=fe(lt,ye)),K.push(Zt),Mt=Nt+1);return K.push(J.slice(Mt,Nt)),K.join("")}}function _(J,_t){return function(lt){var K=zc(1900,void 0,1),Nt=M(K,J,lt+="",0),Mt,$t;if(Nt!=lt.length)return null;if("Q"in K)return new Date(K.Q);if("s"in K)return new Date(K.s*1e3+("L"in K?K.L:0));if(_t&&!("Z"in K)&&(K.Z=0),"p"in K&&(K.H=K.H%12+K.p*12),K.m===void 0&&(K.m="q"in K?K.q:0),"V"in K){if(K.V<1||K.V>53)return null;"w"in K||(K.w=1),"Z"in K?(Mt=Hm(zc(K.y,0,1)),$t=Mt.getUTCDay(),Mt=$t>4||$t===0?ao.ceil(Mt):ao(Mt),Mt=ta.offset(Mt,(K.V-1)*7),K.y=Mt.getUTCFullYear(),K.m=Mt.getUTCMonth(),K.d=Mt.getUTCDate()+(K.w+6)%7):(Mt=Vm(zc(K.y,0,1)),$t=Mt.getDay(),Mt=$t>4||$t===0?so.ceil(Mt):so(Mt),Mt=er.offset(Mt,(K.V-1)*7),K.y=Mt.getFullYear(),K.m=Mt.getMonth(),K.d=Mt.getDate()+(K.w+6)%7)}else("W"in K||"U"in K)&&("w"in K||(K.w="u"in K?K.u%7:"W"in K?1:0),$t="Z"in K?Hm(zc(K.y,0,1)).getUTCDay():Vm(zc(K.y,0,1)).getDay(),K.m=0,K.d="W"in K?(K.w+6)%7+K.W*7-($t+5)%7:K.w+K.U*7-($t+6)%7);return"Z"in K?(K.H+=K.Z/100|0,K.M+=K.Z%100,Hm(K)):Vm(K)}}function M(J,_t,lt,K){for(var Nt=0,Mt=_t.length,$t=lt.length,Zt,ye;Nt<Mt;){if(K>=$t)return-1;if(Zt=_t.charCodeAt(Nt++),Zt===37){if(Zt=_t.charAt(Nt++),ye=w[Zt in U1?_t.charAt(Nt++):Zt],!ye||(K=ye(J,lt,K))<0)return-1}else if(Zt!=lt.charCodeAt(K++))return-1}return K}function C(J,_t,lt){var K=l.exec(_t.slice(lt));return K?(J.p=u.get(K[0].toLowerCase()),lt+K[0].length):-1}function E(J,_t,lt){var K=d.exec(_t.slice(lt));return K?(J.w=p.get(K[0].toLowerCase()),lt+K[0].length):-1}function I(J,_t,lt){var K=h.exec(_t.slice(lt));return K?(J.w=f.get(K[0].toLowerCase()),lt+K[0].length):-1}function R(J,_t,lt){var K=g.exec(_t.slice(lt));return K?(J.m=x.get(K[0].toLowerCase()),lt+K[0].length):-1}function U(J,_t,lt){var K=y.exec(_t.slice(lt));return K?(J.m=m.get(K[0].toLowerCase()),lt+K[0].length):-1}function P(J,_t,lt){return M(J,t,_t,lt)}function L(J,_t,lt){return M(J,n,_t,lt)}function O(J,_t,lt){return M(J,i,_t,lt)}function D(J){return o[J.getDay()]}function Y(J){return s[J.getDay()]}function B(J){return c[J.getMonth()]}function V(J){return a[J.getMonth()]}function q(J){return r[+(J.getHours()>=12)]}function rt(J){return 1+~~(J.getMonth()/3)}function ct(J){return o[J.getUTCDay()]}function $(J){return s[J.getUTCDay()]}function ot(J){return c[J.getUTCMonth()]}function ut(J){return a[J.getUTCMonth()]}function st(J){return r[+(J.getUTCHours()>=12)]}function at(J){return 1+~~(J.getUTCMonth()/3)}return{format:function(J){var _t=b(J+="",S);return _t.toString=function(){return J},_t},parse:function(J){var _t=_(J+="",!1);return _t.toString=function(){return J},_t},utcFormat:function(J){var _t=b(J+="",v);return _t.toString=function(){return J},_t},utcParse:function(J){var _t=_(J+="",!0);return _t.toString=function(){return J},_t}}}var U1={"-":"",_:" ",0:"0"},tn=/^\s*\d+/,LP=/^%/,NP=/[\\^$*+?|[\]().{}]/g;function ae(e,t,n){var i=e<0?"-":"",r=(i?-e:e)+"",s=r.length;return i+(s<n?new Array(n-s+1).join(t)+r:r)}function DP(e){return e.replace(NP,"\\$&")}function Gc(e){return new RegExp("^(?:"+e.map(DP).join("|")+")","i")}function Vc(e){return new Map(e.map((t,n)=>[t.toLowerCase(),n]))}function UP(e,t,n){var i=tn.exec(t.slice(n,n+1));return i?(e.w=+i[0],n+i[0].length):-1}function FP(e,t,n){var i=tn.exec(t.slice(n,n+1));return i?(e.u=+i[0],n+i[0].length):-1}function OP(e,t,n){var i=tn.exec(t.slice(n,n+2));return i?(e.U=+i[0],n+i[0].length):-1}function BP(e,t,n){var i=tn.exec(t.slice(n,n+2));return i?(e.V=+i[0],n+i[0].length):-1}function kP(e,t,n){var i=tn.exec(t.slice(n,n+2));return i?(e.W=+i[0],n+i[0].length):-1}function F1(e,t,n){var i=tn.exec(t.slice(n,n+4));return i?(e.y=+i[0],n+i[0].length):-1}function O1(e,t,n){var i=tn.exec(t.slice(n,n+2));return i?(e.y=+i[0]+(+i[0]>68?1900:2e3),n+i[0].length):-1}function zP(e,t,n){var i=/^(Z)|([+-]\d\d)(?::?(\d\d))?/.exec(t.slice(n,n+6));return i?(e.Z=i[1]?0:-(i[2]+(i[3]||"00")),n+i[0].length):-1}function GP(e,t,n){var i=tn.exec(t.slice(n,n+1));return i?(e.q=i[0]*3-3,n+i[0].length):-1}function VP(e,t,n){var i=tn.exec(t.slice(n,n+2));return i?(e.m=i[0]-1,n+i[0].length):-1}function B1(e,t,n){var i=tn.exec(t.slice(n,n+2));return i?(e.d=+i[0],n+i[0].length):-1}function HP(e,t,n){var i=tn.exec(t.slice(n,n+3));return i?(e.m=0,e.d=+i[0],n+i[0].length):-1}function k1(e,t,n){var i=tn.exec(t.slice(n,n+2));return i?(e.H=+i[0],n+i[0].length):-1}function WP(e,t,n){var i=tn.exec(t.slice(n,n+2));return i?(e.M=+i[0],n+i[0].length):-1}function $P(e,t,n){var i=tn.exec(t.slice(n,n+2));return i?(e.S=+i[0],n+i[0].length):-1}function XP(e,t,n){var i=tn.exec(t.slice(n,n+3));return i?(e.L=+i[0],n+i[0].length):-1}function qP(e,t,n){var i=tn.exec(t.slice(n,n+6));return i?(e.L=Math.floor(i[0]/1e3),n+i[0].length):-1}function YP(e,t,n){var i=LP.exec(t.slice(n,n+1));return i?n+i[0].length:-1}function ZP(e,t,n){var i=tn.exec(t.slice(n));return i?(e.Q=+i[0],n+i[0].length):-1}function JP(e,t,n){var i=tn.exec(t.slice(n));return i?(e.s=+i[0],n+i[0].length):-1}function z1(e,t){return ae(e.getDate(),t,2)}function KP(e,t){return ae(e.getHours(),t,2)}function jP(e,t){return ae(e.getHours()%12||12,t,2)}function QP(e,t){return ae(1+er.count(Bn(e),e),t,3)}function $1(e,t){return ae(e.getMilliseconds(),t,3)}function tI(e,t){return $1(e,t)+"000"}function eI(e,t){return ae(e.getMonth()+1,t,2)}function nI(e,t){return ae(e.getMinutes(),t,2)}function iI(e,t){return ae(e.getSeconds(),t,2)}function rI(e){var t=e.getDay();return t===0?7:t}function sI(e,t){return ae(nr.count(Bn(e)-1,e),t,2)}function X1(e){var t=e.getDay();return t>=4||t===0?Rr(e):Rr.ceil(e)}function oI(e,t){return e=X1(e),ae(Rr.count(Bn(e),e)+(Bn(e).getDay()===4),t,2)}function aI(e){return e.getDay()}function cI(e,t){return ae(so.count(Bn(e)-1,e),t,2)}function lI(e,t){return ae(e.getFullYear()%100,t,2)}function uI(e,t){return e=X1(e),ae(e.getFullYear()%100,t,2)}function fI(e,t){return ae(e.getFullYear()%1e4,t,4)}function hI(e,t){var n=e.getDay();return e=n>=4||n===0?Rr(e):Rr.ceil(e),ae(e.getFullYear()%1e4,t,4)}function dI(e){var t=e.getTimezoneOffset();return(t>0?"-":(t*=-1,"+"))+ae(t/60|0,"0",2)+ae(t%60,"0",2)}function G1(e,t){return ae(e.getUTCDate(),t,2)}function pI(e,t){return ae(e.getUTCHours(),t,2)}function mI(e,t){return ae(e.getUTCHours()%12||12,t,2)}function gI(e,t){return ae(1+ta.count(kn(e),e),t,3)}function q1(e,t){return ae(e.getUTCMilliseconds(),t,3)}function yI(e,t){return q1(e,t)+"000"}function _I(e,t){return ae(e.getUTCMonth()+1,t,2)}function xI(e,t){return ae(e.getUTCMinutes(),t,2)}function vI(e,t){return ae(e.getUTCSeconds(),t,2)}function bI(e){var t=e.getUTCDay();return t===0?7:t}function MI(e,t){return ae(ir.count(kn(e)-1,e),t,2)}function Y1(e){var t=e.getUTCDay();return t>=4||t===0?Pr(e):Pr.ceil(e)}function SI(e,t){return e=Y1(e),ae(Pr.count(kn(e),e)+(kn(e).getUTCDay()===4),t,2)}function wI(e){return e.getUTCDay()}function TI(e,t){return ae(ao.count(kn(e)-1,e),t,2)}function AI(e,t){return ae(e.getUTCFullYear()%100,t,2)}function EI(e,t){return e=Y1(e),ae(e.getUTCFullYear()%100,t,2)}function CI(e,t){return ae(e.getUTCFullYear()%1e4,t,4)}function RI(e,t){var n=e.getUTCDay();return e=n>=4||n===0?Pr(e):Pr.ceil(e),ae(e.getUTCFullYear()%1e4,t,4)}function PI(){return"+0000"}function V1(){return"%"}function H1(e){return+e}function W1(e){return Math.floor(+e/1e3)}var ea,Hc,II,rr,Z1;LI({dateTime:"%x, %X",date:"%-m/%-d/%Y",time:"%-I:%M:%S %p",periods:["AM","PM"],days:["Sunday","Monday","Tuesday","Wednesday","Thursday","Friday","Saturday"],shortDays:["Sun","Mon","Tue","Wed","Thu","Fri","Sat"],months:["January","February","March","April","May","June","July","August","September","October","November","December"],shortMonths:["Jan","Feb","Mar","Apr","May","Jun","Jul","Aug","Sep","Oct","Nov","Dec"]});function LI(e){return ea=IP(e),Hc=ea.format,II=ea.parse,rr=ea.utcFormat,Z1=ea.utcParse,ea}var J1="%Y-%m-%dT%H:%M:%S.%LZ";function NI(e){return e.toISOString()}var P8=Date.prototype.toISOString?NI:rr(J1);function DI(e){var t=new Date(e);return isNaN(t)?null:t}var I8=+new Date("2000-01-01T00:00:00.000Z")?DI:Z1(J1);function sr(e,t){switch(arguments.length){case 0:break;case 1:this.range(e);break;default:this.range(t).domain(e);break}return this}function rf(e,t){switch(arguments.length){case 0:break;case 1:{typeof e=="function"?this.interpolator(e):this.range(e);break}default:{this.domain(e),typeof t=="function"?this.interpolator(t):this.range(t);break}}return this}var nf=Symbol("implicit");function sf(){var e=new li,t=[],n=[],i=nf;function r(s){let o=e.get(s);if(o===void 0){if(i!==nf)return i;e.set(s,o=t.push(s)-1)}return n[o%n.length]}return r.domain=function(s){if(!arguments.length)return t.slice();t=[],e=new li;for(let o of s)e.has(o)||e.set(o,t.push(o)-1);return r},r.range=function(s){return arguments.length?(n=Array.from(s),r):n.slice()},r.unknown=function(s){return arguments.length?(i=s,r):i},r.copy=function(){return sf(t,n).unknown(i)},sr.apply(r,arguments),r}function na(){var e=sf().unknown(void 0),t=e.domain,n=e.range,i=0,r=1,s,o,a=!1,c=0,l=0,u=.5;delete e.unknown;function h(){var f=t().length,d=r<i,p=d?r:i,y=d?i:r;s=(y-p)/Math.max(1,f-c+l*2),a&&(s=Math.floor(s)),p+=(y-p-s*(f-c))*u,o=s*(1-c),a&&(p=Math.round(p),o=Math.round(o));var m=ko(f).map(function(g){return p+s*g});return n(d?m.reverse():m)}return e.domain=function(f){return arguments.length?(t(f),h()):t()},e.range=function(f){return arguments.length?([i,r]=f,i=+i,r=+r,h()):[i,r]},e.rangeRound=function(f){return[i,r]=f,i=+i,r=+r,a=!0,h()},e.bandwidth=function(){return o},e.step=function(){return s},e.round=function(f){return arguments.length?(a=!!f,h()):a},e.padding=function(f){return arguments.length?(c=Math.min(1,l=+f),h()):c},e.paddingInner=function(f){return arguments.length?(c=Math.min(1,f),h()):c},e.paddingOuter=function(f){return arguments.length?(l=+f,h()):l},e.align=function(f){return arguments.length?(u=Math.max(0,Math.min(1,f)),h()):u},e.copy=function(){return na(t(),[i,r]).round(a).paddingInner(c).paddingOuter(l).align(u)},sr.apply(h(),arguments)}function rM(e){var t=e.copy;return e.padding=e.paddingOuter,delete e.paddingInner,delete e.paddingOuter,e.copy=function(){return rM(t())},e}function sM(){return rM(na.apply(null,arguments).paddingInner(1))}function UI(e){return function(){return e}}function Wm(e){return+e}var K1=[0,1];function _i(e){return e}function $m(e,t){return(t-=e=+e)?function(n){return(n-e)/t}:UI(isNaN(t)?NaN:.5)}function FI(e,t){var n;return e>t&&(n=e,e=t,t=n),function(i){return Math.max(e,Math.min(t,i))}}function OI(e,t,n){var i=e[0],r=e[1],s=t[0],o=t[1];return r<i?(i=$m(r,i),s=n(o,s)):(i=$m(i,r),s=n(s,o)),function(a){return s(i(a))}}function BI(e,t,n){var i=Math.min(e.length,t.length)-1,r=new Array(i),s=new Array(i),o=-1;for(e[i]<e[0]&&(e=e.slice().reverse(),t=t.slice().reverse());++o<i;)r[o]=$m(e[o],e[o+1]),s[o]=n(t[o],t[o+1]);return function(a){var c=yu(e,a,1,i)-1;return s[c](r[c](a))}}function Wc(e,t){return t.domain(e.domain()).range(e.range()).interpolate(e.interpolate()).clamp(e.clamp()).unknown(e.unknown())}function of(){var e=K1,t=K1,n=qo,i,r,s,o=_i,a,c,l;function u(){var f=Math.min(e.length,t.length);return o!==_i&&(o=FI(e[0],e[f-1])),a=f>2?BI:OI,c=l=null,h}function h(f){return f==null||isNaN(f=+f)?s:(c||(c=a(e.map(i),t,n)))(i(o(f)))}return h.invert=function(f){return o(r((l||(l=a(t,e.map(i),Ve)))(f)))},h.domain=function(f){return arguments.length?(e=Array.from(f,Wm),u()):e.slice()},h.range=function(f){return arguments.length?(t=Array.from(f),u()):t.slice()},h.rangeRound=function(f){return t=Array.from(f),n=Mc,u()},h.clamp=function(f){return arguments.length?(o=f?!0:_i,u()):o!==_i},h.interpolate=function(f){return arguments.length?(n=f,u()):n},h.unknown=function(f){return arguments.length?(s=f,h):s},function(f,d){return i=f,r=d,u()}}function oM(){return of()(_i,_i)}function kI(e,t,n,i){var r=yc(e,t,n),s;switch(i=Zo(i??",f"),i.type){case"s":{var o=Math.max(Math.abs(e),Math.abs(t));return i.precision==null&&!isNaN(s=vb(r,o))&&(i.precision=s),im(i,o)}case"":case"e":case"g":case"p":case"r":{i.precision==null&&!isNaN(s=bb(r,Math.max(Math.abs(e),Math.abs(t))))&&(i.precision=s-(i.type==="e"));break}case"f":case"%":{i.precision==null&&!isNaN(s=xb(r))&&(i.precision=s-(i.type==="%")*2);break}}return ji(i)}function $c(e){var t=e.domain;return e.ticks=function(n){var i=t();return Bo(i[0],i[i.length-1],n??10)},e.tickFormat=function(n,i){var r=t();return kI(r[0],r[r.length-1],n??10,i)},e.nice=function(n){n==null&&(n=10);var i=t(),r=0,s=i.length-1,o=i[r],a=i[s],c,l,u=10;for(a<o&&(l=o,o=a,a=l,l=r,r=s,s=l);u-- >0;){if(l=gu(o,a,n),l===c)return i[r]=o,i[s]=a,t(i);if(l>0)o=Math.floor(o/l)*l,a=Math.ceil(a/l)*l;else if(l<0)o=Math.ceil(o*l)/l,a=Math.floor(a*l)/l;else break;c=l}return e},e}function Xc(){var e=oM();return e.copy=function(){return Wc(e,Xc())},sr.apply(e,arguments),$c(e)}function Xm(e){var t;function n(i){return i==null||isNaN(i=+i)?t:i}return n.invert=n,n.domain=n.range=function(i){return arguments.length?(e=Array.from(i,Wm),n):e.slice()},n.unknown=function(i){return arguments.length?(t=i,n):t},n.copy=function(){return Xm(e).unknown(t)},e=arguments.length?Array.from(e,Wm):[0,1],$c(n)}function aM(e,t){e=e.slice();var n=0,i=e.length-1,r=e[n],s=e[i],o;return s<r&&(o=n,n=i,i=o,o=r,r=s,s=o),e[n]=t.floor(r),e[i]=t.ceil(s),e}function j1(e){return Math.log(e)}function Q1(e){return Math.exp(e)}function zI(e){return-Math.log(-e)}function GI(e){return-Math.exp(-e)}function VI(e){return isFinite(e)?+("1e"+e):e<0?0:e}function HI(e){return e===10?VI:e===Math.E?Math.exp:t=>Math.pow(e,t)}function WI(e){return e===Math.E?Math.log:e===10&&Math.log10||e===2&&Math.log2||(e=Math.log(e),t=>Math.log(t)/e)}function tM(e){return(t,n)=>-e(-t,n)}function cM(e){let t=e(j1,Q1),n=t.domain,i=10,r,s;function o(){return r=WI(i),s=HI(i),n()[0]<0?(r=tM(r),s=tM(s),e(zI,GI)):e(j1,Q1),t}return t.base=function(a){return arguments.length?(i=+a,o()):i},t.domain=function(a){return arguments.length?(n(a),o()):n()},t.ticks=a=>{let c=n(),l=c[0],u=c[c.length-1],h=u<l;h&&([l,u]=[u,l]);let f=r(l),d=r(u),p,y,m=a==null?10:+a,g=[];if(!(i%1)&&d-f<m){if(f=Math.floor(f),d=Math.ceil(d),l>0){for(;f<=d;++f)for(p=1;p<i;++p)if(y=f<0?p/s(-f):p*s(f),!(y<l)){if(y>u)break;g.push(y)}}else for(;f<=d;++f)for(p=i-1;p>=1;--p)if(y=f>0?p/s(-f):p*s(f),!(y<l)){if(y>u)break;g.push(y)}g.length*2<m&&(g=Bo(l,u,m))}else g=Bo(f,d,Math.min(d-f,m)).map(s);return h?g.reverse():g},t.tickFormat=(a,c)=>{if(a==null&&(a=10),c==null&&(c=i===10?"s":","),typeof c!="function"&&(!(i%1)&&(c=Zo(c)).precision==null&&(c.trim=!0),c=ji(c)),a===1/0)return c;let l=Math.max(1,i*a/t.ticks().length);return u=>{let h=u/s(Math.round(r(u)));return h*i<i-.5&&(h*=i),h<=l?c(u):""}},t.nice=()=>n(aM(n(),{floor:a=>s(Math.floor(r(a))),ceil:a=>s(Math.ceil(r(a)))})),t}function qm(){let e=cM(of()).domain([1,10]);return e.copy=()=>Wc(e,qm()).base(e.base()),sr.apply(e,arguments),e}function eM(e){return function(t){return Math.sign(t)*Math.log1p(Math.abs(t/e))}}function nM(e){return function(t){return Math.sign(t)*Math.expm1(Math.abs(t))*e}}function lM(e){var t=1,n=e(eM(t),nM(t));return n.constant=function(i){return arguments.length?e(eM(t=+i),nM(t)):t},$c(n)}function Ym(){var e=lM(of());return e.copy=function(){return Wc(e,Ym()).constant(e.constant())},sr.apply(e,arguments)}function iM(e){return function(t){return t<0?-Math.pow(-t,e):Math.pow(t,e)}}function $I(e){return e<0?-Math.sqrt(-e):Math.sqrt(e)}function XI(e){return e<0?-e*e:e*e}function uM(e){var t=e(_i,_i),n=1;function i(){return n===1?e(_i,_i):n===.5?e($I,XI):e(iM(n),iM(1/n))}return t.exponent=function(r){return arguments.length?(n=+r,i()):n},$c(t)}function Zm(){var e=uM(of());return e.copy=function(){return Wc(e,Zm()).exponent(e.exponent())},sr.apply(e,arguments),e}function Jm(){var e=[],t=[],n=[],i;function r(){var o=0,a=Math.max(1,t.length);for(n=new Array(a-1);++o<a;)n[o-1]=hv(e,o/a);return s}function s(o){return o==null||isNaN(o=+o)?i:t[yu(n,o)]}return s.invertExtent=function(o){var a=t.indexOf(o);return a<0?[NaN,NaN]:[a>0?n[a-1]:e[0],a<n.length?n[a]:e[e.length-1]]},s.domain=function(o){if(!arguments.length)return e.slice();e=[];for(let a of o)a!=null&&!isNaN(a=+a)&&e.push(a);return e.sort(vn),r()},s.range=function(o){return arguments.length?(t=Array.from(o),r()):t.slice()},s.unknown=function(o){return arguments.length?(i=o,s):i},s.quantiles=function(){return n.slice()},s.copy=function(){return Jm().domain(e).range(t).unknown(i)},sr.apply(s,arguments)}function Km(){var e=[.5],t=[0,1],n,i=1;function r(s){return s!=null&&s<=s?t[yu(e,s,0,i)]:n}return r.domain=function(s){return arguments.length?(e=Array.from(s),i=Math.min(e.length,t.length-1),r):e.slice()},r.range=function(s){return arguments.length?(t=Array.from(s),i=Math.min(e.length,t.length-1),r):t.slice()},r.invertExtent=function(s){var o=t.indexOf(s);return[e[o-1],e[o]]},r.unknown=function(s){return arguments.length?(n=s,r):n},r.copy=function(){return Km().domain(e).range(t).unknown(n)},sr.apply(r,arguments)}function qI(e){return new Date(e)}function YI(e){return e instanceof Date?+e:Math.round(e)}function jm(e,t,n,i,r,s,o,a,c,l){var u=oM(),h=u.invert,f=u.domain,d=l(".%L"),p=l(":%S"),y=l("%I:%M"),m=l("%I %p"),g=l("%a %d"),x=l("%b %d"),S=l("%B"),v=l("%Y");function w(b){return(c(b)<b?d:a(b)<b?p:o(b)<b?y:s(b)<b?m:i(b)<b?r(b)<b?g:x:n(b)<b?S:v)(b)}return u.invert=function(b){return new Date(Math.round(h(b)))},u.domain=function(b){return arguments.length?f(Array.from(b,YI)):f().map(qI)},u.ticks=function(b){var _=f();return e(_[0],_[_.length-1],b??10)},u.tickFormat=function(b,_){return _==null?w:l(_)},u.nice=function(b){var _=f();return(!b||typeof b.range!="function")&&(b=t(_[0],_[_.length-1],b??10)),b?f(aM(_,b)):u},u.copy=function(){return Wc(u,jm(e,t,n,i,r,s,o,a,c,l))},u}function fM(){return sr.apply(jm(N1,D1,Bn,co,nr,er,no,to,Rn,Hc).domain([new Date(2e3,0,1),new Date(2e3,0,2)]),arguments)}function hM(){return sr.apply(jm(I1,L1,kn,lo,ir,ta,io,eo,Rn,rr).domain([Date.UTC(2e3,0,1),Date.UTC(2e3,0,2)]),arguments)}function af(e,t){return t.domain(e.domain()).interpolator(e.interpolator()).clamp(e.clamp()).unknown(e.unknown())}function cf(){var e=0,t=.5,n=1,i=1,r,s,o,a,c,l=_i,u,h=!1,f;function d(y){return y==null||isNaN(y=+y)?f:(y=.5+((y=+u(y))-s)*(i*y<i*s?a:c),l(h?Math.max(0,Math.min(1,y)):y))}d.domain=function(y){return arguments.length?([e,t,n]=y,r=u(e=+e),s=u(t=+t),o=u(n=+n),a=r===s?0:.5/(s-r),c=s===o?0:.5/(o-s),i=s<r?-1:1,d):[e,t,n]},d.clamp=function(y){return arguments.length?(h=!!y,d):h},d.interpolator=function(y){return arguments.length?(l=y,d):l};function p(y){return function(m){var g,x,S;return arguments.length?([g,x,S]=m,l=rs(y,[g,x,S]),d):[l(0),l(.5),l(1)]}}return d.range=p(qo),d.rangeRound=p(Mc),d.unknown=function(y){return arguments.length?(f=y,d):f},function(y){return u=y,r=y(e),s=y(t),o=y(n),a=r===s?0:.5/(s-r),c=s===o?0:.5/(o-s),i=s<r?-1:1,d}}function Qm(){var e=$c(cf()(_i));return e.copy=function(){return af(e,Qm())},rf.apply(e,arguments)}function tg(){var e=cM(cf()).domain([.1,1,10]);return e.copy=function(){return af(e,tg()).base(e.base())},rf.apply(e,arguments)}function eg(){var e=lM(cf());return e.copy=function(){return af(e,eg()).constant(e.constant())},rf.apply(e,arguments)}function ng(){var e=uM(cf());return e.copy=function(){return af(e,ng()).exponent(e.exponent())},rf.apply(e,arguments)}function Yt(e){for(var t=e.length/6|0,n=new Array(t),i=0;i<t;)n[i]="#"+e.slice(i*6,++i*6);return n}var dM=Yt("1f77b4ff7f0e2ca02cd627289467bd8c564be377c27f7f7fbcbd2217becf"),pM=Yt("7fc97fbeaed4fdc086ffff99386cb0f0027fbf5b17666666"),mM=Yt("1b9e77d95f027570b3e7298a66a61ee6ab02a6761d666666"),gM=Yt("4269d0efb118ff725c6cc5b03ca951ff8ab7a463f297bbf59c6b4e9498a0"),yM=Yt("a6cee31f78b4b2df8a33a02cfb9a99e31a1cfdbf6fff7f00cab2d66a3d9affff99b15928"),_M=Yt("fbb4aeb3cde3ccebc5decbe4fed9a6ffffcce5d8bdfddaecf2f2f2"),xM=Yt("b3e2cdfdcdaccbd5e8f4cae4e6f5c9fff2aef1e2cccccccc"),vM=Yt("e41a1c377eb84daf4a984ea3ff7f00ffff33a65628f781bf999999"),bM=Yt("66c2a5fc8d628da0cbe78ac3a6d854ffd92fe5c494b3b3b3"),MM=Yt("8dd3c7ffffb3bebadafb807280b1d3fdb462b3de69fccde5d9d9d9bc80bdccebc5ffed6f"),SM=Yt("4e79a7f28e2ce1575976b7b259a14fedc949af7aa1ff9da79c755fbab0ab"),ve=e=>ib(e[e.length-1]),ig=new Array(3).concat("d8b365f5f5f55ab4ac","a6611adfc27d80cdc1018571","a6611adfc27df5f5f580cdc1018571","8c510ad8b365f6e8c3c7eae55ab4ac01665e","8c510ad8b365f6e8c3f5f5f5c7eae55ab4ac01665e","8c510abf812ddfc27df6e8c3c7eae580cdc135978f01665e","8c510abf812ddfc27df6e8c3f5f5f5c7eae580cdc135978f01665e","5430058c510abf812ddfc27df6e8c3c7eae580cdc135978f01665e003c30","5430058c510abf812ddfc27df6e8c3f5f5f5c7eae580cdc135978f01665e003c30").map(Yt),rg=ve(ig),sg=new Array(3).concat("af8dc3f7f7f77fbf7b","7b3294c2a5cfa6dba0008837","7b3294c2a5cff7f7f7a6dba0008837","762a83af8dc3e7d4e8d9f0d37fbf7b1b7837","762a83af8dc3e7d4e8f7f7f7d9f0d37fbf7b1b7837","762a839970abc2a5cfe7d4e8d9f0d3a6dba05aae611b7837","762a839970abc2a5cfe7d4e8f7f7f7d9f0d3a6dba05aae611b7837","40004b762a839970abc2a5cfe7d4e8d9f0d3a6dba05aae611b783700441b","40004b762a839970abc2a5cfe7d4e8f7f7f7d9f0d3a6dba05aae611b783700441b").map(Yt),og=ve(sg),ag=new Array(3).concat("e9a3c9f7f7f7a1d76a","d01c8bf1b6dab8e1864dac26","d01c8bf1b6daf7f7f7b8e1864dac26","c51b7de9a3c9fde0efe6f5d0a1d76a4d9221","c51b7de9a3c9fde0eff7f7f7e6f5d0a1d76a4d9221","c51b7dde77aef1b6dafde0efe6f5d0b8e1867fbc414d9221","c51b7dde77aef1b6dafde0eff7f7f7e6f5d0b8e1867fbc414d9221","8e0152c51b7dde77aef1b6dafde0efe6f5d0b8e1867fbc414d9221276419","8e0152c51b7dde77aef1b6dafde0eff7f7f7e6f5d0b8e1867fbc414d9221276419").map(Yt),cg=ve(ag),lg=new Array(3).concat("998ec3f7f7f7f1a340","5e3c99b2abd2fdb863e66101","5e3c99b2abd2f7f7f7fdb863e66101","542788998ec3d8daebfee0b6f1a340b35806","542788998ec3d8daebf7f7f7fee0b6f1a340b35806","5427888073acb2abd2d8daebfee0b6fdb863e08214b35806","5427888073acb2abd2d8daebf7f7f7fee0b6fdb863e08214b35806","2d004b5427888073acb2abd2d8daebfee0b6fdb863e08214b358067f3b08","2d004b5427888073acb2abd2d8daebf7f7f7fee0b6fdb863e08214b358067f3b08").map(Yt),ug=ve(lg),ff=new Array(3).concat("ef8a62f7f7f767a9cf","ca0020f4a58292c5de0571b0","ca0020f4a582f7f7f792c5de0571b0","b2182bef8a62fddbc7d1e5f067a9cf2166ac","b2182bef8a62fddbc7f7f7f7d1e5f067a9cf2166ac","b2182bd6604df4a582fddbc7d1e5f092c5de4393c32166ac","b2182bd6604df4a582fddbc7f7f7f7d1e5f092c5de4393c32166ac","67001fb2182bd6604df4a582fddbc7d1e5f092c5de4393c32166ac053061","67001fb2182bd6604df4a582fddbc7f7f7f7d1e5f092c5de4393c32166ac053061").map(Yt),qc=ve(ff),fg=new Array(3).concat("ef8a62ffffff999999","ca0020f4a582bababa404040","ca0020f4a582ffffffbababa404040","b2182bef8a62fddbc7e0e0e09999994d4d4d","b2182bef8a62fddbc7ffffffe0e0e09999994d4d4d","b2182bd6604df4a582fddbc7e0e0e0bababa8787874d4d4d","b2182bd6604df4a582fddbc7ffffffe0e0e0bababa8787874d4d4d","67001fb2182bd6604df4a582fddbc7e0e0e0bababa8787874d4d4d1a1a1a","67001fb2182bd6604df4a582fddbc7ffffffe0e0e0bababa8787874d4d4d1a1a1a").map(Yt),hg=ve(fg),hf=new Array(3).concat("fc8d59ffffbf91bfdb","d7191cfdae61abd9e92c7bb6","d7191cfdae61ffffbfabd9e92c7bb6","d73027fc8d59fee090e0f3f891bfdb4575b4","d73027fc8d59fee090ffffbfe0f3f891bfdb4575b4","d73027f46d43fdae61fee090e0f3f8abd9e974add14575b4","d73027f46d43fdae61fee090ffffbfe0f3f8abd9e974add14575b4","a50026d73027f46d43fdae61fee090e0f3f8abd9e974add14575b4313695","a50026d73027f46d43fdae61fee090ffffbfe0f3f8abd9e974add14575b4313695").map(Yt),Yc=ve(hf),dg=new Array(3).concat("fc8d59ffffbf91cf60","d7191cfdae61a6d96a1a9641","d7191cfdae61ffffbfa6d96a1a9641","d73027fc8d59fee08bd9ef8b91cf601a9850","d73027fc8d59fee08bffffbfd9ef8b91cf601a9850","d73027f46d43fdae61fee08bd9ef8ba6d96a66bd631a9850","d73027f46d43fdae61fee08bffffbfd9ef8ba6d96a66bd631a9850","a50026d73027f46d43fdae61fee08bd9ef8ba6d96a66bd631a9850006837","a50026d73027f46d43fdae61fee08bffffbfd9ef8ba6d96a66bd631a9850006837").map(Yt),pg=ve(dg),mg=new Array(3).concat("fc8d59ffffbf99d594","d7191cfdae61abdda42b83ba","d7191cfdae61ffffbfabdda42b83ba","d53e4ffc8d59fee08be6f59899d5943288bd","d53e4ffc8d59fee08bffffbfe6f59899d5943288bd","d53e4ff46d43fdae61fee08be6f598abdda466c2a53288bd","d53e4ff46d43fdae61fee08bffffbfe6f598abdda466c2a53288bd","9e0142d53e4ff46d43fdae61fee08be6f598abdda466c2a53288bd5e4fa2","9e0142d53e4ff46d43fdae61fee08bffffbfe6f598abdda466c2a53288bd5e4fa2").map(Yt),gg=ve(mg),yg=new Array(3).concat("e5f5f999d8c92ca25f","edf8fbb2e2e266c2a4238b45","edf8fbb2e2e266c2a42ca25f006d2c","edf8fbccece699d8c966c2a42ca25f006d2c","edf8fbccece699d8c966c2a441ae76238b45005824","f7fcfde5f5f9ccece699d8c966c2a441ae76238b45005824","f7fcfde5f5f9ccece699d8c966c2a441ae76238b45006d2c00441b").map(Yt),_g=ve(yg),xg=new Array(3).concat("e0ecf49ebcda8856a7","edf8fbb3cde38c96c688419d","edf8fbb3cde38c96c68856a7810f7c","edf8fbbfd3e69ebcda8c96c68856a7810f7c","edf8fbbfd3e69ebcda8c96c68c6bb188419d6e016b","f7fcfde0ecf4bfd3e69ebcda8c96c68c6bb188419d6e016b","f7fcfde0ecf4bfd3e69ebcda8c96c68c6bb188419d810f7c4d004b").map(Yt),vg=ve(xg),bg=new Array(3).concat("e0f3dba8ddb543a2ca","f0f9e8bae4bc7bccc42b8cbe","f0f9e8bae4bc7bccc443a2ca0868ac","f0f9e8ccebc5a8ddb57bccc443a2ca0868ac","f0f9e8ccebc5a8ddb57bccc44eb3d32b8cbe08589e","f7fcf0e0f3dbccebc5a8ddb57bccc44eb3d32b8cbe08589e","f7fcf0e0f3dbccebc5a8ddb57bccc44eb3d32b8cbe0868ac084081").map(Yt),Mg=ve(bg),Sg=new Array(3).concat("fee8c8fdbb84e34a33","fef0d9fdcc8afc8d59d7301f","fef0d9fdcc8afc8d59e34a33b30000","fef0d9fdd49efdbb84fc8d59e34a33b30000","fef0d9fdd49efdbb84fc8d59ef6548d7301f990000","fff7ecfee8c8fdd49efdbb84fc8d59ef6548d7301f990000","fff7ecfee8c8fdd49efdbb84fc8d59ef6548d7301fb300007f0000").map(Yt),wg=ve(Sg),Tg=new Array(3).concat("ece2f0a6bddb1c9099","f6eff7bdc9e167a9cf02818a","f6eff7bdc9e167a9cf1c9099016c59","f6eff7d0d1e6a6bddb67a9cf1c9099016c59","f6eff7d0d1e6a6bddb67a9cf3690c002818a016450","fff7fbece2f0d0d1e6a6bddb67a9cf3690c002818a016450","fff7fbece2f0d0d1e6a6bddb67a9cf3690c002818a016c59014636").map(Yt),Ag=ve(Tg),Eg=new Array(3).concat("ece7f2a6bddb2b8cbe","f1eef6bdc9e174a9cf0570b0","f1eef6bdc9e174a9cf2b8cbe045a8d","f1eef6d0d1e6a6bddb74a9cf2b8cbe045a8d","f1eef6d0d1e6a6bddb74a9cf3690c00570b0034e7b","fff7fbece7f2d0d1e6a6bddb74a9cf3690c00570b0034e7b","fff7fbece7f2d0d1e6a6bddb74a9cf3690c00570b0045a8d023858").map(Yt),Cg=ve(Eg),Rg=new Array(3).concat("e7e1efc994c7dd1c77","f1eef6d7b5d8df65b0ce1256","f1eef6d7b5d8df65b0dd1c77980043","f1eef6d4b9dac994c7df65b0dd1c77980043","f1eef6d4b9dac994c7df65b0e7298ace125691003f","f7f4f9e7e1efd4b9dac994c7df65b0e7298ace125691003f","f7f4f9e7e1efd4b9dac994c7df65b0e7298ace125698004367001f").map(Yt),Pg=ve(Rg),Ig=new Array(3).concat("fde0ddfa9fb5c51b8a","feebe2fbb4b9f768a1ae017e","feebe2fbb4b9f768a1c51b8a7a0177","feebe2fcc5c0fa9fb5f768a1c51b8a7a0177","feebe2fcc5c0fa9fb5f768a1dd3497ae017e7a0177","fff7f3fde0ddfcc5c0fa9fb5f768a1dd3497ae017e7a0177","fff7f3fde0ddfcc5c0fa9fb5f768a1dd3497ae017e7a017749006a").map(Yt),Lg=ve(Ig),Ng=new Array(3).concat("edf8b17fcdbb2c7fb8","ffffcca1dab441b6c4225ea8","ffffcca1dab441b6c42c7fb8253494","ffffccc7e9b47fcdbb41b6c42c7fb8253494","ffffccc7e9b47fcdbb41b6c41d91c0225ea80c2c84","ffffd9edf8b1c7e9b47fcdbb41b6c41d91c0225ea80c2c84","ffffd9edf8b1c7e9b47fcdbb41b6c41d91c0225ea8253494081d58").map(Yt),Dg=ve(Ng),Ug=new Array(3).concat("f7fcb9addd8e31a354","ffffccc2e69978c679238443","ffffccc2e69978c67931a354006837","ffffccd9f0a3addd8e78c67931a354006837","ffffccd9f0a3addd8e78c67941ab5d238443005a32","ffffe5f7fcb9d9f0a3addd8e78c67941ab5d238443005a32","ffffe5f7fcb9d9f0a3addd8e78c67941ab5d238443006837004529").map(Yt),Fg=ve(Ug),Og=new Array(3).concat("fff7bcfec44fd95f0e","ffffd4fed98efe9929cc4c02","ffffd4fed98efe9929d95f0e993404","ffffd4fee391fec44ffe9929d95f0e993404","ffffd4fee391fec44ffe9929ec7014cc4c028c2d04","ffffe5fff7bcfee391fec44ffe9929ec7014cc4c028c2d04","ffffe5fff7bcfee391fec44ffe9929ec7014cc4c02993404662506").map(Yt),Bg=ve(Og),kg=new Array(3).concat("ffeda0feb24cf03b20","ffffb2fecc5cfd8d3ce31a1c","ffffb2fecc5cfd8d3cf03b20bd0026","ffffb2fed976feb24cfd8d3cf03b20bd0026","ffffb2fed976feb24cfd8d3cfc4e2ae31a1cb10026","ffffccffeda0fed976feb24cfd8d3cfc4e2ae31a1cb10026","ffffccffeda0fed976feb24cfd8d3cfc4e2ae31a1cbd0026800026").map(Yt),zg=ve(kg),Gg=new Array(3).concat("deebf79ecae13182bd","eff3ffbdd7e76baed62171b5","eff3ffbdd7e76baed63182bd08519c","eff3ffc6dbef9ecae16baed63182bd08519c","eff3ffc6dbef9ecae16baed64292c62171b5084594","f7fbffdeebf7c6dbef9ecae16baed64292c62171b5084594","f7fbffdeebf7c6dbef9ecae16baed64292c62171b508519c08306b").map(Yt),Vg=ve(Gg),Hg=new Array(3).concat("e5f5e0a1d99b31a354","edf8e9bae4b374c476238b45","edf8e9bae4b374c47631a354006d2c","edf8e9c7e9c0a1d99b74c47631a354006d2c","edf8e9c7e9c0a1d99b74c47641ab5d238b45005a32","f7fcf5e5f5e0c7e9c0a1d99b74c47641ab5d238b45005a32","f7fcf5e5f5e0c7e9c0a1d99b74c47641ab5d238b45006d2c00441b").map(Yt),Wg=ve(Hg),$g=new Array(3).concat("f0f0f0bdbdbd636363","f7f7f7cccccc969696525252","f7f7f7cccccc969696636363252525","f7f7f7d9d9d9bdbdbd969696636363252525","f7f7f7d9d9d9bdbdbd969696737373525252252525","fffffff0f0f0d9d9d9bdbdbd969696737373525252252525","fffffff0f0f0d9d9d9bdbdbd969696737373525252252525000000").map(Yt),Xg=ve($g),qg=new Array(3).concat("efedf5bcbddc756bb1","f2f0f7cbc9e29e9ac86a51a3","f2f0f7cbc9e29e9ac8756bb154278f","f2f0f7dadaebbcbddc9e9ac8756bb154278f","f2f0f7dadaebbcbddc9e9ac8807dba6a51a34a1486","fcfbfdefedf5dadaebbcbddc9e9ac8807dba6a51a34a1486","fcfbfdefedf5dadaebbcbddc9e9ac8807dba6a51a354278f3f007d").map(Yt),Yg=ve(qg),Zg=new Array(3).concat("fee0d2fc9272de2d26","fee5d9fcae91fb6a4acb181d","fee5d9fcae91fb6a4ade2d26a50f15","fee5d9fcbba1fc9272fb6a4ade2d26a50f15","fee5d9fcbba1fc9272fb6a4aef3b2ccb181d99000d","fff5f0fee0d2fcbba1fc9272fb6a4aef3b2ccb181d99000d","fff5f0fee0d2fcbba1fc9272fb6a4aef3b2ccb181da50f1567000d").map(Yt),Jg=ve(Zg),Kg=new Array(3).concat("fee6cefdae6be6550d","feeddefdbe85fd8d3cd94701","feeddefdbe85fd8d3ce6550da63603","feeddefdd0a2fdae6bfd8d3ce6550da63603","feeddefdd0a2fdae6bfd8d3cf16913d948018c2d04","fff5ebfee6cefdd0a2fdae6bfd8d3cf16913d948018c2d04","fff5ebfee6cefdd0a2fdae6bfd8d3cf16913d94801a636037f2704").map(Yt),jg=ve(Kg);function Qg(e){return e=Math.max(0,Math.min(1,e)),"rgb("+Math.max(0,Math.min(255,Math.round(-4.54-e*(35.34-e*(2381.73-e*(6402.7-e*(7024.72-e*2710.57)))))))+", "+Math.max(0,Math.min(255,Math.round(32.49+e*(170.73+e*(52.82-e*(131.46-e*(176.58-e*67.37)))))))+", "+Math.max(0,Math.min(255,Math.round(81.24+e*(442.36-e*(2482.43-e*(6167.24-e*(6614.94-e*2475.67)))))))+")"}var t0=Iu(hi(300,.5,0),hi(-240,.5,1)),e0=Iu(hi(-100,.75,.35),hi(80,1.5,.8)),n0=Iu(hi(260,.75,.35),hi(80,1.5,.8)),lf=hi();function i0(e){(e<0||e>1)&&(e-=Math.floor(e));var t=Math.abs(e-.5);return lf.h=360*e-100,lf.s=1.5-1.5*t,lf.l=.8-.9*t,lf+""}var uf=Ni(),ZI=Math.PI/3,JI=Math.PI*2/3;function r0(e){var t;return e=(.5-e)*Math.PI,uf.r=255*(t=Math.sin(e))*t,uf.g=255*(t=Math.sin(e+ZI))*t,uf.b=255*(t=Math.sin(e+JI))*t,uf+""}function Zc(e){return e=Math.max(0,Math.min(1,e)),"rgb("+Math.max(0,Math.min(255,Math.round(34.61+e*(1172.33-e*(10793.56-e*(33300.12-e*(38394.49-e*14825.05)))))))+", "+Math.max(0,Math.min(255,Math.round(23.31+e*(557.33+e*(1225.33-e*(3574.96-e*(1073.77+e*707.56)))))))+", "+Math.max(0,Math.min(255,Math.round(27.2+e*(3211.1-e*(15327.97-e*(27814-e*(22569.18-e*6838.66)))))))+")"}function df(e){var t=e.length;return function(n){return e[Math.max(0,Math.min(t-1,Math.floor(n*t)))]}}var s0=df(Yt("44015444025645045745055946075a46085c460a5d460b5e470d60470e6147106347116447136548146748166848176948186a481a6c481b6d481c6e481d6f481f70482071482173482374482475482576482677482878482979472a7a472c7a472d7b472e7c472f7d46307e46327e46337f463480453581453781453882443983443a83443b84433d84433e85423f854240864241864142874144874045884046883f47883f48893e49893e4a893e4c8a3d4d8a3d4e8a3c4f8a3c508b3b518b3b528b3a538b3a548c39558c39568c38588c38598c375a8c375b8d365c8d365d8d355e8d355f8d34608d34618d33628d33638d32648e32658e31668e31678e31688e30698e306a8e2f6b8e2f6c8e2e6d8e2e6e8e2e6f8e2d708e2d718e2c718e2c728e2c738e2b748e2b758e2a768e2a778e2a788e29798e297a8e297b8e287c8e287d8e277e8e277f8e27808e26818e26828e26828e25838e25848e25858e24868e24878e23888e23898e238a8d228b8d228c8d228d8d218e8d218f8d21908d21918c20928c20928c20938c1f948c1f958b1f968b1f978b1f988b1f998a1f9a8a1e9b8a1e9c891e9d891f9e891f9f881fa0881fa1881fa1871fa28720a38620a48621a58521a68522a78522a88423a98324aa8325ab8225ac8226ad8127ad8128ae8029af7f2ab07f2cb17e2db27d2eb37c2fb47c31b57b32b67a34b67935b77937b87838b9773aba763bbb753dbc743fbc7340bd7242be7144bf7046c06f48c16e4ac16d4cc26c4ec36b50c46a52c56954c56856c66758c7655ac8645cc8635ec96260ca6063cb5f65cb5e67cc5c69cd5b6ccd5a6ece5870cf5773d05675d05477d1537ad1517cd2507fd34e81d34d84d44b86d54989d5488bd6468ed64590d74393d74195d84098d83e9bd93c9dd93ba0da39a2da37a5db36a8db34aadc32addc30b0dd2fb2dd2db5de2bb8de29bade28bddf26c0df25c2df23c5e021c8e020cae11fcde11dd0e11cd2e21bd5e21ad8e219dae319dde318dfe318e2e418e5e419e7e419eae51aece51befe51cf1e51df4e61ef6e620f8e621fbe723fde725")),o0=df(Yt("00000401000501010601010802010902020b02020d03030f03031204041405041606051806051a07061c08071e0907200a08220b09240c09260d0a290e0b2b100b2d110c2f120d31130d34140e36150e38160f3b180f3d19103f1a10421c10441d11471e114920114b21114e22115024125325125527125829115a2a115c2c115f2d11612f116331116533106734106936106b38106c390f6e3b0f703d0f713f0f72400f74420f75440f764510774710784910784a10794c117a4e117b4f127b51127c52137c54137d56147d57157e59157e5a167e5c167f5d177f5f187f601880621980641a80651a80671b80681c816a1c816b1d816d1d816e1e81701f81721f817320817521817621817822817922827b23827c23827e24828025828125818326818426818627818827818928818b29818c29818e2a81902a81912b81932b80942c80962c80982d80992d809b2e7f9c2e7f9e2f7fa02f7fa1307ea3307ea5317ea6317da8327daa337dab337cad347cae347bb0357bb2357bb3367ab5367ab73779b83779ba3878bc3978bd3977bf3a77c03a76c23b75c43c75c53c74c73d73c83e73ca3e72cc3f71cd4071cf4070d0416fd2426fd3436ed5446dd6456cd8456cd9466bdb476adc4869de4968df4a68e04c67e24d66e34e65e44f64e55064e75263e85362e95462ea5661eb5760ec5860ed5a5fee5b5eef5d5ef05f5ef1605df2625df2645cf3655cf4675cf4695cf56b5cf66c5cf66e5cf7705cf7725cf8745cf8765cf9785df9795df97b5dfa7d5efa7f5efa815ffb835ffb8560fb8761fc8961fc8a62fc8c63fc8e64fc9065fd9266fd9467fd9668fd9869fd9a6afd9b6bfe9d6cfe9f6dfea16efea36ffea571fea772fea973feaa74feac76feae77feb078feb27afeb47bfeb67cfeb77efeb97ffebb81febd82febf84fec185fec287fec488fec68afec88cfeca8dfecc8ffecd90fecf92fed194fed395fed597fed799fed89afdda9cfddc9efddea0fde0a1fde2a3fde3a5fde5a7fde7a9fde9aafdebacfcecaefceeb0fcf0b2fcf2b4fcf4b6fcf6b8fcf7b9fcf9bbfcfbbdfcfdbf")),a0=df(Yt("00000401000501010601010802010a02020c02020e03021004031204031405041706041907051b08051d09061f0a07220b07240c08260d08290e092b10092d110a30120a32140b34150b37160b39180c3c190c3e1b0c411c0c431e0c451f0c48210c4a230c4c240c4f260c51280b53290b552b0b572d0b592f0a5b310a5c320a5e340a5f3609613809623909633b09643d09653e0966400a67420a68440a68450a69470b6a490b6a4a0c6b4c0c6b4d0d6c4f0d6c510e6c520e6d540f6d550f6d57106e59106e5a116e5c126e5d126e5f136e61136e62146e64156e65156e67166e69166e6a176e6c186e6d186e6f196e71196e721a6e741a6e751b6e771c6d781c6d7a1d6d7c1d6d7d1e6d7f1e6c801f6c82206c84206b85216b87216b88226a8a226a8c23698d23698f24699025689225689326679526679727669827669a28659b29649d29649f2a63a02a63a22b62a32c61a52c60a62d60a82e5fa92e5eab2f5ead305dae305cb0315bb1325ab3325ab43359b63458b73557b93556ba3655bc3754bd3853bf3952c03a51c13a50c33b4fc43c4ec63d4dc73e4cc83f4bca404acb4149cc4248ce4347cf4446d04545d24644d34743d44842d54a41d74b3fd84c3ed94d3dda4e3cdb503bdd513ade5238df5337e05536e15635e25734e35933e45a31e55c30e65d2fe75e2ee8602de9612bea632aeb6429eb6628ec6726ed6925ee6a24ef6c23ef6e21f06f20f1711ff1731df2741cf3761bf37819f47918f57b17f57d15f67e14f68013f78212f78410f8850ff8870ef8890cf98b0bf98c0af98e09fa9008fa9207fa9407fb9606fb9706fb9906fb9b06fb9d07fc9f07fca108fca309fca50afca60cfca80dfcaa0ffcac11fcae12fcb014fcb216fcb418fbb61afbb81dfbba1ffbbc21fbbe23fac026fac228fac42afac62df9c72ff9c932f9cb35f8cd37f8cf3af7d13df7d340f6d543f6d746f5d949f5db4cf4dd4ff4df53f4e156f3e35af3e55df2e661f2e865f2ea69f1ec6df1ed71f1ef75f1f179f2f27df2f482f3f586f3f68af4f88ef5f992f6fa96f8fb9af9fc9dfafda1fcffa4")),c0=df(Yt("0d088710078813078916078a19068c1b068d1d068e20068f2206902406912605912805922a05932c05942e05952f059631059733059735049837049938049a3a049a3c049b3e049c3f049c41049d43039e44039e46039f48039f4903a04b03a14c02a14e02a25002a25102a35302a35502a45601a45801a45901a55b01a55c01a65e01a66001a66100a76300a76400a76600a76700a86900a86a00a86c00a86e00a86f00a87100a87201a87401a87501a87701a87801a87a02a87b02a87d03a87e03a88004a88104a78305a78405a78606a68707a68808a68a09a58b0aa58d0ba58e0ca48f0da4910ea3920fa39410a29511a19613a19814a099159f9a169f9c179e9d189d9e199da01a9ca11b9ba21d9aa31e9aa51f99a62098a72197a82296aa2395ab2494ac2694ad2793ae2892b02991b12a90b22b8fb32c8eb42e8db52f8cb6308bb7318ab83289ba3388bb3488bc3587bd3786be3885bf3984c03a83c13b82c23c81c33d80c43e7fc5407ec6417dc7427cc8437bc9447aca457acb4679cc4778cc4977cd4a76ce4b75cf4c74d04d73d14e72d24f71d35171d45270d5536fd5546ed6556dd7566cd8576bd9586ada5a6ada5b69db5c68dc5d67dd5e66de5f65de6164df6263e06363e16462e26561e26660e3685fe4695ee56a5de56b5de66c5ce76e5be76f5ae87059e97158e97257ea7457eb7556eb7655ec7754ed7953ed7a52ee7b51ef7c51ef7e50f07f4ff0804ef1814df1834cf2844bf3854bf3874af48849f48948f58b47f58c46f68d45f68f44f79044f79143f79342f89441f89540f9973ff9983ef99a3efa9b3dfa9c3cfa9e3bfb9f3afba139fba238fca338fca537fca636fca835fca934fdab33fdac33fdae32fdaf31fdb130fdb22ffdb42ffdb52efeb72dfeb82cfeba2cfebb2bfebd2afebe2afec029fdc229fdc328fdc527fdc627fdc827fdca26fdcb26fccd25fcce25fcd025fcd225fbd324fbd524fbd724fad824fada24f9dc24f9dd25f8df25f8e125f7e225f7e425f6e626f6e826f5e926f5eb27f4ed27f3ee27f3f027f2f227f1f426f1f525f0f724f0f921"));function ia(e){return function(){return e}}var RM=Math.cos;var h0=Math.min,pf=Math.sin,We=Math.sqrt,wM=1e-12,Jc=Math.PI,H8=Jc/2,xf=2*Jc;function KI(e){let t=3;return e.digits=function(n){if(!arguments.length)return t;if(n==null)t=null;else{let i=Math.floor(n);if(!(i>=0))throw new RangeError(`invalid digits: ${n}`);t=i}return e},()=>new js(t)}var W8=Array.prototype.slice;function jI(e){return typeof e=="object"&&"length"in e?e:Array.from(e)}function PM(e){this._context=e}PM.prototype={areaStart:function(){this._line=0},areaEnd:function(){this._line=NaN},lineStart:function(){this._point=0},lineEnd:function(){(this._line||this._line!==0&&this._point===1)&&this._context.closePath(),this._line=1-this._line},point:function(e,t){switch(e=+e,t=+t,this._point){case 0:this._point=1,this._line?this._context.lineTo(e,t):this._context.moveTo(e,t);break;case 1:this._point=2;default:this._context.lineTo(e,t);break}}};function ra(e){return new PM(e)}function QI(e){return e[0]}function tL(e){return e[1]}function IM(e,t){var n=ia(!0),i=null,r=ra,s=null,o=KI(a);e=typeof e=="function"?e:e===void 0?QI:ia(e),t=typeof t=="function"?t:t===void 0?tL:ia(t);function a(c){var l,u=(c=jI(c)).length,h,f=!1,d;for(i==null&&(s=r(d=o())),l=0;l<=u;++l)!(l<u&&n(h=c[l],l,c))===f&&((f=!f)?s.lineStart():s.lineEnd()),f&&s.point(+e(h,l,c),+t(h,l,c));if(d)return s=null,d+""||null}return a.x=function(c){return arguments.length?(e=typeof c=="function"?c:ia(+c),a):e},a.y=function(c){return arguments.length?(t=typeof c=="function"?c:ia(+c),a):t},a.defined=function(c){return arguments.length?(n=typeof c=="function"?c:ia(!!c),a):n},a.curve=function(c){return arguments.length?(r=c,i!=null&&(s=r(i)),a):r},a.context=function(c){return arguments.length?(c==null?i=s=null:s=r(i=c),a):i},a}var $8=eL(ra);function LM(e){this._curve=e}LM.prototype={areaStart:function(){this._curve.areaStart()},areaEnd:function(){this._curve.areaEnd()},lineStart:function(){this._curve.lineStart()},lineEnd:function(){this._curve.lineEnd()},point:function(e,t){this._curve.point(t*Math.sin(e),t*-Math.cos(e))}};function eL(e){function t(n){return new LM(e(n))}return t._curve=e,t}var mf=class{constructor(t,n){this._context=t,this._x=n}areaStart(){this._line=0}areaEnd(){this._line=NaN}lineStart(){this._point=0}lineEnd(){(this._line||this._line!==0&&this._point===1)&&this._context.closePath(),this._line=1-this._line}point(t,n){switch(t=+t,n=+n,this._point){case 0:{this._point=1,this._line?this._context.lineTo(t,n):this._context.moveTo(t,n);break}case 1:this._point=2;default:{this._x?this._context.bezierCurveTo(this._x0=(this._x0+t)/2,this._y0,this._x0,n,t,n):this._context.bezierCurveTo(this._x0,this._y0=(this._y0+n)/2,t,this._y0,t,n);break}}this._x0=t,this._y0=n}};function NM(e){return new mf(e,!0)}function DM(e){return new mf(e,!1)}var nL=We(3),d0={draw(e,t){let n=We(t+h0(t/28,.75))*.59436,i=n/2,r=i*nL;e.moveTo(0,n),e.lineTo(0,-n),e.moveTo(-r,-i),e.lineTo(r,i),e.moveTo(-r,i),e.lineTo(r,-i)}},uo={draw(e,t){let n=We(t/Jc);e.moveTo(n,0),e.arc(0,0,n,0,xf)}},p0={draw(e,t){let n=We(t/5)/2;e.moveTo(-3*n,-n),e.lineTo(-n,-n),e.lineTo(-n,-3*n),e.lineTo(n,-3*n),e.lineTo(n,-n),e.lineTo(3*n,-n),e.lineTo(3*n,n),e.lineTo(n,n),e.lineTo(n,3*n),e.lineTo(-n,3*n),e.lineTo(-n,n),e.lineTo(-3*n,n),e.closePath()}},UM=We(1/3),iL=UM*2,m0={draw(e,t){let n=We(t/iL),i=n*UM;e.moveTo(0,-n),e.lineTo(i,0),e.lineTo(0,n),e.lineTo(-i,0),e.closePath()}},g0={draw(e,t){let n=We(t)*.62625;e.moveTo(0,-n),e.lineTo(n,0),e.lineTo(0,n),e.lineTo(-n,0),e.closePath()}},y0={draw(e,t){let n=We(t-h0(t/7,2))*.87559;e.moveTo(-n,0),e.lineTo(n,0),e.moveTo(0,n),e.lineTo(0,-n)}},_0={draw(e,t){let n=We(t),i=-n/2;e.rect(i,i,n,n)}},x0={draw(e,t){let n=We(t)*.4431;e.moveTo(n,n),e.lineTo(n,-n),e.lineTo(-n,-n),e.lineTo(-n,n),e.closePath()}},rL=.8908130915292852,FM=pf(Jc/10)/pf(7*Jc/10),sL=pf(xf/10)*FM,oL=-RM(xf/10)*FM,v0={draw(e,t){let n=We(t*rL),i=sL*n,r=oL*n;e.moveTo(0,-n),e.lineTo(i,r);for(let s=1;s<5;++s){let o=xf*s/5,a=RM(o),c=pf(o);e.lineTo(c*n,-a*n),e.lineTo(a*i-c*r,c*i+a*r)}e.closePath()}},l0=We(3),b0={draw(e,t){let n=-We(t/(l0*3));e.moveTo(0,n*2),e.lineTo(-l0*n,-n),e.lineTo(l0*n,-n),e.closePath()}},aL=We(3),M0={draw(e,t){let n=We(t)*.6824,i=n/2,r=n*aL/2;e.moveTo(0,-n),e.lineTo(r,i),e.lineTo(-r,i),e.closePath()}},xi=-.5,vi=We(3)/2,f0=1/We(12),cL=(f0/2+1)*3,S0={draw(e,t){let n=We(t/cL),i=n/2,r=n*f0,s=i,o=n*f0+n,a=-s,c=o;e.moveTo(i,r),e.lineTo(s,o),e.lineTo(a,c),e.lineTo(xi*i-vi*r,vi*i+xi*r),e.lineTo(xi*s-vi*o,vi*s+xi*o),e.lineTo(xi*a-vi*c,vi*a+xi*c),e.lineTo(xi*i+vi*r,xi*r-vi*i),e.lineTo(xi*s+vi*o,xi*o-vi*s),e.lineTo(xi*a+vi*c,xi*c-vi*a),e.closePath()}},w0={draw(e,t){let n=We(t-h0(t/6,1.7))*.6189;e.moveTo(-n,-n),e.lineTo(n,n),e.moveTo(-n,n),e.lineTo(n,-n)}},OM=[uo,p0,m0,_0,v0,b0,S0],BM=[uo,y0,w0,M0,d0,x0,g0];function as(){}function gf(e,t,n){e._context.bezierCurveTo((2*e._x0+e._x1)/3,(2*e._y0+e._y1)/3,(e._x0+2*e._x1)/3,(e._y0+2*e._y1)/3,(e._x0+4*e._x1+t)/6,(e._y0+4*e._y1+n)/6)}function vf(e){this._context=e}vf.prototype={areaStart:function(){this._line=0},areaEnd:function(){this._line=NaN},lineStart:function(){this._x0=this._x1=this._y0=this._y1=NaN,this._point=0},lineEnd:function(){switch(this._point){case 3:gf(this,this._x1,this._y1);case 2:this._context.lineTo(this._x1,this._y1);break}(this._line||this._line!==0&&this._point===1)&&this._context.closePath(),this._line=1-this._line},point:function(e,t){switch(e=+e,t=+t,this._point){case 0:this._point=1,this._line?this._context.lineTo(e,t):this._context.moveTo(e,t);break;case 1:this._point=2;break;case 2:this._point=3,this._context.lineTo((5*this._x0+this._x1)/6,(5*this._y0+this._y1)/6);default:gf(this,e,t);break}this._x0=this._x1,this._x1=e,this._y0=this._y1,this._y1=t}};function kM(e){return new vf(e)}function zM(e){this._context=e}zM.prototype={areaStart:as,areaEnd:as,lineStart:function(){this._x0=this._x1=this._x2=this._x3=this._x4=this._y0=this._y1=this._y2=this._y3=this._y4=NaN,this._point=0},lineEnd:function(){switch(this._point){case 1:{this._context.moveTo(this._x2,this._y2),this._context.closePath();break}case 2:{this._context.moveTo((this._x2+2*this._x3)/3,(this._y2+2*this._y3)/3),this._context.lineTo((this._x3+2*this._x2)/3,(this._y3+2*this._y2)/3),this._context.closePath();break}case 3:{this.point(this._x2,this._y2),this.point(this._x3,this._y3),this.point(this._x4,this._y4);break}}},point:function(e,t){switch(e=+e,t=+t,this._point){case 0:this._point=1,this._x2=e,this._y2=t;break;case 1:this._point=2,this._x3=e,this._y3=t;break;case 2:this._point=3,this._x4=e,this._y4=t,this._context.moveTo((this._x0+4*this._x1+e)/6,(this._y0+4*this._y1+t)/6);break;default:gf(this,e,t);break}this._x0=this._x1,this._x1=e,this._y0=this._y1,this._y1=t}};function GM(e){return new zM(e)}function VM(e){this._context=e}VM.prototype={areaStart:function(){this._line=0},areaEnd:function(){this._line=NaN},lineStart:function(){this._x0=this._x1=this._y0=this._y1=NaN,this._point=0},lineEnd:function(){(this._line||this._line!==0&&this._point===3)&&this._context.closePath(),this._line=1-this._line},point:function(e,t){switch(e=+e,t=+t,this._point){case 0:this._point=1;break;case 1:this._point=2;break;case 2:this._point=3;var n=(this._x0+4*this._x1+e)/6,i=(this._y0+4*this._y1+t)/6;this._line?this._context.lineTo(n,i):this._context.moveTo(n,i);break;case 3:this._point=4;default:gf(this,e,t);break}this._x0=this._x1,this._x1=e,this._y0=this._y1,this._y1=t}};function HM(e){return new VM(e)}function WM(e,t){this._basis=new vf(e),this._beta=t}WM.prototype={lineStart:function(){this._x=[],this._y=[],this._basis.lineStart()},lineEnd:function(){var e=this._x,t=this._y,n=e.length-1;if(n>0)for(var i=e[0],r=t[0],s=e[n]-i,o=t[n]-r,a=-1,c;++a<=n;)c=a/n,this._basis.point(this._beta*e[a]+(1-this._beta)*(i+c*s),this._beta*t[a]+(1-this._beta)*(r+c*o));this._x=this._y=null,this._basis.lineEnd()},point:function(e,t){this._x.push(+e),this._y.push(+t)}};var $M=(function e(t){function n(i){return t===1?new vf(i):new WM(i,t)}return n.beta=function(i){return e(+i)},n})(.85);function yf(e,t,n){e._context.bezierCurveTo(e._x1+e._k*(e._x2-e._x0),e._y1+e._k*(e._y2-e._y0),e._x2+e._k*(e._x1-t),e._y2+e._k*(e._y1-n),e._x2,e._y2)}function T0(e,t){this._context=e,this._k=(1-t)/6}T0.prototype={areaStart:function(){this._line=0},areaEnd:function(){this._line=NaN},lineStart:function(){this._x0=this._x1=this._x2=this._y0=this._y1=this._y2=NaN,this._point=0},lineEnd:function(){switch(this._point){case 2:this._context.lineTo(this._x2,this._y2);break;case 3:yf(this,this._x1,this._y1);break}(this._line||this._line!==0&&this._point===1)&&this._context.closePath(),this._line=1-this._line},point:function(e,t){switch(e=+e,t=+t,this._point){case 0:this._point=1,this._line?this._context.lineTo(e,t):this._context.moveTo(e,t);break;case 1:this._point=2,this._x1=e,this._y1=t;break;case 2:this._point=3;default:yf(this,e,t);break}this._x0=this._x1,this._x1=this._x2,this._x2=e,this._y0=this._y1,this._y1=this._y2,this._y2=t}};var XM=(function e(t){function n(i){return new T0(i,t)}return n.tension=function(i){return e(+i)},n})(0);function A0(e,t){this._context=e,this._k=(1-t)/6}A0.prototype={areaStart:as,areaEnd:as,lineStart:function(){this._x0=this._x1=this._x2=this._x3=this._x4=this._x5=this._y0=this._y1=this._y2=this._y3=this._y4=this._y5=NaN,this._point=0},lineEnd:function(){switch(this._point){case 1:{this._context.moveTo(this._x3,this._y3),this._context.closePath();break}case 2:{this._context.lineTo(this._x3,this._y3),this._context.closePath();break}case 3:{this.point(this._x3,this._y3),this.point(this._x4,this._y4),this.point(this._x5,this._y5);break}}},point:function(e,t){switch(e=+e,t=+t,this._point){case 0:this._point=1,this._x3=e,this._y3=t;break;case 1:this._point=2,this._context.moveTo(this._x4=e,this._y4=t);break;case 2:this._point=3,this._x5=e,this._y5=t;break;default:yf(this,e,t);break}this._x0=this._x1,this._x1=this._x2,this._x2=e,this._y0=this._y1,this._y1=this._y2,this._y2=t}};var qM=(function e(t){function n(i){return new A0(i,t)}return n.tension=function(i){return e(+i)},n})(0);function E0(e,t){this._context=e,this._k=(1-t)/6}E0.prototype={areaStart:function(){this._line=0},areaEnd:function(){this._line=NaN},lineStart:function(){this._x0=this._x1=this._x2=this._y0=this._y1=this._y2=NaN,this._point=0},lineEnd:function(){(this._line||this._line!==0&&this._point===3)&&this._context.closePath(),this._line=1-this._line},point:function(e,t){switch(e=+e,t=+t,this._point){case 0:this._point=1;break;case 1:this._point=2;break;case 2:this._point=3,this._line?this._context.lineTo(this._x2,this._y2):this._context.moveTo(this._x2,this._y2);break;case 3:this._point=4;default:yf(this,e,t);break}this._x0=this._x1,this._x1=this._x2,this._x2=e,this._y0=this._y1,this._y1=this._y2,this._y2=t}};var YM=(function e(t){function n(i){return new E0(i,t)}return n.tension=function(i){return e(+i)},n})(0);function C0(e,t,n){var i=e._x1,r=e._y1,s=e._x2,o=e._y2;if(e._l01_a>wM){var a=2*e._l01_2a+3*e._l01_a*e._l12_a+e._l12_2a,c=3*e._l01_a*(e._l01_a+e._l12_a);i=(i*a-e._x0*e._l12_2a+e._x2*e._l01_2a)/c,r=(r*a-e._y0*e._l12_2a+e._y2*e._l01_2a)/c}if(e._l23_a>wM){var l=2*e._l23_2a+3*e._l23_a*e._l12_a+e._l12_2a,u=3*e._l23_a*(e._l23_a+e._l12_a);s=(s*l+e._x1*e._l23_2a-t*e._l12_2a)/u,o=(o*l+e._y1*e._l23_2a-n*e._l12_2a)/u}e._context.bezierCurveTo(i,r,s,o,e._x2,e._y2)}function ZM(e,t){this._context=e,this._alpha=t}ZM.prototype={areaStart:function(){this._line=0},areaEnd:function(){this._line=NaN},lineStart:function(){this._x0=this._x1=this._x2=this._y0=this._y1=this._y2=NaN,this._l01_a=this._l12_a=this._l23_a=this._l01_2a=this._l12_2a=this._l23_2a=this._point=0},lineEnd:function(){switch(this._point){case 2:this._context.lineTo(this._x2,this._y2);break;case 3:this.point(this._x2,this._y2);break}(this._line||this._line!==0&&this._point===1)&&this._context.closePath(),this._line=1-this._line},point:function(e,t){if(e=+e,t=+t,this._point){var n=this._x2-e,i=this._y2-t;this._l23_a=Math.sqrt(this._l23_2a=Math.pow(n*n+i*i,this._alpha))}switch(this._point){case 0:this._point=1,this._line?this._context.lineTo(e,t):this._context.moveTo(e,t);break;case 1:this._point=2;break;case 2:this._point=3;default:C0(this,e,t);break}this._l01_a=this._l12_a,this._l12_a=this._l23_a,this._l01_2a=this._l12_2a,this._l12_2a=this._l23_2a,this._x0=this._x1,this._x1=this._x2,this._x2=e,this._y0=this._y1,this._y1=this._y2,this._y2=t}};var JM=(function e(t){function n(i){return t?new ZM(i,t):new T0(i,0)}return n.alpha=function(i){return e(+i)},n})(.5);function KM(e,t){this._context=e,this._alpha=t}KM.prototype={areaStart:as,areaEnd:as,lineStart:function(){this._x0=this._x1=this._x2=this._x3=this._x4=this._x5=this._y0=this._y1=this._y2=this._y3=this._y4=this._y5=NaN,this._l01_a=this._l12_a=this._l23_a=this._l01_2a=this._l12_2a=this._l23_2a=this._point=0},lineEnd:function(){switch(this._point){case 1:{this._context.moveTo(this._x3,this._y3),this._context.closePath();break}case 2:{this._context.lineTo(this._x3,this._y3),this._context.closePath();break}case 3:{this.point(this._x3,this._y3),this.point(this._x4,this._y4),this.point(this._x5,this._y5);break}}},point:function(e,t){if(e=+e,t=+t,this._point){var n=this._x2-e,i=this._y2-t;this._l23_a=Math.sqrt(this._l23_2a=Math.pow(n*n+i*i,this._alpha))}switch(this._point){case 0:this._point=1,this._x3=e,this._y3=t;break;case 1:this._point=2,this._context.moveTo(this._x4=e,this._y4=t);break;case 2:this._point=3,this._x5=e,this._y5=t;break;default:C0(this,e,t);break}this._l01_a=this._l12_a,this._l12_a=this._l23_a,this._l01_2a=this._l12_2a,this._l12_2a=this._l23_2a,this._x0=this._x1,this._x1=this._x2,this._x2=e,this._y0=this._y1,this._y1=this._y2,this._y2=t}};var jM=(function e(t){function n(i){return t?new KM(i,t):new A0(i,0)}return n.alpha=function(i){return e(+i)},n})(.5);function QM(e,t){this._context=e,this._alpha=t}QM.prototype={areaStart:function(){this._line=0},areaEnd:function(){this._line=NaN},lineStart:function(){this._x0=this._x1=this._x2=this._y0=this._y1=this._y2=NaN,this._l01_a=this._l12_a=this._l23_a=this._l01_2a=this._l12_2a=this._l23_2a=this._point=0},lineEnd:function(){(this._line||this._line!==0&&this._point===3)&&this._context.closePath(),this._line=1-this._line},point:function(e,t){if(e=+e,t=+t,this._point){var n=this._x2-e,i=this._y2-t;this._l23_a=Math.sqrt(this._l23_2a=Math.pow(n*n+i*i,this._alpha))}switch(this._point){case 0:this._point=1;break;case 1:this._point=2;break;case 2:this._point=3,this._line?this._context.lineTo(this._x2,this._y2):this._context.moveTo(this._x2,this._y2);break;case 3:this._point=4;default:C0(this,e,t);break}this._l01_a=this._l12_a,this._l12_a=this._l23_a,this._l01_2a=this._l12_2a,this._l12_2a=this._l23_2a,this._x0=this._x1,this._x1=this._x2,this._x2=e,this._y0=this._y1,this._y1=this._y2,this._y2=t}};var tS=(function e(t){function n(i){return t?new QM(i,t):new E0(i,0)}return n.alpha=function(i){return e(+i)},n})(.5);function eS(e){this._context=e}eS.prototype={areaStart:as,areaEnd:as,lineStart:function(){this._point=0},lineEnd:function(){this._point&&this._context.closePath()},point:function(e,t){e=+e,t=+t,this._point?this._context.lineTo(e,t):(this._point=1,this._context.moveTo(e,t))}};function nS(e){return new eS(e)}function TM(e){return e<0?-1:1}function AM(e,t,n){var i=e._x1-e._x0,r=t-e._x1,s=(e._y1-e._y0)/(i||r<0&&-0),o=(n-e._y1)/(r||i<0&&-0),a=(s*r+o*i)/(i+r);return(TM(s)+TM(o))*Math.min(Math.abs(s),Math.abs(o),.5*Math.abs(a))||0}function EM(e,t){var n=e._x1-e._x0;return n?(3*(e._y1-e._y0)/n-t)/2:t}function u0(e,t,n){var i=e._x0,r=e._y0,s=e._x1,o=e._y1,a=(s-i)/3;e._context.bezierCurveTo(i+a,r+a*t,s-a,o-a*n,s,o)}function _f(e){this._context=e}_f.prototype={areaStart:function(){this._line=0},areaEnd:function(){this._line=NaN},lineStart:function(){this._x0=this._x1=this._y0=this._y1=this._t0=NaN,this._point=0},lineEnd:function(){switch(this._point){case 2:this._context.lineTo(this._x1,this._y1);break;case 3:u0(this,this._t0,EM(this,this._t0));break}(this._line||this._line!==0&&this._point===1)&&this._context.closePath(),this._line=1-this._line},point:function(e,t){var n=NaN;if(e=+e,t=+t,!(e===this._x1&&t===this._y1)){switch(this._point){case 0:this._point=1,this._line?this._context.lineTo(e,t):this._context.moveTo(e,t);break;case 1:this._point=2;break;case 2:this._point=3,u0(this,EM(this,n=AM(this,e,t)),n);break;default:u0(this,this._t0,n=AM(this,e,t));break}this._x0=this._x1,this._x1=e,this._y0=this._y1,this._y1=t,this._t0=n}}};function iS(e){this._context=new rS(e)}(iS.prototype=Object.create(_f.prototype)).point=function(e,t){_f.prototype.point.call(this,t,e)};function rS(e){this._context=e}rS.prototype={moveTo:function(e,t){this._context.moveTo(t,e)},closePath:function(){this._context.closePath()},lineTo:function(e,t){this._context.lineTo(t,e)},bezierCurveTo:function(e,t,n,i,r,s){this._context.bezierCurveTo(t,e,i,n,s,r)}};function sS(e){return new _f(e)}function oS(e){return new iS(e)}function aS(e){this._context=e}aS.prototype={areaStart:function(){this._line=0},areaEnd:function(){this._line=NaN},lineStart:function(){this._x=[],this._y=[]},lineEnd:function(){var e=this._x,t=this._y,n=e.length;if(n)if(this._line?this._context.lineTo(e[0],t[0]):this._context.moveTo(e[0],t[0]),n===2)this._context.lineTo(e[1],t[1]);else for(var i=CM(e),r=CM(t),s=0,o=1;o<n;++s,++o)this._context.bezierCurveTo(i[0][s],r[0][s],i[1][s],r[1][s],e[o],t[o]);(this._line||this._line!==0&&n===1)&&this._context.closePath(),this._line=1-this._line,this._x=this._y=null},point:function(e,t){this._x.push(+e),this._y.push(+t)}};function CM(e){var t,n=e.length-1,i,r=new Array(n),s=new Array(n),o=new Array(n);for(r[0]=0,s[0]=2,o[0]=e[0]+2*e[1],t=1;t<n-1;++t)r[t]=1,s[t]=4,o[t]=4*e[t]+2*e[t+1];for(r[n-1]=2,s[n-1]=7,o[n-1]=8*e[n-1]+e[n],t=1;t<n;++t)i=r[t]/s[t-1],s[t]-=i,o[t]-=i*o[t-1];for(r[n-1]=o[n-1]/s[n-1],t=n-2;t>=0;--t)r[t]=(o[t]-r[t+1])/s[t];for(s[n-1]=(e[n]+r[n-1])/2,t=0;t<n-1;++t)s[t]=2*e[t+1]-r[t+1];return[r,s]}function cS(e){return new aS(e)}function bf(e,t){this._context=e,this._t=t}bf.prototype={areaStart:function(){this._line=0},areaEnd:function(){this._line=NaN},lineStart:function(){this._x=this._y=NaN,this._point=0},lineEnd:function(){0<this._t&&this._t<1&&this._point===2&&this._context.lineTo(this._x,this._y),(this._line||this._line!==0&&this._point===1)&&this._context.closePath(),this._line>=0&&(this._t=1-this._t,this._line=1-this._line)},point:function(e,t){switch(e=+e,t=+t,this._point){case 0:this._point=1,this._line?this._context.lineTo(e,t):this._context.moveTo(e,t);break;case 1:this._point=2;default:{if(this._t<=0)this._context.lineTo(this._x,t),this._context.lineTo(e,t);else{var n=this._x*(1-this._t)+e*this._t;this._context.lineTo(n,this._y),this._context.lineTo(n,t)}break}}this._x=e,this._y=t}};function lS(e){return new bf(e,.5)}function uS(e){return new bf(e,0)}function fS(e){return new bf(e,1)}function bi(e){return e!=null&&!Number.isNaN(e)}function zn(e,t){return+bi(t)-+bi(e)||vn(e,t)}function fo(e,t){return+bi(t)-+bi(e)||Mr(e,t)}function Kc(e){return e!=null&&`${e}`!=""}function R0(e){return isFinite(e)?e:NaN}function ho(e){return e>0&&isFinite(e)?e:NaN}function sa(e){return e<0&&isFinite(e)?e:NaN}function Mf(e,t){if(e instanceof Date||(e=new Date(+e)),isNaN(e))return typeof t=="function"?t(e):t;let n=e.getUTCHours(),i=e.getUTCMinutes(),r=e.getUTCSeconds(),s=e.getUTCMilliseconds();return`${lL(e.getUTCFullYear(),4)}-${Ir(e.getUTCMonth()+1,2)}-${Ir(e.getUTCDate(),2)}${n||i||r||s?`T${Ir(n,2)}:${Ir(i,2)}${r||s?`:${Ir(r,2)}${s?`.${Ir(s,3)}`:""}`:""}Z`:""}`}function lL(e){return e<0?`-${Ir(-e,6)}`:e>9999?`+${Ir(e,6)}`:Ir(e,4)}function Ir(e,t){return`${e}`.padStart(t,"0")}var uL=/^(?:[-+]\d{2})?\d{4}(?:-\d{2}(?:-\d{2})?)?(?:T\d{2}:\d{2}(?::\d{2}(?:\.\d{3})?)?(?:Z|[-+]\d{2}:?\d{2})?)?$/;function jc(e,t){return uL.test(e+="")?new Date(e):typeof t=="function"?t(e):t}function Lr(e){if(e==null)return;let t=e[0],n=e[e.length-1];return Mr(t,n)}var aa=1e3,ls=aa*60,us=ls*60,ar=us*24,or=ar*7,po=ar*30,cs=ar*365,P0=[["millisecond",1],["2 milliseconds",2],["5 milliseconds",5],["10 milliseconds",10],["20 milliseconds",20],["50 milliseconds",50],["100 milliseconds",100],["200 milliseconds",200],["500 milliseconds",500],["second",aa],["5 seconds",5*aa],["15 seconds",15*aa],["30 seconds",30*aa],["minute",ls],["5 minutes",5*ls],["15 minutes",15*ls],["30 minutes",30*ls],["hour",us],["3 hours",3*us],["6 hours",6*us],["12 hours",12*us],["day",ar],["2 days",2*ar],["week",or],["2 weeks",2*or],["month",po],["3 months",3*po],["6 months",6*po],["year",cs],["2 years",2*cs],["5 years",5*cs],["10 years",10*cs],["20 years",20*cs],["50 years",50*cs],["100 years",100*cs]],I0=new Map([["second",aa],["minute",ls],["hour",us],["day",ar],["monday",or],["tuesday",or],["wednesday",or],["thursday",or],["friday",or],["saturday",or],["sunday",or],["week",or],["month",po],["year",cs]]),dS=new Map([["second",Rn],["minute",to],["hour",no],["day",er],["monday",so],["tuesday",Dm],["wednesday",Um],["thursday",Rr],["friday",Fm],["saturday",Om],["sunday",nr],["week",nr],["month",co],["year",Bn]]),L0=new Map([["second",Rn],["minute",eo],["hour",io],["day",kc],["monday",ao],["tuesday",Bm],["wednesday",km],["thursday",Pr],["friday",zm],["saturday",Gm],["sunday",ir],["week",ir],["month",lo],["year",kn]]),ca=Symbol("intervalDuration"),wf=Symbol("intervalType");for(let[e,t]of dS)t[ca]=I0.get(e),t[wf]="time";for(let[e,t]of L0)t[ca]=I0.get(e),t[wf]="utc";var Qc=[["year",kn,"utc"],["month",lo,"utc"],["day",kc,"utc",6*po],["hour",io,"utc",3*ar],["minute",eo,"utc",6*us],["second",Rn,"utc",30*ls]],Sf=[["year",Bn,"time"],["month",co,"time"],["day",er,"time",6*po],["hour",no,"time",3*ar],["minute",to,"time",6*us],["second",Rn,"time",30*ls]],fL=[Qc[0],Sf[0],Qc[1],Sf[1],Qc[2],Sf[2],...Qc.slice(3)];function pS(e){let t=`${e}`.toLowerCase();t.endsWith("s")&&(t=t.slice(0,-1));let n=1,i=/^(?:(\d+)\s+)/.exec(t);switch(i&&(t=t.slice(i[0].length),n=+i[1]),t){case"quarter":t="month",n*=3;break;case"half":t="month",n*=6;break}let r=L0.get(t);if(!r)throw new Error(`unknown interval: ${e}`);if(n>1&&!r.every)throw new Error(`non-periodic interval: ${t}`);return[t,n]}function N0(e){return mS(pS(e),"time")}function D0(e){return mS(pS(e),"utc")}function mS([e,t],n){let i=(n==="time"?dS:L0).get(e);return t>1&&(i=i.every(t),i[ca]=I0.get(e)*t,i[wf]=n),i}function U0(e,t){if(!(t>1))return;let n=e[ca];if(!P0.some(([,r])=>r===n)||n%ar===0&&ar<n&&n<po)return;let[i]=P0[Fo(([,r])=>Math.log(r)).center(P0,Math.log(n*t))];return(e[wf]==="time"?N0:D0)(i)}function hS(e,t,n){let i=t==="time"?Hc:rr;if(n==null)return i(e==="year"?"%Y":e==="month"?"%Y-%m":e==="day"?"%Y-%m-%d":e==="hour"||e==="minute"?"%Y-%m-%dT%H:%M":e==="second"?"%Y-%m-%dT%H:%M:%S":"%Y-%m-%dT%H:%M:%S.%L");let r=hL(n);switch(e){case"millisecond":return oa(i(".%L"),i(":%M:%S"),r);case"second":return oa(i(":%S"),i("%-I:%M"),r);case"minute":return oa(i("%-I:%M"),i("%p"),r);case"hour":return oa(i("%-I %p"),i("%b %-d"),r);case"day":return oa(i("%-d"),i("%b"),r);case"month":return oa(i("%b"),i("%Y"),r);case"year":return i("%Y")}throw new Error("unable to format time ticks")}function hL(e){return e==="left"||e==="right"?(t,n)=>`
${t}
${n}`:e==="top"?(t,n)=>`${n}
${t}`:(t,n)=>`${t}
${n}`}function dL(e){return e==="time"?Sf:e==="utc"?Qc:fL}function gS(e,t,n){let i=An(mv(t,(r,s)=>Math.abs(s-r)));if(i<1e3)return hS("millisecond","utc",n);for(let[r,s,o,a]of dL(e)){if(i>a||r==="hour"&&!i)break;if(t.every(c=>s.floor(c)>=c))return hS(r,o,n)}}function oa(e,t,n){return(i,r,s)=>{let o=e(i,r),a=t(i,r),c=r-Lr(s);return r!==c&&s[c]!==void 0&&a===t(s[c],c)?o:n(o,a)}}var O0=Object.getPrototypeOf(Uint8Array),pL=Object.prototype.toString;function Ui(e){return e instanceof Array||e instanceof O0}function xS(e){return e instanceof O0&&!mL(e)}function vS(e){return e?.prototype instanceof O0&&!gL(e)}function mL(e){return e instanceof BigInt64Array||e instanceof BigUint64Array}function gL(e){return e===BigInt64Array||e===BigUint64Array}var B0=Symbol("reindex");function nn(e,t,n){let i=typeof t;return i==="string"?BS(e)?k0(e.getChild(t),n):yS(e,z0(t),n):i==="function"?yS(e,t,n):i==="number"||t instanceof Date||i==="boolean"?Se(e,qn(t),n):typeof t?.transform=="function"?F0(t.transform(e),n):yL(F0(t,n),e?.[B0])}function yL(e,t){return e!=null&&t?Af(e,t):e}function yS(e,t,n){return Se(e,vS(n)?(i,r)=>V0(t(i,r)):t,n)}function F0(e,t){return t===void 0?cr(e):kS(e)?k0(e,t):e instanceof t?e:t.from(e,vS(t)&&!xS(e)?V0:void 0)}function k0(e,t){return e==null?e:(t===void 0||t===Array)&&ML(e.type)?H0(_S(e)):F0(_S(e),t)}function _S(e){return e.nullCount?e.toJSON():e.toArray()}var la=[null],z0=e=>t=>{let n=t[e];return n===void 0&&t.type==="Feature"?t.properties?.[e]:n},Nr={transform:Gn},be={transform:e=>e};var bS=()=>1,MS=()=>!0,Ue=e=>e==null?e:`${e}`,Fe=e=>e==null?e:+e;var G0=e=>e?e[0]:void 0,SS=e=>e?e[1]:void 0;var qn=e=>()=>e;function wS(e){let t=+`${e}`.slice(1)/100;return(n,i)=>$s(n,t,i)}function mo(e){return xS(e)?e:Se(e,V0,Float64Array)}function V0(e){return e==null?NaN:Number(e)}function H0(e){return Se(e,_L)}function _L(e){return e instanceof Date&&!isNaN(e)?e:typeof e=="string"?jc(e):e==null||isNaN(e=Number(e))?void 0:new Date(e)}function Di(e,t){return e===void 0&&(e=t),e===null?[void 0,"none"]:ha(e)?[void 0,e]:[e,void 0]}function Ie(e,t){return e===void 0&&(e=t),e===null||typeof e=="number"?[void 0,e]:[e,void 0]}function W0(e,t,n){if(e!=null)return Pn(e,t,n)}function Pn(e,t,n){let i=`${e}`.toLowerCase();if(!n.includes(i))throw new Error(`invalid ${t}: ${e}`);return i}function Dr(e){return BS(e)?e:cr(e)}function cr(e){if(e==null||Ui(e))return e;if(kS(e))return k0(e);if(TS(e))switch(e.type){case"FeatureCollection":return e.features;case"GeometryCollection":return e.geometries;default:return[e]}return Array.from(e)}function TS(e){switch(e?.type){case"FeatureCollection":case"GeometryCollection":case"Feature":case"LineString":case"MultiLineString":case"MultiPoint":case"MultiPolygon":case"Point":case"Polygon":case"Sphere":return!0;default:return!1}}function Se(e,t,n=Array){return e==null?e:e instanceof n?e.map(t):n.from(e,t)}function fs(e,t=Array){return e instanceof t?e.slice():t.from(e)}function $0({x:e,x1:t,x2:n}){return e!==void 0||t!==void 0||n!==void 0}function X0({y:e,y1:t,y2:n}){return e!==void 0||t!==void 0||n!==void 0}function tl(e){return $0(e)||X0(e)||e.interval!==void 0}function lr(e){return e?.toString===pL}function ua(e){return lr(e)&&(e.type!==void 0||e.domain!==void 0)}function fa(e){return lr(e)&&typeof e.transform!="function"}function hs(e){return fa(e)&&e.value===void 0&&e.channel===void 0}function q0(e,t,n,i=be){return t===void 0&&n===void 0?(t=0,n=e===void 0?i:e):t===void 0?t=e===void 0?0:e:n===void 0&&(n=e===void 0?0:e),[t,n]}function Fi(e,t){return e===void 0&&t===void 0?[G0,SS]:[e,t]}function Tf({z:e,fill:t,stroke:n}={}){return e===void 0&&([e]=Di(t)),e===void 0&&([e]=Di(n)),e}function ds(e){return Ui(e)?e.length:e?.numRows}function Gn(e){let t=ds(e),n=new Uint32Array(t);for(let i=0;i<t;++i)n[i]=i;return n}function Af(e,t){return Ui(e)?Se(t,n=>e[n],e.constructor):Se(t,n=>e.at(n))}function AS(e,t,n){return e.subarray?e.subarray(t,n):e.slice(t,n)}function Mi(e){return e!==null&&typeof e=="object"?e.valueOf():e}function el(e){let t;return[{transform:()=>t,label:ps(e)},n=>t=n]}function ES(e){return e==null?[e]:el(e)}function ps(e,t){return typeof e=="string"?e:e&&e.label!==void 0?e.label:t}function Y0(e,t){return{transform(n){let i=e.transform(n),r=t.transform(n);return en(i)||en(r)?Se(i,(s,o)=>new Date((+i[o]+ +r[o])/2)):Se(i,(s,o)=>(+i[o]+ +r[o])/2,Float64Array)},label:e.label}}function CS(e,t){let n=Z0(t?.interval,t?.type);return n?Se(e,n):e}function Z0(e,t){let n=Ef(e,t);return n&&(i=>bi(i)?n.floor(i):i)}function Ef(e,t){if(e!=null){if(typeof e=="number")return xL(e);if(typeof e=="string")return(t==="time"?N0:D0)(e);if(typeof e.floor!="function")throw new Error("invalid interval; missing floor method");if(typeof e.offset!="function")throw new Error("invalid interval; missing offset method");return e}}function xL(e){e=+e,0<e&&e<1&&Number.isInteger(1/e)&&(e=-1/e);let t=Math.abs(e);return e<0?{floor:n=>Math.floor(n*t)/t,offset:(n,i=1)=>(n*t+Math.floor(i))/t,range:(n,i)=>ko(Math.ceil(n*t),i*t).map(r=>r/t)}:{floor:n=>Math.floor(n/t)*t,offset:(n,i=1)=>n+t*Math.floor(i),range:(n,i)=>ko(Math.ceil(n/t),i/t).map(r=>r*t)}}function ms(e,t){if(e=Ef(e,t),e&&typeof e.range!="function")throw new Error("invalid interval: missing range method");return e}function RS(e,t){if(e=ms(e,t),e&&typeof e.ceil!="function")throw new Error("invalid interval: missing ceil method");return e}function PS(e){return typeof e?.range=="function"}function gs(e){return e===void 0||fa(e)?e:{value:e}}function IS(e){return e==null?null:{transform:t=>nn(t,e,Float64Array),label:ps(e)}}function Si(e){return e&&typeof e[Symbol.iterator]=="function"}function Cf(e){for(let t of e)if(t!=null)return typeof t!="object"||t instanceof Date}function J0(e){for(let t of e){if(t==null)continue;let n=typeof t;return n==="string"||n==="boolean"}}function en(e){for(let t of e)if(t!=null)return t instanceof Date}function LS(e){for(let t of e)if(t!=null)return typeof t=="string"&&isNaN(t)&&jc(t)}function NS(e){for(let t of e)if(t!=null){if(typeof t!="string")return!1;if(t.trim())return!isNaN(t)}}function DS(e){for(let t of e)if(t!=null)return typeof t=="number"}function Rf(e,t){let n;for(let i of e)if(i!=null){if(!t(i))return!1;n=!0}return n}var vL=new Set("none,currentcolor,transparent,aliceblue,antiquewhite,aqua,aquamarine,azure,beige,bisque,black,blanchedalmond,blue,blueviolet,brown,burlywood,cadetblue,chartreuse,chocolate,coral,cornflowerblue,cornsilk,crimson,cyan,darkblue,darkcyan,darkgoldenrod,darkgray,darkgreen,darkgrey,darkkhaki,darkmagenta,darkolivegreen,darkorange,darkorchid,darkred,darksalmon,darkseagreen,darkslateblue,darkslategray,darkslategrey,darkturquoise,darkviolet,deeppink,deepskyblue,dimgray,dimgrey,dodgerblue,firebrick,floralwhite,forestgreen,fuchsia,gainsboro,ghostwhite,gold,goldenrod,gray,green,greenyellow,grey,honeydew,hotpink,indianred,indigo,ivory,khaki,lavender,lavenderblush,lawngreen,lemonchiffon,lightblue,lightcoral,lightcyan,lightgoldenrodyellow,lightgray,lightgreen,lightgrey,lightpink,lightsalmon,lightseagreen,lightskyblue,lightslategray,lightslategrey,lightsteelblue,lightyellow,lime,limegreen,linen,magenta,maroon,mediumaquamarine,mediumblue,mediumorchid,mediumpurple,mediumseagreen,mediumslateblue,mediumspringgreen,mediumturquoise,mediumvioletred,midnightblue,mintcream,mistyrose,moccasin,navajowhite,navy,oldlace,olive,olivedrab,orange,orangered,orchid,palegoldenrod,palegreen,paleturquoise,palevioletred,papayawhip,peachpuff,peru,pink,plum,powderblue,purple,rebeccapurple,red,rosybrown,royalblue,saddlebrown,salmon,sandybrown,seagreen,seashell,sienna,silver,skyblue,slateblue,slategray,slategrey,snow,springgreen,steelblue,tan,teal,thistle,tomato,turquoise,violet,wheat,white,whitesmoke,yellow".split(","));function ha(e){return typeof e!="string"?!1:(e=e.toLowerCase().trim(),/^#[0-9a-f]{3,8}$/.test(e)||/^(?:url|var|rgb|rgba|hsl|hsla|hwb|lab|lch|oklab|oklch|color|color-mix)\(.*\)$/.test(e)||vL.has(e))}function US(e){return typeof e=="number"&&(0<=e&&e<=1||isNaN(e))}function rn(e){return e==null||go(e)}function go(e){return/^\s*none\s*$/i.test(e)}function FS(e){return/^\s*round\s*$/i.test(e)}function Pf(e,t){return W0(e,t,["middle","top-left","top","top-right","right","bottom-right","bottom","bottom-left","left"])}function ys(e="middle"){return Pf(e,"frameAnchor")}function OS(e={},...t){let n=e;for(let i of t)for(let r in i)if(n[r]===void 0){let s=i[r];n===e?n={...n,[r]:s}:n[r]=s}return n}function bL(e){console.warn("named iterables are deprecated; please use an object instead");let t=new Set;return Object.fromEntries(Array.from(e,n=>{let{name:i}=n;if(i==null)throw new Error("missing name");let r=`${i}`;if(r==="__proto__")throw new Error(`illegal name: ${r}`);if(t.has(r))throw new Error(`duplicate name: ${r}`);return t.add(r),[i,n]}))}function K0(e){return Si(e)?bL(e):e}function If(e){return e===!0?e="frame":e===!1?e=null:!TS(e)&&e!=null&&(e=Pn(e,"clip",["frame","sphere"]),e==="sphere"&&(e={type:"Sphere"})),e}function BS(e){return e&&typeof e.getChild=="function"&&typeof e.toArray=="function"&&e.schema&&Array.isArray(e.schema.fields)}function kS(e){return e&&typeof e.toArray=="function"&&e.type}function ML(e){return e&&(e.typeId===8||e.typeId===10)&&e.unit===1}var wi=Symbol("position"),Yn=Symbol("color"),yo=Symbol("radius"),_o=Symbol("length"),xo=Symbol("opacity"),da=Symbol("symbol"),zS=Symbol("projection"),_e=new Map([["x",wi],["y",wi],["fx",wi],["fy",wi],["r",yo],["color",Yn],["opacity",xo],["symbol",da],["length",_o],["projection",zS]]);function GS(e){return e===wi||e===zS}function VS(e){return e===wi||e===yo||e===_o||e===xo}var SL=Math.sqrt(3),wL=2/SL,TL={draw(e,t){let n=Math.sqrt(t/Math.PI),i=n*wL,r=i/2;e.moveTo(0,i),e.lineTo(n,r),e.lineTo(n,-r),e.lineTo(0,-i),e.lineTo(-n,-r),e.lineTo(-n,r),e.closePath()}},j0=new Map([["asterisk",d0],["circle",uo],["cross",p0],["diamond",m0],["diamond2",g0],["hexagon",TL],["plus",y0],["square",_0],["square2",x0],["star",v0],["times",w0],["triangle",b0],["triangle2",M0],["wye",S0]]);function Q0(e){return e&&typeof e.draw=="function"}function HS(e){return Q0(e)?!0:typeof e!="string"?!1:j0.has(e.toLowerCase())}function pa(e){if(e==null||Q0(e))return e;let t=j0.get(`${e}`.toLowerCase());if(t)return t;throw new Error(`invalid symbol: ${e}`)}function WS(e){if(e==null||Q0(e))return[void 0,e];if(typeof e=="string"){let t=j0.get(`${e}`.toLowerCase());if(t)return[void 0,t]}return[e,void 0]}function nl({filter:e,sort:t,reverse:n,transform:i,initializer:r,...s}={},o){if(i===void 0&&(e!=null&&(i=$S(e)),t!=null&&!hs(t)&&(i=ty(i,ny(t))),n&&(i=ty(i,XS))),o!=null&&r!=null)throw new Error("transforms cannot be applied after initializers");return{...s,...(t===null||hs(t))&&{sort:t},transform:ty(i,o)}}function Ur({filter:e,sort:t,reverse:n,initializer:i,...r}={},s){return i===void 0&&(e!=null&&(i=$S(e)),t!=null&&!hs(t)&&(i=ey(i,ny(t))),n&&(i=ey(i,XS))),{...r,...(t===null||hs(t))&&{sort:t},initializer:ey(i,s)}}function ty(e,t){return e==null?t===null?void 0:t:t==null?e===null?void 0:e:function(n,i,r){return{data:n,facets:i}=e.call(this,n,i,r),t.call(this,Dr(n),i,r)}}function ey(e,t){return e==null?t===null?void 0:t:t==null?e===null?void 0:e:function(n,i,r,...s){let o,a,c,l,u,h;return{data:a=n,facets:c=i,channels:o}=e.call(this,n,i,r,...s),{data:u=a,facets:h=c,channels:l}=t.call(this,a,c,{...r,...o},...s),{data:u,facets:h,channels:{...o,...l}}}}function AL(e,t){return(e.initializer!=null?Ur:nl)(e,t)}function $S(e){return(t,n)=>{let i=nn(t,e);return{data:t,facets:n.map(r=>r.filter(s=>i[s]))}}}function XS(e,t){return{data:e,facets:t.map(n=>n.slice().reverse())}}function qS(e,{sort:t,...n}={}){return{...(fa(e)&&e.channel!==void 0?Ur:AL)(n,ny(e)),sort:hs(t)?t:null}}function ny(e){return(typeof e=="function"&&e.length!==1?EL:CL)(e)}function EL(e){return(t,n)=>{let i=Ui(t)?(r,s)=>e(t[r],t[s]):(r,s)=>e(t.get(r),t.get(s));return{data:t,facets:n.map(r=>r.slice().sort(i))}}}function CL(e){let t,n;({channel:t,value:e,order:n}={...gs(e)});let i=t?.startsWith("-");if(i&&(t=t.slice(1)),n===void 0&&(n=i?fo:zn),typeof n!="function")switch(`${n}`.toLowerCase()){case"ascending":n=zn;break;case"descending":n=fo;break;default:throw new Error(`invalid order: ${n}`)}return(r,s,o)=>{let a;if(t===void 0)a=nn(r,e);else{if(o===void 0)throw new Error("channel sort requires an initializer");if(a=o[t],!a)return{};a=a.value}let c=(l,u)=>n(a[l],a[u]);return{data:r,facets:s.map(l=>l.slice().sort(c))}}}function KS(e,t,n=RL){if(e==null)return n(e);if(typeof e.reduceIndex=="function")return e;if(typeof e.reduce=="function"&&lr(e))return PL(e);if(typeof e=="function")return IL(e);if(/^p\d{2}$/i.test(e))return Fr(wS(e));switch(`${e}`.toLowerCase()){case"first":return NL;case"last":return DL;case"identity":return LL;case"count":return ZS;case"distinct":return UL;case"sum":return t==null?ZS:FL;case"proportion":return JS(t,"data");case"proportion-facet":return JS(t,"facet");case"deviation":return Fr(iv);case"min":return Fr(ui);case"min-index":return Fr(uv);case"max":return Fr(An);case"max-index":return Fr(lv);case"mean":return YS(dv);case"median":return YS(_c);case"variance":return Fr(Np);case"mode":return Fr(pv)}return n(e)}function RL(e){throw new Error(`invalid reduce: ${e}`)}function PL(e){return console.warn("deprecated reduce interface; implement reduceIndex instead."),{...e,reduceIndex:e.reduce.bind(e)}}function IL(e){return{reduceIndex(t,n,i){return e(Af(n,t),i)}}}function Fr(e){return{reduceIndex(t,n){return e(t,i=>n[i])}}}function YS(e){return{reduceIndex(t,n){let i=e(t,r=>n[r]);return en(n)?new Date(i):i}}}var LL={reduceIndex(e,t){return Af(t,e)}},NL={reduceIndex(e,t){return t[e[0]]}};var DL={reduceIndex(e,t){return t[e[e.length-1]]}},ZS={label:"Frequency",reduceIndex(e){return e.length}},UL={label:"Distinct",reduceIndex(e,t){let n=new qi;for(let i of e)n.add(t[i]);return n.size}},FL=Fr(Yi);function JS(e,t){return e==null?{scope:t,label:"Frequency",reduceIndex:(n,i,r=1)=>n.length/r}:{scope:t,reduceIndex:(n,i,r=1)=>Yi(n,s=>i[s])/r}}function ma(e,{scale:t,type:n,value:i,filter:r,hint:s,label:o=ps(i)},a){return s===void 0&&typeof i?.transform=="function"&&(s=i.hint),ry(a,{scale:t,type:n,value:nn(e,i),label:o,filter:r,hint:s})}function QS(e,t){return Object.fromEntries(Object.entries(e).map(([n,i])=>[n,ma(t,i,n)]))}function tw(e,t){let n=Object.fromEntries(Object.entries(e).map(([i,{scale:r,value:s}])=>{let o=r==null?null:t[r];return[i,o==null?s:Se(s,o)]}));return n.channels=e,n}function ry(e,t){let{scale:n,value:i}=t;if(n===!0||n==="auto")switch(e){case"fill":case"stroke":case"color":t.scale=n!==!0&&Rf(i,ha)?null:"color",t.defaultScale="color";break;case"fillOpacity":case"strokeOpacity":case"opacity":t.scale=n!==!0&&Rf(i,US)?null:"opacity",t.defaultScale="opacity";break;case"symbol":n!==!0&&Rf(i,HS)?(t.scale=null,t.value=Se(i,pa)):t.scale="symbol",t.defaultScale="symbol";break;default:t.scale=_e.has(e)?e:null;break}else if(n===!1)t.scale=null;else if(n!=null&&!_e.has(n))throw new Error(`unknown scale: ${n}`);return t}function ew(e,t,n,i,r){let{order:s,reverse:o,reduce:a=!0,limit:c}=r;for(let l in r){if(!_e.has(l))continue;let{value:u,order:h=s,reverse:f=o,reduce:d=a,limit:p=c}=gs(r[l]),y=u?.startsWith("-");if(y&&(u=u.slice(1)),h=h===void 0?y!==(u==="width"||u==="height")?iw:nw:kL(h),d==null||d===!1)continue;let m=l==="fx"||l==="fy"?BL(t,i[l]):OL(n,l);if(!m)throw new Error(`missing channel for scale: ${l}`);let g=m.value,[x=0,S=1/0]=Si(p)?p:p<0?[p]:[0,p];if(u==null)m.domain=()=>{let v=Array.from(new qi(g));return f&&(v=v.reverse()),(x!==0||S!==1/0)&&(v=v.slice(x,S)),v};else{let v=u==="data"?e:u==="height"?jS(n,"y1","y2"):u==="width"?jS(n,"x1","x2"):iy(n,u,u==="y"?"y2":u==="x"?"x2":void 0),w=KS(d===!0?"max":d,v);m.domain=()=>{let b=av(Gn(g),_=>w.reduceIndex(_,v),_=>g[_]);return h&&b.sort(h),f&&b.reverse(),(x!==0||S!==1/0)&&(b=b.slice(x,S)),b.map(G0)}}}}function OL(e,t){for(let n in e){let i=e[n];if(i.scale===t)return i}}function BL(e,t){let n=e.original;if(n===e)return t;let i=t.value,r=t.value=[];for(let s=0;s<n.length;++s){let o=i[n[s][0]];for(let a of e[s])r[a]=o}return t}function jS(e,t,n){let i=iy(e,t),r=iy(e,n);return Se(r,(s,o)=>Math.abs(s-i[o]),Float64Array)}function iy(e,t,n){let i=e[t];if(!i&&n!==void 0&&(i=e[n]),i)return i.value;throw new Error(`missing channel: ${t}`)}function kL(e){if(e==null||typeof e=="function")return e;switch(`${e}`.toLowerCase()){case"ascending":return nw;case"descending":return iw}throw new Error(`invalid order: ${e}`)}function nw([e,t],[n,i]){return zn(t,i)||zn(e,n)}function iw([e,t],[n,i]){return fo(t,i)||zn(e,n)}function sy(e,t){let n=e[t];if(n){for(;n.source;)n=n.source;return n.source===null?null:n}}var cw=new Map([["accent",pM],["category10",dM],["dark2",mM],["observable10",gM],["paired",yM],["pastel1",_M],["pastel2",xM],["set1",vM],["set2",bM],["set3",MM],["tableau10",SM]]);function lw(e){return e!=null&&cw.has(`${e}`.toLowerCase())}var rw=new Map([...cw,["brbg",Or(ig,rg)],["prgn",Or(sg,og)],["piyg",Or(ag,cg)],["puor",Or(lg,ug)],["rdbu",Or(ff,qc)],["rdgy",Or(fg,hg)],["rdylbu",Or(hf,Yc)],["rdylgn",Or(dg,pg)],["spectral",Or(mg,gg)],["burd",sw(ff,qc)],["buylrd",sw(hf,Yc)],["blues",sn(Gg,Vg)],["greens",sn(Hg,Wg)],["greys",sn($g,Xg)],["oranges",sn(Kg,jg)],["purples",sn(qg,Yg)],["reds",sn(Zg,Jg)],["turbo",Br(Zc)],["viridis",Br(s0)],["magma",Br(o0)],["inferno",Br(a0)],["plasma",Br(c0)],["cividis",Br(Qg)],["cubehelix",Br(t0)],["warm",Br(e0)],["cool",Br(n0)],["bugn",sn(yg,_g)],["bupu",sn(xg,vg)],["gnbu",sn(bg,Mg)],["orrd",sn(Sg,wg)],["pubu",sn(Eg,Cg)],["pubugn",sn(Tg,Ag)],["purd",sn(Rg,Pg)],["rdpu",sn(Ig,Lg)],["ylgn",sn(Ug,Fg)],["ylgnbu",sn(Ng,Dg)],["ylorbr",sn(Og,Bg)],["ylorrd",sn(kg,zg)],["rainbow",ow(i0)],["sinebow",ow(r0)]]);function sn(e,t){return({length:n})=>n===1?[e[3][1]]:n===2?[e[3][1],e[3][2]]:(n=Math.max(3,Math.floor(n)),n>9?En(t,n):e[n])}function Or(e,t){return({length:n})=>n===2?[e[3][0],e[3][2]]:(n=Math.max(3,Math.floor(n)),n>11?En(t,n):e[n])}function sw(e,t){return({length:n})=>n===2?[e[3][2],e[3][0]]:(n=Math.max(3,Math.floor(n)),n>11?En(i=>t(1-i),n):e[n].slice().reverse())}function Br(e){return({length:t})=>En(e,Math.max(2,Math.floor(t)))}function ow(e){return({length:t})=>En(e,Math.floor(t)+1).slice(0,-1)}function oy(e){let t=`${e}`.toLowerCase();if(!rw.has(t))throw new Error(`unknown ordinal scheme: ${t}`);return rw.get(t)}function il(e,t){let n=oy(e),i=typeof n=="function"?n({length:t}):n;return i.length!==t?i.slice(0,t):i}function uw(e,t="greys"){let n=new Set,[i,r]=il(t,2);for(let s of e)if(s!=null)if(s===!0)n.add(r);else if(s===!1)n.add(i);else return;return[...n]}var aw=new Map([["brbg",rg],["prgn",og],["piyg",cg],["puor",ug],["rdbu",qc],["rdgy",hg],["rdylbu",Yc],["rdylgn",pg],["spectral",gg],["burd",e=>qc(1-e)],["buylrd",e=>Yc(1-e)],["blues",Vg],["greens",Wg],["greys",Xg],["purples",Yg],["reds",Jg],["oranges",jg],["turbo",Zc],["viridis",s0],["magma",o0],["inferno",a0],["plasma",c0],["cividis",Qg],["cubehelix",t0],["warm",e0],["cool",n0],["bugn",_g],["bupu",vg],["gnbu",Mg],["orrd",wg],["pubugn",Ag],["pubu",Cg],["purd",Pg],["rdpu",Lg],["ylgnbu",Dg],["ylgn",Fg],["ylorbr",Bg],["ylorrd",zg],["rainbow",i0],["sinebow",r0]]);function ga(e){let t=`${e}`.toLowerCase();if(!aw.has(t))throw new Error(`unknown quantitative scheme: ${t}`);return aw.get(t)}var zL=new Set(["brbg","prgn","piyg","puor","rdbu","rdgy","rdylbu","rdylgn","spectral","burd","buylrd"]);function fw(e){return e!=null&&zL.has(`${e}`.toLowerCase())}var cy=e=>t=>e(1-t),ay=[0,1],hw=new Map([["number",Ve],["rgb",Js],["hsl",ab],["hcl",ub],["lab",cb]]);function ly(e){let t=`${e}`.toLowerCase();if(!hw.has(t))throw new Error(`unknown interpolator: ${t}`);return hw.get(t)}function _a(e,t,n,{type:i,nice:r,clamp:s,zero:o,domain:a=bw(e,n),unknown:c,round:l,scheme:u,interval:h,range:f=_e.get(e)===yo?WL(n,a):_e.get(e)===_o?$L(n,a):_e.get(e)===xo?ay:void 0,interpolate:d=_e.get(e)===Yn?u==null&&f!==void 0?Js:ga(u!==void 0?u:i==="cyclical"?"rainbow":"turbo"):l?Mc:Ve,reverse:p}){if(a=dw(a),h=ms(h,i),(i==="cyclical"||i==="sequential")&&(i="linear"),typeof d!="function"&&(d=ly(d)),p=!!p,f!==void 0){let y=a.length,m=(f=dw(f)).length;if(y!==m){if(d.length===1)throw new Error("invalid piecewise interpolator");d=rs(d,f),f=void 0}}if(d.length===1?(p&&(d=cy(d),p=!1),f===void 0&&(f=Float64Array.from(a,(y,m)=>m/(a.length-1)),f.length===2&&(f=ay)),t.interpolate((f===ay?qn:rl)(d))):t.interpolate(d),o){let[y,m]=fi(a);(y>0||m<0)&&(a=fs(a),(Lr(a)||1)===Math.sign(y)?a[0]=0:a[a.length-1]=0)}return p&&(a=zo(a)),t.domain(a).unknown(c),r&&(t.nice(GL(r,i)),a=t.domain()),f!==void 0&&t.range(f),s&&t.clamp(s),{type:i,domain:a,range:f,scale:t,interpolate:d,interval:h}}function dw(e){return e=cr(e),e.length>=2?e:[e[0],e[0]]}function GL(e,t){return e===!0?void 0:typeof e=="number"?e:RS(e,t)}function pw(e,t,n){return _a(e,Xc(),t,n)}function mw(e,t,n){return uy(e,t,{...n,exponent:.5})}function uy(e,t,{exponent:n=1,...i}){return _a(e,Zm().exponent(n),t,{...i,type:"pow"})}function gw(e,t,{base:n=10,domain:i=XL(t),...r}){return _a(e,qm().base(n),t,{...r,domain:i})}function yw(e,t,{constant:n=1,...i}){return _a(e,Ym().constant(n),t,i)}function _w(e,t,{range:n,quantiles:i=n===void 0?5:(n=[...n]).length,n:r=i,scheme:s="rdylbu",domain:o=qL(t),unknown:a,interpolate:c,reverse:l}){return n===void 0&&(n=c!==void 0?En(c,r):_e.get(e)===Yn?il(s,r):void 0),o.length>0&&(o=Jm(o,n===void 0?{length:r}:n).quantiles()),Lf(e,t,{domain:o,range:n,reverse:l,unknown:a})}function xw(e,t,{range:n,n:i=n===void 0?5:(n=[...n]).length,scheme:r="rdylbu",domain:s=bw(e,t),unknown:o,interpolate:a,reverse:c}){let[l,u]=fi(s),h;return n===void 0?(h=Bo(l,u,i),h[0]<=l&&h.splice(0,1),h[h.length-1]>=u&&h.pop(),i=h.length+1,n=a!==void 0?En(a,i):_e.get(e)===Yn?il(r,i):void 0):(h=En(Ve(l,u),i+1).slice(1,-1),l instanceof Date&&(h=h.map(f=>new Date(f)))),Lr(cr(s))<0&&h.reverse(),Lf(e,t,{domain:h,range:n,reverse:c,unknown:o})}function Lf(e,t,{domain:n=[0],unknown:i,scheme:r="rdylbu",interpolate:s,range:o=s!==void 0?En(s,n.length+1):_e.get(e)===Yn?il(r,n.length+1):void 0,reverse:a}){n=cr(n);let c=Lr(n);if(!isNaN(c)&&!VL(n,c))throw new Error(`the ${e} scale has a non-monotonic domain`);return a&&(o=zo(o)),{type:"threshold",scale:Km(c<0?zo(n):n,o===void 0?[]:o).unknown(i),domain:n,range:o}}function VL(e,t){for(let n=1,i=e.length,r=e[0];n<i;++n){let s=Mr(r,r=e[n]);if(s!==0&&s!==t)return!1}return!0}function vw(e){return{type:"identity",scale:VS(_e.get(e))?Xm():t=>t}}function ya(e,t=R0){return e.length?[ui(e,({value:n})=>n===void 0?n:ui(n,t)),An(e,({value:n})=>n===void 0?n:An(n,t))]:[0,1]}function bw(e,t){let n=_e.get(e);return(n===yo||n===xo||n===_o?HL:ya)(t)}function HL(e){return[0,e.length?An(e,({value:t})=>t===void 0?t:An(t,R0)):1]}function WL(e,t){let n=e.find(({radius:o})=>o!==void 0);if(n!==void 0)return[0,n.radius];let i=$s(e,.5,({value:o})=>o===void 0?NaN:$s(o,.25,ho)),r=t.map(o=>3*Math.sqrt(o/i)),s=30/An(r);return s<1?r.map(o=>o*s):r}function $L(e,t){let n=_c(e,({value:s})=>s===void 0?NaN:_c(s,Math.abs)),i=t.map(s=>12*s/n),r=60/An(i);return r<1?i.map(s=>s*r):i}function XL(e){for(let{value:t}of e)if(t!==void 0)for(let n of t){if(n>0)return ya(e,ho);if(n<0)return ya(e,sa)}return[1,10]}function qL(e){let t=[];for(let{value:n}of e)if(n!==void 0)for(let i of n)t.push(i);return t}function rl(e){return(t,n)=>i=>e(t+i*(n-t))}var fy=0,hy;function Mw(){let e=fy;return fy=0,hy=void 0,e}function Vn(e){e!==hy&&(hy=e,console.warn(e),++fy)}function Nf(e,t,n,i,{type:r,nice:s,clamp:o,domain:a=ya(i),unknown:c,pivot:l=0,scheme:u,range:h,symmetric:f=!0,interpolate:d=_e.get(e)===Yn?u==null&&h!==void 0?Js:ga(u!==void 0?u:"rdbu"):Ve,reverse:p}){l=+l,a=cr(a);let[y,m]=a;if(a.length>2&&Vn(`Warning: the diverging ${e} scale domain contains extra elements.`),Mr(y,m)<0&&([y,m]=[m,y],p=!p),y=Math.min(y,l),m=Math.max(m,l),typeof d!="function"&&(d=ly(d)),h!==void 0&&(d=d.length===1?rl(d)(...h):rs(d,h)),p&&(d=cy(d)),f){let g=n.apply(l),x=g-n.apply(y),S=n.apply(m)-g;x<S?y=n.invert(g-S):x>S&&(m=n.invert(g+x))}return t.domain([y,l,m]).unknown(c).interpolator(d),o&&t.clamp(o),s&&t.nice(s),{type:r,domain:[y,m],pivot:l,interpolate:d,scale:t}}function Sw(e,t,n){return Nf(e,Qm(),YL,t,n)}function ww(e,t,n){return dy(e,t,{...n,exponent:.5})}function dy(e,t,{exponent:n=1,...i}){return Nf(e,ng().exponent(n=+n),KL(n),t,{...i,type:"diverging-pow"})}function Tw(e,t,{base:n=10,pivot:i=1,domain:r=ya(t,i<0?sa:ho),...s}){return Nf(e,tg().base(n=+n),ZL,t,{domain:r,pivot:i,...s})}function Aw(e,t,{constant:n=1,...i}){return Nf(e,eg().constant(n=+n),jL(n),t,i)}var YL={apply(e){return e},invert(e){return e}},ZL={apply:Math.log,invert:Math.exp},JL={apply(e){return Math.sign(e)*Math.sqrt(Math.abs(e))},invert(e){return Math.sign(e)*(e*e)}};function KL(e){return e===.5?JL:{apply(t){return Math.sign(t)*Math.pow(Math.abs(t),e)},invert(t){return Math.sign(t)*Math.pow(Math.abs(t),1/e)}}}function jL(e){return{apply(t){return Math.sign(t)*Math.log1p(Math.abs(t/e))},invert(t){return Math.sign(t)*Math.expm1(Math.abs(t))*e}}}function Ew(e,t,n,i){return _a(e,t,n,i)}function Cw(e,t,n){return Ew(e,fM(),t,n)}function Rw(e,t,n){return Ew(e,hM(),t,n)}var xa=Symbol("ordinal");function Iw(e,t,n,{type:i,interval:r,domain:s,range:o,reverse:a,hint:c}){return r=ms(r,i),s===void 0&&(s=Fw(n,r,e)),(i==="categorical"||i===xa)&&(i="ordinal"),a&&(s=zo(s)),s=t.domain(s).domain(),o!==void 0&&(typeof o=="function"&&(o=o(s)),t.range(o)),{type:i,domain:s,range:o,scale:t,hint:c,interval:r}}function Lw(e,t,{type:n,interval:i,domain:r,range:s,scheme:o,unknown:a,...c}){i=ms(i,n),r===void 0&&(r=Fw(t,i,e));let l;if(_e.get(e)===da)l=QL(t),s=s===void 0?tN(l):Se(s,pa);else if(_e.get(e)===Yn&&(s===void 0&&(n==="ordinal"||n===xa)&&(s=uw(r,o),s!==void 0&&(o=void 0)),o===void 0&&s===void 0&&(o=n==="ordinal"?"turbo":"observable10"),o!==void 0))if(s!==void 0){let u=ga(o),h=s[0],f=s[1]-s[0];s=({length:d})=>En(p=>u(h+f*p),d)}else s=oy(o);if(a===nf)throw new Error(`implicit unknown on ${e} scale is not supported`);return Iw(e,sf().unknown(a),t,{...c,type:n,domain:r,range:s,hint:l})}function Nw(e,t,{align:n=.5,padding:i=.5,...r}){return Uw(sM().align(n).padding(i),t,r,e)}function Dw(e,t,{align:n=.5,padding:i=.1,paddingInner:r=i,paddingOuter:s=e==="fx"||e==="fy"?0:i,...o}){return Uw(na().align(n).paddingInner(r).paddingOuter(s),t,o,e)}function Uw(e,t,n,i){let{round:r}=n;return r!==void 0&&e.round(r=!!r),e=Iw(i,e,t,n),e.round=r,e}function Fw(e,t,n){let i=new qi;for(let{value:r,domain:s}of e){if(s!==void 0)return s();if(r!==void 0)for(let o of r)i.add(o)}if(t!==void 0){let[r,s]=fi(i).map(t.floor,t);return t.range(r,t.offset(s))}if(i.size>1e4&&_e.get(n)===wi)throw new Error(`implicit ordinal domain of ${n} scale has more than 10,000 values`);return gc(i,zn)}function Pw(e,t){let n;for(let{hint:i}of e){let r=i?.[t];if(r!==void 0){if(n===void 0)n=r;else if(n!==r)return}}return n}function QL(e){return{fill:Pw(e,"fill"),stroke:Pw(e,"stroke")}}function tN(e){return rn(e.fill)?BM:OM}function sl(e,{label:t,inset:n=0,insetTop:i=n,insetRight:r=n,insetBottom:s=n,insetLeft:o=n,round:a,nice:c,clamp:l,zero:u,align:h,padding:f,projection:d,facet:{label:p=t}={},...y}={}){let m={};for(let[g,x]of e){let S=y[g],v=iN(g,x,{round:_e.get(g)===wi?a:void 0,nice:c,clamp:l,zero:u,align:h,padding:f,projection:d,...S});if(v){let{label:w=g==="fx"||g==="fy"?p:t,percent:b,transform:_,inset:M,insetTop:C=M!==void 0?M:g==="y"?i:0,insetRight:E=M!==void 0?M:g==="x"?r:0,insetBottom:I=M!==void 0?M:g==="y"?s:0,insetLeft:R=M!==void 0?M:g==="x"?o:0}=S||{};if(_==null)_=void 0;else if(typeof _!="function")throw new Error("invalid scale transform; not a function");v.percent=!!b,v.label=w===void 0?eN(x,v):w,v.transform=_,g==="x"||g==="fx"?(v.insetLeft=+R,v.insetRight=+E):(g==="y"||g==="fy")&&(v.insetTop=+C,v.insetBottom=+I),m[g]=v}}return m}function my(e){let t={},n={scales:t};for(let[i,r]of Object.entries(e)){let{scale:s,type:o,interval:a,label:c}=r;t[i]=aN(r),n[i]=s,s.type=o,a!=null&&(s.interval=a),c!=null&&(s.label=c)}return n}function Gw(e,t){let{x:n,y:i,fx:r,fy:s}=e,o=r||s?Uf(t):t;r&&Ow(r,o),s&&Bw(s,o);let a=r||s?gy(e,t):t;n&&Ow(n,a),i&&Bw(i,a)}function eN(e=[],t){let n;for(let{label:i}of e)if(i!==void 0){if(n===void 0)n=i;else if(n!==i)return}if(n!==void 0)return!ur(t)&&t.percent&&(n=`${n} (%)`),{inferred:!0,toString:()=>n}}function Vw(e){return Math.sign(Lr(e.domain()))*Math.sign(Lr(e.range()))}function Uf(e){let{marginTop:t,marginRight:n,marginBottom:i,marginLeft:r,width:s,height:o,facet:{marginTop:a,marginRight:c,marginBottom:l,marginLeft:u}}=e;return{marginTop:Math.max(t,a),marginRight:Math.max(n,c),marginBottom:Math.max(i,l),marginLeft:Math.max(r,u),width:s,height:o}}function gy({fx:e,fy:t},n){let{marginTop:i,marginRight:r,marginBottom:s,marginLeft:o,width:a,height:c}=Uf(n);return{marginTop:i,marginRight:r,marginBottom:s,marginLeft:o,width:e?e.scale.bandwidth()+o+r:a,height:t?t.scale.bandwidth()+i+s:c,facet:{width:a,height:c}}}function Ow(e,t){if(e.range===void 0){let{insetLeft:n,insetRight:i}=e,{width:r,marginLeft:s=0,marginRight:o=0}=t,a=s+n,c=r-o-i;e.range=[a,Math.max(a,c)],ur(e)||(e.range=Ww(e)),e.scale.range(e.range)}Hw(e)}function Bw(e,t){if(e.range===void 0){let{insetTop:n,insetBottom:i}=e,{height:r,marginTop:s=0,marginBottom:o=0}=t,a=s+n,c=r-o-i;e.range=[Math.max(a,c),a],ur(e)?e.range.reverse():e.range=Ww(e),e.scale.range(e.range)}Hw(e)}function Hw(e){e.round===void 0&&sN(e)&&nN(e)<=30&&e.scale.round(!0)}function nN({scale:e}){let t=e.domain().length,[n,i]=e.range(),r=e.paddingInner?e.paddingInner():1,s=e.paddingOuter?e.paddingOuter():e.padding(),o=t-r,a=Math.abs(i-n)/Math.max(1,o+s*2);return(a-Math.floor(a))*o}function Ww(e){let t=e.scale.domain().length+yy(e);if(!(t>2))return e.range;let[n,i]=e.range;return Array.from({length:t},(r,s)=>n+s/(t-1)*(i-n))}function iN(e,t=[],n={}){let i=rN(e,t,n);if(n.type===void 0&&n.domain===void 0&&n.range===void 0&&n.interval==null&&e!=="fx"&&e!=="fy"&&ur({type:i})){let r=t.map(({value:s})=>s).filter(s=>s!==void 0);r.some(en)?Vn(`Warning: some data associated with the ${e} scale are dates. Dates are typically associated with a "utc" or "time" scale rather than a "${va(i)}" scale. If you are using a bar mark, you probably want a rect mark with the interval option instead; if you are using a group transform, you probably want a bin transform instead. If you want to treat this data as ordinal, you can specify the interval of the ${e} scale (e.g., d3.utcDay), or you can suppress this warning by setting the type of the ${e} scale to "${va(i)}".`):r.some(LS)?Vn(`Warning: some data associated with the ${e} scale are strings that appear to be dates (e.g., YYYY-MM-DD). If these strings represent dates, you should parse them to Date objects. Dates are typically associated with a "utc" or "time" scale rather than a "${va(i)}" scale. If you are using a bar mark, you probably want a rect mark with the interval option instead; if you are using a group transform, you probably want a bin transform instead. If you want to treat this data as ordinal, you can suppress this warning by setting the type of the ${e} scale to "${va(i)}".`):r.some(NS)&&Vn(`Warning: some data associated with the ${e} scale are strings that appear to be numbers. If these strings represent numbers, you should parse or coerce them to numbers. Numbers are typically associated with a "linear" scale rather than a "${va(i)}" scale. If you want to treat this data as ordinal, you can specify the interval of the ${e} scale (e.g., 1 for integers), or you can suppress this warning by setting the type of the ${e} scale to "${va(i)}".`)}switch(n.type=i,i){case"diverging":case"diverging-sqrt":case"diverging-pow":case"diverging-log":case"diverging-symlog":case"cyclical":case"sequential":case"linear":case"sqrt":case"threshold":case"quantile":case"pow":case"log":case"symlog":n=Df(t,n,mo);break;case"identity":switch(_e.get(e)){case wi:n=Df(t,n,mo);break;case da:n=Df(t,n,oN);break}break;case"utc":case"time":n=Df(t,n,H0);break}switch(i){case"diverging":return Sw(e,t,n);case"diverging-sqrt":return ww(e,t,n);case"diverging-pow":return dy(e,t,n);case"diverging-log":return Tw(e,t,n);case"diverging-symlog":return Aw(e,t,n);case"categorical":case"ordinal":case xa:return Lw(e,t,n);case"cyclical":case"sequential":case"linear":return pw(e,t,n);case"sqrt":return mw(e,t,n);case"threshold":return Lf(e,t,n);case"quantile":return _w(e,t,n);case"quantize":return xw(e,t,n);case"pow":return uy(e,t,n);case"log":return gw(e,t,n);case"symlog":return yw(e,t,n);case"utc":return Rw(e,t,n);case"time":return Cw(e,t,n);case"point":return Nw(e,t,n);case"band":return Dw(e,t,n);case"identity":return vw(e);case void 0:return;default:throw new Error(`unknown scale type: ${i}`)}}function va(e){return typeof e=="symbol"?e.description:e}function kw(e){return typeof e=="string"?`${e}`.toLowerCase():e}var zw={toString:()=>"projection"};function rN(e,t,{type:n,domain:i,range:r,scheme:s,pivot:o,projection:a}){if(n=kw(n),e==="fx"||e==="fy")return"band";(e==="x"||e==="y")&&a!=null&&(n=zw);for(let u of t){let h=kw(u.type);if(h!==void 0){if(n===void 0)n=h;else if(n!==h)throw new Error(`scale incompatible with channel: ${n} !== ${h}`)}}if(n===zw)return;if(n!==void 0)return n;if(i===void 0&&!t.some(({value:u})=>u!==void 0))return;let c=_e.get(e);if(c===yo)return"sqrt";if(c===xo||c===_o)return"linear";if(c===da)return"ordinal";let l=(i??r)?.length;if(l<2||l>2)return py(c);if(i!==void 0){if(J0(i))return py(c);if(en(i))return"utc"}else{let u=t.map(({value:h})=>h).filter(h=>h!==void 0);if(u.some(J0))return py(c);if(u.some(en))return"utc"}if(c===Yn){if(o!=null||fw(s))return"diverging";if(lw(s))return"categorical"}return"linear"}function py(e){switch(e){case wi:return"point";case Yn:return xa;default:return"ordinal"}}function ur({type:e}){return e==="ordinal"||e==="point"||e==="band"||e===xa}function yy({type:e}){return e==="threshold"}function sN({type:e}){return e==="point"||e==="band"}function Zn(e){if(e===void 0)return!0;let t=e.domain(),n=e(t[0]);for(let i=1,r=t.length;i<r;++i)if(e(t[i])-n)return!1;return!0}function Df(e,{domain:t,...n},i){for(let r of e)r.value!==void 0&&(t===void 0&&(t=r.value?.domain),r.value=i(r.value));return{domain:t===void 0?t:i(t),...n}}function oN(e){return Se(e,pa)}function $w(e){return t=>{if(!_e.has(t=`${t}`))throw new Error(`unknown scale: ${t}`);return e[t]}}function aN({scale:e,type:t,domain:n,range:i,interpolate:r,interval:s,transform:o,percent:a,pivot:c}){if(t==="identity")return{type:"identity",apply:u=>u,invert:u=>u};let l=e.unknown?e.unknown():void 0;return{type:t,domain:fs(n),...i!==void 0&&{range:fs(i)},...o!==void 0&&{transform:o},...a&&{percent:a},...l!==void 0&&{unknown:l},...s!==void 0&&{interval:s},...r!==void 0&&{interpolate:r},...e.clamp&&{clamp:e.clamp()},...c!==void 0&&{pivot:c,symmetric:!1},...e.base&&{base:e.base()},...e.exponent&&{exponent:e.exponent()},...e.constant&&{constant:e.constant()},...e.align&&{align:e.align(),round:e.round()},...e.padding&&(e.paddingInner?{paddingInner:e.paddingInner(),paddingOuter:e.paddingOuter()}:{padding:e.padding()}),...e.bandwidth&&{bandwidth:e.bandwidth(),step:e.step()},apply:u=>e(u),...e.invert&&{invert:u=>e.invert(u)}}}function qw(e,t){let{fx:n,fy:i}=sl(e,t),r=n?.scale.domain(),s=i?.scale.domain();return r&&s?ev(r,s).map(([o,a],c)=>({x:o,y:a,i:c})):r?r.map((o,a)=>({x:o,i:a})):s?s.map((o,a)=>({y:o,i:a})):void 0}function Yw(e,{x:t,y:n}){return t&&=My(t),n&&=My(n),e.filter(t&&n?i=>t.has(i.x)&&n.has(i.y):t?i=>t.has(i.x):i=>n.has(i.y)).sort(t&&n?(i,r)=>t.get(i.x)-t.get(r.x)||n.get(i.y)-n.get(r.y):t?(i,r)=>t.get(i.x)-t.get(r.x):(i,r)=>n.get(i.y)-n.get(r.y))}function Of(e,{fx:t,fy:n}){let i=Gn(e),r=t?.value,s=n?.value;return t&&n?es(i,o=>(o.fx=r[o[0]],o.fy=s[o[0]],o),o=>r[o],o=>s[o]):t?es(i,o=>(o.fx=r[o[0]],o),o=>r[o]):es(i,o=>(o.fy=s[o[0]],o),o=>s[o])}function Zw(e,t,{marginTop:n,marginLeft:i}){let r=e?({x:o})=>e(o)-i:()=>0,s=t?({y:o})=>t(o)-n:()=>0;return function(o){this.tagName==="svg"?(this.setAttribute("x",r(o)),this.setAttribute("y",s(o))):this.setAttribute("transform",`translate(${r(o)},${s(o)})`)}}function Jw(e){let t=[],n=new Uint32Array(Yi(e,i=>i.length));for(let i of e){let r=0;for(let s of e)i!==s&&(n.set(s,r),r+=s.length);t.push(n.slice(0,r))}return t}var cN=new Map([["top",_y],["right",by],["bottom",xy],["left",vy],["top-left",Ff(_y,vy)],["top-right",Ff(_y,by)],["bottom-left",Ff(xy,vy)],["bottom-right",Ff(xy,by)],["top-empty",uN],["right-empty",dN],["bottom-empty",fN],["left-empty",hN],["empty",pN]]);function Kw(e){if(e==null)return null;let t=cN.get(`${e}`.toLowerCase());if(t)return t;throw new Error(`invalid facet anchor: ${e}`)}var Xw=new WeakMap;function My(e){let t=Xw.get(e);return t||Xw.set(e,t=new li(Se(e,(n,i)=>[n,i]))),t}function _s(e,t){return My(e).get(t)}function lN(e,t,n){return t=Mi(t),n=Mi(n),e.find(i=>Object.is(Mi(i.x),t)&&Object.is(Mi(i.y),n))}function Bf(e,t,n){return lN(e,t,n)?.empty}function _y(e,{y:t},{y:n}){return t?_s(t,n)===0:!0}function xy(e,{y:t},{y:n}){return t?_s(t,n)===t.length-1:!0}function vy(e,{x:t},{x:n}){return t?_s(t,n)===0:!0}function by(e,{x:t},{x:n}){return t?_s(t,n)===t.length-1:!0}function uN(e,{y:t},{x:n,y:i,empty:r}){if(r)return!1;if(!t)return;let s=_s(t,i);if(s>0)return Bf(e,n,t[s-1])}function fN(e,{y:t},{x:n,y:i,empty:r}){if(r)return!1;if(!t)return;let s=_s(t,i);if(s<t.length-1)return Bf(e,n,t[s+1])}function hN(e,{x:t},{x:n,y:i,empty:r}){if(r)return!1;if(!t)return;let s=_s(t,n);if(s>0)return Bf(e,t[s-1],i)}function dN(e,{x:t},{x:n,y:i,empty:r}){if(r)return!1;if(!t)return;let s=_s(t,n);if(s<t.length-1)return Bf(e,t[s+1],i)}function pN(e,t,{empty:n}){return n}function Ff(e,t){return function(){return e.apply(null,arguments)&&t.apply(null,arguments)}}function kf(e,{channels:{fx:t,fy:n},groups:i}){return t&&n?e.map(({x:r,y:s})=>i.get(r)?.get(s)??[]):t?e.map(({x:r})=>i.get(r)??[]):e.map(({y:r})=>i.get(r)??[])}var jw=Math.PI,kr=2*jw,Sy=.618;function Qw({projection:e,inset:t=0,insetTop:n=t,insetRight:i=t,insetBottom:r=t,insetLeft:s=t}={},o){if(e==null)return;if(typeof e.stream=="function")return e;let a,c,l="frame";if(lr(e)){let w;if({type:e,domain:c,inset:w,insetTop:n=w!==void 0?w:n,insetRight:i=w!==void 0?w:i,insetBottom:r=w!==void 0?w:r,insetLeft:s=w!==void 0?w:s,clip:l=l,...a}=e,e==null)return}typeof e!="function"&&({type:e}=wy(e));let{width:u,height:h,marginLeft:f,marginRight:d,marginTop:p,marginBottom:y}=o,m=u-f-d-s-i,g=h-p-y-n-r;if(e=e?.({width:m,height:g,clip:l,...a}),e==null)return;l=mN(l,f,p,u-d,h-y);let x=f+s,S=p+n,v;if(c!=null){let[[w,b],[_,M]]=Fc(e).bounds(c),C=Math.min(m/(_-w),g/(M-b));C>0?(x-=(C*(w+_)-m)/2,S-=(C*(b+M)-g)/2,v=Oc({point(E,I){this.stream.point(E*C+x,I*C+S)}})):Vn("Warning: the projection could not be fit to the specified domain; using the default scale.")}return v??=x===0&&S===0?tT():Oc({point(w,b){this.stream.point(w+x,b+S)}}),{stream:w=>e.stream(v.stream(l(w)))}}function wy(e){switch(`${e}`.toLowerCase()){case"albers-usa":return Oi(c1,.7463,.4673);case"albers":return zf(Rm,.7463,.4673);case"azimuthal-equal-area":return Oi(f1,4,4);case"azimuthal-equidistant":return Oi(d1,kr,kr);case"conic-conformal":return zf(g1,kr,kr);case"conic-equal-area":return zf(Uc,6.1702,2.9781);case"conic-equidistant":return zf(_1,7.312,3.6282);case"equal-earth":return Oi(v1,5.4133,2.6347);case"equirectangular":return Oi(y1,kr,jw);case"gnomonic":return Oi(M1,3.4641,3.4641);case"identity":return{type:tT};case"reflect-y":return{type:gN};case"mercator":return Oi(p1,kr,kr);case"orthographic":return Oi(w1,2,2);case"stereographic":return Oi(A1,2,2);case"transverse-mercator":return Oi(C1,kr,kr);default:throw new Error(`unknown projection type: ${e}`)}}function mN(e,t,n,i,r){if(e===!1||e==null||typeof e=="number")return s=>s;if(e===!0&&(e="frame"),`${e}`.toLowerCase()==="frame")return Tm(t,n,i,r);throw new Error(`unknown projection clip type: ${e}`)}function Oi(e,t,n){return{type:({width:i,height:r,rotate:s,precision:o=.15,clip:a})=>{let c=e();return o!=null&&c.precision?.(o),s!=null&&c.rotate?.(s),typeof a=="number"&&c.clipAngle?.(a),i!=null&&(c.scale(Math.min(i/t,r/n)),c.translate([i/2,r/2])),c},aspectRatio:n/t}}function zf(e,t,n){let{type:i,aspectRatio:r}=Oi(e,t,n);return{type:s=>{let{parallels:o,domain:a,width:c,height:l}=s,u=i(s);return o!=null&&(u.parallels(o),a===void 0&&c!=null&&u.fitSize([c,l],{type:"Sphere"})),u},aspectRatio:r}}var tT=qn({stream:e=>e}),gN=qn(Oc({point(e,t){this.stream.point(e,-t)}}));function eT(e,t,n,i){let r=n[e],s=n[t],o=r.length,a=n[e]=new Float64Array(o).fill(NaN),c=n[t]=new Float64Array(o).fill(NaN),l,u=i.stream({point(h,f){a[l]=h,c[l]=f}});for(l=0;l<o;++l)u.point(r[l],s[l])}function nT({projection:e}={}){return e==null?!1:typeof e.stream=="function"?!0:(lr(e)&&(e=e.type),e!=null)}function iT(e){if(typeof e?.stream=="function")return Sy;if(lr(e)){let t,n;if({domain:t,type:e,...n}=e,t!=null&&e!=null){let i=typeof e=="string"?wy(e).type:e,[[r,s],[o,a]]=Fc(i({...n,width:100,height:100})).bounds(t),c=(a-s)/(o-r);return c&&isFinite(c)?c<.2?.2:c>5?5:c:Sy}}if(e!=null){if(typeof e!="function"){let{aspectRatio:t}=wy(e);if(t)return t}return Sy}}function rT(e){let t=[],n=[],i={scale:"x",value:t},r={scale:"y",value:n},s={point(o,a){t.push(o),n.push(a)},lineStart(){},lineEnd(){},polygonStart(){},polygonEnd(){},sphere(){}};for(let o of e.value)ss(o,s);return[i,r]}function sT({x:e,y:t}){if(e||t)return e??=n=>n,t??=n=>n,Oc({point(n,i){this.stream.point(e(n),t(i))}})}function ba(e={}){let{document:t=typeof window<"u"?window.document:void 0,clip:n}=e;return{document:t,clip:If(n)}}function le(e,{document:t}){return Ii(Go(e).call(t.documentElement))}var Gf=Symbol("unset");function Vf(e){return(e.length===1?yN:_N)(e)}function yN(e){let t,n=Gf;return i=>(Object.is(n,i)||(n=i,t=e(i)),t)}function _N(e){let t,n;return(...i)=>((n?.length!==i.length||n.some((r,s)=>!Object.is(r,i[s])))&&(n=i,t=e(...i)),t)}var xN=Vf(e=>new Intl.NumberFormat(e)),Uz=Vf((e,t)=>new Intl.DateTimeFormat(e,{timeZone:"UTC",...t&&{month:t}})),Fz=Vf((e,t)=>new Intl.DateTimeFormat(e,{timeZone:"UTC",...t&&{weekday:t}}));function vN(e="en-US"){let t=xN(e);return n=>n!=null&&!isNaN(n)?t.format(n):void 0}function bN(e){return Mf(e,"Invalid Date")}function MN(e="en-US"){let t=vN(e);return n=>(n instanceof Date?bN:typeof n=="number"?t:Ue)(n)}var fr=MN();var fn=(typeof window<"u"?window.devicePixelRatio>1:typeof it>"u")?0:.5,SN=0;function aT(){return`plot-clip-${++SN}`}function cT(e,{title:t,href:n,ariaLabel:i,ariaDescription:r,ariaHidden:s,target:o,fill:a,fillOpacity:c,stroke:l,strokeWidth:u,strokeOpacity:h,strokeLinejoin:f,strokeLinecap:d,strokeMiterlimit:p,strokeDasharray:y,strokeDashoffset:m,opacity:g,mixBlendMode:x,imageFilter:S,paintOrder:v,pointerEvents:w,shapeRendering:b,channels:_},{ariaLabel:M,fill:C="currentColor",fillOpacity:E,stroke:I="none",strokeOpacity:R,strokeWidth:U,strokeLinecap:P,strokeLinejoin:L,strokeMiterlimit:O,paintOrder:D}){C===null&&(a=null,c=null),I===null&&(l=null,h=null),rn(C)?!rn(I)&&(!rn(a)||_?.fill)&&(I="none"):rn(I)&&(!rn(l)||_?.stroke)&&(C="none");let[Y,B]=Di(a,C),[V,q]=Ie(c,E),[rt,ct]=Di(l,I),[$,ot]=Ie(h,R),[ut,st]=Ie(g);go(ct)||(u===void 0&&(u=U),d===void 0&&(d=P),f===void 0&&(f=L),p===void 0&&!FS(f)&&(p=O),!go(B)&&v===void 0&&(v=D));let[at,J]=Ie(u);return C!==null&&(e.fill=Le(B,"currentColor"),e.fillOpacity=ol(q,1)),I!==null&&(e.stroke=Le(ct,"none"),e.strokeWidth=ol(J,1),e.strokeOpacity=ol(ot,1),e.strokeLinejoin=Le(f,"miter"),e.strokeLinecap=Le(d,"butt"),e.strokeMiterlimit=ol(p,4),e.strokeDasharray=Le(y,"none"),e.strokeDashoffset=Le(m,"0")),e.target=Ue(o),e.ariaLabel=Ue(M),e.ariaDescription=Ue(r),e.ariaHidden=Ue(s),e.opacity=ol(st,1),e.mixBlendMode=Le(x,"normal"),e.imageFilter=Le(S,"none"),e.paintOrder=Le(v,"normal"),e.pointerEvents=Le(w,"auto"),e.shapeRendering=Le(b,"auto"),{title:{value:t,optional:!0,filter:null},href:{value:n,optional:!0,filter:null},ariaLabel:{value:i,optional:!0,filter:null},fill:{value:Y,scale:"auto",optional:!0},fillOpacity:{value:V,scale:"auto",optional:!0},stroke:{value:rt,scale:"auto",optional:!0},strokeOpacity:{value:$,scale:"auto",optional:!0},strokeWidth:{value:at,optional:!0},opacity:{value:ut,scale:"auto",optional:!0}}}function wN(e,t){t&&e.filter(n=>Kc(t[n])).append("title").call(AN,t)}function TN(e,t){t&&e.filter(([n])=>Kc(t[n])).append("title").call(EN,t)}function AN(e,t){t&&e.text(n=>fr(t[n]))}function EN(e,t){t&&e.text(([n])=>fr(t[n]))}function hn(e,{target:t,tip:n},{ariaLabel:i,title:r,fill:s,fillOpacity:o,stroke:a,strokeOpacity:c,strokeWidth:l,opacity:u,href:h}){i&&Bt(e,"aria-label",f=>i[f]),s&&Bt(e,"fill",f=>s[f]),o&&Bt(e,"fill-opacity",f=>o[f]),a&&Bt(e,"stroke",f=>a[f]),c&&Bt(e,"stroke-opacity",f=>c[f]),l&&Bt(e,"stroke-width",f=>l[f]),u&&Bt(e,"opacity",f=>u[f]),h&&fT(e,f=>h[f],t),n||wN(e,r)}function lT(e,{target:t,tip:n},{ariaLabel:i,title:r,fill:s,fillOpacity:o,stroke:a,strokeOpacity:c,strokeWidth:l,opacity:u,href:h}){i&&Bt(e,"aria-label",([f])=>i[f]),s&&Bt(e,"fill",([f])=>s[f]),o&&Bt(e,"fill-opacity",([f])=>o[f]),a&&Bt(e,"stroke",([f])=>a[f]),c&&Bt(e,"stroke-opacity",([f])=>c[f]),l&&Bt(e,"stroke-width",([f])=>l[f]),u&&Bt(e,"opacity",([f])=>u[f]),h&&fT(e,([f])=>h[f],t),n||TN(e,r)}function CN({ariaLabel:e,title:t,fill:n,fillOpacity:i,stroke:r,strokeOpacity:s,strokeWidth:o,opacity:a,href:c},{tip:l}){return[e,l?void 0:t,n,i,r,s,o,a,c].filter(u=>u!==void 0)}function RN(e,t,n){let i=Oo(e,r=>t[r]);return n===void 0&&i.size>1+e.length>>1&&Vn("Warning: the implicit z channel has high cardinality. This may occur when the fill or stroke channel is associated with quantitative data rather than ordinal or categorical data. You can suppress this warning by setting the z option explicitly; if this data represents a single series, set z to null."),i.values()}function*uT(e,t,n,i){let{z:r}=n,{z:s}=i,o=CN(i,n),a=[...t,...o];for(let c of s?RN(e,s,r):[e]){let l,u;t:for(let h of c){for(let f of a)if(!bi(f[h])){u&&u.push(-1);continue t}if(l===void 0){u&&(yield u),l=o.map(f=>Mi(f[h])),u=[h];continue}u.push(h);for(let f=0;f<o.length;++f)if(Mi(o[f][h])!==l[f]){yield u,l=o.map(p=>Mi(p[h])),u=[h];continue t}}u&&(yield u)}}function PN(e,t,n,i){let r,{clip:s=i.clip}=t;s==="frame"?(e=le("svg:g",i).each(function(){this.appendChild(e.node()),e.node=()=>this}),r=LN(i,n)):s&&(r=DN(s,i)),Bt(e,"aria-label",t.ariaLabel),Bt(e,"aria-description",t.ariaDescription),Bt(e,"aria-hidden",t.ariaHidden),Bt(e,"clip-path",r)}function IN(e){let t=new WeakMap;return(n,i)=>{let r=t.get(n);if(!r){let s=aT();Ii(n.ownerSVGElement).append("clipPath").attr("id",s).call(e,n,i),t.set(n,r=`url(#${s})`)}return r}}var LN=IN((e,t,n)=>{let{width:i,height:r,marginLeft:s,marginRight:o,marginTop:a,marginBottom:c}=n;e.append("rect").attr("x",s).attr("y",a).attr("width",i-o-s).attr("height",r-a-c)}),oT=new WeakMap,NN={type:"Sphere"};function DN(e,t){let n,i;if((n=oT.get(t))||oT.set(t,n=new WeakMap),e.type==="Sphere"&&(e=NN),!(i=n.get(e))){let r=aT();Ii(t.ownerSVGElement).append("clipPath").attr("id",r).append("path").attr("d",t.path()(e)),n.set(e,i=`url(#${r})`)}return i}function $e(e,t,n,i){PN(e,t,n,i),Bt(e,"class",t.className),Bt(e,"fill",t.fill),Bt(e,"fill-opacity",t.fillOpacity),Bt(e,"stroke",t.stroke),Bt(e,"stroke-width",t.strokeWidth),Bt(e,"stroke-opacity",t.strokeOpacity),Bt(e,"stroke-linejoin",t.strokeLinejoin),Bt(e,"stroke-linecap",t.strokeLinecap),Bt(e,"stroke-miterlimit",t.strokeMiterlimit),Bt(e,"stroke-dasharray",t.strokeDasharray),Bt(e,"stroke-dashoffset",t.strokeDashoffset),Bt(e,"shape-rendering",t.shapeRendering),Bt(e,"filter",t.imageFilter),Bt(e,"paint-order",t.paintOrder);let{pointerEvents:r=i.pointerSticky===!1?"none":void 0}=t;Bt(e,"pointer-events",r)}function Oe(e,t){UN(e,"mix-blend-mode",t.mixBlendMode),Bt(e,"opacity",t.opacity)}function fT(e,t,n){e.each(function(i){let r=t(i);if(r!=null){let s=this.ownerDocument.createElementNS(ns.svg,"a");s.setAttribute("fill","inherit"),s.setAttributeNS(ns.xlink,"href",r),n!=null&&s.setAttribute("target",n),this.parentNode.insertBefore(s,this).appendChild(this)}})}function Bt(e,t,n){n!=null&&e.attr(t,n)}function UN(e,t,n){n!=null&&e.style(t,n)}function Ne(e,t,{x:n,y:i},r=fn,s=fn){r+=t.dx,s+=t.dy,n?.bandwidth&&(r+=n.bandwidth()/2),i?.bandwidth&&(s+=i.bandwidth()/2),(r||s)&&e.attr("transform",`translate(${r},${s})`)}function Le(e,t){if((e=Ue(e))!==t)return e}function ol(e,t){if((e=Fe(e))!==t)return e}var FN=/^-?([_a-z]|[\240-\377]|\\[0-9a-f]{1,6}(\r\n|[ \t\r\n\f])?|\\[^\r\n\f0-9a-f])([_a-z0-9-]|[\240-\377]|\\[0-9a-f]{1,6}(\r\n|[ \t\r\n\f])?|\\[^\r\n\f0-9a-f])*$/i;function Ma(e){if(e===void 0)return"plot-d6a7b5";if(e=`${e}`,!FN.test(e))throw new Error(`invalid class name: ${e}`);return e}function Sa(e,t){if(typeof t=="string")e.property("style",t);else if(t!=null)for(let n of e)Object.assign(n.style,t)}function hr({frameAnchor:e},{width:t,height:n,marginTop:i,marginRight:r,marginBottom:s,marginLeft:o}){return[/left$/.test(e)?o:/right$/.test(e)?t-r:(o+t-r)/2,/^top/.test(e)?i:/^bottom/.test(e)?n-s:(i+n-s)/2]}var we=class{constructor(t,n={},i={},r){let{facet:s="auto",facetAnchor:o,fx:a,fy:c,sort:l,dx:u=0,dy:h=0,margin:f=0,marginTop:d=f,marginRight:p=f,marginBottom:y=f,marginLeft:m=f,className:g,clip:x=r?.clip,channels:S,tip:v,render:w}=i;if(this.data=t,this.sort=hs(l)?l:null,this.initializer=Ur(i).initializer,this.transform=this.initializer?i.transform:nl(i).transform,s===null||s===!1?this.facet=null:(this.facet=Pn(s===!0?"include":s,"facet",["auto","include","exclude","super"]),this.fx=t===la&&typeof a=="string"?[a]:a,this.fy=t===la&&typeof c=="string"?[c]:c),this.facetAnchor=Kw(o),n=K0(n),S!==void 0&&(n={...ON(S),...n}),r!==void 0&&(n={...cT(this,i,r),...n}),this.channels=Object.fromEntries(Object.entries(n).map(([b,_])=>{if(fa(_.value)){let{value:M,label:C=_.label,scale:E=_.scale}=_.value;_={..._,label:C,scale:E,value:M}}if(t===la&&typeof _.value=="string"){let{value:M}=_;_={..._,value:[M]}}return[b,_]}).filter(([b,{value:_,optional:M}])=>{if(_!=null)return!0;if(M)return!1;throw new Error(`missing channel value: ${b}`)})),this.dx=+u,this.dy=+h,this.marginTop=+d,this.marginRight=+p,this.marginBottom=+y,this.marginLeft=+m,this.clip=If(x),this.tip=BN(v),this.className=Ue(g),this.facet==="super"){if(a||c)throw new Error("super-faceting cannot use fx or fy");for(let b in this.channels){let{scale:_}=n[b];if(!(_!=="x"&&_!=="y"))throw new Error("super-faceting cannot use x or y")}}w!=null&&(this.render=Ay(w,this.render))}initialize(t,n,i){let r=Dr(this.data);t===void 0&&r!=null&&(t=[Gn(r)]);let s=t;this.transform!=null&&({facets:t,data:r}=this.transform(r,t,i),r=Dr(r)),t!==void 0&&(t.original=s);let o=QS(this.channels,r);return this.sort!=null&&ew(r,t,o,n,this.sort),{data:r,facets:t,channels:o}}filter(t,n,i){for(let r in n){let{filter:s=bi}=n[r];if(s!==null){let o=i[r];t=t.filter(a=>s(o[a]))}}return t}project(t,n,i){for(let r in t)if(t[r].scale==="x"&&/^x|x$/.test(r)){let s=r.replace(/^x|x$/,"y");s in t&&t[s].scale==="y"&&eT(r,s,n,i.projection)}}scale(t,n,i){let r=tw(t,n);return i.projection&&this.project(t,r,i),r}};function Ty(...e){return e.plot=we.prototype.plot,e}function Ay(e,t){if(e==null)return t===null?void 0:t;if(t==null)return e===null?void 0:e;if(typeof e!="function")throw new TypeError(`invalid render transform: ${e}`);if(typeof t!="function")throw new TypeError(`invalid render transform: ${t}`);return function(n,i,r,s,o,a){return e.call(this,n,i,r,s,o,(c,l,u,h,f)=>t.call(this,c,l,u,h,f,a))}}function ON(e){return Object.fromEntries(Object.entries(K0(e)).map(([t,n])=>(n=typeof n=="string"?{value:n,label:t}:gs(n),n.filter===void 0&&n.scale==null&&(n={...n,filter:null}),[t,n])))}function BN(e){return e===!0?"xy":e===!1||e==null?null:typeof e=="string"?Pn(e,"tip",["x","y","xy"]):e}function wa(e,t){return e?.tip===!0?{...e,tip:t}:lr(e?.tip)&&e.tip.pointer===void 0?{...e,tip:{...e.tip,pointer:t}}:e}function dT(e,t,n={}){let i=.5-fn,r=.5+fn,s=.5+fn,o=.5-fn;for(let{marginTop:y,marginRight:m,marginBottom:g,marginLeft:x}of t)y>i&&(i=y),m>r&&(r=m),g>s&&(s=g),x>o&&(o=x);let{margin:a,marginTop:c=a!==void 0?a:i,marginRight:l=a!==void 0?a:r,marginBottom:u=a!==void 0?a:s,marginLeft:h=a!==void 0?a:o}=n;c=+c,l=+l,u=+u,h=+h;let{width:f=640,height:d=kN(e,n,{width:f,marginTopDefault:i,marginRightDefault:r,marginBottomDefault:s,marginLeftDefault:o})+Math.max(0,c-i+u-s)}=n;f=+f,d=+d;let p={width:f,height:d,marginTop:c,marginRight:l,marginBottom:u,marginLeft:h};if(e.fx||e.fy){let{margin:y,marginTop:m=y!==void 0?y:c,marginRight:g=y!==void 0?y:l,marginBottom:x=y!==void 0?y:u,marginLeft:S=y!==void 0?y:h}=n.facet??{};m=+m,g=+g,x=+x,S=+S,p.facet={marginTop:m,marginRight:g,marginBottom:x,marginLeft:S}}return p}function kN({x:e,y:t,fy:n,fx:i},{projection:r,aspectRatio:s},{width:o,marginTopDefault:a,marginRightDefault:c,marginBottomDefault:l,marginLeftDefault:u}){let h=n&&n.scale.domain().length||1,f=iT(r);if(f){let p=i?i.scale.domain().length:1,y=(1.1*h-.1)/(1.1*p-.1)*f,m=Math.max(.1,Math.min(10,y));return Math.round((o-u-c)*m+a+l)}let d=t?ur(t)?t.scale.domain().length||1:Math.max(7,17/h):1;if(s!=null){if(s=+s,!(isFinite(s)&&s>0))throw new Error(`invalid aspectRatio: ${s}`);let p=hT("y",t)/(hT("x",e)*s),y=i?i.scale.bandwidth():1,m=n?n.scale.bandwidth():1,g=y*(o-u-c)-e.insetLeft-e.insetRight;return(p*g+t.insetTop+t.insetBottom)/m+a+l}return!!(t||n)*Math.max(1,Math.min(60,d*h))*20+!!i*30+60}function hT(e,t){if(!t)throw new Error(`aspectRatio requires ${e} scale`);let{type:n,domain:i}=t,r;switch(n){case"linear":case"utc":case"time":r=Number;break;case"pow":{let a=t.scale.exponent();r=c=>Math.pow(c,a);break}case"log":r=Math.log;break;case"point":case"band":return i.length;default:throw new Error(`unsupported ${e} scale for aspectRatio: ${n}`)}let[s,o]=fi(i);return Math.abs(r(o)-r(s))}var pT=new WeakMap;function Ey(e,t,{x:n,y:i,px:r,py:s,maxRadius:o=40,channels:a,render:c,...l}={}){return o=+o,r!=null&&(n??=null,a={...a,px:{value:r,scale:"x"}}),s!=null&&(i??=null,a={...a,py:{value:s,scale:"y"}}),{x:n,y:i,channels:a,...l,render:Ay(function(u,h,f,d,p,y){p={...p,pointerSticky:!1};let m=p.ownerSVGElement,{data:g}=p.getMarkState(this),x=pT.get(m);x||pT.set(m,x={sticky:!1,roots:[],renders:[]});let S=x.renders.push(ct)-1,{x:v,y:w,fx:b,fy:_}=h,M=b?b(u.fx)-d.marginLeft:0,C=_?_(u.fy)-d.marginTop:0;v?.bandwidth&&(M+=v.bandwidth()/2),w?.bandwidth&&(C+=w.bandwidth()/2);let E=u.fi!=null,I;if(E){let st=x.facetStates;st||(x.facetStates=st=new Map),I=st.get(this),I||st.set(this,I=new Map)}let[R,U]=hr(this,d),{px:P,py:L}=f,O=P?st=>P[st]:Ry(f,R),D=L?st=>L[st]:Py(f,U),Y,B,V,q;function rt(st,at){if(E)if(q&&(q=cancelAnimationFrame(q)),st==null)I.delete(u.fi);else{I.set(u.fi,at),q=requestAnimationFrame(()=>{q=null;for(let[J,_t]of I)if(_t<at||_t===at&&J<u.fi){st=null;break}ct(st)});return}ct(st)}function ct(st){if(Y===st&&V===x.sticky)return;Y=st,V=p.pointerSticky=x.sticky;let at=Y==null?[]:[Y];E&&(at.fx=u.fx,at.fy=u.fy,at.fi=u.fi);let J=y(at,h,f,d,p);if(B){if(E){let _t=B.parentNode,lt=B.getAttribute("transform"),K=J.getAttribute("transform");lt?J.setAttribute("transform",lt):J.removeAttribute("transform"),K?_t.setAttribute("transform",K):_t.removeAttribute("transform"),J.removeAttribute("aria-label"),J.removeAttribute("aria-description"),J.removeAttribute("aria-hidden")}B.replaceWith(J)}if(x.roots[S]=B=J,!(Y==null&&I?.size>1)){let _t=Y==null?null:Ui(g)?g[Y]:g.get(Y);p.dispatchValue(_t)}return J}function $(st){if(x.sticky||st.pointerType==="mouse"&&st.buttons===1)return;let[at,J]=Rv(st);at-=M,J-=C;let _t=at<d.marginLeft||at>d.width-d.marginRight?1:e,lt=J<d.marginTop||J>d.height-d.marginBottom?1:t,K=null,Nt=o*o;for(let Mt of u){let $t=_t*(O(Mt)-at),Zt=lt*(D(Mt)-J),ye=$t*$t+Zt*Zt;ye<=Nt&&(K=Mt,Nt=ye)}if(K!=null&&(e!==1||t!==1)){let Mt=O(K)-at,$t=D(K)-J;Nt=Mt*Mt+$t*$t}rt(K,Nt)}function ot(st){st.pointerType==="mouse"&&Y!=null&&(x.sticky&&x.roots.some(at=>at?.contains(st.target))||(x.sticky?(x.sticky=!1,x.renders.forEach(at=>at(null))):(x.sticky=!0,ct(Y)),st.stopImmediatePropagation()))}function ut(st){st.pointerType==="mouse"&&(x.sticky||rt(null))}return m.addEventListener("pointerenter",$),m.addEventListener("pointermove",$),m.addEventListener("pointerdown",ot),m.addEventListener("pointerleave",ut),ct(null)},c)}}function Ta(e){return Ey(1,1,e)}function Cy(e){return Ey(1,.01,e)}function Hf(e){return Ey(.01,1,e)}function Ry({x1:e,x2:t,x:n=e},i){return e&&t?r=>(e[r]+t[r])/2:n?r=>n[r]:()=>i}function Py({y1:e,y2:t,y:n=e},i){return e&&t?r=>(e[r]+t[r])/2:n?r=>n[r]:()=>i}function Wf(e){return ur(e)&&e.interval===void 0?void 0:"tabular-nums"}function mT(e,t){let{label:n=e.label,tickSize:i=6,width:r=240,height:s=44+i,marginTop:o=18,marginRight:a=0,marginBottom:c=16+i,marginLeft:l=0,style:u,ticks:h=(r-l-a)/64,tickFormat:f,fontVariant:d=Wf(e),round:p=!0,opacity:y,className:m}=t,g=ba(t);m=Ma(m),y=Ie(y)[1],f===null&&(f=()=>null);let x=le("svg",g).attr("class",`${m}-ramp`).attr("font-family","system-ui, sans-serif").attr("font-size",10).attr("width",r).attr("height",s).attr("viewBox",`0 0 ${r} ${s}`).call(R=>R.append("style").text(`:where(.${m}-ramp) {
  display: block;
  height: auto;
  height: intrinsic;
  max-width: 100%;
  overflow: visible;
}
:where(.${m}-ramp text) {
  white-space: pre;
}`)).call(Sa,u),S=R=>R.selectAll(".tick line").attr("y1",o+c-s),v,w=p?(R,U)=>R.rangeRound(U):(R,U)=>R.range(U),{type:b,domain:_,range:M,interpolate:C,scale:E,pivot:I}=e;if(C){let R=M===void 0?C:rs(C.length===1?rl(C):C,M);v=w(E.copy(),En(Ve(l,r-a),Math.min(_.length+(I!==void 0),M===void 0?1/0:M.length)));let U=256,P=g.document.createElement("canvas");P.width=U,P.height=1;let L=P.getContext("2d");for(let O=0,D=U-1;O<U;++O)L.fillStyle=R(O/D),L.fillRect(O,0,1,1);x.append("image").attr("opacity",y).attr("x",l).attr("y",o).attr("width",r-l-a).attr("height",s-o-c).attr("preserveAspectRatio","none").attr("xlink:href",P.toDataURL())}else if(b==="threshold"){let R=_,U=f===void 0?P=>P:typeof f=="string"?ji(f):f;v=w(Xc().domain([-1,M.length-1]),[l,r-a]),x.append("g").attr("fill-opacity",y).selectAll().data(M).enter().append("rect").attr("x",(P,L)=>v(L-1)).attr("y",o).attr("width",(P,L)=>v(L)-v(L-1)).attr("height",s-o-c).attr("fill",P=>P),h=Se(R,(P,L)=>L),f=P=>U(R[P],P)}else v=w(na().domain(_),[l,r-a]),x.append("g").attr("fill-opacity",y).selectAll().data(_).enter().append("rect").attr("x",v).attr("y",o).attr("width",Math.max(0,v.bandwidth()-1)).attr("height",s-o-c).attr("fill",E),S=()=>{};return x.append("g").attr("transform",`translate(0,${s-c})`).call(yv(v).ticks(Array.isArray(h)?null:h,typeof f=="string"?f:void 0).tickFormat(typeof f=="function"?f:void 0).tickSize(i).tickValues(Array.isArray(h)?h:null)).attr("font-size",null).attr("font-family",null).attr("font-variant",Le(d,"normal")).call(S).call(R=>R.select(".domain").remove()),n!==void 0&&x.append("text").attr("x",l).attr("y",o-6).attr("fill","currentColor").attr("font-weight","bold").text(n),x.node()}var Iy=Math.PI/180;function al(e,{marker:t,markerStart:n=t,markerMid:i=t,markerEnd:r=t}={}){e.markerStart=Ly(n),e.markerMid=Ly(i),e.markerEnd=Ly(r)}function Ly(e){if(e==null||e===!1)return null;if(e===!0)return yT;if(typeof e=="function")return e;switch(`${e}`.toLowerCase()){case"none":return null;case"arrow":return gT("auto");case"arrow-reverse":return gT("auto-start-reverse");case"dot":return zN;case"circle":case"circle-fill":return yT;case"circle-stroke":return GN;case"tick":return Ny("auto");case"tick-x":return Ny(90);case"tick-y":return Ny(0)}throw new Error(`invalid marker: ${e}`)}function gT(e){return(t,n)=>le("svg:marker",n).attr("viewBox","-5 -5 10 10").attr("markerWidth",6.67).attr("markerHeight",6.67).attr("orient",e).attr("fill","none").attr("stroke",t).attr("stroke-width",1.5).attr("stroke-linecap","round").attr("stroke-linejoin","round").call(i=>i.append("path").attr("d","M-1.5,-3l3,3l-3,3")).node()}function zN(e,t){return le("svg:marker",t).attr("viewBox","-5 -5 10 10").attr("markerWidth",6.67).attr("markerHeight",6.67).attr("fill",e).attr("stroke","none").call(n=>n.append("circle").attr("r",2.5)).node()}function yT(e,t){return le("svg:marker",t).attr("viewBox","-5 -5 10 10").attr("markerWidth",6.67).attr("markerHeight",6.67).attr("fill",e).attr("stroke","var(--plot-background)").attr("stroke-width",1.5).call(n=>n.append("circle").attr("r",3)).node()}function GN(e,t){return le("svg:marker",t).attr("viewBox","-5 -5 10 10").attr("markerWidth",6.67).attr("markerHeight",6.67).attr("fill","var(--plot-background)").attr("stroke",e).attr("stroke-width",1.5).call(n=>n.append("circle").attr("r",3)).node()}function Ny(e){return(t,n)=>le("svg:marker",n).attr("viewBox","-3 -3 6 6").attr("markerWidth",6).attr("markerHeight",6).attr("orient",e).attr("stroke",t).call(i=>i.append("path").attr("d","M0,-3v6")).node()}var VN=0;function Uy(e,t,{stroke:n},i){return vT(e,t,n&&(r=>n[r]),null,i)}function _T(e,t,{stroke:n,z:i},r){return vT(e,t,n&&(([s])=>n[s]),i,r)}var Dy=1,xT=2;function HN(e,t){let n=new Uint8Array(t.length),i=e.data().filter(s=>s.length>1),r=i.length;for(let s=0,o=Gf;s<r;++s){let a=i[s];if(a.length>1){let c=a[0];o!==(o=Mi(t[c]))&&(n[c]|=Dy)}}for(let s=r-1,o=Gf;s>=0;--s){let a=i[s];if(a.length>1){let c=a[0];o!==(o=Mi(t[c]))&&(n[c]|=xT)}}return([s])=>n[s]}function vT(e,{markerStart:t,markerMid:n,markerEnd:i,stroke:r},s=()=>r,o,a){if(!t&&!n&&!i)return;let c=new Map,l=o&&HN(e,o);function u(h,f,d){return function(p){if(d&&!d(p))return;let y=s(p),m=c.get(f);m||c.set(f,m=new Map);let g=m.get(y);if(!g){let x=this.parentNode.insertBefore(f(y,a),this),S=`plot-marker-${++VN}`;x.setAttribute("id",S),m.set(y,g=`url(#${S})`)}this.setAttribute(h,g)}}t&&e.each(u("marker-start",t,l&&(h=>l(h)&Dy))),n&&l&&e.each(u("marker-start",n,h=>!(l(h)&Dy))),n&&e.each(u("marker-mid",n)),i&&e.each(u("marker-end",i,l&&(h=>l(h)&xT)))}function $f({inset:e,insetLeft:t,insetRight:n,...i}={}){return[t,n]=bT(e,t,n),{inset:e,insetLeft:t,insetRight:n,...i}}function Fy({inset:e,insetTop:t,insetBottom:n,...i}={}){return[t,n]=bT(e,t,n),{inset:e,insetTop:t,insetBottom:n,...i}}function bT(e,t,n){return e===void 0&&t===void 0&&n===void 0?fn?[1,0]:[.5,.5]:[t,n]}function MT(e,{interval:t}){return e={...gs(e)},e.interval=Ef(e.interval===void 0?t:e.interval),e}function Oy(e,t,n,i){let{[e]:r,[`${e}1`]:s,[`${e}2`]:o}=n,{value:a,interval:c}=MT(r,n);if(a==null||c==null&&!i)return n;let l=ps(r);if(c==null){let d,p={transform:y=>d||(d=nn(y,a)),label:l};return{...n,[e]:void 0,[`${e}1`]:s===void 0?p:s,[`${e}2`]:o===void 0&&!(s===o&&i)?p:o}}let u,h;function f(d){return h!==void 0&&d===u?h:h=Se(nn(u=d,a),p=>c.floor(p))}return t({...n,[e]:void 0,[`${e}1`]:s===void 0?{transform:f,label:l}:s,[`${e}2`]:o===void 0?{transform:d=>f(d).map(p=>c.offset(p)),label:l}:o})}function ST(e,t,n){let{[e]:i}=n,{value:r,interval:s}=MT(i,n);return r==null||s==null?n:t({...n,[e]:{label:ps(i),transform:o=>{let a=Se(nn(o,r),l=>s.floor(l)),c=a.map(l=>s.offset(l));return a.map(en(a)?(l,u)=>l==null||isNaN(l=+l)||(u=c[u],u==null)||isNaN(u=+u)?void 0:new Date((l+u)/2):(l,u)=>l==null||(u=c[u],u==null)?NaN:(+l+ +u)/2)}}})}function wT(e={}){return Oy("x",$f,e,!0)}function Xf(e={}){return Oy("x",$f,e)}function qf(e={}){return Oy("y",Fy,e)}function TT(e={}){return ST("x",$f,e)}function AT(e={}){return ST("y",Fy,e)}var ET={ariaLabel:"rule",fill:null,stroke:"currentColor"},Yf=class extends we{constructor(t,n={}){let{x:i,y1:r,y2:s,inset:o=0,insetTop:a=o,insetBottom:c=o}=n;super(t,{x:{value:i,scale:"x",optional:!0},y1:{value:r,scale:"y",optional:!0},y2:{value:s,scale:"y",optional:!0}},wa(n,"x"),ET),this.insetTop=Fe(a),this.insetBottom=Fe(c),al(this,n)}render(t,n,i,r,s){let{x:o,y:a}=n,{x:c,y1:l,y2:u}=i,{width:h,height:f,marginTop:d,marginRight:p,marginLeft:y,marginBottom:m}=r,{insetTop:g,insetBottom:x}=this;return le("svg:g",s).call($e,this,r,s).call(Ne,this,{x:c&&o},fn,0).call(S=>S.selectAll().data(t).enter().append("line").call(Oe,this).attr("x1",c?v=>c[v]:(y+h-p)/2).attr("x2",c?v=>c[v]:(y+h-p)/2).attr("y1",l&&!Zn(a)?v=>l[v]+g:d+g).attr("y2",u&&!Zn(a)?a.bandwidth?v=>u[v]+a.bandwidth()-x:v=>u[v]-x:f-m-x).call(hn,this,i).call(Uy,this,i,s)).node()}},Zf=class extends we{constructor(t,n={}){let{x1:i,x2:r,y:s,inset:o=0,insetRight:a=o,insetLeft:c=o}=n;super(t,{y:{value:s,scale:"y",optional:!0},x1:{value:i,scale:"x",optional:!0},x2:{value:r,scale:"x",optional:!0}},wa(n,"y"),ET),this.insetRight=Fe(a),this.insetLeft=Fe(c),al(this,n)}render(t,n,i,r,s){let{x:o,y:a}=n,{y:c,x1:l,x2:u}=i,{width:h,height:f,marginTop:d,marginRight:p,marginLeft:y,marginBottom:m}=r,{insetLeft:g,insetRight:x}=this;return le("svg:g",s).call($e,this,r,s).call(Ne,this,{y:c&&a},0,fn).call(S=>S.selectAll().data(t).enter().append("line").call(Oe,this).attr("x1",l&&!Zn(o)?v=>l[v]+g:y+g).attr("x2",u&&!Zn(o)?o.bandwidth?v=>u[v]+o.bandwidth()-x:v=>u[v]-x:h-p-x).attr("y1",c?v=>c[v]:(d+f-m)/2).attr("y2",c?v=>c[v]:(d+f-m)/2).call(hn,this,i).call(Uy,this,i,s)).node()}};function cl(e,t){let{x:n=be,y:i,y1:r,y2:s,...o}=qf(t);return[r,s]=CT(i,r,s),new Yf(e,{...o,x:n,y1:r,y2:s})}function vo(e,t){let{y:n=be,x:i,x1:r,x2:s,...o}=Xf(t);return[r,s]=CT(i,r,s),new Zf(e,{...o,y:n,x1:r,x2:s})}function CT(e,t,n){if(e==null){if(t===void 0){if(n!==void 0)return[0,n]}else if(n===void 0)return[0,t]}else{if(t===void 0)return n===void 0?[0,e]:[e,n];if(n===void 0)return[e,t]}return[t,n]}function Aa(e,...t){let n=t.length;for(let i=0,r=!0;i<n;++i)typeof t[i]!="function"&&(r&&(e=e.slice(),r=!1),e.splice(i,2,e[i]+t[i]+e[i+1]),t.splice(i,1),--i,--n);return i=>{let r=e[0];for(let s=0;s<n;++s)r+=t[s](i)+e[s+1];return r}}var WN={ariaLabel:"text",strokeLinejoin:"round",strokeWidth:3,paintOrder:"stroke"},NT="\xAD",ll=class extends we{constructor(t,n={}){let{x:i,y:r,text:s=Si(t)&&Cf(t)?be:Nr,frameAnchor:o,textAnchor:a=/right$/i.test(o)?"end":/left$/i.test(o)?"start":"middle",lineAnchor:c=/^top/i.test(o)?"top":/^bottom/i.test(o)?"bottom":"middle",lineHeight:l=1,lineWidth:u=1/0,textOverflow:h,monospace:f,fontFamily:d=f?"ui-monospace, monospace":void 0,fontSize:p,fontStyle:y,fontVariant:m,fontWeight:g,rotate:x}=n,[S,v]=Ie(x,0),[w,b]=YN(p);if(super(t,{x:{value:i,scale:"x",optional:!0},y:{value:r,scale:"y",optional:!0},fontSize:{value:w,optional:!0},rotate:{value:IS(S),optional:!0},text:{value:s,filter:Kc,optional:!0}},n,WN),this.rotate=v,this.textAnchor=Le(a,"middle"),this.lineAnchor=Pn(c,"lineAnchor",["top","middle","bottom"]),this.lineHeight=+l,this.lineWidth=+u,this.textOverflow=ky(h),this.monospace=!!f,this.fontFamily=Ue(d),this.fontSize=b,this.fontStyle=Ue(y),this.fontVariant=Ue(m),this.fontWeight=Ue(g),this.frameAnchor=ys(o),!(this.lineWidth>=0))throw new Error(`invalid lineWidth: ${u}`);this.splitLines=Vy(this),this.clipLine=Hy(this)}render(t,n,i,r,s){let{x:o,y:a}=n,{x:c,y:l,rotate:u,text:h,title:f,fontSize:d}=i,{rotate:p}=this,[y,m]=hr(this,r);return le("svg:g",s).call($e,this,r,s).call(Gy,this,h,r).call(Ne,this,{x:c&&o,y:l&&a}).call(g=>g.selectAll().data(t).enter().append("text").call(Oe,this).call($N,this,h,f).attr("transform",Aa`translate(${c?x=>c[x]:y},${l?x=>l[x]:m})${u?x=>` rotate(${u[x]})`:p?` rotate(${p})`:""}`).call(Bt,"font-size",d&&(x=>d[x])).call(hn,this,i)).node()}};function ky(e){return e==null?null:Pn(e,"textOverflow",["clip","ellipsis","clip-start","clip-end","ellipsis-start","ellipsis-middle","ellipsis-end"]).replace(/^(clip|ellipsis)$/,"$1-end")}function $N(e,t,n,i){if(!n)return;let{lineAnchor:r,lineHeight:s,textOverflow:o,splitLines:a,clipLine:c}=t;e.each(function(l){let u=a(fr(n[l])??"").map(c),h=u.length,f=r==="top"?.71:r==="bottom"?1-h:(164-h*100)/200;if(h>1){let d=0;for(let p=0;p<h;++p){if(++d,!u[p])continue;let y=this.ownerDocument.createElementNS(ns.svg,"tspan");y.setAttribute("x",0),p===d-1?y.setAttribute("y",`${(f+p)*s}em`):y.setAttribute("dy",`${d*s}em`),y.textContent=u[p],this.appendChild(y),d=0}}else f&&this.setAttribute("y",`${f*s}em`),this.textContent=u[0];if(o&&!i&&u[0]!==n[l]){let d=this.ownerDocument.createElementNS(ns.svg,"title");d.textContent=n[l],this.appendChild(d)}})}function zy(e,{x:t,y:n,...i}={}){return i.frameAnchor===void 0&&([t,n]=Fi(t,n)),new ll(e,{...i,x:t,y:n})}function DT(e,{x:t=be,...n}={}){return new ll(e,AT({...n,x:t}))}function UT(e,{y:t=be,...n}={}){return new ll(e,TT({...n,y:t}))}function Gy(e,t,n){Bt(e,"text-anchor",t.textAnchor),Bt(e,"font-family",t.fontFamily),Bt(e,"font-size",t.fontSize),Bt(e,"font-style",t.fontStyle),Bt(e,"font-variant",t.fontVariant===void 0?XN(n):t.fontVariant),Bt(e,"font-weight",t.fontWeight)}function XN(e){return e&&(DS(e)||en(e))?"tabular-nums":void 0}var qN=new Set(["inherit","initial","revert","unset","xx-small","x-small","small","medium","large","x-large","xx-large","xxx-large","larger","smaller"]);function YN(e){return e==null||typeof e=="number"?[void 0,e]:typeof e!="string"?[e,void 0]:(e=e.trim().toLowerCase(),qN.has(e)||/^[+-]?\d*\.?\d+(e[+-]?\d+)?(\w*|%)$/.test(e)?[void 0,e]:[e,void 0])}function ZN(e,t,n){let i=[],r,s=0;for(let[o,a,c]of JN(e)){if(r===void 0&&(r=o),s>r&&n(e,r,a)>t&&(i.push(e.slice(r,s)+(e[s-1]===NT?"-":"")),r=o),c){i.push(e.slice(r,a)),r=void 0;continue}s=a}return i}function*JN(e){let t=0,n=0,i=e.length;for(;n<i;){let r=1;switch(e[n]){case NT:case"-":++n,yield[t,n,!1],t=n;break;case" ":for(yield[t,n,!1];e[++n]===" ";);t=n;break;case"\r":e[n+1]===`
`&&++r;case`
`:yield[t,n,!0],n+=r,t=n;break;default:++n;break}}yield[t,n,!0]}var RT={a:56,b:63,c:57,d:63,e:58,f:37,g:62,h:60,i:26,j:26,k:55,l:26,m:88,n:60,o:60,p:62,q:62,r:39,s:54,t:38,u:60,v:55,w:79,x:54,y:55,z:55,A:69,B:67,C:73,D:74,E:61,F:58,G:76,H:75,I:28,J:55,K:67,L:58,M:89,N:75,O:78,P:65,Q:78,R:67,S:65,T:65,U:75,V:69,W:98,X:69,Y:67,Z:67,0:64,1:48,2:62,3:64,4:66,5:63,6:65,7:58,8:65,9:65," ":29,"!":32,'"':49,"'":31,"(":39,")":39,",":31,"-":48,".":31,"/":32,":":31,";":31,"?":52,"\u2018":31,"\u2019":31,"\u201C":47,"\u201D":47,"\u2026":82};function Jf(e,t=0,n=e.length){let i=0;for(let r=t;r<n;r=Ea(e,r))i+=RT[e[r]]??(OT(e,r)?120:RT.e);return i}function Kf(e,t=0,n=e.length){let i=0;for(let r=t;r<n;r=Ea(e,r))i+=OT(e,r)?126:63;return i}function Vy({monospace:e,lineWidth:t,textOverflow:n}){if(n!=null||t==1/0)return s=>s.split(/\r\n?|\n/g);let i=e?Kf:Jf,r=t*100;return s=>ZN(s,r,i)}function Hy({monospace:e,lineWidth:t,textOverflow:n}){if(n==null||t==1/0)return s=>s;let i=e?Kf:Jf,r=t*100;switch(n){case"clip-start":return s=>IT(s,r,i,"");case"clip-end":return s=>PT(s,r,i,"");case"ellipsis-start":return s=>IT(s,r,i,bo);case"ellipsis-middle":return s=>KN(s,r,i,bo);case"ellipsis-end":return s=>PT(s,r,i,bo)}}var bo="\u2026";function Mo(e,t,n,i){let r=[],s=0;for(let o=0,a=0,c=e.length;o<c;o=a){a=Ea(e,o);let l=n(e,o,a);if(s+l>t){for(s+=i;s>t&&o>0;)a=o,o=r.pop(),s-=n(e,o,a);return[o,t-s]}s+=l,r.push(o)}return[-1,0]}function PT(e,t,n,i){e=e.trim();let r=n(i),[s]=Mo(e,t,n,r);return s<0?e:e.slice(0,s).trimEnd()+i}function KN(e,t,n,i){e=e.trim();let r=n(e);if(r<=t)return e;let s=n(i)/2,[o,a]=Mo(e,t/2,n,s),[c]=Mo(e,r-t/2-a+s,n,-s);return c<0?i:e.slice(0,o).trimEnd()+i+e.slice(Ea(e,c)).trimStart()}function IT(e,t,n,i){e=e.trim();let r=n(e);if(r<=t)return e;let s=n(i),[o]=Mo(e,r-t+s,n,-s);return o<0?i:i+e.slice(Ea(e,o)).trimStart()}var By=/[\p{Combining_Mark}\p{Emoji_Modifier}]+/uy,LT=/\p{Extended_Pictographic}/uy;function Ea(e,t){return t+=jN(e,t)?2:1,tD(e,t)&&(t=By.lastIndex),QN(e,t)?Ea(e,t+1):t}function FT(e,t){return e.charCodeAt(t)<128}function jN(e,t){let n=e.charCodeAt(t);if(n>=55296&&n<56320){let i=e.charCodeAt(t+1);return i>=56320&&i<57344}return!1}function QN(e,t){return e.charCodeAt(t)===8205}function tD(e,t){return FT(e,t)?!1:(By.lastIndex=t,By.test(e))}function OT(e,t){return FT(e,t)?!1:(LT.lastIndex=t,LT.test(e))}var eD={ariaLabel:"vector",fill:"none",stroke:"currentColor",strokeWidth:1.5,strokeLinejoin:"round",strokeLinecap:"round"},BT=3.5,nD=BT*5,kT={draw(e,t,n){let i=t*n/nD;e.moveTo(0,0),e.lineTo(0,-t),e.moveTo(-i,i-t),e.lineTo(0,-t),e.lineTo(i,i-t)}},iD={draw(e,t,n){e.moveTo(-n,0),e.lineTo(0,-t),e.lineTo(n,0)}},rD=new Map([["arrow",kT],["spike",iD]]);function sD(e){return e&&typeof e.draw=="function"}function oD(e){if(sD(e))return e;let t=rD.get(`${e}`.toLowerCase());if(t)return t;throw new Error(`invalid shape: ${e}`)}var jf=class extends we{constructor(t,n={}){let{x:i,y:r,r:s=BT,length:o,rotate:a,shape:c=kT,anchor:l="middle",frameAnchor:u}=n,[h,f]=Ie(o,12),[d,p]=Ie(a,0);super(t,{x:{value:i,scale:"x",optional:!0},y:{value:r,scale:"y",optional:!0},length:{value:h,scale:"length",optional:!0},rotate:{value:d,optional:!0}},n,eD),this.r=+s,this.length=f,this.rotate=p,this.shape=oD(c),this.anchor=Pn(l,"anchor",["start","middle","end"]),this.frameAnchor=ys(u)}render(t,n,i,r,s){let{x:o,y:a}=n,{x:c,y:l,length:u,rotate:h}=i,{length:f,rotate:d,anchor:p,shape:y,r:m}=this,[g,x]=hr(this,r);return le("svg:g",s).call($e,this,r,s).call(Ne,this,{x:c&&o,y:l&&a}).call(S=>S.selectAll().data(t).enter().append("path").call(Oe,this).attr("transform",Aa`translate(${c?v=>c[v]:g},${l?v=>l[v]:x})${h?v=>` rotate(${h[v]})`:d?` rotate(${d})`:""}${p==="start"?"":p==="end"?u?v=>` translate(0,${u[v]})`:` translate(0,${f})`:u?v=>` translate(0,${u[v]/2})`:` translate(0,${f/2})`}`).attr("d",u?v=>{let w=Ki();return y.draw(w,u[v],m),w}:(()=>{let v=Ki();return y.draw(v,f,m),v})()).call(hn,this,i)).node()}};function zT(e,t={}){let{x:n=be,...i}=t;return new jf(e,{...i,x:n})}function GT(e,t={}){let{y:n=be,...i}=t;return new jf(e,{...i,y:n})}function xs(e,t){return arguments.length<2&&!Si(e)&&(t=e,e=null),t===void 0&&(t={}),[e,t]}function Qf({anchor:e}={},t){return e===void 0?t[0]:Pn(e,"anchor",t)}function VT(e){return Qf(e,["left","right"])}function HT(e){return Qf(e,["right","left"])}function WT(e){return Qf(e,["bottom","top"])}function $T(e){return Qf(e,["top","bottom"])}function $y(){let[e,t]=xs(...arguments);return YT("y",VT(t),e,t)}function XT(){let[e,t]=xs(...arguments);return YT("fy",HT(t),e,t)}function Xy(){let[e,t]=xs(...arguments);return ZT("x",WT(t),e,t)}function qT(){let[e,t]=xs(...arguments);return ZT("fx",$T(t),e,t)}function YT(e,t,n,{color:i="currentColor",opacity:r=1,stroke:s=i,strokeOpacity:o=r,strokeWidth:a=1,fill:c=i,fillOpacity:l=r,textAnchor:u,textStroke:h,textStrokeOpacity:f,textStrokeWidth:d,tickSize:p=e==="y"?6:0,tickPadding:y,tickRotate:m,x:g,margin:x,marginTop:S=x===void 0?20:x,marginRight:v=x===void 0?t==="right"?40:0:x,marginBottom:w=x===void 0?20:x,marginLeft:b=x===void 0?t==="left"?40:0:x,label:_,labelAnchor:M,labelArrow:C,labelOffset:E,ariaLabel:I=`${e}-axis`,...R}){return p=Fe(p),y=Fe(y),m=Fe(m),M!==void 0&&(M=Pn(M,"labelAnchor",["center","top","bottom"])),C=aA(C),Ty(p&&!rn(s)?aD(e,t,n,{stroke:s,strokeOpacity:o,strokeWidth:a,tickSize:p,tickPadding:y,tickRotate:m,x:g,ariaLabel:I,...R}):null,rn(c)?null:lD(e,t,n,{fill:c,fillOpacity:l,stroke:h,strokeOpacity:f,strokeWidth:d,textAnchor:u,tickSize:p,tickPadding:y,tickRotate:m,x:g,marginTop:S,marginRight:v,marginBottom:w,marginLeft:b,ariaLabel:I,...R}),!rn(c)&&_!==null?zy([],iA({fill:c,fillOpacity:l,...R},function(U,P,L,O,D){let Y=O[e],{marginTop:B,marginRight:V,marginBottom:q,marginLeft:rt}=e==="y"&&D.inset||D,ct=M??(Y.bandwidth?"center":"top"),$=E??(t==="right"?V:rt)-3;return ct==="center"?(this.textAnchor=void 0,this.lineAnchor=t==="right"?"bottom":"top",this.frameAnchor=t,this.rotate=-90):(this.textAnchor=t==="right"?"end":"start",this.lineAnchor=ct,this.frameAnchor=`${ct}-${t}`,this.rotate=0),this.dy=ct==="top"?3-B:ct==="bottom"?q-3:0,this.dx=t==="right"?$:-$,this.ariaLabel=`${I} label`,{facets:[[0]],channels:{text:{value:[oA(e,Y,{anchor:t,label:_,labelAnchor:ct,labelArrow:C})]}}}})):null)}function ZT(e,t,n,{color:i="currentColor",opacity:r=1,stroke:s=i,strokeOpacity:o=r,strokeWidth:a=1,fill:c=i,fillOpacity:l=r,textAnchor:u,textStroke:h,textStrokeOpacity:f,textStrokeWidth:d,tickSize:p=e==="x"?6:0,tickPadding:y,tickRotate:m,y:g,margin:x,marginTop:S=x===void 0?t==="top"?30:0:x,marginRight:v=x===void 0?20:x,marginBottom:w=x===void 0?t==="bottom"?30:0:x,marginLeft:b=x===void 0?20:x,label:_,labelAnchor:M,labelArrow:C,labelOffset:E,ariaLabel:I=`${e}-axis`,...R}){return p=Fe(p),y=Fe(y),m=Fe(m),M!==void 0&&(M=Pn(M,"labelAnchor",["center","left","right"])),C=aA(C),Ty(p&&!rn(s)?cD(e,t,n,{stroke:s,strokeOpacity:o,strokeWidth:a,tickSize:p,tickPadding:y,tickRotate:m,y:g,ariaLabel:I,...R}):null,rn(c)?null:uD(e,t,n,{fill:c,fillOpacity:l,stroke:h,strokeOpacity:f,strokeWidth:d,textAnchor:u,tickSize:p,tickPadding:y,tickRotate:m,y:g,marginTop:S,marginRight:v,marginBottom:w,marginLeft:b,ariaLabel:I,...R}),!rn(c)&&_!==null?zy([],iA({fill:c,fillOpacity:l,...R},function(U,P,L,O,D){let Y=O[e],{marginTop:B,marginRight:V,marginBottom:q,marginLeft:rt}=e==="x"&&D.inset||D,ct=M??(Y.bandwidth?"center":"right"),$=E??(t==="top"?B:q)-3;return ct==="center"?(this.frameAnchor=t,this.textAnchor=void 0):(this.frameAnchor=`${t}-${ct}`,this.textAnchor=ct==="right"?"end":"start"),this.lineAnchor=t,this.dy=t==="top"?-$:$,this.dx=ct==="right"?V-3:ct==="left"?3-rt:0,this.ariaLabel=`${I} label`,{facets:[[0]],channels:{text:{value:[oA(e,Y,{anchor:t,label:_,labelAnchor:ct,labelArrow:C})]}}}})):null)}function aD(e,t,n,{strokeWidth:i=1,strokeLinecap:r=null,strokeLinejoin:s=null,facetAnchor:o=t+(e==="y"?"-empty":""),frameAnchor:a=t,tickSize:c,inset:l=0,insetLeft:u=l,insetRight:h=l,dx:f=0,y:d=e==="y"?void 0:null,ariaLabel:p,...y}){return Ca(GT,e,n,{ariaLabel:`${p} tick`,ariaHidden:!0},{strokeWidth:i,strokeLinecap:r,strokeLinejoin:s,facetAnchor:o,frameAnchor:a,y:d,...y,dx:t==="left"?+f-fn+ +u:+f+fn-h,anchor:"start",length:c,shape:t==="left"?pD:mD})}function cD(e,t,n,{strokeWidth:i=1,strokeLinecap:r=null,strokeLinejoin:s=null,facetAnchor:o=t+(e==="x"?"-empty":""),frameAnchor:a=t,tickSize:c,inset:l=0,insetTop:u=l,insetBottom:h=l,dy:f=0,x:d=e==="x"?void 0:null,ariaLabel:p,...y}){return Ca(zT,e,n,{ariaLabel:`${p} tick`,ariaHidden:!0},{strokeWidth:i,strokeLinejoin:s,strokeLinecap:r,facetAnchor:o,frameAnchor:a,x:d,...y,dy:t==="bottom"?+f-fn-h:+f+fn+ +u,anchor:"start",length:c,shape:t==="bottom"?hD:dD})}function lD(e,t,n,{facetAnchor:i=t+(e==="y"?"-empty":""),frameAnchor:r=t,tickSize:s,tickRotate:o=0,tickPadding:a=Math.max(3,9-s)+(Math.abs(o)>60?4*Math.cos(o*Iy):0),text:c,textAnchor:l=Math.abs(o)>60?"middle":t==="left"?"end":"start",lineAnchor:u=o>60?"top":o<-60?"bottom":"middle",fontVariant:h,inset:f=0,insetLeft:d=f,insetRight:p=f,dx:y=0,ariaLabel:m,y:g=e==="y"?void 0:null,...x}){return Ca(UT,e,n,{ariaLabel:`${m} tick label`},{facetAnchor:i,frameAnchor:r,text:c,textAnchor:l,lineAnchor:u,fontVariant:h,rotate:o,y:g,...x,dx:t==="left"?+y-s-a+ +d:+y+ +s+ +a-p},function(S,v,w,b,_){h===void 0&&(this.fontVariant=sA(S)),c===void 0&&(_.text=rA(S,v,w,b,t))})}function uD(e,t,n,{facetAnchor:i=t+(e==="x"?"-empty":""),frameAnchor:r=t,tickSize:s,tickRotate:o=0,tickPadding:a=Math.max(3,9-s)+(Math.abs(o)>=10?4*Math.cos(o*Iy):0),text:c,textAnchor:l=Math.abs(o)>=10?o<0^t==="bottom"?"start":"end":"middle",lineAnchor:u=Math.abs(o)>=10?"middle":t==="bottom"?"top":"bottom",fontVariant:h,inset:f=0,insetTop:d=f,insetBottom:p=f,dy:y=0,x:m=e==="x"?void 0:null,ariaLabel:g,...x}){return Ca(DT,e,n,{ariaLabel:`${g} tick label`},{facetAnchor:i,frameAnchor:r,text:c===void 0?null:c,textAnchor:l,lineAnchor:u,fontVariant:h,rotate:o,x:m,...x,dy:t==="bottom"?+y+ +s+ +a-p:+y-s-a+ +d},function(S,v,w,b,_){h===void 0&&(this.fontVariant=sA(S)),c===void 0&&(_.text=rA(S,v,w,b,t))})}function JT(){let[e,t]=xs(...arguments);return tA("y",VT(t),e,t)}function KT(){let[e,t]=xs(...arguments);return tA("fy",HT(t),e,t)}function jT(){let[e,t]=xs(...arguments);return eA("x",WT(t),e,t)}function QT(){let[e,t]=xs(...arguments);return eA("fx",$T(t),e,t)}function tA(e,t,n,{y:i=e==="y"?void 0:null,x:r=null,x1:s=t==="left"?r:null,x2:o=t==="right"?r:null,ariaLabel:a=`${e}-grid`,ariaHidden:c=!0,...l}){return Ca(vo,e,n,{ariaLabel:a,ariaHidden:c},{y:i,x1:s,x2:o,...nA(l)})}function eA(e,t,n,{x:i=e==="x"?void 0:null,y:r=null,y1:s=t==="top"?r:null,y2:o=t==="bottom"?r:null,ariaLabel:a=`${e}-grid`,ariaHidden:c=!0,...l}){return Ca(cl,e,n,{ariaLabel:a,ariaHidden:c},{x:i,y1:s,y2:o,...nA(l)})}function nA({color:e="currentColor",opacity:t=.1,stroke:n=e,strokeOpacity:i=t,strokeWidth:r=1,...s}){return{stroke:n,strokeOpacity:i,strokeWidth:r,...s}}function iA({fill:e,fillOpacity:t,fontFamily:n,fontSize:i,fontStyle:r,fontVariant:s,fontWeight:o,monospace:a,pointerEvents:c,shapeRendering:l,clip:u=!1},h){return[,e]=Di(e),[,t]=Ie(t),{facet:"super",x:null,y:null,fill:e,fillOpacity:t,fontFamily:n,fontSize:i,fontStyle:r,fontVariant:s,fontWeight:o,monospace:a,pointerEvents:c,shapeRendering:l,clip:u,initializer:h}}function Ca(e,t,n,i,r,s){let o;function a(u,h,f,d,p,y){let m=u==null&&(t==="fx"||t==="fy"),{[t]:g}=d;if(!g)throw new Error(`missing scale: ${t}`);let x=g.domain(),{interval:S,ticks:v,tickFormat:w,tickSpacing:b=t==="x"?80:35}=r;if(typeof v=="string"&&cA(g)&&(S=v,v=void 0),v===void 0&&(v=ms(S,g.type)??fD(g,b)),u==null){if(Si(v))u=cr(v);else if(PS(v))u=Wy(v,...fi(x));else if(g.interval){let M=g.interval;if(g.ticks){let[C,E]=fi(x),I=(E-C)/M[ca];M=U0(M,I/v)??M,u=Wy(M,C,E)}else{u=x;let C=u.length;M=U0(M,C/v)??M,M!==g.interval&&(u=Wy(M,...fi(u)))}if(M===g.interval){let C=Math.round(u.length/v);C>1&&(u=u.filter((E,I)=>I%C===0))}}else g.ticks?u=g.ticks(v):u=x;if(!g.ticks&&u.length&&u!==x){let M=new qi(x);u=u.filter(C=>M.has(C)),u.length||Vn(`Warning: the ${t}-axis ticks appear to not align with the scale domain, resulting in no ticks. Try different ticks?`)}t==="y"||t==="x"?h=[Gn(u)]:o[t]={scale:t,value:be}}s?.call(this,g,u,v,w,o);let _=Object.fromEntries(Object.entries(o).map(([M,C])=>[M,{...C,value:nn(u,C.value)}]));return m&&(h=y.filterFacets(u,_)),{data:u,facets:h,channels:_}}let c=Ur(r).initializer,l=e(n,Ur({...r,initializer:a},c));return n==null?(o=l.channels,l.channels={}):o={},i!==void 0&&Object.assign(l,i),l.clip===void 0&&(l.clip=!1),l}function fD(e,t){let[n,i]=fi(e.range());return(i-n)/t}function rA(e,t,n,i,r){return{value:ul(e,t,n,i,r)}}function ul(e,t,n,i,r){return typeof i=="function"&&!(e.type==="log"&&e.tickFormat)?i:i===void 0&&t&&en(t)?gS(e.type,t,r)??fr:e.tickFormat?e.tickFormat(typeof n=="number"?n:null,i):typeof i=="string"&&e.domain().length>0?(en(e.domain())?rr:ji)(i):i===void 0?fr:qn(i)}function Wy(e,t,n){return e.range(t,e.offset(e.floor(n)))}var hD={draw(e,t){e.moveTo(0,0),e.lineTo(0,t)}},dD={draw(e,t){e.moveTo(0,0),e.lineTo(0,-t)}},pD={draw(e,t){e.moveTo(0,0),e.lineTo(-t,0)}},mD={draw(e,t){e.moveTo(0,0),e.lineTo(t,0)}};function sA(e){return e.bandwidth&&!e.interval?void 0:"tabular-nums"}function oA(e,t,{anchor:n,label:i=t.label,labelAnchor:r,labelArrow:s}={}){if(!(i==null||i.inferred&&cA(t)&&/^(date|time|year)$/i.test(i))){if(i=String(i),s==="auto"&&(s=(!t.bandwidth||t.interval)&&!/[↑↓→←]/.test(i)),!s)return i;if(s===!0){let o=Vw(t);o&&(s=/x$/.test(e)||r==="center"?/x$/.test(e)===o<0?"left":"right":o<0?"up":"down")}switch(s){case"left":return`\u2190 ${i}`;case"right":return`${i} \u2192`;case"up":return n==="right"?`${i} \u2191`:`\u2191 ${i}`;case"down":return n==="right"?`${i} \u2193`:`\u2193 ${i}`}return i}}function aA(e="auto"){return rn(e)?!1:typeof e=="boolean"?e:Pn(e,"labelArrow",["auto","up","right","down","left"])}function cA(e){return en(e.domain())}function lA(e,t){if(t==null)return t;let n=e(t);if(!n)throw new Error(`scale not found: ${t}`);return n}function uA(e,{opacity:t,...n}={}){if(!ur(e)&&!yy(e))throw new Error(`swatches legend requires ordinal or threshold color scale (not ${e.type})`);return hA(e,n,(i,r,s,o)=>i.append("svg").attr("width",s).attr("height",o).attr("fill",r.scale).attr("fill-opacity",Ie(t)[1]).append("rect").attr("width","100%").attr("height","100%"))}function fA(e,{fill:t=e.hint?.fill!==void 0?e.hint.fill:"none",fillOpacity:n=1,stroke:i=e.hint?.stroke!==void 0?e.hint.stroke:rn(t)?"currentColor":"none",strokeOpacity:r=1,strokeWidth:s=1.5,r:o=4.5,...a}={},c){let[l,u]=Di(t),[h,f]=Di(i),d=lA(c,l),p=lA(c,h),y=o*o*Math.PI;return n=Ie(n)[1],r=Ie(r)[1],s=Ie(s)[1],hA(e,a,(m,g,x,S)=>m.append("svg").attr("viewBox","-8 -8 16 16").attr("width",x).attr("height",S).attr("fill",l==="color"?v=>d.scale(v):u).attr("fill-opacity",n).attr("stroke",h==="color"?v=>p.scale(v):f).attr("stroke-opacity",r).attr("stroke-width",s).append("path").attr("d",v=>{let w=Ki();return e.scale(v).draw(w,y),w}))}function hA(e,t={},n){let{columns:i,tickFormat:r,fontVariant:s=Wf(e),swatchSize:o=15,swatchWidth:a=o,swatchHeight:c=o,marginLeft:l=0,className:u,style:h,width:f}=t,d=ba(t);u=Ma(u),r=ul(e.scale,e.domain,void 0,r);let p=le("div",d).attr("class",`${u}-swatches ${u}-swatches-${i!=null?"columns":"wrap"}`),y;return i!=null?(y=`:where(.${u}-swatches-columns .${u}-swatch) {
  display: flex;
  align-items: center;
  break-inside: avoid;
  padding-bottom: 1px;
}
:where(.${u}-swatches-columns .${u}-swatch::before) {
  flex-shrink: 0;
}
:where(.${u}-swatches-columns .${u}-swatch-label) {
  white-space: nowrap;
  overflow: hidden;
  text-overflow: ellipsis;
}`,p.style("columns",i).selectAll().data(e.domain).enter().append("div").attr("class",`${u}-swatch`).call(n,e,a,c).call(m=>m.append("div").attr("class",`${u}-swatch-label`).attr("title",r).text(r))):(y=`:where(.${u}-swatches-wrap) {
  display: flex;
  align-items: center;
  min-height: 33px;
  flex-wrap: wrap;
}
:where(.${u}-swatches-wrap .${u}-swatch) {
  display: inline-flex;
  align-items: center;
  margin-right: 1em;
}`,p.selectAll().data(e.domain).enter().append("span").attr("class",`${u}-swatch`).call(n,e,a,c).append(function(){return this.ownerDocument.createTextNode(r.apply(this,arguments))})),p.call(m=>m.insert("style","*").text(`:where(.${u}-swatches) {
  font-family: system-ui, sans-serif;
  font-size: 10px;
  margin-bottom: 0.5em;
}
:where(.${u}-swatch > svg) {
  margin-right: 0.5em;
  overflow: visible;
}
${y}`)).style("margin-left",l?`${+l}px`:null).style("width",f===void 0?null:`${+f}px`).style("font-variant",Le(s,"normal")).call(Sa,h).node()}var qy=new Map([["symbol",fA],["color",mA],["opacity",gD]]);function dA(e,t,n={}){return(i,r)=>{if(!qy.has(i))throw new Error(`unknown legend type: ${i}`);if(i in e)return qy.get(i)(e[i],pA(t,n[i],r),s=>e[s])}}function pA({className:e,...t},{label:n,ticks:i,tickFormat:r}={},s){return OS(s,{className:e,...t},{label:n,ticks:i,tickFormat:r})}function mA(e,{legend:t=!0,...n}){if(t===!0&&(t=e.type==="ordinal"?"swatches":"ramp"),e.domain!==void 0)switch(`${t}`.toLowerCase()){case"swatches":return uA(e,n);case"ramp":return mT(e,n);default:throw new Error(`unknown legend type: ${t}`)}}function gD({type:e,interpolate:t,...n},{legend:i=!0,color:r=Ni(0,0,0),...s}){if(!t)throw new Error(`${e} opacity scales are not supported`);if(i===!0&&(i="ramp"),`${i}`.toLowerCase()!=="ramp")throw new Error(`${i} opacity legends are not supported`);return mA({type:e,...n,interpolate:yD(r)},{legend:i,...s})}function yD(e){let{r:t,g:n,b:i}=Ni(e)||Ni(0,0,0);return r=>`rgba(${t},${n},${i},${r})`}function gA(e,t,n){let i=[];for(let[r,s]of qy){let o=n[r];if(o?.legend&&r in e){let a=s(e[r],pA(t,e[r],o),c=>e[c]);a!=null&&i.push(a)}}return i}function Yy(e={},t="x"){return $0(e)?e:{...e,[t]:be}}function th(e={},t="y"){return X0(e)?e:{...e,[t]:be}}function yA(e,t){if(t.length===1)return{data:e,facets:t};let n=ds(e),i=new Uint8Array(n),r=0;for(let a of t)for(let c of a)i[c]&&++r,i[c]=1;if(r===0)return{data:e,facets:t};e=fs(e);let s=e[B0]=new Uint32Array(n+r);t=t.map(a=>fs(a,Uint32Array));let o=n;i.fill(0);for(let a of t)for(let c=0,l=a.length;c<l;++c){let u=a[c];i[u]?(a[c]=o,e[o]=e[u],s[o]=u,++o):s[u]=u,i[u]=1}return{data:e,facets:t}}function _D(e={},t={}){arguments.length===1&&([e,t]=vA(e));let{y1:n,y:i=n,x:r,...s}=t,[o,a,c,l]=bA(i,r,"y","x",e,s);return{...o,y1:n,y:a,x1:c,x2:l,x:Y0(c,l)}}function xD(e={},t={}){arguments.length===1&&([e,t]=vA(e));let{x1:n,x:i=n,y:r,...s}=t,[o,a,c,l]=bA(i,r,"x","y",e,s);return{...o,x1:n,x:a,y1:c,y2:l,y:Y0(c,l)}}function Zy({x:e,x1:t,x2:n,...i}={}){return i=wa(i,"y"),t===void 0&&n===void 0?_D({x:e,...i}):([t,n]=q0(e,t,n),{...i,x1:t,x2:n})}function eh({y:e,y1:t,y2:n,...i}={}){return i=wa(i,"x"),t===void 0&&n===void 0?xD({y:e,...i}):([t,n]=q0(e,t,n),{...i,y1:t,y2:n})}function vA(e){let{offset:t,order:n,reverse:i,...r}=e;return[{offset:t,order:n,reverse:i},r]}var vD={length:!0};function bA(e,t=bS,n,i,{offset:r,order:s,reverse:o},a){if(t===null)throw new Error(`stack requires ${i}`);let c=Tf(a),[l,u]=ES(e),[h,f]=el(t),[d,p]=el(t);return h.hint=d.hint=vD,r=bD(r),s=wD(s,r,i),[nl(a,(y,m,g)=>{({data:y,facets:m}=yA(y,m));let x=e==null?void 0:u(CS(nn(y,e),g?.[n])),S=nn(y,t,Float64Array),v=nn(y,c),w=s&&s(y,x,S,v),b=ds(y),_=f(new Float64Array(b)),M=p(new Float64Array(b)),C=[];for(let E of m){let I=x?Array.from(Oo(E,R=>x[R]).values()):[E];if(w)for(let R of I)R.sort(w);for(let R of I){let U=0,P=0;o&&R.reverse();for(let L of R){let O=S[L];O<0?U=M[L]=(_[L]=U)+O:O>0?P=M[L]=(_[L]=P)+O:M[L]=_[L]=P}}C.push(I)}return r&&r(C,_,M,v),{data:y,facets:m}}),l,h,d]}function bD(e){if(e!=null){if(typeof e=="function")return e;switch(`${e}`.toLowerCase()){case"expand":case"normalize":return MD;case"center":case"silhouette":return SD;case"wiggle":return SA}throw new Error(`unknown offset: ${e}`)}}function MA(e,t){let n=0,i=0;for(let r of e){let s=t[r];s<n&&(n=s),s>i&&(i=s)}return[n,i]}function MD(e,t,n){for(let i of e)for(let r of i){let[s,o]=MA(r,n);for(let a of r){let c=1/(o-s||1);t[a]=c*(t[a]-s),n[a]=c*(n[a]-s)}}}function SD(e,t,n){for(let i of e){for(let r of i){let[s,o]=MA(r,n);for(let a of r){let c=(o+s)/2;t[a]-=c,n[a]-=c}}wA(i,t,n)}TA(e,t,n)}function SA(e,t,n,i){for(let r of e){let s=new li,o=0;for(let a of r){let c=-1,l=a.map(d=>Math.abs(n[d]-t[d])),u=a.map(d=>{c=i?i[d]:++c;let p=n[d]-t[d],y=s.has(c)?p-s.get(c):0;return s.set(c,p),y}),h=[0,...nv(u)];for(let d of a)t[d]+=o,n[d]+=o;let f=Yi(l);f&&(o-=Yi(l,(d,p)=>(u[p]/2+h[p])*d)/f)}wA(r,t,n)}TA(e,t,n)}function wA(e,t,n){let i=ui(e,r=>ui(r,s=>t[s]));for(let r of e)for(let s of r)t[s]-=i,n[s]-=i}function TA(e,t,n){let i=e.length;if(i===1)return;let r=e.map(a=>a.flat()),s=r.map(a=>(ui(a,c=>t[c])+An(a,c=>n[c]))/2),o=ui(s);for(let a=0;a<i;a++){let c=o-s[a];for(let l of r[a])t[l]+=c,n[l]+=c}}function wD(e,t,n){if(e===void 0&&t===SA)return _A(zn);if(e!=null){if(typeof e=="string"){let i=e.startsWith("-"),r=i?fo:zn;switch((i?e.slice(1):e).toLowerCase()){case"value":case n:return TD(r);case"z":return AD(r);case"sum":return ED(r);case"appearance":return CD(r);case"inside-out":return _A(r)}return xA(z0(e))}if(typeof e=="function")return(e.length===1?xA:RD)(e);if(Ui(e))return PD(e);throw new Error(`invalid order: ${e}`)}}function TD(e){return(t,n,i)=>(r,s)=>e(i[r],i[s])}function AD(e){return(t,n,i,r)=>(s,o)=>e(r[s],r[o])}function ED(e){return nh(e,(t,n,i,r)=>_u(Gn(t),s=>Yi(s,o=>i[o]),s=>r[s]))}function CD(e){return nh(e,(t,n,i,r)=>_u(Gn(t),s=>n[Up(s,o=>i[o])],s=>r[s]))}function _A(e){return nh(e,(t,n,i,r)=>{let s=Gn(t),o=_u(s,h=>n[Up(h,f=>i[f])],h=>r[h]),a=es(s,h=>Yi(h,f=>i[f]),h=>r[h]),c=[],l=[],u=0;for(let h of o)u<0?(u+=a.get(h),c.push(h)):(u-=a.get(h),l.push(h));return l.reverse().concat(c)})}function xA(e){return t=>{let n=nn(t,e);return(i,r)=>zn(n[i],n[r])}}function RD(e){return t=>Ui(t)?(n,i)=>e(t[n],t[i]):(n,i)=>e(t.get(n),t.get(i))}function PD(e){return nh(zn,()=>e)}function nh(e,t){return(n,i,r,s)=>{if(!s)throw new Error("missing channel: z");let o=new li(t(n,i,r,s).map((a,c)=>[a,c]));return(a,c)=>e(o.get(s[a]),o.get(s[c]))}}var ID={ariaLabel:"rect"},sh=class extends we{constructor(t,n={}){let{x1:i,y1:r,x2:s,y2:o}=n;super(t,{x1:{value:i,scale:"x",type:i!=null&&s==null?"band":void 0,optional:!0},y1:{value:r,scale:"y",type:r!=null&&o==null?"band":void 0,optional:!0},x2:{value:s,scale:"x",optional:!0},y2:{value:o,scale:"y",optional:!0}},n,ID),fl(this,n),hl(this,n)}render(t,n,i,r,s){let{x:o,y:a}=n,{x1:c,y1:l,x2:u,y2:h}=i,{marginTop:f,marginRight:d,marginBottom:p,marginLeft:y,width:m,height:g}=r,{projection:x}=s,{insetTop:S,insetRight:v,insetBottom:w,insetLeft:b}=this,{rx:_,ry:M,rx1y1:C,rx1y2:E,rx2y1:I,rx2y2:R}=this;(c||u)&&!x&&Zn(o)&&(c=u=null),(l||h)&&!x&&Zn(a)&&(l=h=null);let U=o?.bandwidth?o.bandwidth():0,P=a?.bandwidth?a.bandwidth():0;return le("svg:g",s).call($e,this,r,s).call(Ne,this,{},0,0).call(L=>L.selectAll().data(t).enter().call(C||E||I||R?O=>O.append("path").call(Oe,this).call(dl,c&&u?D=>c[D]+(u[D]<c[D]?-v:b):c?D=>c[D]+b:y+b,l&&h?D=>l[D]+(h[D]<l[D]?-w:S):l?D=>l[D]+S:f+S,c&&u?D=>u[D]-(u[D]<c[D]?-b:v):c?D=>c[D]+U-v:m-d-v,l&&h?D=>h[D]-(h[D]<l[D]?-S:w):l?D=>l[D]+P-w:g-p-w,this).call(hn,this,i):O=>O.append("rect").call(Oe,this).attr("x",c?u?D=>Math.min(c[D],u[D])+b:D=>c[D]+b:y+b).attr("y",l?h?D=>Math.min(l[D],h[D])+S:D=>l[D]+S:f+S).attr("width",c?u?D=>Math.max(0,Math.abs(u[D]-c[D])+U-b-v):U-b-v:m-d-y-v-b).attr("height",l?h?D=>Math.max(0,Math.abs(l[D]-h[D])+P-S-w):P-S-w:g-f-p-S-w).call(Bt,"rx",_).call(Bt,"ry",M).call(hn,this,i))).node()}};function fl(e,{inset:t=0,insetTop:n=t,insetRight:i=t,insetBottom:r=t,insetLeft:s=t}={}){e.insetTop=Fe(n),e.insetRight=Fe(i),e.insetBottom=Fe(r),e.insetLeft=Fe(s)}function hl(e,{r:t,rx:n,ry:i,rx1:r=t,ry1:s=t,rx2:o=t,ry2:a=t,rx1y1:c=r!==void 0?+r:s!==void 0?+s:0,rx1y2:l=r!==void 0?+r:a!==void 0?+a:0,rx2y1:u=o!==void 0?+o:s!==void 0?+s:0,rx2y2:h=o!==void 0?+o:a!==void 0?+a:0}={}){c||l||u||h?(e.rx1y1=c,e.rx1y2=l,e.rx2y1=u,e.rx2y2=h):(e.rx=Le(n,"auto"),e.ry=Le(i,"auto"))}function dl(e,t,n,i,r,s){let{rx1y1:o,rx1y2:a,rx2y1:c,rx2y2:l}=s;typeof t!="function"&&(t=qn(t)),typeof n!="function"&&(n=qn(n)),typeof i!="function"&&(i=qn(i)),typeof r!="function"&&(r=qn(r));let u=Math.max(Math.abs(o+c),Math.abs(a+l)),h=Math.max(Math.abs(o+a),Math.abs(c+l));e.attr("d",f=>{let d=t(f),p=n(f),y=i(f),m=r(f),g=d>y,x=p>m,S=g?y:d,v=g?d:y,w=x?m:p,b=x?p:m,_=Math.min(1,(v-S)/u,(b-w)/h),M=_*(g?x?l:c:x?a:o),C=_*(g?x?a:o:x?l:c),E=_*(g?x?o:a:x?c:l),I=_*(g?x?c:l:x?o:a);return`M${S},${w+rh(M,I)}A${M},${M} 0 0 ${M<0?0:1} ${S+ih(M,I)},${w}H${v-ih(C,E)}A${C},${C} 0 0 ${C<0?0:1} ${v},${w+rh(C,E)}V${b-rh(E,C)}A${E},${E} 0 0 ${E<0?0:1} ${v-ih(E,C)},${b}H${S+ih(I,M)}A${I},${I} 0 0 ${I<0?0:1} ${S},${b-rh(I,M)}Z`})}function ih(e,t){return t<0?e:Math.abs(e)}function rh(e,t){return t<0?Math.abs(e):e}function Jy(e,t={}){return tl(t)||(t={...t,x:Nr,y2:be,interval:1}),new sh(e,eh(wT(th(t))))}var LD={ariaLabel:"frame",fill:"none",stroke:"currentColor",clip:!1},ND={ariaLabel:"frame",fill:null,stroke:"currentColor",strokeLinecap:"square",clip:!1},Ky=class extends we{constructor(t={}){let{anchor:n=null}=t;super(la,void 0,t,n==null?LD:ND),this.anchor=W0(n,"anchor",["top","right","bottom","left"]),fl(this,t),n||hl(this,t)}render(t,n,i,r,s){let{marginTop:o,marginRight:a,marginBottom:c,marginLeft:l,width:u,height:h}=r,{anchor:f,insetTop:d,insetRight:p,insetBottom:y,insetLeft:m}=this,{rx:g,ry:x,rx1y1:S,rx1y2:v,rx2y1:w,rx2y2:b}=this,_=l+m,M=u-a-p,C=o+d,E=h-c-y;return le(f?"svg:line":S||v||w||b?"svg:path":"svg:rect",s).datum(0).call($e,this,r,s).call(Oe,this).call(hn,this,i).call(Ne,this,{}).call(f==="left"?I=>I.attr("x1",_).attr("x2",_).attr("y1",C).attr("y2",E):f==="right"?I=>I.attr("x1",M).attr("x2",M).attr("y1",C).attr("y2",E):f==="top"?I=>I.attr("x1",_).attr("x2",M).attr("y1",C).attr("y2",C):f==="bottom"?I=>I.attr("x1",_).attr("x2",M).attr("y1",E).attr("y2",E):S||v||w||b?I=>I.call(dl,_,C,M,E,this):I=>I.attr("x",_).attr("y",C).attr("width",M-_).attr("height",E-C).attr("rx",g).attr("ry",x)).node()}};function AA(e){return new Ky(e)}var jy={ariaLabel:"tip",fill:"var(--plot-background)",stroke:"currentColor"},DD=new Set(["geometry","href","src","ariaLabel","scales"]),oh=class extends we{constructor(t,n={}){n.tip&&(n={...n,tip:!1}),n.title===void 0&&Si(t)&&Cf(t)&&(n={...n,title:be});let{x:i,y:r,x1:s,x2:o,y1:a,y2:c,anchor:l,preferredAnchor:u="bottom",monospace:h,fontFamily:f=h?"ui-monospace, monospace":void 0,fontSize:d,fontStyle:p,fontVariant:y,fontWeight:m,lineHeight:g=1,lineWidth:x=20,frameAnchor:S,format:v,textAnchor:w="start",textOverflow:b,textPadding:_=8,title:M,pointerSize:C=12,pathFilter:E="drop-shadow(0 3px 4px rgba(0,0,0,0.2))"}=n;super(t,{x:{value:s!=null&&o!=null?null:i,scale:"x",optional:!0},y:{value:a!=null&&c!=null?null:r,scale:"y",optional:!0},x1:{value:s,scale:"x",optional:o==null},y1:{value:a,scale:"y",optional:c==null},x2:{value:o,scale:"x",optional:s==null},y2:{value:c,scale:"y",optional:a==null},title:{value:M,optional:!0}},n,jy),this.anchor=Pf(l,"anchor"),this.preferredAnchor=Pf(u,"preferredAnchor"),this.frameAnchor=ys(S),this.textAnchor=Le(w,"middle"),this.textPadding=+_,this.pointerSize=+C,this.pathFilter=Ue(E),this.lineHeight=+g,this.lineWidth=+x,this.textOverflow=ky(b),this.monospace=!!h,this.fontFamily=Ue(f),this.fontSize=Fe(d),this.fontStyle=Ue(p),this.fontVariant=Ue(y),this.fontWeight=Ue(m);for(let I in jy)I in this.channels&&(this[I]=jy[I]);this.splitLines=Vy(this),this.clipLine=Hy(this),this.format=typeof v=="string"||typeof v=="function"?{title:v}:{...v}}render(t,n,i,r,s){let o=this,{x:a,y:c,fx:l,fy:u}=n,{ownerSVGElement:h,document:f}=s,{anchor:d,monospace:p,lineHeight:y,lineWidth:m}=this,{textPadding:g,pointerSize:x,pathFilter:S}=this,{marginTop:v,marginLeft:w}=r,{x1:b,y1:_,x2:M,y2:C,x:E=b??M,y:I=_??C}=i,R=l?l(t.fx)-w:0,U=u?u(t.fy)-v:0,[P,L]=hr(this,r),O=Ry(i,P),D=Py(i,L),Y=p?Kf:Jf,B=Y(bo),V,q;"title"in i?(V=EA.call(this,{title:i.channels.title},n),q=BD):(V=EA.call(this,i.channels,n),q=kD);let rt=le("svg:g",s).call($e,this,r,s).call(Gy,this).call(Ne,this,{x:E&&a,y:I&&c}).call(ot=>ot.selectAll().data(t).enter().append("g").attr("transform",ut=>`translate(${Math.round(O(ut))},${Math.round(D(ut))})`).call(Oe,this).call(ut=>ut.append("path").attr("filter",S)).call(ut=>ut.append("text").each(function(st){let at=Ii(this);this.setAttribute("fill","currentColor"),this.setAttribute("fill-opacity",1),this.setAttribute("stroke","none");let J=q.call(o,st,t,V,n,i);if(typeof J=="string")for(let _t of o.splitLines(J))ct(at,{value:o.clipLine(_t)});else{let _t=new Set;for(let lt of J){let{label:K=""}=lt;K&&_t.has(K)||(_t.add(K),ct(at,lt))}}})));function ct(ot,{label:ut,value:st,color:at,opacity:J}){ut??="",st??="";let _t=at!=null||J!=null,lt,K=m*100,[Nt]=Mo(ut,K,Y,B);if(Nt>=0)ut=ut.slice(0,Nt).trimEnd()+bo,lt=st.trim(),st="";else{(ut||!st&&!_t)&&(st=" "+st);let[$t]=Mo(st,K-Y(ut),Y,B);$t>=0&&(lt=st.trim(),st=st.slice(0,$t).trimEnd()+bo)}let Mt=ot.append("tspan").attr("x",0).attr("dy",`${y}em`).text("\u200B");ut&&Mt.append("tspan").attr("font-weight","bold").text(ut),st&&Mt.append(()=>f.createTextNode(st)),_t&&Mt.append("tspan").text(" \u25A0").attr("fill",at).attr("fill-opacity",J).style("user-select","none"),lt&&Mt.append("title").text(lt)}function $(){let{width:ot,height:ut}=r.facet??r;rt.selectChildren().each(function(st){let{x:at,width:J,height:_t}=this.getBBox();J=Math.round(J),_t=Math.round(_t);let lt=d;if(lt===void 0){let Mt=O(st)+R,$t=D(st)+U,Zt=Mt+J+x+g*2<ot,ye=Mt-J-x-g*2>0,fe=$t+_t+x+g*2<ut,yn=$t-_t-x-g*2>0;lt=Zt&&ye?fe&&yn?o.preferredAnchor:yn?"bottom":"top":fe&&yn?Zt?"left":"right":(Zt||ye)&&(fe||yn)?`${yn?"bottom":"top"}-${Zt?"left":"right"}`:o.preferredAnchor}let K=this.firstChild,Nt=this.lastChild;if(K.setAttribute("d",OD(lt,x,g,J,_t)),at)for(let Mt of Nt.childNodes)Mt.setAttribute("x",-at);Nt.setAttribute("y",`${+UD(lt,Nt.childNodes.length,y).toFixed(6)}em`),Nt.setAttribute("transform",`translate(${FD(lt,x,g,J,_t)})`)}),rt.attr("visibility",null)}return t.length&&(rt.attr("visibility","hidden"),h.isConnected?Promise.resolve().then($):typeof requestAnimationFrame<"u"&&requestAnimationFrame($)),rt.node()}};function Ra(e,{x:t,y:n,...i}={}){return i.frameAnchor===void 0&&([t,n]=Fi(t,n)),new oh(e,{...i,x:t,y:n})}function UD(e,t,n){return/^top(?:-|$)/.test(e)?.94-n:-.29-t*n}function FD(e,t,n,i,r){switch(e){case"middle":return[-i/2,r/2];case"top-left":return[n,t+n];case"top":return[-i/2,t/2+n];case"top-right":return[-i-n,t+n];case"right":return[-t/2-i-n,r/2];case"bottom-left":return[n,-t-n];case"bottom":return[-i/2,-t/2-n];case"bottom-right":return[-i-n,-t-n];case"left":return[n+t/2,r/2]}}function OD(e,t,n,i,r){let s=i+n*2,o=r+n*2;switch(e){case"middle":return`M${-s/2},${-o/2}h${s}v${o}h${-s}z`;case"top-left":return`M0,0l${t},${t}h${s-t}v${o}h${-s}z`;case"top":return`M0,0l${t/2},${t/2}h${(s-t)/2}v${o}h${-s}v${-o}h${(s-t)/2}z`;case"top-right":return`M0,0l${-t},${t}h${t-s}v${o}h${s}z`;case"right":return`M0,0l${-t/2},${-t/2}v${t/2-o/2}h${-s}v${o}h${s}v${t/2-o/2}z`;case"bottom-left":return`M0,0l${t},${-t}h${s-t}v${-o}h${-s}z`;case"bottom":return`M0,0l${t/2},${-t/2}h${(s-t)/2}v${-o}h${-s}v${o}h${(s-t)/2}z`;case"bottom-right":return`M0,0l${-t},${-t}h${t-s}v${-o}h${s}z`;case"left":return`M0,0l${t/2},${-t/2}v${t/2-o/2}h${s}v${o}h${-s}v${t/2-o/2}z`}}function EA(e,t){let n={},i=this.format;i=CA(i,e,"x"),i=CA(i,e,"y"),this.format=i;for(let r in i){let s=i[r];if(!(s===null||s===!1))if(r==="fx"||r==="fy")n[r]=!0;else{let o=sy(e,r);o&&(n[r]=o)}}for(let r in e){if(r in n||r in i||DD.has(r)||(r==="x"||r==="y")&&e.geometry)continue;let s=sy(e,r);if(s){if(s.scale==null&&s.defaultScale==="color")continue;n[r]=s}}this.facet&&(t.fx&&!("fx"in i)&&(n.fx=!0),t.fy&&!("fy"in i)&&(n.fy=!0));for(let r in n){let s=this.format[r];if(typeof s=="string"){let o=n[r]?.value??t[r]?.domain()??[];this.format[r]=(en(o)?rr:ji)(s)}else if(s===void 0||s===!0){let o=t[r];this.format[r]=o?.bandwidth?ul(o,o.domain()):fr}}return n}function CA(e,t,n){if(!(n in e))return e;let i=`${n}1`,r=`${n}2`;if((i in e||!(i in t))&&(r in e||!(r in t)))return e;let s=Object.entries(e),o=e[n];return s.splice(s.findIndex(([a])=>a===n)+1,0,[i,o],[r,o]),Object.fromEntries(s)}function BD(e,t,{title:n}){return this.format.title(n.value[e],e)}function*kD(e,t,n,i,r){for(let s in n){if(s==="fx"||s==="fy"){yield{label:ah(i,n,s),value:this.format[s](t[s],e)};continue}if(s==="x1"&&"x2"in n||s==="y1"&&"y2"in n)continue;let o=n[s];if(s==="x2"&&"x1"in n)yield{label:PA(i,n,"x"),value:RA(this.format.x2,n.x1,o,e)};else if(s==="y2"&&"y1"in n)yield{label:PA(i,n,"y"),value:RA(this.format.y2,n.y1,o,e)};else{let a=o.value[e],c=o.scale;if(!bi(a)&&c==null)continue;yield{label:ah(i,n,s),value:this.format[s](a,e),color:c==="color"?r[s][e]:null,opacity:c==="opacity"?r[s][e]:null}}}}function RA(e,t,n,i){return n.hint?.length?`${e(n.value[i]-t.value[i],i)}`:`${e(t.value[i],i)}\u2013${e(n.value[i],i)}`}function PA(e,t,n){let i=ah(e,t,`${n}1`,n),r=ah(e,t,`${n}2`,n);return i===r?i:`${i}\u2013${r}`}function ah(e,t,n,i=n){let r=t[n],s=e[r?.scale??n];return String(s?.label??r?.label??i)}function Pa(e={}){let{facet:t,style:n,title:i,subtitle:r,caption:s,ariaLabel:o,ariaDescription:a}=e,c=Ma(e.className),l=e.marks===void 0?[]:LA(e.marks);l.push(...$D(l));let u=HD(t,e),h=new Map;for(let B of l){let V=NA(B,u,e);V&&h.set(B,V)}let f=new Map;u&&pl(f,[u],e),pl(f,h,e);let d=LA(XD(l,f,e));for(let B of d){let V=NA(B,u,e);V&&h.set(B,V)}l.unshift(...d);let p=qw(f,e);if(p!==void 0){let B=u?kf(p,u):void 0;for(let q of l){if(q.facet===null||q.facet==="super")continue;let rt=h.get(q);rt!==void 0&&(rt.facetsIndex=q.fx!=null||q.fy!=null?kf(p,rt):B)}let V=new Set;for(let{facetsIndex:q}of h.values())q?.forEach((rt,ct)=>{rt?.length>0&&V.add(ct)});p.forEach(0<V.size&&V.size<p.length?(q,rt)=>q.empty=!V.has(rt):q=>q.empty=!1);for(let q of l)if(q.facet==="exclude"){let rt=h.get(q);rt!==void 0&&(rt.facetsIndex=Jw(rt.facetsIndex))}}for(let B of _e.keys())ua(e[B])&&B!=="fx"&&B!=="fy"&&f.set(B,[]);let y=new Map;for(let B of l){if(y.has(B))throw new Error("duplicate mark; each mark must be unique");let{facetsIndex:V,channels:q}=h.get(B)??{},{data:rt,facets:ct,channels:$}=B.initialize(V,q,e);e_($,e),y.set(B,{data:rt,facets:ct,channels:$})}let m=sl(pl(f,y,e),e),g=dT(m,l,e);Gw(m,g);let x=my(m),{fx:S,fy:v}=x,w=S||v?gy(m,g):g,b=S||v?QD(x,g):g,_=ba(e),M=_.document,C=Go("svg").call(M.documentElement),E=C;_.ownerSVGElement=C,_.className=c,_.projection=Qw(e,w),_.path=function(){return Fc(this.projection??sT(x))},_.filterFacets=(B,V)=>kf(p,{channels:V,groups:Of(B,V)}),_.getMarkState=B=>{let V=y.get(B),q=h.get(B);return{...V,channels:{...V.channels,...q?.channels}}},_.dispatchValue=B=>{E.value!==B&&(E.value=B,E.dispatchEvent(new _.document.defaultView.Event("input",{bubbles:!0})))};let I=new Set;for(let[B,V]of y)if(B.initializer!=null){let q=B.facet==="super"?b:w,rt=B.initializer(V.data,V.facets,V.channels,x,q,_);if(rt.data!==void 0&&(V.data=rt.data),rt.facets!==void 0&&(V.facets=rt.facets),rt.channels!==void 0){let{fx:ct,fy:$,...ot}=rt.channels;VD(ot),Object.assign(V.channels,ot);for(let ut of Object.values(ot)){let{scale:st}=ut;st!=null&&!GS(_e.get(st))&&(FA(ut,e),I.add(st))}(ct!=null||$!=null)&&h.set(B,!0)}}if(I.size){let B=new Map;pl(B,y,e,ct=>I.has(ct)),pl(f,y,e,ct=>I.has(ct));let V=jD(sl(B,e),m),{scales:q,...rt}=my(V);Object.assign(m,V),Object.assign(x,rt),Object.assign(x.scales,q)}let R,U;p!==void 0&&(R={x:S?.domain(),y:v?.domain()},p=Yw(p,R),U=Zw(S,v,g));for(let[B,V]of y)V.values=B.scale(V.channels,x,_);let{width:P,height:L}=g;Ii(C).attr("class",c).attr("fill","currentColor").attr("font-family","system-ui, sans-serif").attr("font-size",10).attr("text-anchor","middle").attr("width",P).attr("height",L).attr("viewBox",`0 0 ${P} ${L}`).attr("aria-label",o).attr("aria-description",a).call(B=>B.append("style").text(`:where(.${c}) {
  --plot-background: white;
  display: block;
  height: auto;
  height: intrinsic;
  max-width: 100%;
}
:where(.${c} text),
:where(.${c} tspan) {
  white-space: pre;
}`)).call(Sa,n);for(let B of l){let{channels:V,values:q,facets:rt}=y.get(B);if(p===void 0||B.facet==="super"){let ct=null;if(rt&&(ct=rt[0],ct=B.filter(ct,V,q),ct.length===0))continue;let $=B.render(ct,x,q,b,_);if($==null)continue;C.appendChild($)}else{let ct;for(let $ of p){if(!(B.facetAnchor?.(p,R,$)??!$.empty))continue;let ot=null;if(rt){let st=h.has(B);if(ot=rt[st?$.i:0],ot=B.filter(ot,V,q),ot.length===0)continue;!st&&ot===rt[0]&&(ot=AS(ot)),ot.fx=$.x,ot.fy=$.y,ot.fi=$.i}let ut=B.render(ot,x,q,w,_);if(ut!=null){(ct??=Ii(C).append("g")).append(()=>ut).datum($);for(let st of["aria-label","aria-description","aria-hidden","transform"])ut.hasAttribute(st)&&(ct.attr(st,ut.getAttribute(st)),ut.removeAttribute(st))}}ct?.selectChildren().each(U)}}let O=gA(m,_,e),{figure:D=i!=null||r!=null||s!=null||O.length>0}=e;D&&(E=M.createElement("figure"),E.className=`${c}-figure`,E.style.maxWidth="initial",i!=null&&E.append(IA(M,i,"h2")),r!=null&&E.append(IA(M,r,"h3")),E.append(...O,C),s!=null&&E.append(zD(M,s)),"value"in C&&(E.value=C.value,delete C.value)),E.scale=$w(x.scales),E.legend=dA(m,_,e);let Y=Mw();return Y>0&&Ii(C).append("text").attr("x",P).attr("y",20).attr("dy","-1em").attr("text-anchor","end").attr("font-family","initial").text("\u26A0\uFE0F").append("title").text(`${Y.toLocaleString("en-US")} warning${Y===1?"":"s"}. Please check the console.`),E}function IA(e,t,n){if(t.ownerDocument)return t;let i=e.createElement(n);return i.append(t),i}function zD(e,t){let n=e.createElement("figcaption");return n.append(t),n}function LA(e){return e.flat(1/0).filter(t=>t!=null).map(GD)}function GD(e){return typeof e.render=="function"?e:new t_(e)}var t_=class extends we{constructor(t){if(typeof t!="function")throw new TypeError("invalid mark; missing render function");super(),this.render=t}render(){}};function e_(e,t){for(let n in e)FA(e[n],t);return e}function FA(e,t){let{scale:n,transform:i=!0}=e;if(n==null||!i)return;let{type:r,percent:s,interval:o,transform:a=s?c=>c==null?NaN:c*100:Z0(o,r)}=t[n]??{};a!=null&&(e.value=Se(e.value,a),e.transform=!1)}function VD(e){for(let t in e)ry(t,e[t])}function pl(e,t,n,i=MS){for(let{channels:r}of t.values())for(let s in r){let o=r[s],{scale:a}=o;if(a!=null&&i(a))if(a==="projection"){if(!nT(n)){let c=n.x?.domain===void 0,l=n.y?.domain===void 0;if(c||l){let[u,h]=rT(o);c&&Qy(e,"x",u),l&&Qy(e,"y",h)}}}else Qy(e,a,o)}return e}function Qy(e,t,n){let i=e.get(t);i!==void 0?i.push(n):e.set(t,[n])}function HD(e,t){if(e==null)return;let{x:n,y:i}=e;if(n==null&&i==null)return;let r=Dr(e.data);if(r==null)throw new Error("missing facet data");let s={};n!=null&&(s.fx=ma(r,{value:n,scale:"fx"})),i!=null&&(s.fy=ma(r,{value:i,scale:"fy"})),e_(s,t);let o=Of(r,s);return{channels:s,groups:o,data:e.data}}function NA(e,t,n){if(e.facet===null||e.facet==="super")return;let{fx:i,fy:r}=e;if(i!=null||r!=null){let c=Dr(e.data??i??r);if(c===void 0)throw new Error(`missing facet data in ${e.ariaLabel}`);if(c===null)return;let l={};return i!=null&&(l.fx=ma(c,{value:i,scale:"fx"})),r!=null&&(l.fy=ma(c,{value:r,scale:"fy"})),e_(l,n),{channels:l,groups:Of(c,l)}}if(t===void 0)return;let{channels:s,groups:o,data:a}=t;if(e.facet!=="auto"||e.data===a)return{channels:s,groups:o};a.length>0&&(o.size>1||o.size===1&&s.fx&&s.fy&&[...o][0][1].size>1)&&ds(Dr(e.data))===ds(a)&&Vn(`Warning: the ${e.ariaLabel} mark appears to use faceted data, but isn\u2019t faceted. The mark data has the same length as the facet data and the mark facet option is "auto", but the mark data and facet data are distinct. If this mark should be faceted, set the mark facet option to true; otherwise, suppress this warning by setting the mark facet option to false.`)}function WD(e,t={}){return Ur({...t,x:null,y:null},(n,i,r,s,o,a)=>a.getMarkState(e))}function $D(e){let t=[];for(let n of e){let i=n.tip;if(i){i===!0?i={}:typeof i=="string"&&(i={pointer:i});let{pointer:r,preferredAnchor:s}=i;r=/^x$/i.test(r)?Cy:/^y$/i.test(r)?Hf:Ta,i=r(WD(n,i)),i.title=null,s===void 0&&(i.preferredAnchor=r===Hf?"left":"bottom");let o=Ra(n.data,i);o.facet=n.facet,o.facetAnchor=n.facetAnchor,t.push(o)}}return t}function XD(e,t,n){let{projection:i,x:r={},y:s={},fx:o={},fy:a={},axis:c,grid:l,facet:u={},facet:{axis:h=c,grid:f}=u,x:{axis:d=c,grid:p=d===null?null:l}=r,y:{axis:y=c,grid:m=y===null?null:l}=s,fx:{axis:g=h,grid:x=g===null?null:f}=o,fy:{axis:S=h,grid:v=S===null?null:f}=a}=n;(i||!ua(r)&&!DA("x",e))&&(d=p=null),(i||!ua(s)&&!DA("y",e))&&(y=m=null),t.has("fx")||(g=x=null),t.has("fy")||(S=v=null),d===void 0&&(d=!uh(e,"x")),y===void 0&&(y=!uh(e,"y")),g===void 0&&(g=!uh(e,"fx")),S===void 0&&(S=!uh(e,"fy")),d===!0&&(d="bottom"),y===!0&&(y="left"),g===!0&&(g=d==="top"||d===null?"bottom":"top"),S===!0&&(S=y==="right"||y===null?"left":"right");let w=[];return lh(w,v,KT,a),ch(w,S,XT,"right","left",u,a),lh(w,x,QT,o),ch(w,g,qT,"top","bottom",u,o),lh(w,m,JT,s),ch(w,y,$y,"left","right",n,s),lh(w,p,jT,r),ch(w,d,Xy,"bottom","top",n,r),w}function ch(e,t,n,i,r,s,o){if(!t)return;let a=qD(t);o=YD(a?i:t,s,o);let{line:c}=o;(n===$y||n===Xy)&&c&&!go(c)&&e.push(AA(ZD(o))),e.push(n(o)),a&&e.push(n({...o,anchor:r,label:null}))}function lh(e,t,n,i){!t||go(t)||e.push(n(JD(t,i)))}function qD(e){return/^\s*both\s*$/i.test(e)}function YD(e,t,{line:n=t.line,ticks:i,tickSize:r,tickSpacing:s,tickPadding:o,tickFormat:a,tickRotate:c,fontVariant:l,ariaLabel:u,ariaDescription:h,label:f=t.label,labelAnchor:d,labelArrow:p=t.labelArrow,labelOffset:y}){return{anchor:e,line:n,ticks:i,tickSize:r,tickSpacing:s,tickPadding:o,tickFormat:a,tickRotate:c,fontVariant:l,ariaLabel:u,ariaDescription:h,label:f,labelAnchor:d,labelArrow:p,labelOffset:y}}function ZD(e){let{anchor:t,line:n}=e;return{anchor:t,facetAnchor:t+"-empty",stroke:n===!0?void 0:n}}function JD(e,{stroke:t=ha(e)?e:void 0,ticks:n=KD(e)?e:void 0,tickSpacing:i,ariaLabel:r,ariaDescription:s}){return{stroke:t,ticks:n,tickSpacing:i,ariaLabel:r,ariaDescription:s}}function KD(e){switch(typeof e){case"number":return!0;case"string":return!ha(e)}return Si(e)||typeof e?.range=="function"}function uh(e,t){let n=`${t}-axis `;return e.some(i=>i.ariaLabel?.startsWith(n))}function DA(e,t){for(let n of t)for(let i in n.channels){let{scale:r}=n.channels[i];if(r===e||r==="projection")return!0}return!1}function jD(e,t){for(let n in e){let i=e[n],r=t[n];i.label===void 0&&r&&(i.label=r.label)}return e}function QD({fx:e,fy:t},n){let{marginTop:i,marginRight:r,marginBottom:s,marginLeft:o,width:a,height:c}=Uf(n),l=e&&UA(e),u=t&&UA(t);return{marginTop:t?u[0]:i,marginRight:e?a-l[1]:r,marginBottom:t?c-u[1]:s,marginLeft:e?l[0]:o,inset:{marginTop:n.marginTop,marginRight:n.marginRight,marginBottom:n.marginBottom,marginLeft:n.marginLeft},width:a,height:c}}function UA(e){let t=e.domain();if(t.length===0)return[0,e.bandwidth()];let n=e(t[0]),i=e(t[t.length-1]);return i<n&&([n,i]=[i,n]),[n,i+e.bandwidth()]}var tU=new Map([["basis",kM],["basis-closed",GM],["basis-open",HM],["bundle",$M],["bump-x",NM],["bump-y",DM],["cardinal",XM],["cardinal-closed",qM],["cardinal-open",YM],["catmull-rom",JM],["catmull-rom-closed",jM],["catmull-rom-open",tS],["linear",ra],["linear-closed",nS],["monotone-x",sS],["monotone-y",oS],["natural",cS],["step",lS],["step-after",fS],["step-before",uS]]);function eU(e=ra,t){if(typeof e=="function")return e;let n=tU.get(`${e}`.toLowerCase());if(!n)throw new Error(`unknown curve: ${e}`);if(t!==void 0){if("beta"in n)return n.beta(t);if("tension"in n)return n.tension(t);if("alpha"in n)return n.alpha(t)}return n}function OA(e=ml,t){return typeof e!="function"&&`${e}`.toLowerCase()==="auto"?ml:eU(e,t)}function ml(e){return ra(e)}var nU={ariaLabel:"bar"},Ia=class extends we{constructor(t,n,i={},r=nU){super(t,n,i,r),fl(this,i),hl(this,i)}render(t,n,i,r,s){let{rx:o,ry:a,rx1y1:c,rx1y2:l,rx2y1:u,rx2y2:h}=this,f=this._x(n,i,r),d=this._y(n,i,r),p=this._width(n,i,r),y=this._height(n,i,r);return le("svg:g",s).call($e,this,r,s).call(this._transform,this,n).call(m=>m.selectAll().data(t).enter().call(c||l||u||h?g=>g.append("path").call(Oe,this).call(dl,f,d,BA(f,p),BA(d,y),this).call(hn,this,i):g=>g.append("rect").call(Oe,this).attr("x",f).attr("width",p).attr("y",d).attr("height",y).call(Bt,"rx",o).call(Bt,"ry",a).call(hn,this,i))).node()}_x(t,{x:n},{marginLeft:i}){let{insetLeft:r}=this;return n?s=>n[s]+r:i+r}_y(t,{y:n},{marginTop:i}){let{insetTop:r}=this;return n?s=>n[s]+r:i+r}_width({x:t},{x:n},{marginRight:i,marginLeft:r,width:s}){let{insetLeft:o,insetRight:a}=this,c=n&&t?t.bandwidth():s-i-r;return Math.max(0,c-o-a)}_height({y:t},{y:n},{marginTop:i,marginBottom:r,height:s}){let{insetTop:o,insetBottom:a}=this,c=n&&t?t.bandwidth():s-i-r;return Math.max(0,c-o-a)}};function BA(e,t){return typeof e=="function"&&typeof t=="function"?n=>e(n)+t(n):typeof e=="function"?n=>e(n)+t:typeof t=="function"?n=>e+t(n):e+t}var fh=class extends Ia{constructor(t,n={},i){let{x1:r,x2:s,y:o}=n;super(t,{x1:{value:r,scale:"x"},x2:{value:s,scale:"x"},y:{value:o,scale:"y",type:"band",optional:!0}},n,i)}_transform(t,n,{x:i}){t.call(Ne,n,{x:i},0,0)}_x({x:t},{x1:n,x2:i},{marginLeft:r}){let{insetLeft:s}=this;return Zn(t)?r+s:o=>Math.min(n[o],i[o])+s}_width({x:t},{x1:n,x2:i},{marginRight:r,marginLeft:s,width:o}){let{insetLeft:a,insetRight:c}=this;return Zn(t)?o-r-s-a-c:l=>Math.max(0,Math.abs(i[l]-n[l])-a-c)}},hh=class extends Ia{constructor(t,n={},i){let{x:r,y1:s,y2:o}=n;super(t,{y1:{value:s,scale:"y"},y2:{value:o,scale:"y"},x:{value:r,scale:"x",type:"band",optional:!0}},n,i)}_transform(t,n,{y:i}){t.call(Ne,n,{y:i},0,0)}_y({y:t},{y1:n,y2:i},{marginTop:r}){let{insetTop:s}=this;return Zn(t)?r+s:o=>Math.min(n[o],i[o])+s}_height({y:t},{y1:n,y2:i},{marginTop:r,marginBottom:s,height:o}){let{insetTop:a,insetBottom:c}=this;return Zn(t)?o-r-s-a-c:l=>Math.max(0,Math.abs(i[l]-n[l])-a-c)}};function n_(e,t={}){return tl(t)||(t={...t,y:Nr,x2:be}),new fh(e,Zy(Xf(Yy(t))))}function i_(e,t={}){return tl(t)||(t={...t,x:Nr,y2:be}),new hh(e,eh(qf(th(t))))}var iU={ariaLabel:"cell"},dh=class extends Ia{constructor(t,{x:n,y:i,...r}={}){super(t,{x:{value:n,scale:"x",type:"band",optional:!0},y:{value:i,scale:"y",type:"band",optional:!0}},r,iU)}_transform(t,n){t.call(Ne,n,{},0,0)}};function ph(e,{x:t,y:n,...i}={}){return[t,n]=Fi(t,n),new dh(e,{...i,x:t,y:n})}var rU={ariaLabel:"dot",fill:"none",stroke:"currentColor",strokeWidth:1.5};function sU(e){return e.sort===void 0&&e.reverse===void 0?qS({channel:"-r"},e):e}var mh=class extends we{constructor(t,n={}){let{x:i,y:r,r:s,rotate:o,symbol:a=uo,frameAnchor:c}=n,[l,u]=Ie(o,0),[h,f]=WS(a),[d,p]=Ie(s,h==null?3:4.5);super(t,{x:{value:i,scale:"x",optional:!0},y:{value:r,scale:"y",optional:!0},r:{value:d,scale:"r",filter:ho,optional:!0},rotate:{value:l,optional:!0},symbol:{value:h,scale:"auto",optional:!0}},sU(n),rU),this.r=p,this.rotate=u,this.symbol=f,this.frameAnchor=ys(c);let{channels:y}=this,{symbol:m}=y;if(m){let{fill:g,stroke:x}=y;m.hint={fill:g?g.value===m.value?"color":"currentColor":this.fill??"currentColor",stroke:x?x.value===m.value?"color":"currentColor":this.stroke??"none"}}}render(t,n,i,r,s){let{x:o,y:a}=n,{x:c,y:l,r:u,rotate:h,symbol:f}=i,{r:d,rotate:p,symbol:y}=this,[m,g]=hr(this,r),x=y===uo,S=u?void 0:d*d*Math.PI;return sa(d)&&(t=[]),le("svg:g",s).call($e,this,r,s).call(Ne,this,{x:c&&o,y:l&&a}).call(v=>v.selectAll().data(t).enter().append(x?"circle":"path").call(Oe,this).call(x?w=>{w.attr("cx",c?b=>c[b]:m).attr("cy",l?b=>l[b]:g).attr("r",u?b=>u[b]:d)}:w=>{w.attr("transform",Aa`translate(${c?b=>c[b]:m},${l?b=>l[b]:g})${h?b=>` rotate(${h[b]})`:p?` rotate(${p})`:""}`).attr("d",u&&f?b=>{let _=Ki();return f[b].draw(_,u[b]*u[b]*Math.PI),_}:u?b=>{let _=Ki();return y.draw(_,u[b]*u[b]*Math.PI),_}:f?b=>{let _=Ki();return f[b].draw(_,S),_}:(()=>{let b=Ki();return y.draw(b,S),b})())}).call(hn,this,i)).node()}};function r_(e,{x:t,y:n,...i}={}){return i.frameAnchor===void 0&&([t,n]=Fi(t,n)),new mh(e,{...i,x:t,y:n})}var oU={ariaLabel:"line",fill:"none",stroke:"currentColor",strokeWidth:1.5,strokeLinecap:"round",strokeLinejoin:"round",strokeMiterlimit:1},gh=class extends we{constructor(t,n={}){let{x:i,y:r,z:s,curve:o,tension:a}=n;super(t,{x:{value:i,scale:"x"},y:{value:r,scale:"y"},z:{value:Tf(n),optional:!0}},n,oU),this.z=s,this.curve=OA(o,a),al(this,n)}filter(t){return t}project(t,n,i){this.curve!==ml&&super.project(t,n,i)}render(t,n,i,r,s){let{x:o,y:a}=i,{curve:c}=this;return le("svg:g",s).call($e,this,r,s).call(Ne,this,n).call(l=>l.selectAll().data(uT(t,[o,a],this,i)).enter().append("path").call(Oe,this).call(lT,this,i).call(_T,this,i,s).attr("d",c===ml&&s.projection?aU(s.path(),o,a):IM().curve(c).defined(u=>u>=0).x(u=>o[u]).y(u=>a[u]))).node()}};function aU(e,t,n){return t=mo(t),n=mo(n),i=>{let r=[],s=[r];for(let o of i)o===-1?(r=[],s.push(r)):r.push([t[o],n[o]]);return e({type:"MultiLineString",coordinates:s})}}function s_(e,{x:t,y:n,...i}={}){return[t,n]=Fi(t,n),new gh(e,{...i,x:t,y:n})}we.prototype.plot=function({marks:e=[],...t}={}){return Pa({...t,marks:[...e,this]})};var lU=50,uU=44;function fU(e){let t=ai(e);return e.columns.filter(n=>n.hidden||n.label==="file"&&n.values.names?.length===1?!1:n.values.names?t===0||n.values.names.some(i=>i!==""):t===0||n.values.some(i=>i!=null&&i!==""))}function gl(e,{title:t,onselect:n,page:i=lU}={}){let r=ai(e),s=fU(e),o=Array.from({length:r},(R,U)=>U),a=null,c=!1,l=0,u=-1,h=St("tbody"),f=St("span",{className:"where","aria-live":"polite"}),d=St("button",{type:"button",onclick:()=>m(-1)},"\u2039 Previous"),p=St("button",{type:"button",onclick:()=>m(1)},"Next \u203A"),y=s.map(R=>{let U=St("button",{type:"button",className:"sort",onclick:()=>g(R)},Ws(R));return St("th",{scope:"col",className:r&&typeof oe(R,0)=="number"?"number":""},U)});function m(R){l=Math.max(0,Math.min(l+R*i,Math.floor(Math.max(0,o.length-1)/i)*i)),v()}function g(R){c=a===R?!c:typeof oe(R,0)=="number",a=R,x()}function x(){let R=_.value.trim().toLowerCase();if(o=Array.from({length:r},(U,P)=>P),R&&(o=o.filter(U=>s.some(P=>String(oe(P,U)??"").toLowerCase().includes(R)))),a){let U=c?-1:1;o.sort((P,L)=>{let[O,D]=[oe(a,P),oe(a,L)];return O==null||D==null?(O==null)-(D==null):U*(typeof O=="number"?O-D:String(O).localeCompare(String(D)))})}for(let[U,P]of s.entries()){let L=a===P?c?"descending":"ascending":null;L?y[U].setAttribute("aria-sort",L):y[U].removeAttribute("aria-sort")}l=0,v()}function S(R){let U=s.map(L=>{let O=oe(L,R),Y=St("td",{className:typeof O=="number"?"number":""},pc(O));return typeof O=="string"&&O.length>uU&&Y.classList.add("long"),L.label==="severity"&&O&&Y.classList.add("severity",String(O)),Y}),P=St("tr",{"data-row":String(R)},...U);return n&&(P.setAttribute("aria-selected",String(R===u)),P.tabIndex=R===u||u<0&&R===o[l]?0:-1,P.addEventListener("click",()=>w(R,!0))),P}function v(){let R=o.slice(l,l+i);h.replaceChildren(...R.map(S)),n&&R.length&&!h.querySelector('tr[tabindex="0"]')&&(h.firstElementChild.tabIndex=0);let U=l+R.length;f.textContent=o.length?`${l+1}\u2013${U} of ${o.length}`:"no rows",d.disabled=l===0,p.disabled=U>=o.length}function w(R,U,P=!1){u=R;let L=o.indexOf(R);L<0&&(_.value="",x(),L=o.indexOf(R)),L>=0&&(l=Math.floor(L/i)*i),v();let O=h.querySelector(`tr[data-row="${R}"]`);O&&P&&O.focus();let D=M.parentElement;if(O&&D){let Y=O.offsetTop-D.offsetTop;Y<D.scrollTop+O.offsetHeight?D.scrollTop=Y-O.offsetHeight:Y+O.offsetHeight>D.scrollTop+D.clientHeight&&(D.scrollTop=Y+O.offsetHeight-D.clientHeight)}U&&n?.(R)}function b(R){let U=o.indexOf(Number(R.target.closest("tr")?.dataset.row??u)),P={ArrowDown:1,ArrowUp:-1,PageDown:i,PageUp:-i,Home:-1/0,End:1/0};if(R.key==="Enter"||R.key===" ")R.preventDefault(),w(o[U],!0,!0);else if(R.key in P&&o.length){R.preventDefault();let L=Math.max(0,Math.min(o.length-1,U+P[R.key]));w(o[L],!0,!0)}}let _=St("input",{type:"search",placeholder:"search","aria-label":`Search ${t??"table"}`,oninput:x}),M=St("table",n?{role:"grid","aria-label":t,onkeydown:b}:{"aria-label":t},St("thead",{},St("tr",{},...y)),h),C=r>i,E=St("div",{className:"bar"});return r>10&&E.append(_),C&&E.append(d,p),(C||r>10)&&E.append(f),E.append(Zx(e,Jx(t??"table"))),v(),{node:St("div",{className:"table"},St("div",{className:"rows"},M),E),select:R=>w(R,!1)}}function yh(e,t){let n=St("details",{className:"behind"},St("summary",{},"Table"));return n.addEventListener("toggle",()=>{n.open&&n.children.length===1&&n.append(gl(e(),{title:t}).node)}),n}var hU=3e3,a_=e=>`var(--${e??"one"})`;function o_(e,t,n=hU){if(e.length<=n)return e;let i=Math.floor(n/2),r=[];for(let s=0;s<i;s+=1){let o=Math.floor(s*e.length/i),a=Math.floor((s+1)*e.length/i),[c,l]=[e[o],e[o]];for(let u=o;u<a;u+=1)t(e[u])<t(c)&&(c=e[u]),t(e[u])>t(l)&&(l=e[u]);c===l?r.push(c):r.push(...e.indexOf(c,o)<e.indexOf(l,o)?[c,l]:[l,c])}return r}function kA(e){let t=ai({columns:e}),n=[];for(let i=0;i<t;i+=1)e.every(r=>oe(r,i)!=null)&&n.push(i);return n}function dU(e,t){let n=l=>t[l],i=a_(e.tone),r=l=>u=>oe(n(l),u),s=[e.x,e.x2,e.y,e.y2].filter(l=>l!=null).map(n),o=kA(s),[a,c]=[r(e.x),r(e.y)];switch(e.kind){case"line":return[s_(o_(o,c),{x:a,y:c,stroke:i,strokeWidth:1.5})];case"histogram":return[Jy(o,{x1:a,x2:r(e.x2),y:c,fill:i,inset:.4})];case"bars":return[i_(o,{x:a,y:c,fill:i,fillOpacity:.85})];case"rows":return[cl([0]),n_(o,{x:c,y:a,fill:i,fillOpacity:.85,sort:null}),...e.y2==null?[]:[vo(o,{y:a,x1:l=>c(l)-r(e.y2)(l),x2:l=>c(l)+r(e.y2)(l),stroke:"currentColor",strokeWidth:1.2})]];case"level":return[vo(o,{y:c,stroke:i,strokeDasharray:"5 3",strokeWidth:1.5})];default:return[r_(o_(o,c),{x:a,y:c,fill:i,fillOpacity:.75,r:o.length>600?1.6:2.6})]}}function pU(e){let t=e.filter(i=>i.name);if(t.length<2)return null;let n=t.map(i=>St("li",{},St("i",{style:`background:${a_(i.tone)}`}),i.name));return St("ul",{className:"legend"},...n)}function zA(e){let t=St("div",{className:"plot"}),n=0,i=()=>{let r=Math.round(t.clientWidth);r>0&&r!==n&&(n=r,t.replaceChildren(e(r)))};return new ResizeObserver(i).observe(t),t}function _h(e,t,n){let i=t.columns,r=e.series.some(c=>c.kind==="rows"),s=c=>c?.unit?`${c.label}, ${c.unit}`:c?.label,o=e.series.find(c=>c.kind==="line"||c.kind==="dots"),a=c=>{let l=[vo(r?[]:[0],{strokeOpacity:.3})];for(let y of e.series)l.push(...dU(y,i));if(o){let y=o_(kA([i[o.x],i[o.y]]),g=>oe(i[o.y],g)),m={x:g=>oe(i[o.x],g),y:g=>oe(i[o.y],g)};l.push(Ra(y,Ta({...m,title:g=>i.filter(x=>!x.hidden).slice(0,6).map(x=>`${Ws(x)}: ${oe(x,g)??"\u2013"}`).join(`
`)})))}let u=ai(t),h=e.series.find(y=>y.kind==="histogram"),f=h?Math.max(...Array.from({length:u},(y,m)=>oe(i[h.y],m))):1/0,d=r?Math.max(4,...Array.from({length:u},(y,m)=>String(oe(i[e.series[0].x],m)).length)):0,p=Pa({width:c,height:r?60+20*u:e.height??260,marginLeft:r?Math.min(c*.62,14+6.6*d):56,marginBottom:46,style:{background:"transparent",fontSize:"12px",overflow:"visible"},x:r?{label:s(e.y),grid:!0}:{label:s(e.x),type:e.bands?"band":void 0,domain:e.bands?Array.from({length:u},(y,m)=>oe(i[e.series[0].x],m)):void 0},y:r?{label:null,type:"band",domain:Array.from({length:u},(y,m)=>oe(i[e.series[0].x],m))}:{label:s(e.y),grid:!0,zero:!0,nice:!0,ticks:Math.min(f,5)},marks:l});return p.setAttribute("role","img"),p.setAttribute("aria-label",e.title),n&&(p.addEventListener("click",()=>{p.value!=null&&n(p.value)}),p.style.cursor="pointer"),p};return St("figure",{className:e.wide?"chart wide":"chart"},St("figcaption",{},St("h3",{},e.title),e.note?St("p",{},e.note):null),pU(e.series),zA(a),yh(()=>t,e.title))}function GA(e){let t=e.names,n=[];for(let a=0;a<t.length;a+=1)for(let c=0;c<t.length;c+=1){let l=e.values[Math.max(a,c)][Math.min(a,c)];l!=null&&n.push({i:a,j:c,value:l})}let i=Math.max(4,...t.map(a=>a.length)),r=a=>{let c=Math.min(a*.35,10+6*i),l=Math.max(6,Math.min(26,(a-c-10)/t.length)),u=l<11,h=Pa({width:c+10+l*t.length,height:c+10+l*t.length,marginLeft:c,marginTop:c,marginRight:10,marginBottom:10,style:{background:"transparent",fontSize:u?"8px":"11px"},x:{axis:"top",type:"band",domain:t.map((f,d)=>d),tickFormat:f=>t[f],tickRotate:-90,label:null,padding:.04},y:{type:"band",domain:t.map((f,d)=>d),tickFormat:f=>t[f],label:null,padding:.04},marks:[ph(n,{x:"j",y:"i",fill:"none",stroke:"currentColor",strokeOpacity:.1}),ph(n,{x:"j",y:"i",fill:{value:f=>a_(f.value<0?"after":"before"),scale:null},fillOpacity:{value:f=>Math.abs(f.value),scale:null}}),Ra(n,Ta({x:"j",y:"i",title:f=>`${t[f.i]}
${t[f.j]}
${f.value}`}))]});return h.setAttribute("role","img"),h.setAttribute("aria-label",e.title),h},s=()=>{let a=n.filter(c=>c.i>c.j);return{columns:[{label:"one",values:a.map(c=>t[c.i])},{label:"other",values:a.map(c=>t[c.j])},{label:"correlation",values:a.map(c=>c.value)}]}},o=St("div",{className:"scale heat"},St("span",{},"\u22121"),St("i"),St("span",{},"+1"));return St("figure",{className:"chart wide"},St("figcaption",{},St("h3",{},e.title),e.note?St("p",{},e.note):null),o,zA(r),yh(s,e.title))}var Fs={LEFT:0,MIDDLE:1,RIGHT:2,ROTATE:0,DOLLY:1,PAN:2},Os={ROTATE:0,PAN:1,DOLLY_PAN:2,DOLLY_ROTATE:3},bE=0,B_=1,ME=2;var jl=1,SE=2,sc=3,Bs=0,Un=1,Ri=2,Co=0,oc=1,k_=2,z_=3,G_=4,wE=5;var Ro=100,TE=101,AE=102,EE=103,CE=104,RE=200,PE=201,IE=202,LE=203,V_=204,H_=205,NE=206,DE=207,UE=208,FE=209,OE=210,BE=211,kE=212,zE=213,GE=214,Xh=0,qh=1,Yh=2,Ya=3,Zh=4,Jh=5,Kh=6,jh=7,Ad=0,VE=1,HE=2,gr=0,W_=1,$_=2,X_=3,q_=4,Y_=5,Z_=6,J_=7;var K_=300,Po=301,ac=302,Ed=303,Cd=304,Qh=1e3,pr=1001,td=1002,an=1003,WE=1004;var Ql=1005;var Nn=1006,Rd=1007;var Jr=1008;var Hn=1009,j_=1010,Q_=1011,cc=1012,Pd=1013,Hi=1014,Wi=1015,$i=1016,Id=1017,Ld=1018,Io=1020,tx=35902,ex=35899,nx=1021,ix=1022,Xi=1023,Xr=1026,Kr=1027,rx=1028,Nd=1029,ks=1030,Dd=1031;var Ud=1033,tu=33776,eu=33777,nu=33778,iu=33779,Fd=35840,Od=35841,Bd=35842,kd=35843,zd=36196,Gd=37492,Vd=37496,Hd=37488,Wd=37489,ru=37490,$d=37491,Xd=37808,qd=37809,Yd=37810,Zd=37811,Jd=37812,Kd=37813,jd=37814,Qd=37815,tp=37816,ep=37817,np=37818,ip=37819,rp=37820,sp=37821,op=36492,ap=36494,cp=36495,lp=36283,up=36284,su=36285,fp=36286;var Tl=2300,ed=2301,Wh=2302,P_=2303,I_=2400,L_=2401,N_=2402;var $E=3200;var hp=0,XE=1,jr="",jn="srgb",Al="srgb-linear",El="linear",de="srgb";var $h=7680;var qE=519,YE=512,ZE=513,JE=514,sx=515,KE=516,jE=517,ox=518,ax=519,cx=35044;var lx="300 es",Ai=2e3,Za=2001;function mU(e){for(let t=e.length-1;t>=0;--t)if(e[t]>=65535)return!0;return!1}function gU(e){return ArrayBuffer.isView(e)&&!(e instanceof DataView)}function Cl(e){return document.createElementNS("http://www.w3.org/1999/xhtml",e)}function QE(){let e=Cl("canvas");return e.style.display="block",e}var VA={},Ja=null;function Rl(...e){let t="THREE."+e.shift();Ja?Ja("log",t,...e):console.log(t,...e)}function t2(e){let t=e[0];if(typeof t=="string"&&t.startsWith("TSL:")){let n=e[1];n&&n.isStackTrace?e[0]+=" "+n.getLocation():e[1]='Stack trace not available. Enable "THREE.Node.captureStackTrace" to capture stack traces.'}return e}function Ut(...e){e=t2(e);let t="THREE."+e.shift();if(Ja)Ja("warn",t,...e);else{let n=e[0];n&&n.isStackTrace?console.warn(n.getError(t)):console.warn(t,...e)}}function kt(...e){e=t2(e);let t="THREE."+e.shift();if(Ja)Ja("error",t,...e);else{let n=e[0];n&&n.isStackTrace?console.error(n.getError(t)):console.error(t,...e)}}function Ml(...e){let t=e.join(" ");t in VA||(VA[t]=!0,Ut(...e))}function e2(e,t,n){return new Promise(function(i,r){function s(){switch(e.clientWaitSync(t,e.SYNC_FLUSH_COMMANDS_BIT,0)){case e.WAIT_FAILED:r();break;case e.TIMEOUT_EXPIRED:setTimeout(s,n);break;default:i()}}setTimeout(s,n)})}var n2={[Xh]:Xh,[Yh]:Kh,[Zh]:Zh,[Ya]:Jh,[qh]:qh,[Kh]:Yh,[jh]:jh,[Jh]:Ya},Gi=class{addEventListener(t,n){this._listeners===void 0&&(this._listeners={});let i=this._listeners;i[t]===void 0&&(i[t]=[]),i[t].indexOf(n)===-1&&i[t].push(n)}hasEventListener(t,n){let i=this._listeners;return i===void 0?!1:i[t]!==void 0&&i[t].indexOf(n)!==-1}removeEventListener(t,n){let i=this._listeners;if(i===void 0)return;let r=i[t];if(r!==void 0){let s=r.indexOf(n);s!==-1&&r.splice(s,1)}}dispatchEvent(t){let n=this._listeners;if(n===void 0)return;let i=n[t.type];if(i!==void 0){t.target=this;let r=i.slice(0);for(let s=0,o=r.length;s<o;s++)r[s].call(this,t);t.target=null}}},bn=["00","01","02","03","04","05","06","07","08","09","0a","0b","0c","0d","0e","0f","10","11","12","13","14","15","16","17","18","19","1a","1b","1c","1d","1e","1f","20","21","22","23","24","25","26","27","28","29","2a","2b","2c","2d","2e","2f","30","31","32","33","34","35","36","37","38","39","3a","3b","3c","3d","3e","3f","40","41","42","43","44","45","46","47","48","49","4a","4b","4c","4d","4e","4f","50","51","52","53","54","55","56","57","58","59","5a","5b","5c","5d","5e","5f","60","61","62","63","64","65","66","67","68","69","6a","6b","6c","6d","6e","6f","70","71","72","73","74","75","76","77","78","79","7a","7b","7c","7d","7e","7f","80","81","82","83","84","85","86","87","88","89","8a","8b","8c","8d","8e","8f","90","91","92","93","94","95","96","97","98","99","9a","9b","9c","9d","9e","9f","a0","a1","a2","a3","a4","a5","a6","a7","a8","a9","aa","ab","ac","ad","ae","af","b0","b1","b2","b3","b4","b5","b6","b7","b8","b9","ba","bb","bc","bd","be","bf","c0","c1","c2","c3","c4","c5","c6","c7","c8","c9","ca","cb","cc","cd","ce","cf","d0","d1","d2","d3","d4","d5","d6","d7","d8","d9","da","db","dc","dd","de","df","e0","e1","e2","e3","e4","e5","e6","e7","e8","e9","ea","eb","ec","ed","ee","ef","f0","f1","f2","f3","f4","f5","f6","f7","f8","f9","fa","fb","fc","fd","fe","ff"],HA=1234567,Sl=Math.PI/180,Ka=180/Math.PI;function zs(){let e=Math.random()*4294967295|0,t=Math.random()*4294967295|0,n=Math.random()*4294967295|0,i=Math.random()*4294967295|0;return(bn[e&255]+bn[e>>8&255]+bn[e>>16&255]+bn[e>>24&255]+"-"+bn[t&255]+bn[t>>8&255]+"-"+bn[t>>16&15|64]+bn[t>>24&255]+"-"+bn[n&63|128]+bn[n>>8&255]+"-"+bn[n>>16&255]+bn[n>>24&255]+bn[i&255]+bn[i>>8&255]+bn[i>>16&255]+bn[i>>24&255]).toLowerCase()}function Ht(e,t,n){return Math.max(t,Math.min(n,e))}function ux(e,t){return(e%t+t)%t}function yU(e,t,n,i,r){return i+(e-t)*(r-i)/(n-t)}function _U(e,t,n){return e!==t?(n-e)/(t-e):0}function wl(e,t,n){return(1-n)*e+n*t}function xU(e,t,n,i){return wl(e,t,1-Math.exp(-n*i))}function vU(e,t=1){return t-Math.abs(ux(e,t*2)-t)}function bU(e,t,n){return e<=t?0:e>=n?1:(e=(e-t)/(n-t),e*e*(3-2*e))}function MU(e,t,n){return e<=t?0:e>=n?1:(e=(e-t)/(n-t),e*e*e*(e*(e*6-15)+10))}function SU(e,t){return e+Math.floor(Math.random()*(t-e+1))}function wU(e,t){return e+Math.random()*(t-e)}function TU(e){return e*(.5-Math.random())}function AU(e){e!==void 0&&(HA=e);let t=HA+=1831565813;return t=Math.imul(t^t>>>15,t|1),t^=t+Math.imul(t^t>>>7,t|61),((t^t>>>14)>>>0)/4294967296}function EU(e){return e*Sl}function CU(e){return e*Ka}function RU(e){return e>0&&Number.isInteger(e)&&2**Math.round(Math.log2(e))===e}function PU(e){return Math.pow(2,Math.ceil(Math.log(e)/Math.LN2))}function fx(e){return Math.pow(2,Math.floor(Math.log(e)/Math.LN2))}function IU(e,t,n,i,r){let s=Math.cos,o=Math.sin,a=s(n/2),c=o(n/2),l=s((t+i)/2),u=o((t+i)/2),h=s((t-i)/2),f=o((t-i)/2),d=s((i-t)/2),p=o((i-t)/2);switch(r){case"XYX":e.set(a*u,c*h,c*f,a*l);break;case"YZY":e.set(c*f,a*u,c*h,a*l);break;case"ZXZ":e.set(c*h,c*f,a*u,a*l);break;case"XZX":e.set(a*u,c*p,c*d,a*l);break;case"YXY":e.set(c*d,a*u,c*p,a*l);break;case"ZYZ":e.set(c*p,c*d,a*u,a*l);break;default:Ut("MathUtils: .setQuaternionFromProperEuler() encountered an unknown order: "+r)}}function dp(e){switch(e.constructor){case Uint32Array:return 4294967295;case Uint16Array:return 65535;case Uint8Array:case Uint8ClampedArray:return 255;case Int32Array:return 2147483647;case Int16Array:return 32767;case Int8Array:return 127;default:return}}function hx(e,t){if(t.constructor===Float32Array)return e;let n=dp(t);if(n===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.max(e/n,-1)}function dx(e,t){if(t.constructor===Float32Array)return e;let n=dp(t);if(n===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.round(e*n)}var ou={DEG2RAD:Sl,RAD2DEG:Ka,generateUUID:zs,clamp:Ht,euclideanModulo:ux,mapLinear:yU,inverseLerp:_U,lerp:wl,damp:xU,pingpong:vU,smoothstep:bU,smootherstep:MU,randInt:SU,randFloat:wU,randFloatSpread:TU,seededRandom:AU,degToRad:EU,radToDeg:CU,isPowerOfTwo:RU,ceilPowerOfTwo:PU,floorPowerOfTwo:fx,setQuaternionFromProperEuler:IU,normalize:dx,denormalize:hx},Ft=class{static{this.prototype.isVector2=!0}constructor(t=0,n=0){this.x=t,this.y=n}get width(){return this.x}set width(t){this.x=t}get height(){return this.y}set height(t){this.y=t}set(t,n){return this.x=t,this.y=n,this}setScalar(t){return this.x=t,this.y=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setComponent(t,n){switch(t){case 0:this.x=n;break;case 1:this.y=n;break;default:throw new Error("THREE.Vector2: index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;default:throw new Error("THREE.Vector2: index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y)}copy(t){return this.x=t.x,this.y=t.y,this}add(t){return this.x+=t.x,this.y+=t.y,this}addScalar(t){return this.x+=t,this.y+=t,this}addVectors(t,n){return this.x=t.x+n.x,this.y=t.y+n.y,this}addScaledVector(t,n){return this.x+=t.x*n,this.y+=t.y*n,this}sub(t){return this.x-=t.x,this.y-=t.y,this}subScalar(t){return this.x-=t,this.y-=t,this}subVectors(t,n){return this.x=t.x-n.x,this.y=t.y-n.y,this}multiply(t){return this.x*=t.x,this.y*=t.y,this}multiplyScalar(t){return this.x*=t,this.y*=t,this}divide(t){return this.x/=t.x,this.y/=t.y,this}divideScalar(t){return this.multiplyScalar(1/t)}applyMatrix3(t){let n=this.x,i=this.y,r=t.elements;return this.x=r[0]*n+r[3]*i+r[6],this.y=r[1]*n+r[4]*i+r[7],this}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this}clamp(t,n){return this.x=Ht(this.x,t.x,n.x),this.y=Ht(this.y,t.y,n.y),this}clampScalar(t,n){return this.x=Ht(this.x,t,n),this.y=Ht(this.y,t,n),this}clampLength(t,n){let i=this.length();return this.divideScalar(i||1).multiplyScalar(Ht(i,t,n))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this}negate(){return this.x=-this.x,this.y=-this.y,this}dot(t){return this.x*t.x+this.y*t.y}cross(t){return this.x*t.y-this.y*t.x}lengthSq(){return this.x*this.x+this.y*this.y}length(){return Math.sqrt(this.x*this.x+this.y*this.y)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)}normalize(){return this.divideScalar(this.length()||1)}angle(){return Math.atan2(-this.y,-this.x)+Math.PI}angleTo(t){let n=Math.sqrt(this.lengthSq()*t.lengthSq());if(n===0)return Math.PI/2;let i=this.dot(t)/n;return Math.acos(Ht(i,-1,1))}distanceTo(t){return Math.sqrt(this.distanceToSquared(t))}distanceToSquared(t){let n=this.x-t.x,i=this.y-t.y;return n*n+i*i}manhattanDistanceTo(t){return Math.abs(this.x-t.x)+Math.abs(this.y-t.y)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,n){return this.x+=(t.x-this.x)*n,this.y+=(t.y-this.y)*n,this}lerpVectors(t,n,i){return this.x=t.x+(n.x-t.x)*i,this.y=t.y+(n.y-t.y)*i,this}equals(t){return t.x===this.x&&t.y===this.y}fromArray(t,n=0){return this.x=t[n],this.y=t[n+1],this}toArray(t=[],n=0){return t[n]=this.x,t[n+1]=this.y,t}fromBufferAttribute(t,n){return this.x=t.getX(n),this.y=t.getY(n),this}rotateAround(t,n){let i=Math.cos(n),r=Math.sin(n),s=this.x-t.x,o=this.y-t.y;return this.x=s*i-o*r+t.x,this.y=s*r+o*i+t.y,this}random(){return this.x=Math.random(),this.y=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y}},Sn=class{constructor(t=0,n=0,i=0,r=1){this.isQuaternion=!0,this._x=t,this._y=n,this._z=i,this._w=r}static slerpFlat(t,n,i,r,s,o,a){let c=i[r+0],l=i[r+1],u=i[r+2],h=i[r+3],f=s[o+0],d=s[o+1],p=s[o+2],y=s[o+3];if(h!==y||c!==f||l!==d||u!==p){let m=c*f+l*d+u*p+h*y;m<0&&(f=-f,d=-d,p=-p,y=-y,m=-m);let g=1-a;if(m<.9995){let x=Math.acos(m),S=Math.sin(x);g=Math.sin(g*x)/S,a=Math.sin(a*x)/S,c=c*g+f*a,l=l*g+d*a,u=u*g+p*a,h=h*g+y*a}else{c=c*g+f*a,l=l*g+d*a,u=u*g+p*a,h=h*g+y*a;let x=1/Math.sqrt(c*c+l*l+u*u+h*h);c*=x,l*=x,u*=x,h*=x}}t[n]=c,t[n+1]=l,t[n+2]=u,t[n+3]=h}static multiplyQuaternionsFlat(t,n,i,r,s,o){let a=i[r],c=i[r+1],l=i[r+2],u=i[r+3],h=s[o],f=s[o+1],d=s[o+2],p=s[o+3];return t[n]=a*p+u*h+c*d-l*f,t[n+1]=c*p+u*f+l*h-a*d,t[n+2]=l*p+u*d+a*f-c*h,t[n+3]=u*p-a*h-c*f-l*d,t}get x(){return this._x}set x(t){this._x=t,this._onChangeCallback()}get y(){return this._y}set y(t){this._y=t,this._onChangeCallback()}get z(){return this._z}set z(t){this._z=t,this._onChangeCallback()}get w(){return this._w}set w(t){this._w=t,this._onChangeCallback()}set(t,n,i,r){return this._x=t,this._y=n,this._z=i,this._w=r,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._w)}copy(t){return this._x=t.x,this._y=t.y,this._z=t.z,this._w=t.w,this._onChangeCallback(),this}setFromEuler(t,n=!0){let i=t._x,r=t._y,s=t._z,o=t._order,a=Math.cos,c=Math.sin,l=a(i/2),u=a(r/2),h=a(s/2),f=c(i/2),d=c(r/2),p=c(s/2);switch(o){case"XYZ":this._x=f*u*h+l*d*p,this._y=l*d*h-f*u*p,this._z=l*u*p+f*d*h,this._w=l*u*h-f*d*p;break;case"YXZ":this._x=f*u*h+l*d*p,this._y=l*d*h-f*u*p,this._z=l*u*p-f*d*h,this._w=l*u*h+f*d*p;break;case"ZXY":this._x=f*u*h-l*d*p,this._y=l*d*h+f*u*p,this._z=l*u*p+f*d*h,this._w=l*u*h-f*d*p;break;case"ZYX":this._x=f*u*h-l*d*p,this._y=l*d*h+f*u*p,this._z=l*u*p-f*d*h,this._w=l*u*h+f*d*p;break;case"YZX":this._x=f*u*h+l*d*p,this._y=l*d*h+f*u*p,this._z=l*u*p-f*d*h,this._w=l*u*h-f*d*p;break;case"XZY":this._x=f*u*h-l*d*p,this._y=l*d*h-f*u*p,this._z=l*u*p+f*d*h,this._w=l*u*h+f*d*p;break;default:Ut("Quaternion: .setFromEuler() encountered an unknown order: "+o)}return n===!0&&this._onChangeCallback(),this}setFromAxisAngle(t,n){let i=n/2,r=Math.sin(i);return this._x=t.x*r,this._y=t.y*r,this._z=t.z*r,this._w=Math.cos(i),this._onChangeCallback(),this}setFromRotationMatrix(t){let n=t.elements,i=n[0],r=n[4],s=n[8],o=n[1],a=n[5],c=n[9],l=n[2],u=n[6],h=n[10],f=i+a+h;if(f>0){let d=.5/Math.sqrt(f+1);this._w=.25/d,this._x=(u-c)*d,this._y=(s-l)*d,this._z=(o-r)*d}else if(i>a&&i>h){let d=2*Math.sqrt(1+i-a-h);this._w=(u-c)/d,this._x=.25*d,this._y=(r+o)/d,this._z=(s+l)/d}else if(a>h){let d=2*Math.sqrt(1+a-i-h);this._w=(s-l)/d,this._x=(r+o)/d,this._y=.25*d,this._z=(c+u)/d}else{let d=2*Math.sqrt(1+h-i-a);this._w=(o-r)/d,this._x=(s+l)/d,this._y=(c+u)/d,this._z=.25*d}return this._onChangeCallback(),this}setFromUnitVectors(t,n){let i=t.dot(n)+1;return i<1e-8?(i=0,Math.abs(t.x)>Math.abs(t.z)?(this._x=-t.y,this._y=t.x,this._z=0,this._w=i):(this._x=0,this._y=-t.z,this._z=t.y,this._w=i)):(this._x=t.y*n.z-t.z*n.y,this._y=t.z*n.x-t.x*n.z,this._z=t.x*n.y-t.y*n.x,this._w=i),this.normalize()}angleTo(t){return 2*Math.acos(Math.abs(Ht(this.dot(t),-1,1)))}rotateTowards(t,n){let i=this.angleTo(t);if(i===0)return this;let r=Math.min(1,n/i);return this.slerp(t,r),this}identity(){return this.set(0,0,0,1)}invert(){return this.conjugate()}conjugate(){return this._x*=-1,this._y*=-1,this._z*=-1,this._onChangeCallback(),this}dot(t){return this._x*t._x+this._y*t._y+this._z*t._z+this._w*t._w}lengthSq(){return this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w}length(){return Math.sqrt(this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w)}normalize(){let t=this.length();return t===0?(this._x=0,this._y=0,this._z=0,this._w=1):(t=1/t,this._x=this._x*t,this._y=this._y*t,this._z=this._z*t,this._w=this._w*t),this._onChangeCallback(),this}multiply(t){return this.multiplyQuaternions(this,t)}premultiply(t){return this.multiplyQuaternions(t,this)}multiplyQuaternions(t,n){let i=t._x,r=t._y,s=t._z,o=t._w,a=n._x,c=n._y,l=n._z,u=n._w;return this._x=i*u+o*a+r*l-s*c,this._y=r*u+o*c+s*a-i*l,this._z=s*u+o*l+i*c-r*a,this._w=o*u-i*a-r*c-s*l,this._onChangeCallback(),this}slerp(t,n){let i=t._x,r=t._y,s=t._z,o=t._w,a=this.dot(t);a<0&&(i=-i,r=-r,s=-s,o=-o,a=-a);let c=1-n;if(a<.9995){let l=Math.acos(a),u=Math.sin(l);c=Math.sin(c*l)/u,n=Math.sin(n*l)/u,this._x=this._x*c+i*n,this._y=this._y*c+r*n,this._z=this._z*c+s*n,this._w=this._w*c+o*n,this._onChangeCallback()}else this._x=this._x*c+i*n,this._y=this._y*c+r*n,this._z=this._z*c+s*n,this._w=this._w*c+o*n,this.normalize();return this}slerpQuaternions(t,n,i){return this.copy(t).slerp(n,i)}random(){let t=2*Math.PI*Math.random(),n=2*Math.PI*Math.random(),i=Math.random(),r=Math.sqrt(1-i),s=Math.sqrt(i);return this.set(r*Math.sin(t),r*Math.cos(t),s*Math.sin(n),s*Math.cos(n))}equals(t){return t._x===this._x&&t._y===this._y&&t._z===this._z&&t._w===this._w}fromArray(t,n=0){return this._x=t[n],this._y=t[n+1],this._z=t[n+2],this._w=t[n+3],this._onChangeCallback(),this}toArray(t=[],n=0){return t[n]=this._x,t[n+1]=this._y,t[n+2]=this._z,t[n+3]=this._w,t}fromBufferAttribute(t,n){return this._x=t.getX(n),this._y=t.getY(n),this._z=t.getZ(n),this._w=t.getW(n),this._onChangeCallback(),this}toJSON(){return this.toArray()}_onChange(t){return this._onChangeCallback=t,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._w}},k=class{static{this.prototype.isVector3=!0}constructor(t=0,n=0,i=0){this.x=t,this.y=n,this.z=i}set(t,n,i){return i===void 0&&(i=this.z),this.x=t,this.y=n,this.z=i,this}setScalar(t){return this.x=t,this.y=t,this.z=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setZ(t){return this.z=t,this}setComponent(t,n){switch(t){case 0:this.x=n;break;case 1:this.y=n;break;case 2:this.z=n;break;default:throw new Error("THREE.Vector3: index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;case 2:return this.z;default:throw new Error("THREE.Vector3: index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y,this.z)}copy(t){return this.x=t.x,this.y=t.y,this.z=t.z,this}add(t){return this.x+=t.x,this.y+=t.y,this.z+=t.z,this}addScalar(t){return this.x+=t,this.y+=t,this.z+=t,this}addVectors(t,n){return this.x=t.x+n.x,this.y=t.y+n.y,this.z=t.z+n.z,this}addScaledVector(t,n){return this.x+=t.x*n,this.y+=t.y*n,this.z+=t.z*n,this}sub(t){return this.x-=t.x,this.y-=t.y,this.z-=t.z,this}subScalar(t){return this.x-=t,this.y-=t,this.z-=t,this}subVectors(t,n){return this.x=t.x-n.x,this.y=t.y-n.y,this.z=t.z-n.z,this}multiply(t){return this.x*=t.x,this.y*=t.y,this.z*=t.z,this}multiplyScalar(t){return this.x*=t,this.y*=t,this.z*=t,this}multiplyVectors(t,n){return this.x=t.x*n.x,this.y=t.y*n.y,this.z=t.z*n.z,this}applyEuler(t){return this.applyQuaternion(WA.setFromEuler(t))}applyAxisAngle(t,n){return this.applyQuaternion(WA.setFromAxisAngle(t,n))}applyMatrix3(t){let n=this.x,i=this.y,r=this.z,s=t.elements;return this.x=s[0]*n+s[3]*i+s[6]*r,this.y=s[1]*n+s[4]*i+s[7]*r,this.z=s[2]*n+s[5]*i+s[8]*r,this}applyNormalMatrix(t){return this.applyMatrix3(t).normalize()}applyMatrix4(t){let n=this.x,i=this.y,r=this.z,s=t.elements,o=1/(s[3]*n+s[7]*i+s[11]*r+s[15]);return this.x=(s[0]*n+s[4]*i+s[8]*r+s[12])*o,this.y=(s[1]*n+s[5]*i+s[9]*r+s[13])*o,this.z=(s[2]*n+s[6]*i+s[10]*r+s[14])*o,this}applyQuaternion(t){let n=this.x,i=this.y,r=this.z,s=t.x,o=t.y,a=t.z,c=t.w,l=2*(o*r-a*i),u=2*(a*n-s*r),h=2*(s*i-o*n);return this.x=n+c*l+o*h-a*u,this.y=i+c*u+a*l-s*h,this.z=r+c*h+s*u-o*l,this}project(t){return this.applyMatrix4(t.matrixWorldInverse).applyMatrix4(t.projectionMatrix)}unproject(t){return this.applyMatrix4(t.projectionMatrixInverse).applyMatrix4(t.matrixWorld)}transformDirection(t){let n=this.x,i=this.y,r=this.z,s=t.elements;return this.x=s[0]*n+s[4]*i+s[8]*r,this.y=s[1]*n+s[5]*i+s[9]*r,this.z=s[2]*n+s[6]*i+s[10]*r,this.normalize()}divide(t){return this.x/=t.x,this.y/=t.y,this.z/=t.z,this}divideScalar(t){return this.multiplyScalar(1/t)}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this.z=Math.min(this.z,t.z),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this.z=Math.max(this.z,t.z),this}clamp(t,n){return this.x=Ht(this.x,t.x,n.x),this.y=Ht(this.y,t.y,n.y),this.z=Ht(this.z,t.z,n.z),this}clampScalar(t,n){return this.x=Ht(this.x,t,n),this.y=Ht(this.y,t,n),this.z=Ht(this.z,t,n),this}clampLength(t,n){let i=this.length();return this.divideScalar(i||1).multiplyScalar(Ht(i,t,n))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this}dot(t){return this.x*t.x+this.y*t.y+this.z*t.z}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)}normalize(){return this.divideScalar(this.length()||1)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,n){return this.x+=(t.x-this.x)*n,this.y+=(t.y-this.y)*n,this.z+=(t.z-this.z)*n,this}lerpVectors(t,n,i){return this.x=t.x+(n.x-t.x)*i,this.y=t.y+(n.y-t.y)*i,this.z=t.z+(n.z-t.z)*i,this}cross(t){return this.crossVectors(this,t)}crossVectors(t,n){let i=t.x,r=t.y,s=t.z,o=n.x,a=n.y,c=n.z;return this.x=r*c-s*a,this.y=s*o-i*c,this.z=i*a-r*o,this}projectOnVector(t){let n=t.lengthSq();if(n===0)return this.set(0,0,0);let i=t.dot(this)/n;return this.copy(t).multiplyScalar(i)}projectOnPlane(t){return c_.copy(this).projectOnVector(t),this.sub(c_)}reflect(t){return this.sub(c_.copy(t).multiplyScalar(2*this.dot(t)))}angleTo(t){let n=Math.sqrt(this.lengthSq()*t.lengthSq());if(n===0)return Math.PI/2;let i=this.dot(t)/n;return Math.acos(Ht(i,-1,1))}distanceTo(t){return Math.sqrt(this.distanceToSquared(t))}distanceToSquared(t){let n=this.x-t.x,i=this.y-t.y,r=this.z-t.z;return n*n+i*i+r*r}manhattanDistanceTo(t){return Math.abs(this.x-t.x)+Math.abs(this.y-t.y)+Math.abs(this.z-t.z)}setFromSpherical(t){return this.setFromSphericalCoords(t.radius,t.phi,t.theta)}setFromSphericalCoords(t,n,i){let r=Math.sin(n)*t;return this.x=r*Math.sin(i),this.y=Math.cos(n)*t,this.z=r*Math.cos(i),this}setFromCylindrical(t){return this.setFromCylindricalCoords(t.radius,t.theta,t.y)}setFromCylindricalCoords(t,n,i){return this.x=t*Math.sin(n),this.y=i,this.z=t*Math.cos(n),this}setFromMatrixPosition(t){let n=t.elements;return this.x=n[12],this.y=n[13],this.z=n[14],this}setFromMatrixScale(t){let n=this.setFromMatrixColumn(t,0).length(),i=this.setFromMatrixColumn(t,1).length(),r=this.setFromMatrixColumn(t,2).length();return this.x=n,this.y=i,this.z=r,this}setFromMatrixColumn(t,n){return this.fromArray(t.elements,n*4)}setFromMatrix3Column(t,n){return this.fromArray(t.elements,n*3)}setFromEuler(t){return this.x=t._x,this.y=t._y,this.z=t._z,this}setFromColor(t){return this.x=t.r,this.y=t.g,this.z=t.b,this}equals(t){return t.x===this.x&&t.y===this.y&&t.z===this.z}fromArray(t,n=0){return this.x=t[n],this.y=t[n+1],this.z=t[n+2],this}toArray(t=[],n=0){return t[n]=this.x,t[n+1]=this.y,t[n+2]=this.z,t}fromBufferAttribute(t,n){return this.x=t.getX(n),this.y=t.getY(n),this.z=t.getZ(n),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this}randomDirection(){let t=Math.random()*Math.PI*2,n=Math.random()*2-1,i=Math.sqrt(1-n*n);return this.x=i*Math.cos(t),this.y=n,this.z=i*Math.sin(t),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z}},c_=new k,WA=new Sn,zt=class{static{this.prototype.isMatrix3=!0}constructor(t,n,i,r,s,o,a,c,l){this.elements=[1,0,0,0,1,0,0,0,1],t!==void 0&&this.set(t,n,i,r,s,o,a,c,l)}set(t,n,i,r,s,o,a,c,l){let u=this.elements;return u[0]=t,u[1]=r,u[2]=a,u[3]=n,u[4]=s,u[5]=c,u[6]=i,u[7]=o,u[8]=l,this}identity(){return this.set(1,0,0,0,1,0,0,0,1),this}copy(t){let n=this.elements,i=t.elements;return n[0]=i[0],n[1]=i[1],n[2]=i[2],n[3]=i[3],n[4]=i[4],n[5]=i[5],n[6]=i[6],n[7]=i[7],n[8]=i[8],this}extractBasis(t,n,i){return t.setFromMatrix3Column(this,0),n.setFromMatrix3Column(this,1),i.setFromMatrix3Column(this,2),this}setFromMatrix4(t){let n=t.elements;return this.set(n[0],n[4],n[8],n[1],n[5],n[9],n[2],n[6],n[10]),this}multiply(t){return this.multiplyMatrices(this,t)}premultiply(t){return this.multiplyMatrices(t,this)}multiplyMatrices(t,n){let i=t.elements,r=n.elements,s=this.elements,o=i[0],a=i[3],c=i[6],l=i[1],u=i[4],h=i[7],f=i[2],d=i[5],p=i[8],y=r[0],m=r[3],g=r[6],x=r[1],S=r[4],v=r[7],w=r[2],b=r[5],_=r[8];return s[0]=o*y+a*x+c*w,s[3]=o*m+a*S+c*b,s[6]=o*g+a*v+c*_,s[1]=l*y+u*x+h*w,s[4]=l*m+u*S+h*b,s[7]=l*g+u*v+h*_,s[2]=f*y+d*x+p*w,s[5]=f*m+d*S+p*b,s[8]=f*g+d*v+p*_,this}multiplyScalar(t){let n=this.elements;return n[0]*=t,n[3]*=t,n[6]*=t,n[1]*=t,n[4]*=t,n[7]*=t,n[2]*=t,n[5]*=t,n[8]*=t,this}determinant(){let t=this.elements,n=t[0],i=t[1],r=t[2],s=t[3],o=t[4],a=t[5],c=t[6],l=t[7],u=t[8];return n*o*u-n*a*l-i*s*u+i*a*c+r*s*l-r*o*c}invert(){let t=this.elements,n=t[0],i=t[1],r=t[2],s=t[3],o=t[4],a=t[5],c=t[6],l=t[7],u=t[8],h=u*o-a*l,f=a*c-u*s,d=l*s-o*c,p=n*h+i*f+r*d;if(p===0)return this.set(0,0,0,0,0,0,0,0,0);let y=1/p;return t[0]=h*y,t[1]=(r*l-u*i)*y,t[2]=(a*i-r*o)*y,t[3]=f*y,t[4]=(u*n-r*c)*y,t[5]=(r*s-a*n)*y,t[6]=d*y,t[7]=(i*c-l*n)*y,t[8]=(o*n-i*s)*y,this}transpose(){let t,n=this.elements;return t=n[1],n[1]=n[3],n[3]=t,t=n[2],n[2]=n[6],n[6]=t,t=n[5],n[5]=n[7],n[7]=t,this}getNormalMatrix(t){return this.setFromMatrix4(t).invert().transpose()}transposeIntoArray(t){let n=this.elements;return t[0]=n[0],t[1]=n[3],t[2]=n[6],t[3]=n[1],t[4]=n[4],t[5]=n[7],t[6]=n[2],t[7]=n[5],t[8]=n[8],this}setUvTransform(t,n,i,r,s,o,a){let c=Math.cos(s),l=Math.sin(s);return this.set(i*c,i*l,-i*(c*o+l*a)+o+t,-r*l,r*c,-r*(-l*o+c*a)+a+n,0,0,1),this}scale(t,n){return Ml("Matrix3: .scale() is deprecated. Use .makeScale() instead."),this.premultiply(l_.makeScale(t,n)),this}rotate(t){return Ml("Matrix3: .rotate() is deprecated. Use .makeRotation() instead."),this.premultiply(l_.makeRotation(-t)),this}translate(t,n){return Ml("Matrix3: .translate() is deprecated. Use .makeTranslation() instead."),this.premultiply(l_.makeTranslation(t,n)),this}makeTranslation(t,n){return t.isVector2?this.set(1,0,t.x,0,1,t.y,0,0,1):this.set(1,0,t,0,1,n,0,0,1),this}makeRotation(t){let n=Math.cos(t),i=Math.sin(t);return this.set(n,-i,0,i,n,0,0,0,1),this}makeScale(t,n){return this.set(t,0,0,0,n,0,0,0,1),this}equals(t){let n=this.elements,i=t.elements;for(let r=0;r<9;r++)if(n[r]!==i[r])return!1;return!0}fromArray(t,n=0){for(let i=0;i<9;i++)this.elements[i]=t[i+n];return this}toArray(t=[],n=0){let i=this.elements;return t[n]=i[0],t[n+1]=i[1],t[n+2]=i[2],t[n+3]=i[3],t[n+4]=i[4],t[n+5]=i[5],t[n+6]=i[6],t[n+7]=i[7],t[n+8]=i[8],t}clone(){return new this.constructor().fromArray(this.elements)}},l_=new zt,$A=new zt().set(.4123908,.3575843,.1804808,.212639,.7151687,.0721923,.0193308,.1191948,.9505322),XA=new zt().set(3.2409699,-1.5373832,-.4986108,-.9692436,1.8759675,.0415551,.0556301,-.203977,1.0569715);function LU(){let e={enabled:!0,workingColorSpace:Al,spaces:{},convert:function(r,s,o){return this.enabled===!1||s===o||!s||!o||(this.spaces[s].transfer===de&&(r.r=$r(r.r),r.g=$r(r.g),r.b=$r(r.b)),this.spaces[s].primaries!==this.spaces[o].primaries&&(r.applyMatrix3(this.spaces[s].toXYZ),r.applyMatrix3(this.spaces[o].fromXYZ)),this.spaces[o].transfer===de&&(r.r=qa(r.r),r.g=qa(r.g),r.b=qa(r.b))),r},workingToColorSpace:function(r,s){return this.convert(r,this.workingColorSpace,s)},colorSpaceToWorking:function(r,s){return this.convert(r,s,this.workingColorSpace)},getPrimaries:function(r){return this.spaces[r].primaries},getTransfer:function(r){return r===jr?El:this.spaces[r].transfer},getToneMappingMode:function(r){return this.spaces[r].outputColorSpaceConfig.toneMappingMode||"standard"},getLuminanceCoefficients:function(r,s=this.workingColorSpace){return r.fromArray(this.spaces[s].luminanceCoefficients)},define:function(r){Object.assign(this.spaces,r)},_getMatrix:function(r,s,o){return r.copy(this.spaces[o].fromXYZ).multiply(this.spaces[s].toXYZ)},_getDrawingBufferColorSpace:function(r){return this.spaces[r].outputColorSpaceConfig.drawingBufferColorSpace},_getUnpackColorSpace:function(r=this.workingColorSpace){return this.spaces[r].workingColorSpaceConfig.unpackColorSpace}},t=[.64,.33,.3,.6,.15,.06],n=[.2126,.7152,.0722],i=[.3127,.329];return e.define({[Al]:{primaries:t,whitePoint:i,transfer:El,toXYZ:$A,fromXYZ:XA,luminanceCoefficients:n,workingColorSpaceConfig:{unpackColorSpace:jn},outputColorSpaceConfig:{drawingBufferColorSpace:jn}},[jn]:{primaries:t,whitePoint:i,transfer:de,toXYZ:$A,fromXYZ:XA,luminanceCoefficients:n,outputColorSpaceConfig:{drawingBufferColorSpace:jn}}}),e}var re=LU();function $r(e){return e<.04045?e*.0773993808:Math.pow(e*.9478672986+.0521327014,2.4)}function qa(e){return e<.0031308?e*12.92:1.055*Math.pow(e,.41666)-.055}var La,nd=class{static getDataURL(t,n="image/png"){if(/^data:/i.test(t.src)||typeof HTMLCanvasElement>"u")return t.src;let i;if(t instanceof HTMLCanvasElement)i=t;else{La===void 0&&(La=Cl("canvas")),La.width=t.width,La.height=t.height;let r=La.getContext("2d");t instanceof ImageData?r.putImageData(t,0,0):r.drawImage(t,0,0,t.width,t.height),i=La}return i.toDataURL(n)}static sRGBToLinear(t){if(typeof HTMLImageElement<"u"&&t instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&t instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&t instanceof ImageBitmap){let n=Cl("canvas");n.width=t.width,n.height=t.height;let i=n.getContext("2d");i.drawImage(t,0,0,t.width,t.height);let r=i.getImageData(0,0,t.width,t.height),s=r.data;for(let o=0;o<s.length;o++)s[o]=$r(s[o]/255)*255;return i.putImageData(r,0,0),n}else if(t.data){let n=t.data.slice(0);for(let i=0;i<n.length;i++)n instanceof Uint8Array||n instanceof Uint8ClampedArray?n[i]=Math.floor($r(n[i]/255)*255):n[i]=$r(n[i]);return{data:n,width:t.width,height:t.height}}else return Ut("ImageUtils.sRGBToLinear(): Unsupported image type. No color space conversion applied."),t}},NU=0,ja=class{constructor(t=null){this.isTextureSource=!0,Object.defineProperty(this,"id",{value:NU++}),this.uuid=zs(),this.data=t,this.dataReady=!0,this.version=0}getSize(t){let n=this.data;return typeof HTMLVideoElement<"u"&&n instanceof HTMLVideoElement?t.set(n.videoWidth,n.videoHeight,0):typeof VideoFrame<"u"&&n instanceof VideoFrame?t.set(n.displayWidth,n.displayHeight,0):n!==null?t.set(n.width||0,n.height||0,n.depth||0):t.set(0,0,0),t}set needsUpdate(t){t===!0&&this.version++}toJSON(t){let n=t===void 0||typeof t=="string";if(!n&&t.images[this.uuid]!==void 0)return t.images[this.uuid];let i={uuid:this.uuid,url:""},r=this.data;if(r!==null){let s;if(Array.isArray(r)){s=[];for(let o=0,a=r.length;o<a;o++)r[o].isDataTexture?s.push(u_(r[o].image)):s.push(u_(r[o]))}else s=u_(r);i.url=s}return n||(t.images[this.uuid]=i),i}};function u_(e){return typeof HTMLImageElement<"u"&&e instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&e instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&e instanceof ImageBitmap?nd.getDataURL(e):e.data?{data:Array.from(e.data),width:e.width,height:e.height,type:e.data.constructor.name}:(Ut("Texture: Unable to serialize Texture."),{})}var DU=0,f_=new k,Dn=class e extends Gi{constructor(t=e.DEFAULT_IMAGE,n=e.DEFAULT_MAPPING,i=pr,r=pr,s=Nn,o=Jr,a=Xi,c=Hn,l=e.DEFAULT_ANISOTROPY,u=jr){super(),this.isTexture=!0,Object.defineProperty(this,"id",{value:DU++}),this.uuid=zs(),this.name="",this.source=new ja(t),this.mipmaps=[],this.mapping=n,this.channel=0,this.wrapS=i,this.wrapT=r,this.magFilter=s,this.minFilter=o,this.anisotropy=l,this.format=a,this.internalFormat=null,this.type=c,this.offset=new Ft(0,0),this.repeat=new Ft(1,1),this.center=new Ft(0,0),this.rotation=0,this.matrixAutoUpdate=!0,this.matrix=new zt,this.generateMipmaps=!0,this.mipmapsAutoUpdate=!0,this.premultiplyAlpha=!1,this.flipY=!0,this.unpackAlignment=4,this.colorSpace=u,this.userData={},this.updateRanges=[],this.version=0,this.onUpdate=null,this.renderTarget=null,this.isRenderTargetTexture=!1,this.isArrayTexture=!!(t&&t.depth&&t.depth>1),this.pmremVersion=0,this.isPMREMTexture=!1,this.normalized=!1}get width(){return this.source.getSize(f_).x}get height(){return this.source.getSize(f_).y}get depth(){return this.source.getSize(f_).z}get image(){return this.source.data}set image(t){this.source.data=t}updateMatrix(){this.matrix.setUvTransform(this.offset.x,this.offset.y,this.repeat.x,this.repeat.y,this.rotation,this.center.x,this.center.y)}addUpdateRange(t,n){this.updateRanges.push({start:t,count:n})}clearUpdateRanges(){this.updateRanges.length=0}clone(){return new this.constructor().copy(this)}copy(t){return this.name=t.name,this.source=t.source,this.mipmaps=t.mipmaps.slice(0),this.mapping=t.mapping,this.channel=t.channel,this.wrapS=t.wrapS,this.wrapT=t.wrapT,this.magFilter=t.magFilter,this.minFilter=t.minFilter,this.anisotropy=t.anisotropy,this.format=t.format,this.internalFormat=t.internalFormat,this.type=t.type,this.normalized=t.normalized,this.offset.copy(t.offset),this.repeat.copy(t.repeat),this.center.copy(t.center),this.rotation=t.rotation,this.matrixAutoUpdate=t.matrixAutoUpdate,this.matrix.copy(t.matrix),this.generateMipmaps=t.generateMipmaps,this.mipmapsAutoUpdate=t.mipmapsAutoUpdate,this.premultiplyAlpha=t.premultiplyAlpha,this.flipY=t.flipY,this.unpackAlignment=t.unpackAlignment,this.colorSpace=t.colorSpace,this.renderTarget=t.renderTarget,this.isRenderTargetTexture=t.isRenderTargetTexture,this.isPMREMTexture=t.isPMREMTexture,this.isArrayTexture=t.isArrayTexture,this.userData=JSON.parse(JSON.stringify(t.userData)),this.needsUpdate=!0,this}setValues(t){for(let n in t){let i=t[n];if(i===void 0){Ut(`Texture.setValues(): parameter '${n}' has value of undefined.`);continue}let r=this[n];if(r===void 0){Ut(`Texture.setValues(): property '${n}' does not exist.`);continue}r&&i&&r.isVector2&&i.isVector2||r&&i&&r.isVector3&&i.isVector3||r&&i&&r.isMatrix3&&i.isMatrix3?r.copy(i):this[n]=i}}toJSON(t){let n=t===void 0||typeof t=="string";if(!n&&t.textures[this.uuid]!==void 0)return t.textures[this.uuid];let i={metadata:{version:4.7,type:"Texture",generator:"Texture.toJSON"},uuid:this.uuid,name:this.name,image:this.source.toJSON(t).uuid,mapping:this.mapping,channel:this.channel,repeat:[this.repeat.x,this.repeat.y],offset:[this.offset.x,this.offset.y],center:[this.center.x,this.center.y],rotation:this.rotation,wrap:[this.wrapS,this.wrapT],format:this.format,internalFormat:this.internalFormat,type:this.type,normalized:this.normalized,colorSpace:this.colorSpace,minFilter:this.minFilter,magFilter:this.magFilter,anisotropy:this.anisotropy,flipY:this.flipY,generateMipmaps:this.generateMipmaps,mipmapsAutoUpdate:this.mipmapsAutoUpdate,premultiplyAlpha:this.premultiplyAlpha,unpackAlignment:this.unpackAlignment};return Object.keys(this.userData).length>0&&(i.userData=this.userData),n||(t.textures[this.uuid]=i),i}dispose(){this.dispatchEvent({type:"dispose"})}transformUv(t){if(this.mapping!==K_)return t;if(t.applyMatrix3(this.matrix),t.x<0||t.x>1)switch(this.wrapS){case Qh:t.x=t.x-Math.floor(t.x);break;case pr:t.x=t.x<0?0:1;break;case td:Math.abs(Math.floor(t.x)%2)===1?t.x=Math.ceil(t.x)-t.x:t.x=t.x-Math.floor(t.x);break}if(t.y<0||t.y>1)switch(this.wrapT){case Qh:t.y=t.y-Math.floor(t.y);break;case pr:t.y=t.y<0?0:1;break;case td:Math.abs(Math.floor(t.y)%2)===1?t.y=Math.ceil(t.y)-t.y:t.y=t.y-Math.floor(t.y);break}return this.flipY&&(t.y=1-t.y),t}set needsUpdate(t){t===!0&&(this.version++,this.source.needsUpdate=!0)}set needsPMREMUpdate(t){t===!0&&this.pmremVersion++}};Dn.DEFAULT_IMAGE=null;Dn.DEFAULT_MAPPING=K_;Dn.DEFAULT_ANISOTROPY=1;var pe=class{static{this.prototype.isVector4=!0}constructor(t=0,n=0,i=0,r=1){this.x=t,this.y=n,this.z=i,this.w=r}get width(){return this.z}set width(t){this.z=t}get height(){return this.w}set height(t){this.w=t}set(t,n,i,r){return this.x=t,this.y=n,this.z=i,this.w=r,this}setScalar(t){return this.x=t,this.y=t,this.z=t,this.w=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setZ(t){return this.z=t,this}setW(t){return this.w=t,this}setComponent(t,n){switch(t){case 0:this.x=n;break;case 1:this.y=n;break;case 2:this.z=n;break;case 3:this.w=n;break;default:throw new Error("THREE.Vector4: index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;case 2:return this.z;case 3:return this.w;default:throw new Error("THREE.Vector4: index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y,this.z,this.w)}copy(t){return this.x=t.x,this.y=t.y,this.z=t.z,this.w=t.w!==void 0?t.w:1,this}add(t){return this.x+=t.x,this.y+=t.y,this.z+=t.z,this.w+=t.w,this}addScalar(t){return this.x+=t,this.y+=t,this.z+=t,this.w+=t,this}addVectors(t,n){return this.x=t.x+n.x,this.y=t.y+n.y,this.z=t.z+n.z,this.w=t.w+n.w,this}addScaledVector(t,n){return this.x+=t.x*n,this.y+=t.y*n,this.z+=t.z*n,this.w+=t.w*n,this}sub(t){return this.x-=t.x,this.y-=t.y,this.z-=t.z,this.w-=t.w,this}subScalar(t){return this.x-=t,this.y-=t,this.z-=t,this.w-=t,this}subVectors(t,n){return this.x=t.x-n.x,this.y=t.y-n.y,this.z=t.z-n.z,this.w=t.w-n.w,this}multiply(t){return this.x*=t.x,this.y*=t.y,this.z*=t.z,this.w*=t.w,this}multiplyScalar(t){return this.x*=t,this.y*=t,this.z*=t,this.w*=t,this}applyMatrix4(t){let n=this.x,i=this.y,r=this.z,s=this.w,o=t.elements;return this.x=o[0]*n+o[4]*i+o[8]*r+o[12]*s,this.y=o[1]*n+o[5]*i+o[9]*r+o[13]*s,this.z=o[2]*n+o[6]*i+o[10]*r+o[14]*s,this.w=o[3]*n+o[7]*i+o[11]*r+o[15]*s,this}divide(t){return this.x/=t.x,this.y/=t.y,this.z/=t.z,this.w/=t.w,this}divideScalar(t){return this.multiplyScalar(1/t)}setAxisAngleFromQuaternion(t){this.w=2*Math.acos(t.w);let n=Math.sqrt(1-t.w*t.w);return n<1e-4?(this.x=1,this.y=0,this.z=0):(this.x=t.x/n,this.y=t.y/n,this.z=t.z/n),this}setAxisAngleFromRotationMatrix(t){let n,i,r,s,c=t.elements,l=c[0],u=c[4],h=c[8],f=c[1],d=c[5],p=c[9],y=c[2],m=c[6],g=c[10];if(Math.abs(u-f)<.01&&Math.abs(h-y)<.01&&Math.abs(p-m)<.01){if(Math.abs(u+f)<.1&&Math.abs(h+y)<.1&&Math.abs(p+m)<.1&&Math.abs(l+d+g-3)<.1)return this.set(1,0,0,0),this;n=Math.PI;let S=(l+1)/2,v=(d+1)/2,w=(g+1)/2,b=(u+f)/4,_=(h+y)/4,M=(p+m)/4;return S>v&&S>w?S<.01?(i=0,r=.707106781,s=.707106781):(i=Math.sqrt(S),r=b/i,s=_/i):v>w?v<.01?(i=.707106781,r=0,s=.707106781):(r=Math.sqrt(v),i=b/r,s=M/r):w<.01?(i=.707106781,r=.707106781,s=0):(s=Math.sqrt(w),i=_/s,r=M/s),this.set(i,r,s,n),this}let x=Math.sqrt((m-p)*(m-p)+(h-y)*(h-y)+(f-u)*(f-u));return Math.abs(x)<.001&&(x=1),this.x=(m-p)/x,this.y=(h-y)/x,this.z=(f-u)/x,this.w=Math.acos((l+d+g-1)/2),this}setFromMatrixPosition(t){let n=t.elements;return this.x=n[12],this.y=n[13],this.z=n[14],this.w=n[15],this}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this.z=Math.min(this.z,t.z),this.w=Math.min(this.w,t.w),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this.z=Math.max(this.z,t.z),this.w=Math.max(this.w,t.w),this}clamp(t,n){return this.x=Ht(this.x,t.x,n.x),this.y=Ht(this.y,t.y,n.y),this.z=Ht(this.z,t.z,n.z),this.w=Ht(this.w,t.w,n.w),this}clampScalar(t,n){return this.x=Ht(this.x,t,n),this.y=Ht(this.y,t,n),this.z=Ht(this.z,t,n),this.w=Ht(this.w,t,n),this}clampLength(t,n){let i=this.length();return this.divideScalar(i||1).multiplyScalar(Ht(i,t,n))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this.w=Math.floor(this.w),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this.w=Math.ceil(this.w),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this.w=Math.round(this.w),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this.w=Math.trunc(this.w),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this.w=-this.w,this}dot(t){return this.x*t.x+this.y*t.y+this.z*t.z+this.w*t.w}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)+Math.abs(this.w)}normalize(){return this.divideScalar(this.length()||1)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,n){return this.x+=(t.x-this.x)*n,this.y+=(t.y-this.y)*n,this.z+=(t.z-this.z)*n,this.w+=(t.w-this.w)*n,this}lerpVectors(t,n,i){return this.x=t.x+(n.x-t.x)*i,this.y=t.y+(n.y-t.y)*i,this.z=t.z+(n.z-t.z)*i,this.w=t.w+(n.w-t.w)*i,this}equals(t){return t.x===this.x&&t.y===this.y&&t.z===this.z&&t.w===this.w}fromArray(t,n=0){return this.x=t[n],this.y=t[n+1],this.z=t[n+2],this.w=t[n+3],this}toArray(t=[],n=0){return t[n]=this.x,t[n+1]=this.y,t[n+2]=this.z,t[n+3]=this.w,t}fromBufferAttribute(t,n){return this.x=t.getX(n),this.y=t.getY(n),this.z=t.getZ(n),this.w=t.getW(n),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this.w=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z,yield this.w}},id=class extends Gi{constructor(t=1,n=1,i={}){super(),i=Object.assign({generateMipmaps:!1,internalFormat:null,minFilter:Nn,depthBuffer:!0,stencilBuffer:!1,resolveColorBuffer:!0,resolveDepthBuffer:!0,resolveStencilBuffer:!0,storeMultisampledColorBuffer:!0,storeMultisampledDepthBuffer:!0,storeMultisampledStencilBuffer:!0,depthTexture:null,samples:0,count:1,depth:1,multiview:!1,useArrayDepthTexture:!1},i),this.isRenderTarget=!0,this.width=t,this.height=n,this.depth=i.depth,this.scissor=new pe(0,0,t,n),this.scissorTest=!1,this.viewport=new pe(0,0,t,n),this.textures=[];let r=i.count;for(let s=0;s<r;s++)this.textures[s]=new Dn({width:t,height:n,depth:i.depth}),this.textures[s].isRenderTargetTexture=!0,this.textures[s].renderTarget=this;this._setTextureOptions(i),this.depthBuffer=i.depthBuffer,this.stencilBuffer=i.stencilBuffer,this.resolveColorBuffer=i.resolveColorBuffer,this.resolveDepthBuffer=i.resolveDepthBuffer,this.resolveStencilBuffer=i.resolveStencilBuffer,this.storeMultisampledColorBuffer=i.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=i.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=i.storeMultisampledStencilBuffer,this._depthTexture=null,this.depthTexture=i.depthTexture,this.samples=i.samples,this.multiview=i.multiview,this.useArrayDepthTexture=i.useArrayDepthTexture}_setTextureOptions(t={}){let n={minFilter:Nn,generateMipmaps:!1,flipY:!1,internalFormat:null};t.mapping!==void 0&&(n.mapping=t.mapping),t.wrapS!==void 0&&(n.wrapS=t.wrapS),t.wrapT!==void 0&&(n.wrapT=t.wrapT),t.wrapR!==void 0&&(n.wrapR=t.wrapR),t.magFilter!==void 0&&(n.magFilter=t.magFilter),t.minFilter!==void 0&&(n.minFilter=t.minFilter),t.format!==void 0&&(n.format=t.format),t.type!==void 0&&(n.type=t.type),t.anisotropy!==void 0&&(n.anisotropy=t.anisotropy),t.colorSpace!==void 0&&(n.colorSpace=t.colorSpace),t.flipY!==void 0&&(n.flipY=t.flipY),t.generateMipmaps!==void 0&&(n.generateMipmaps=t.generateMipmaps),t.mipmapsAutoUpdate!==void 0&&(n.mipmapsAutoUpdate=t.mipmapsAutoUpdate),t.internalFormat!==void 0&&(n.internalFormat=t.internalFormat);for(let i=0;i<this.textures.length;i++)this.textures[i].setValues(n)}get texture(){return this.textures[0]}set texture(t){this.textures[0]=t}set depthTexture(t){this._depthTexture!==null&&this._depthTexture.renderTarget===this&&(this._depthTexture.renderTarget=null),t!==null&&t.renderTarget===null&&(t.renderTarget=this),this._depthTexture=t}get depthTexture(){return this._depthTexture}setSize(t,n,i=1){if(this.width!==t||this.height!==n||this.depth!==i){this.width=t,this.height=n,this.depth=i;for(let r=0,s=this.textures.length;r<s;r++)this.textures[r].image.width=t,this.textures[r].image.height=n,this.textures[r].image.depth=i,this.textures[r].isData3DTexture!==!0&&(this.textures[r].isArrayTexture=this.textures[r].image.depth>1);this.dispose()}this.viewport.set(0,0,t,n),this.scissor.set(0,0,t,n)}clone(){return new this.constructor().copy(this)}copy(t){this.width=t.width,this.height=t.height,this.depth=t.depth,this.scissor.copy(t.scissor),this.scissorTest=t.scissorTest,this.viewport.copy(t.viewport),this.textures.length=0;for(let n=0,i=t.textures.length;n<i;n++){this.textures[n]=t.textures[n].clone(),this.textures[n].isRenderTargetTexture=!0,this.textures[n].renderTarget=this;let r=Object.assign({},t.textures[n].image);this.textures[n].source=new ja(r)}if(this.depthBuffer=t.depthBuffer,this.stencilBuffer=t.stencilBuffer,this.resolveColorBuffer=t.resolveColorBuffer,this.resolveDepthBuffer=t.resolveDepthBuffer,this.resolveStencilBuffer=t.resolveStencilBuffer,this.storeMultisampledColorBuffer=t.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=t.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=t.storeMultisampledStencilBuffer,t.depthTexture!==null)if(t.depthTexture.renderTarget===t){let n=t.depthTexture.clone();n.renderTarget=null,this.depthTexture=n}else this.depthTexture=t.depthTexture;else this.depthTexture=null;return this.samples=t.samples,this.multiview=t.multiview,this.useArrayDepthTexture=t.useArrayDepthTexture,this}dispose(){this.dispatchEvent({type:"dispose"})}},ei=class extends id{constructor(t=1,n=1,i={}){super(t,n,i),this.isWebGLRenderTarget=!0}},Pl=class extends Dn{constructor(t=null,n=1,i=1,r=1){super(null),this.isDataArrayTexture=!0,this.image={data:t,width:n,height:i,depth:r},this.magFilter=an,this.minFilter=an,this.wrapR=pr,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1,this.layerUpdates=new Set}copy(t){return super.copy(t),this.wrapR=t.wrapR,this}addLayerUpdate(t){this.layerUpdates.add(t)}clearLayerUpdates(){this.layerUpdates.clear()}};var rd=class extends Dn{constructor(t=null,n=1,i=1,r=1){super(null),this.isData3DTexture=!0,this.image={data:t,width:n,height:i,depth:r},this.magFilter=an,this.minFilter=an,this.wrapR=pr,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}copy(t){return super.copy(t),this.wrapR=t.wrapR,this}};var ee=class e{static{this.prototype.isMatrix4=!0}constructor(t,n,i,r,s,o,a,c,l,u,h,f,d,p,y,m){this.elements=[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],t!==void 0&&this.set(t,n,i,r,s,o,a,c,l,u,h,f,d,p,y,m)}set(t,n,i,r,s,o,a,c,l,u,h,f,d,p,y,m){let g=this.elements;return g[0]=t,g[4]=n,g[8]=i,g[12]=r,g[1]=s,g[5]=o,g[9]=a,g[13]=c,g[2]=l,g[6]=u,g[10]=h,g[14]=f,g[3]=d,g[7]=p,g[11]=y,g[15]=m,this}identity(){return this.set(1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1),this}clone(){return new e().fromArray(this.elements)}copy(t){let n=this.elements,i=t.elements;return n[0]=i[0],n[1]=i[1],n[2]=i[2],n[3]=i[3],n[4]=i[4],n[5]=i[5],n[6]=i[6],n[7]=i[7],n[8]=i[8],n[9]=i[9],n[10]=i[10],n[11]=i[11],n[12]=i[12],n[13]=i[13],n[14]=i[14],n[15]=i[15],this}copyPosition(t){let n=this.elements,i=t.elements;return n[12]=i[12],n[13]=i[13],n[14]=i[14],this}setFromMatrix3(t){let n=t.elements;return this.set(n[0],n[3],n[6],0,n[1],n[4],n[7],0,n[2],n[5],n[8],0,0,0,0,1),this}extractBasis(t,n,i){return this.determinantAffine()===0?(t.set(1,0,0),n.set(0,1,0),i.set(0,0,1),this):(t.setFromMatrixColumn(this,0),n.setFromMatrixColumn(this,1),i.setFromMatrixColumn(this,2),this)}makeBasis(t,n,i){return this.set(t.x,n.x,i.x,0,t.y,n.y,i.y,0,t.z,n.z,i.z,0,0,0,0,1),this}extractRotation(t){if(t.determinantAffine()===0)return this.identity();let n=this.elements,i=t.elements,r=1/Na.setFromMatrixColumn(t,0).length(),s=1/Na.setFromMatrixColumn(t,1).length(),o=1/Na.setFromMatrixColumn(t,2).length();return n[0]=i[0]*r,n[1]=i[1]*r,n[2]=i[2]*r,n[3]=0,n[4]=i[4]*s,n[5]=i[5]*s,n[6]=i[6]*s,n[7]=0,n[8]=i[8]*o,n[9]=i[9]*o,n[10]=i[10]*o,n[11]=0,n[12]=0,n[13]=0,n[14]=0,n[15]=1,this}makeRotationFromEuler(t){let n=this.elements,i=t.x,r=t.y,s=t.z,o=Math.cos(i),a=Math.sin(i),c=Math.cos(r),l=Math.sin(r),u=Math.cos(s),h=Math.sin(s);if(t.order==="XYZ"){let f=o*u,d=o*h,p=a*u,y=a*h;n[0]=c*u,n[4]=-c*h,n[8]=l,n[1]=d+p*l,n[5]=f-y*l,n[9]=-a*c,n[2]=y-f*l,n[6]=p+d*l,n[10]=o*c}else if(t.order==="YXZ"){let f=c*u,d=c*h,p=l*u,y=l*h;n[0]=f+y*a,n[4]=p*a-d,n[8]=o*l,n[1]=o*h,n[5]=o*u,n[9]=-a,n[2]=d*a-p,n[6]=y+f*a,n[10]=o*c}else if(t.order==="ZXY"){let f=c*u,d=c*h,p=l*u,y=l*h;n[0]=f-y*a,n[4]=-o*h,n[8]=p+d*a,n[1]=d+p*a,n[5]=o*u,n[9]=y-f*a,n[2]=-o*l,n[6]=a,n[10]=o*c}else if(t.order==="ZYX"){let f=o*u,d=o*h,p=a*u,y=a*h;n[0]=c*u,n[4]=p*l-d,n[8]=f*l+y,n[1]=c*h,n[5]=y*l+f,n[9]=d*l-p,n[2]=-l,n[6]=a*c,n[10]=o*c}else if(t.order==="YZX"){let f=o*c,d=o*l,p=a*c,y=a*l;n[0]=c*u,n[4]=y-f*h,n[8]=p*h+d,n[1]=h,n[5]=o*u,n[9]=-a*u,n[2]=-l*u,n[6]=d*h+p,n[10]=f-y*h}else if(t.order==="XZY"){let f=o*c,d=o*l,p=a*c,y=a*l;n[0]=c*u,n[4]=-h,n[8]=l*u,n[1]=f*h+y,n[5]=o*u,n[9]=d*h-p,n[2]=p*h-d,n[6]=a*u,n[10]=y*h+f}return n[3]=0,n[7]=0,n[11]=0,n[12]=0,n[13]=0,n[14]=0,n[15]=1,this}makeRotationFromQuaternion(t){return this.compose(UU,t,FU)}lookAt(t,n,i){let r=this.elements;return Jn.subVectors(t,n),Jn.lengthSq()===0&&(Jn.z=1),Jn.normalize(),vs.crossVectors(i,Jn),vs.lengthSq()===0&&(Math.abs(i.z)===1?Jn.x+=1e-4:Jn.z+=1e-4,Jn.normalize(),vs.crossVectors(i,Jn)),vs.normalize(),xh.crossVectors(Jn,vs),r[0]=vs.x,r[4]=xh.x,r[8]=Jn.x,r[1]=vs.y,r[5]=xh.y,r[9]=Jn.y,r[2]=vs.z,r[6]=xh.z,r[10]=Jn.z,this}multiply(t){return this.multiplyMatrices(this,t)}premultiply(t){return this.multiplyMatrices(t,this)}multiplyMatrices(t,n){let i=t.elements,r=n.elements,s=this.elements,o=i[0],a=i[4],c=i[8],l=i[12],u=i[1],h=i[5],f=i[9],d=i[13],p=i[2],y=i[6],m=i[10],g=i[14],x=i[3],S=i[7],v=i[11],w=i[15],b=r[0],_=r[4],M=r[8],C=r[12],E=r[1],I=r[5],R=r[9],U=r[13],P=r[2],L=r[6],O=r[10],D=r[14],Y=r[3],B=r[7],V=r[11],q=r[15];return s[0]=o*b+a*E+c*P+l*Y,s[4]=o*_+a*I+c*L+l*B,s[8]=o*M+a*R+c*O+l*V,s[12]=o*C+a*U+c*D+l*q,s[1]=u*b+h*E+f*P+d*Y,s[5]=u*_+h*I+f*L+d*B,s[9]=u*M+h*R+f*O+d*V,s[13]=u*C+h*U+f*D+d*q,s[2]=p*b+y*E+m*P+g*Y,s[6]=p*_+y*I+m*L+g*B,s[10]=p*M+y*R+m*O+g*V,s[14]=p*C+y*U+m*D+g*q,s[3]=x*b+S*E+v*P+w*Y,s[7]=x*_+S*I+v*L+w*B,s[11]=x*M+S*R+v*O+w*V,s[15]=x*C+S*U+v*D+w*q,this}multiplyScalar(t){let n=this.elements;return n[0]*=t,n[4]*=t,n[8]*=t,n[12]*=t,n[1]*=t,n[5]*=t,n[9]*=t,n[13]*=t,n[2]*=t,n[6]*=t,n[10]*=t,n[14]*=t,n[3]*=t,n[7]*=t,n[11]*=t,n[15]*=t,this}determinant(){let t=this.elements,n=t[0],i=t[4],r=t[8],s=t[12],o=t[1],a=t[5],c=t[9],l=t[13],u=t[2],h=t[6],f=t[10],d=t[14],p=t[3],y=t[7],m=t[11],g=t[15],x=c*d-l*f,S=a*d-l*h,v=a*f-c*h,w=o*d-l*u,b=o*f-c*u,_=o*h-a*u;return n*(y*x-m*S+g*v)-i*(p*x-m*w+g*b)+r*(p*S-y*w+g*_)-s*(p*v-y*b+m*_)}determinantAffine(){let t=this.elements,n=t[0],i=t[4],r=t[8],s=t[1],o=t[5],a=t[9],c=t[2],l=t[6],u=t[10];return n*(o*u-a*l)-i*(s*u-a*c)+r*(s*l-o*c)}transpose(){let t=this.elements,n;return n=t[1],t[1]=t[4],t[4]=n,n=t[2],t[2]=t[8],t[8]=n,n=t[6],t[6]=t[9],t[9]=n,n=t[3],t[3]=t[12],t[12]=n,n=t[7],t[7]=t[13],t[13]=n,n=t[11],t[11]=t[14],t[14]=n,this}setPosition(t,n,i){let r=this.elements;return t.isVector3?(r[12]=t.x,r[13]=t.y,r[14]=t.z):(r[12]=t,r[13]=n,r[14]=i),this}invert(){let t=this.elements,n=t[0],i=t[1],r=t[2],s=t[3],o=t[4],a=t[5],c=t[6],l=t[7],u=t[8],h=t[9],f=t[10],d=t[11],p=t[12],y=t[13],m=t[14],g=t[15],x=n*a-i*o,S=n*c-r*o,v=n*l-s*o,w=i*c-r*a,b=i*l-s*a,_=r*l-s*c,M=u*y-h*p,C=u*m-f*p,E=u*g-d*p,I=h*m-f*y,R=h*g-d*y,U=f*g-d*m,P=x*U-S*R+v*I+w*E-b*C+_*M;if(P===0)return this.set(0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0);let L=1/P;return t[0]=(a*U-c*R+l*I)*L,t[1]=(r*R-i*U-s*I)*L,t[2]=(y*_-m*b+g*w)*L,t[3]=(f*b-h*_-d*w)*L,t[4]=(c*E-o*U-l*C)*L,t[5]=(n*U-r*E+s*C)*L,t[6]=(m*v-p*_-g*S)*L,t[7]=(u*_-f*v+d*S)*L,t[8]=(o*R-a*E+l*M)*L,t[9]=(i*E-n*R-s*M)*L,t[10]=(p*b-y*v+g*x)*L,t[11]=(h*v-u*b-d*x)*L,t[12]=(a*C-o*I-c*M)*L,t[13]=(n*I-i*C+r*M)*L,t[14]=(y*S-p*w-m*x)*L,t[15]=(u*w-h*S+f*x)*L,this}scale(t){let n=this.elements,i=t.x,r=t.y,s=t.z;return n[0]*=i,n[4]*=r,n[8]*=s,n[1]*=i,n[5]*=r,n[9]*=s,n[2]*=i,n[6]*=r,n[10]*=s,n[3]*=i,n[7]*=r,n[11]*=s,this}getMaxScaleOnAxis(){let t=this.elements,n=t[0]*t[0]+t[1]*t[1]+t[2]*t[2],i=t[4]*t[4]+t[5]*t[5]+t[6]*t[6],r=t[8]*t[8]+t[9]*t[9]+t[10]*t[10];return Math.sqrt(Math.max(n,i,r))}makeTranslation(t,n,i){return t.isVector3?this.set(1,0,0,t.x,0,1,0,t.y,0,0,1,t.z,0,0,0,1):this.set(1,0,0,t,0,1,0,n,0,0,1,i,0,0,0,1),this}makeRotationX(t){let n=Math.cos(t),i=Math.sin(t);return this.set(1,0,0,0,0,n,-i,0,0,i,n,0,0,0,0,1),this}makeRotationY(t){let n=Math.cos(t),i=Math.sin(t);return this.set(n,0,i,0,0,1,0,0,-i,0,n,0,0,0,0,1),this}makeRotationZ(t){let n=Math.cos(t),i=Math.sin(t);return this.set(n,-i,0,0,i,n,0,0,0,0,1,0,0,0,0,1),this}makeRotationAxis(t,n){let i=Math.cos(n),r=Math.sin(n),s=1-i,o=t.x,a=t.y,c=t.z,l=s*o,u=s*a;return this.set(l*o+i,l*a-r*c,l*c+r*a,0,l*a+r*c,u*a+i,u*c-r*o,0,l*c-r*a,u*c+r*o,s*c*c+i,0,0,0,0,1),this}makeScale(t,n,i){return this.set(t,0,0,0,0,n,0,0,0,0,i,0,0,0,0,1),this}makeShear(t,n,i,r,s,o){return this.set(1,i,s,0,t,1,o,0,n,r,1,0,0,0,0,1),this}compose(t,n,i){let r=this.elements,s=n._x,o=n._y,a=n._z,c=n._w,l=s+s,u=o+o,h=a+a,f=s*l,d=s*u,p=s*h,y=o*u,m=o*h,g=a*h,x=c*l,S=c*u,v=c*h,w=i.x,b=i.y,_=i.z;return r[0]=(1-(y+g))*w,r[1]=(d+v)*w,r[2]=(p-S)*w,r[3]=0,r[4]=(d-v)*b,r[5]=(1-(f+g))*b,r[6]=(m+x)*b,r[7]=0,r[8]=(p+S)*_,r[9]=(m-x)*_,r[10]=(1-(f+y))*_,r[11]=0,r[12]=t.x,r[13]=t.y,r[14]=t.z,r[15]=1,this}decompose(t,n,i){let r=this.elements;t.x=r[12],t.y=r[13],t.z=r[14];let s=this.determinantAffine();if(s===0)return i.set(1,1,1),n.identity(),this;let o=Na.set(r[0],r[1],r[2]).length(),a=Na.set(r[4],r[5],r[6]).length(),c=Na.set(r[8],r[9],r[10]).length();s<0&&(o=-o),Bi.copy(this);let l=1/o,u=1/a,h=1/c;return Bi.elements[0]*=l,Bi.elements[1]*=l,Bi.elements[2]*=l,Bi.elements[4]*=u,Bi.elements[5]*=u,Bi.elements[6]*=u,Bi.elements[8]*=h,Bi.elements[9]*=h,Bi.elements[10]*=h,n.setFromRotationMatrix(Bi),i.x=o,i.y=a,i.z=c,this}makePerspective(t,n,i,r,s,o,a=Ai,c=!1){let l=this.elements,u=2*s/(n-t),h=2*s/(i-r),f=(n+t)/(n-t),d=(i+r)/(i-r),p,y;if(c)p=s/(o-s),y=o*s/(o-s);else if(a===Ai)p=-(o+s)/(o-s),y=-2*o*s/(o-s);else if(a===Za)p=-o/(o-s),y=-o*s/(o-s);else throw new Error("THREE.Matrix4.makePerspective(): Invalid coordinate system: "+a);return l[0]=u,l[4]=0,l[8]=f,l[12]=0,l[1]=0,l[5]=h,l[9]=d,l[13]=0,l[2]=0,l[6]=0,l[10]=p,l[14]=y,l[3]=0,l[7]=0,l[11]=-1,l[15]=0,this}makeOrthographic(t,n,i,r,s,o,a=Ai,c=!1){let l=this.elements,u=2/(n-t),h=2/(i-r),f=-(n+t)/(n-t),d=-(i+r)/(i-r),p,y;if(c)p=1/(o-s),y=o/(o-s);else if(a===Ai)p=-2/(o-s),y=-(o+s)/(o-s);else if(a===Za)p=-1/(o-s),y=-s/(o-s);else throw new Error("THREE.Matrix4.makeOrthographic(): Invalid coordinate system: "+a);return l[0]=u,l[4]=0,l[8]=0,l[12]=f,l[1]=0,l[5]=h,l[9]=0,l[13]=d,l[2]=0,l[6]=0,l[10]=p,l[14]=y,l[3]=0,l[7]=0,l[11]=0,l[15]=1,this}equals(t){let n=this.elements,i=t.elements;for(let r=0;r<16;r++)if(n[r]!==i[r])return!1;return!0}fromArray(t,n=0){for(let i=0;i<16;i++)this.elements[i]=t[i+n];return this}toArray(t=[],n=0){let i=this.elements;return t[n]=i[0],t[n+1]=i[1],t[n+2]=i[2],t[n+3]=i[3],t[n+4]=i[4],t[n+5]=i[5],t[n+6]=i[6],t[n+7]=i[7],t[n+8]=i[8],t[n+9]=i[9],t[n+10]=i[10],t[n+11]=i[11],t[n+12]=i[12],t[n+13]=i[13],t[n+14]=i[14],t[n+15]=i[15],t}},Na=new k,Bi=new ee,UU=new k(0,0,0),FU=new k(1,1,1),vs=new k,xh=new k,Jn=new k,qA=new ee,YA=new Sn,qr=class e{constructor(t=0,n=0,i=0,r=e.DEFAULT_ORDER){this.isEuler=!0,this._x=t,this._y=n,this._z=i,this._order=r}get x(){return this._x}set x(t){this._x=t,this._onChangeCallback()}get y(){return this._y}set y(t){this._y=t,this._onChangeCallback()}get z(){return this._z}set z(t){this._z=t,this._onChangeCallback()}get order(){return this._order}set order(t){this._order=t,this._onChangeCallback()}set(t,n,i,r=this._order){return this._x=t,this._y=n,this._z=i,this._order=r,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._order)}copy(t){return this._x=t._x,this._y=t._y,this._z=t._z,this._order=t._order,this._onChangeCallback(),this}setFromRotationMatrix(t,n=this._order,i=!0){let r=t.elements,s=r[0],o=r[4],a=r[8],c=r[1],l=r[5],u=r[9],h=r[2],f=r[6],d=r[10];switch(n){case"XYZ":this._y=Math.asin(Ht(a,-1,1)),Math.abs(a)<.9999999?(this._x=Math.atan2(-u,d),this._z=Math.atan2(-o,s)):(this._x=Math.atan2(f,l),this._z=0);break;case"YXZ":this._x=Math.asin(-Ht(u,-1,1)),Math.abs(u)<.9999999?(this._y=Math.atan2(a,d),this._z=Math.atan2(c,l)):(this._y=Math.atan2(-h,s),this._z=0);break;case"ZXY":this._x=Math.asin(Ht(f,-1,1)),Math.abs(f)<.9999999?(this._y=Math.atan2(-h,d),this._z=Math.atan2(-o,l)):(this._y=0,this._z=Math.atan2(c,s));break;case"ZYX":this._y=Math.asin(-Ht(h,-1,1)),Math.abs(h)<.9999999?(this._x=Math.atan2(f,d),this._z=Math.atan2(c,s)):(this._x=0,this._z=Math.atan2(-o,l));break;case"YZX":this._z=Math.asin(Ht(c,-1,1)),Math.abs(c)<.9999999?(this._x=Math.atan2(-u,l),this._y=Math.atan2(-h,s)):(this._x=0,this._y=Math.atan2(a,d));break;case"XZY":this._z=Math.asin(-Ht(o,-1,1)),Math.abs(o)<.9999999?(this._x=Math.atan2(f,l),this._y=Math.atan2(a,s)):(this._x=Math.atan2(-u,d),this._y=0);break;default:Ut("Euler: .setFromRotationMatrix() encountered an unknown order: "+n)}return this._order=n,i===!0&&this._onChangeCallback(),this}setFromQuaternion(t,n,i){return qA.makeRotationFromQuaternion(t),this.setFromRotationMatrix(qA,n,i)}setFromVector3(t,n=this._order){return this.set(t.x,t.y,t.z,n)}reorder(t){return YA.setFromEuler(this),this.setFromQuaternion(YA,t)}equals(t){return t._x===this._x&&t._y===this._y&&t._z===this._z&&t._order===this._order}fromArray(t){return this._x=t[0],this._y=t[1],this._z=t[2],t[3]!==void 0&&(this._order=t[3]),this._onChangeCallback(),this}toArray(t=[],n=0){return t[n]=this._x,t[n+1]=this._y,t[n+2]=this._z,t[n+3]=this._order,t}_onChange(t){return this._onChangeCallback=t,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._order}};qr.DEFAULT_ORDER="XYZ";var Il=class{constructor(){this.mask=1}set(t){this.mask=(1<<t|0)>>>0}enable(t){this.mask|=1<<t|0}enableAll(){this.mask=-1}toggle(t){this.mask^=1<<t|0}disable(t){this.mask&=~(1<<t|0)}disableAll(){this.mask=0}test(t){return(this.mask&t.mask)!==0}isEnabled(t){return(this.mask&(1<<t|0))!==0}},OU=0,ZA=new k,Da=new Sn,zr=new ee,vh=new k,yl=new k,BU=new k,kU=new Sn,JA=new k(1,0,0),KA=new k(0,1,0),jA=new k(0,0,1),QA={type:"added"},zU={type:"removed"},Ua={type:"childadded",child:null},h_={type:"childremoved",child:null},dn=class e extends Gi{constructor(){super(),this.isObject3D=!0,Object.defineProperty(this,"id",{value:OU++}),this.uuid=zs(),this.name="",this.type="Object3D",this.parent=null,this.children=[],this.up=e.DEFAULT_UP.clone();let t=new k,n=new qr,i=new Sn,r=new k(1,1,1);function s(){i.setFromEuler(n,!1)}function o(){n.setFromQuaternion(i,void 0,!1)}n._onChange(s),i._onChange(o),Object.defineProperties(this,{position:{configurable:!0,enumerable:!0,value:t},rotation:{configurable:!0,enumerable:!0,value:n},quaternion:{configurable:!0,enumerable:!0,value:i},scale:{configurable:!0,enumerable:!0,value:r},modelViewMatrix:{value:new ee},normalMatrix:{value:new zt}}),this.matrix=new ee,this.matrixWorld=new ee,this.matrixAutoUpdate=e.DEFAULT_MATRIX_AUTO_UPDATE,this.matrixWorldAutoUpdate=e.DEFAULT_MATRIX_WORLD_AUTO_UPDATE,this.matrixWorldNeedsUpdate=!1,this.layers=new Il,this.visible=!0,this.castShadow=!1,this.receiveShadow=!1,this.frustumCulled=!0,this.renderOrder=0,this.animations=[],this.customDepthMaterial=void 0,this.customDistanceMaterial=void 0,this.static=!1,this.userData={},this.pivot=null}onBeforeShadow(){}onAfterShadow(){}onBeforeRender(){}onAfterRender(){}applyMatrix4(t){this.matrixAutoUpdate&&this.updateMatrix(),this.matrix.premultiply(t),this.matrix.decompose(this.position,this.quaternion,this.scale),this.pivot!==null&&this.position.copy(this.pivot).applyMatrix4(this.matrix).sub(this.pivot)}applyQuaternion(t){return this.quaternion.premultiply(t),this}setRotationFromAxisAngle(t,n){this.quaternion.setFromAxisAngle(t,n)}setRotationFromEuler(t){this.quaternion.setFromEuler(t,!0)}setRotationFromMatrix(t){this.quaternion.setFromRotationMatrix(t)}setRotationFromQuaternion(t){this.quaternion.copy(t)}rotateOnAxis(t,n){return Da.setFromAxisAngle(t,n),this.quaternion.multiply(Da),this}rotateOnWorldAxis(t,n){return Da.setFromAxisAngle(t,n),this.quaternion.premultiply(Da),this}rotateX(t){return this.rotateOnAxis(JA,t)}rotateY(t){return this.rotateOnAxis(KA,t)}rotateZ(t){return this.rotateOnAxis(jA,t)}translateOnAxis(t,n){return ZA.copy(t).applyQuaternion(this.quaternion),this.position.add(ZA.multiplyScalar(n)),this}translateX(t){return this.translateOnAxis(JA,t)}translateY(t){return this.translateOnAxis(KA,t)}translateZ(t){return this.translateOnAxis(jA,t)}localToWorld(t){return this.updateWorldMatrix(!0,!1),t.applyMatrix4(this.matrixWorld)}worldToLocal(t){return this.updateWorldMatrix(!0,!1),t.applyMatrix4(zr.copy(this.matrixWorld).invert())}lookAt(t,n,i){t.isVector3?vh.copy(t):vh.set(t,n,i);let r=this.parent;this.updateWorldMatrix(!0,!1),yl.setFromMatrixPosition(this.matrixWorld),this.isCamera||this.isLight?zr.lookAt(yl,vh,this.up):zr.lookAt(vh,yl,this.up),this.quaternion.setFromRotationMatrix(zr),r&&(zr.extractRotation(r.matrixWorld),Da.setFromRotationMatrix(zr),this.quaternion.premultiply(Da.invert()))}add(t){if(arguments.length>1){for(let n=0;n<arguments.length;n++)this.add(arguments[n]);return this}return t===this?(kt("Object3D.add: object can't be added as a child of itself.",t),this):(t&&t.isObject3D?(t.removeFromParent(),t.parent=this,this.children.push(t),t.dispatchEvent(QA),Ua.child=t,this.dispatchEvent(Ua),Ua.child=null):kt("Object3D.add: object not an instance of THREE.Object3D.",t),this)}remove(t){if(arguments.length>1){for(let i=0;i<arguments.length;i++)this.remove(arguments[i]);return this}let n=this.children.indexOf(t);return n!==-1&&(t.parent=null,this.children.splice(n,1),t.dispatchEvent(zU),h_.child=t,this.dispatchEvent(h_),h_.child=null),this}removeFromParent(){let t=this.parent;return t!==null&&t.remove(this),this}clear(){return this.remove(...this.children)}attach(t){return this.updateWorldMatrix(!0,!1),zr.copy(this.matrixWorld).invert(),t.parent!==null&&(t.parent.updateWorldMatrix(!0,!1),zr.multiply(t.parent.matrixWorld)),t.applyMatrix4(zr),t.removeFromParent(),t.parent=this,this.children.push(t),t.updateWorldMatrix(!1,!0),t.dispatchEvent(QA),Ua.child=t,this.dispatchEvent(Ua),Ua.child=null,this}getObjectById(t){return this.getObjectByProperty("id",t)}getObjectByName(t){return this.getObjectByProperty("name",t)}getObjectByProperty(t,n){if(this[t]===n)return this;for(let i=0,r=this.children.length;i<r;i++){let o=this.children[i].getObjectByProperty(t,n);if(o!==void 0)return o}}getObjectsByProperty(t,n,i=[]){this[t]===n&&i.push(this);let r=this.children;for(let s=0,o=r.length;s<o;s++)r[s].getObjectsByProperty(t,n,i);return i}getWorldPosition(t){return this.updateWorldMatrix(!0,!1),t.setFromMatrixPosition(this.matrixWorld)}getWorldQuaternion(t){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(yl,t,BU),t}getWorldScale(t){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(yl,kU,t),t}getWorldDirection(t){this.updateWorldMatrix(!0,!1);let n=this.matrixWorld.elements;return t.set(n[8],n[9],n[10]).normalize()}raycast(){}intersectsFrustum(){return!0}traverse(t){t(this);let n=this.children;for(let i=0,r=n.length;i<r;i++)n[i].traverse(t)}traverseVisible(t){if(this.visible===!1)return;t(this);let n=this.children;for(let i=0,r=n.length;i<r;i++)n[i].traverseVisible(t)}traverseAncestors(t){let n=this.parent;n!==null&&(t(n),n.traverseAncestors(t))}updateMatrix(){this.matrix.compose(this.position,this.quaternion,this.scale);let t=this.pivot;if(t!==null){let n=t.x,i=t.y,r=t.z,s=this.matrix.elements;s[12]+=n-s[0]*n-s[4]*i-s[8]*r,s[13]+=i-s[1]*n-s[5]*i-s[9]*r,s[14]+=r-s[2]*n-s[6]*i-s[10]*r}this.matrixWorldNeedsUpdate=!0}updateMatrixWorld(t){this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||t)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,t=!0);let n=this.children;for(let i=0,r=n.length;i<r;i++)n[i].updateMatrixWorld(t)}updateWorldMatrix(t,n,i=!1){let r=this.parent;if(t===!0&&r!==null&&r.updateWorldMatrix(!0,!1),this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||i)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,i=!0),n===!0){let s=this.children;for(let o=0,a=s.length;o<a;o++)s[o].updateWorldMatrix(!1,!0,i)}}toJSON(t){let n=t===void 0||typeof t=="string",i={};n&&(t={geometries:{},materials:{},textures:{},images:{},shapes:{},skeletons:{},animations:{},nodes:{}},i.metadata={version:4.7,type:"Object",generator:"Object3D.toJSON"});let r={};r.uuid=this.uuid,r.type=this.type,r.name=this.name,r.castShadow=this.castShadow,r.receiveShadow=this.receiveShadow,r.visible=this.visible,r.frustumCulled=this.frustumCulled,r.renderOrder=this.renderOrder,r.static=this.static,r.matrixAutoUpdate=this.matrixAutoUpdate,Object.keys(this.userData).length>0&&(r.userData=this.userData),r.layers=this.layers.mask,r.matrix=this.matrix.toArray(),r.up=this.up.toArray(),this.pivot!==null&&(r.pivot=this.pivot.toArray()),this.morphTargetDictionary!==void 0&&(r.morphTargetDictionary=Object.assign({},this.morphTargetDictionary)),this.morphTargetInfluences!==void 0&&(r.morphTargetInfluences=this.morphTargetInfluences.slice()),this.isInstancedMesh&&(r.type="InstancedMesh",r.count=this.count,r.instanceMatrix=this.instanceMatrix.toJSON(),this.instanceColor!==null&&(r.instanceColor=this.instanceColor.toJSON())),this.isBatchedMesh&&(r.type="BatchedMesh",r.perObjectFrustumCulled=this.perObjectFrustumCulled,r.sortObjects=this.sortObjects,r.drawRanges=this._drawRanges,r.reservedRanges=this._reservedRanges,r.geometryInfo=this._geometryInfo.map(a=>({...a,boundingBox:a.boundingBox?a.boundingBox.toJSON():void 0,boundingSphere:a.boundingSphere?a.boundingSphere.toJSON():void 0})),r.instanceInfo=this._instanceInfo.map(a=>({...a})),r.availableInstanceIds=this._availableInstanceIds.slice(),r.availableGeometryIds=this._availableGeometryIds.slice(),r.nextIndexStart=this._nextIndexStart,r.nextVertexStart=this._nextVertexStart,r.geometryCount=this._geometryCount,r.maxInstanceCount=this._maxInstanceCount,r.maxVertexCount=this._maxVertexCount,r.maxIndexCount=this._maxIndexCount,r.geometryInitialized=this._geometryInitialized,r.matricesTexture=this._matricesTexture.toJSON(t),r.indirectTexture=this._indirectTexture.toJSON(t),this._colorsTexture!==null&&(r.colorsTexture=this._colorsTexture.toJSON(t)),this.boundingSphere!==null&&(r.boundingSphere=this.boundingSphere.toJSON()),this.boundingBox!==null&&(r.boundingBox=this.boundingBox.toJSON()));function s(a,c){return a[c.uuid]===void 0&&(a[c.uuid]=c.toJSON(t)),c.uuid}if(this.isScene)this.background&&(this.background.isColor?r.background=this.background.toJSON():this.background.isTexture&&(r.background=this.background.toJSON(t).uuid)),this.environment&&this.environment.isTexture&&this.environment.isRenderTargetTexture!==!0&&(r.environment=this.environment.toJSON(t).uuid);else if(this.isMesh||this.isLine||this.isPoints){r.geometry=s(t.geometries,this.geometry);let a=this.geometry.parameters;if(a!==void 0&&a.shapes!==void 0){let c=a.shapes;if(Array.isArray(c))for(let l=0,u=c.length;l<u;l++){let h=c[l];s(t.shapes,h)}else s(t.shapes,c)}}if(this.isSkinnedMesh&&(r.bindMode=this.bindMode,r.bindMatrix=this.bindMatrix.toArray(),this.skeleton!==void 0&&(s(t.skeletons,this.skeleton),r.skeleton=this.skeleton.uuid)),this.material!==void 0)if(Array.isArray(this.material)){let a=[];for(let c=0,l=this.material.length;c<l;c++)a.push(s(t.materials,this.material[c]));r.material=a}else r.material=s(t.materials,this.material);if(this.children.length>0){r.children=[];for(let a=0;a<this.children.length;a++)r.children.push(this.children[a].toJSON(t).object)}if(this.animations.length>0){r.animations=[];for(let a=0;a<this.animations.length;a++){let c=this.animations[a];r.animations.push(s(t.animations,c))}}if(n){let a=o(t.geometries),c=o(t.materials),l=o(t.textures),u=o(t.images),h=o(t.shapes),f=o(t.skeletons),d=o(t.animations),p=o(t.nodes);a.length>0&&(i.geometries=a),c.length>0&&(i.materials=c),l.length>0&&(i.textures=l),u.length>0&&(i.images=u),h.length>0&&(i.shapes=h),f.length>0&&(i.skeletons=f),d.length>0&&(i.animations=d),p.length>0&&(i.nodes=p)}return i.object=r,i;function o(a){let c=[];for(let l in a){let u=a[l];delete u.metadata,c.push(u)}return c}}clone(t){return new this.constructor().copy(this,t)}copy(t,n=!0){if(this.name=t.name,this.up.copy(t.up),this.position.copy(t.position),this.rotation.order=t.rotation.order,this.quaternion.copy(t.quaternion),this.scale.copy(t.scale),this.pivot=t.pivot!==null?t.pivot.clone():null,this.matrix.copy(t.matrix),this.matrixWorld.copy(t.matrixWorld),this.matrixAutoUpdate=t.matrixAutoUpdate,this.matrixWorldAutoUpdate=t.matrixWorldAutoUpdate,this.matrixWorldNeedsUpdate=t.matrixWorldNeedsUpdate,this.layers.mask=t.layers.mask,this.visible=t.visible,this.castShadow=t.castShadow,this.receiveShadow=t.receiveShadow,this.frustumCulled=t.frustumCulled,this.renderOrder=t.renderOrder,this.static=t.static,this.animations=t.animations.slice(),this.userData=JSON.parse(JSON.stringify(t.userData)),n===!0)for(let i=0;i<t.children.length;i++){let r=t.children[i];this.add(r.clone())}return this}dispose(){this.dispatchEvent({type:"dispose"})}};dn.DEFAULT_UP=new k(0,1,0);dn.DEFAULT_MATRIX_AUTO_UPDATE=!0;dn.DEFAULT_MATRIX_WORLD_AUTO_UPDATE=!0;var ti=class extends dn{constructor(){super(),this.isGroup=!0,this.type="Group"}},GU={type:"move"},Qa=class{constructor(){this._targetRay=null,this._grip=null,this._hand=null}getHandSpace(){return this._hand===null&&(this._hand=new ti,this._hand.matrixAutoUpdate=!1,this._hand.visible=!1,this._hand.joints={},this._hand.inputState={pinching:!1}),this._hand}getTargetRaySpace(){return this._targetRay===null&&(this._targetRay=new ti,this._targetRay.matrixAutoUpdate=!1,this._targetRay.visible=!1,this._targetRay.hasLinearVelocity=!1,this._targetRay.linearVelocity=new k,this._targetRay.hasAngularVelocity=!1,this._targetRay.angularVelocity=new k),this._targetRay}getGripSpace(){return this._grip===null&&(this._grip=new ti,this._grip.matrixAutoUpdate=!1,this._grip.visible=!1,this._grip.hasLinearVelocity=!1,this._grip.linearVelocity=new k,this._grip.hasAngularVelocity=!1,this._grip.angularVelocity=new k,this._grip.eventsEnabled=!1),this._grip}dispatchEvent(t){return this._targetRay!==null&&this._targetRay.dispatchEvent(t),this._grip!==null&&this._grip.dispatchEvent(t),this._hand!==null&&this._hand.dispatchEvent(t),this}connect(t){if(t&&t.hand){let n=this._hand;if(n)for(let i of t.hand.values())this._getHandJoint(n,i)}return this.dispatchEvent({type:"connected",data:t}),this}disconnect(t){return this.dispatchEvent({type:"disconnected",data:t}),this._targetRay!==null&&(this._targetRay.visible=!1),this._grip!==null&&(this._grip.visible=!1),this._hand!==null&&(this._hand.visible=!1),this}update(t,n,i){let r=null,s=null,o=null,a=this._targetRay,c=this._grip,l=this._hand;if(t&&n.session.visibilityState!=="visible-blurred"){if(l&&t.hand){o=!0;for(let y of t.hand.values()){let m=n.getJointPose(y,i),g=this._getHandJoint(l,y);m!==null&&(g.matrix.fromArray(m.transform.matrix),g.matrix.decompose(g.position,g.quaternion,g.scale),g.matrixWorldNeedsUpdate=!0,g.jointRadius=m.radius),g.visible=m!==null}let u=l.joints["index-finger-tip"],h=l.joints["thumb-tip"],f=u.position.distanceTo(h.position),d=.02,p=.005;l.inputState.pinching&&f>d+p?(l.inputState.pinching=!1,this.dispatchEvent({type:"pinchend",handedness:t.handedness,target:this})):!l.inputState.pinching&&f<=d-p&&(l.inputState.pinching=!0,this.dispatchEvent({type:"pinchstart",handedness:t.handedness,target:this}))}else c!==null&&t.gripSpace&&(s=n.getPose(t.gripSpace,i),s!==null&&(c.matrix.fromArray(s.transform.matrix),c.matrix.decompose(c.position,c.quaternion,c.scale),c.matrixWorldNeedsUpdate=!0,s.linearVelocity?(c.hasLinearVelocity=!0,c.linearVelocity.copy(s.linearVelocity)):c.hasLinearVelocity=!1,s.angularVelocity?(c.hasAngularVelocity=!0,c.angularVelocity.copy(s.angularVelocity)):c.hasAngularVelocity=!1,c.eventsEnabled&&c.dispatchEvent({type:"gripUpdated",data:t,target:this})));a!==null&&(r=n.getPose(t.targetRaySpace,i),r===null&&s!==null&&(r=s),r!==null&&(a.matrix.fromArray(r.transform.matrix),a.matrix.decompose(a.position,a.quaternion,a.scale),a.matrixWorldNeedsUpdate=!0,r.linearVelocity?(a.hasLinearVelocity=!0,a.linearVelocity.copy(r.linearVelocity)):a.hasLinearVelocity=!1,r.angularVelocity?(a.hasAngularVelocity=!0,a.angularVelocity.copy(r.angularVelocity)):a.hasAngularVelocity=!1,this.dispatchEvent(GU)))}return a!==null&&(a.visible=r!==null),c!==null&&(c.visible=s!==null),l!==null&&(l.visible=o!==null),this}_getHandJoint(t,n){if(t.joints[n.jointName]===void 0){let i=new ti;i.matrixAutoUpdate=!1,i.visible=!1,t.joints[n.jointName]=i,t.add(i)}return t.joints[n.jointName]}},i2={aliceblue:15792383,antiquewhite:16444375,aqua:65535,aquamarine:8388564,azure:15794175,beige:16119260,bisque:16770244,black:0,blanchedalmond:16772045,blue:255,blueviolet:9055202,brown:10824234,burlywood:14596231,cadetblue:6266528,chartreuse:8388352,chocolate:13789470,coral:16744272,cornflowerblue:6591981,cornsilk:16775388,crimson:14423100,cyan:65535,darkblue:139,darkcyan:35723,darkgoldenrod:12092939,darkgray:11119017,darkgreen:25600,darkgrey:11119017,darkkhaki:12433259,darkmagenta:9109643,darkolivegreen:5597999,darkorange:16747520,darkorchid:10040012,darkred:9109504,darksalmon:15308410,darkseagreen:9419919,darkslateblue:4734347,darkslategray:3100495,darkslategrey:3100495,darkturquoise:52945,darkviolet:9699539,deeppink:16716947,deepskyblue:49151,dimgray:6908265,dimgrey:6908265,dodgerblue:2003199,firebrick:11674146,floralwhite:16775920,forestgreen:2263842,fuchsia:16711935,gainsboro:14474460,ghostwhite:16316671,gold:16766720,goldenrod:14329120,gray:8421504,green:32768,greenyellow:11403055,grey:8421504,honeydew:15794160,hotpink:16738740,indianred:13458524,indigo:4915330,ivory:16777200,khaki:15787660,lavender:15132410,lavenderblush:16773365,lawngreen:8190976,lemonchiffon:16775885,lightblue:11393254,lightcoral:15761536,lightcyan:14745599,lightgoldenrodyellow:16448210,lightgray:13882323,lightgreen:9498256,lightgrey:13882323,lightpink:16758465,lightsalmon:16752762,lightseagreen:2142890,lightskyblue:8900346,lightslategray:7833753,lightslategrey:7833753,lightsteelblue:11584734,lightyellow:16777184,lime:65280,limegreen:3329330,linen:16445670,magenta:16711935,maroon:8388608,mediumaquamarine:6737322,mediumblue:205,mediumorchid:12211667,mediumpurple:9662683,mediumseagreen:3978097,mediumslateblue:8087790,mediumspringgreen:64154,mediumturquoise:4772300,mediumvioletred:13047173,midnightblue:1644912,mintcream:16121850,mistyrose:16770273,moccasin:16770229,navajowhite:16768685,navy:128,oldlace:16643558,olive:8421376,olivedrab:7048739,orange:16753920,orangered:16729344,orchid:14315734,palegoldenrod:15657130,palegreen:10025880,paleturquoise:11529966,palevioletred:14381203,papayawhip:16773077,peachpuff:16767673,peru:13468991,pink:16761035,plum:14524637,powderblue:11591910,purple:8388736,rebeccapurple:6697881,red:16711680,rosybrown:12357519,royalblue:4286945,saddlebrown:9127187,salmon:16416882,sandybrown:16032864,seagreen:3050327,seashell:16774638,sienna:10506797,silver:12632256,skyblue:8900331,slateblue:6970061,slategray:7372944,slategrey:7372944,snow:16775930,springgreen:65407,steelblue:4620980,tan:13808780,teal:32896,thistle:14204888,tomato:16737095,turquoise:4251856,violet:15631086,wheat:16113331,white:16777215,whitesmoke:16119285,yellow:16776960,yellowgreen:10145074},bs={h:0,s:0,l:0},bh={h:0,s:0,l:0};function d_(e,t,n){return n<0&&(n+=1),n>1&&(n-=1),n<1/6?e+(t-e)*6*n:n<1/2?t:n<2/3?e+(t-e)*6*(2/3-n):e}var Wt=class{constructor(t,n,i){return this.isColor=!0,this.r=1,this.g=1,this.b=1,this.set(t,n,i)}set(t,n,i){if(n===void 0&&i===void 0){let r=t;r&&r.isColor?this.copy(r):typeof r=="number"?this.setHex(r):typeof r=="string"&&this.setStyle(r)}else this.setRGB(t,n,i);return this}setScalar(t){return this.r=t,this.g=t,this.b=t,this}setHex(t,n=jn){return t=Math.floor(t),this.r=(t>>16&255)/255,this.g=(t>>8&255)/255,this.b=(t&255)/255,re.colorSpaceToWorking(this,n),this}setRGB(t,n,i,r=re.workingColorSpace){return this.r=t,this.g=n,this.b=i,re.colorSpaceToWorking(this,r),this}setHSL(t,n,i,r=re.workingColorSpace){if(t=ux(t,1),n=Ht(n,0,1),i=Ht(i,0,1),n===0)this.r=this.g=this.b=i;else{let s=i<=.5?i*(1+n):i+n-i*n,o=2*i-s;this.r=d_(o,s,t+1/3),this.g=d_(o,s,t),this.b=d_(o,s,t-1/3)}return re.colorSpaceToWorking(this,r),this}setStyle(t,n=jn){function i(s){s!==void 0&&parseFloat(s)<1&&Ut("Color: Alpha component of "+t+" will be ignored.")}let r;if(r=/^(\w+)\(([^\)]*)\)/.exec(t)){let s,o=r[1],a=r[2];switch(o){case"rgb":case"rgba":if(s=/^\s*(\d+)\s*,\s*(\d+)\s*,\s*(\d+)\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return i(s[4]),this.setRGB(Math.min(255,parseInt(s[1],10))/255,Math.min(255,parseInt(s[2],10))/255,Math.min(255,parseInt(s[3],10))/255,n);if(s=/^\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return i(s[4]),this.setRGB(Math.min(100,parseFloat(s[1]))/100,Math.min(100,parseFloat(s[2]))/100,Math.min(100,parseFloat(s[3]))/100,n);break;case"hsl":case"hsla":if(s=/^\s*([+-]?(?:\d+(?:\.\d+)?|\.\d+))\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return i(s[4]),this.setHSL(parseFloat(s[1])/360,parseFloat(s[2])/100,parseFloat(s[3])/100,n);break;default:Ut("Color: Unknown color model "+t)}}else if(r=/^\#([A-Fa-f\d]+)$/.exec(t)){let s=r[1],o=s.length;if(o===3)return this.setRGB(parseInt(s.charAt(0),16)/15,parseInt(s.charAt(1),16)/15,parseInt(s.charAt(2),16)/15,n);if(o===6)return this.setHex(parseInt(s,16),n);Ut("Color: Invalid hex color "+t)}else if(t&&t.length>0)return this.setColorName(t,n);return this}setColorName(t,n=jn){let i=i2[t.toLowerCase()];return i!==void 0?this.setHex(i,n):Ut("Color: Unknown color "+t),this}clone(){return new this.constructor(this.r,this.g,this.b)}copy(t){return this.r=t.r,this.g=t.g,this.b=t.b,this}copySRGBToLinear(t){return this.r=$r(t.r),this.g=$r(t.g),this.b=$r(t.b),this}copyLinearToSRGB(t){return this.r=qa(t.r),this.g=qa(t.g),this.b=qa(t.b),this}convertSRGBToLinear(){return this.copySRGBToLinear(this),this}convertLinearToSRGB(){return this.copyLinearToSRGB(this),this}getHex(t=jn){return re.workingToColorSpace(Mn.copy(this),t),Math.round(Ht(Mn.r*255,0,255))*65536+Math.round(Ht(Mn.g*255,0,255))*256+Math.round(Ht(Mn.b*255,0,255))}getHexString(t=jn){return("000000"+this.getHex(t).toString(16)).slice(-6)}getHSL(t,n=re.workingColorSpace){re.workingToColorSpace(Mn.copy(this),n);let i=Mn.r,r=Mn.g,s=Mn.b,o=Math.max(i,r,s),a=Math.min(i,r,s),c,l,u=(a+o)/2;if(a===o)c=0,l=0;else{let h=o-a;switch(l=u<=.5?h/(o+a):h/(2-o-a),o){case i:c=(r-s)/h+(r<s?6:0);break;case r:c=(s-i)/h+2;break;case s:c=(i-r)/h+4;break}c/=6}return t.h=c,t.s=l,t.l=u,t}getRGB(t,n=re.workingColorSpace){return re.workingToColorSpace(Mn.copy(this),n),t.r=Mn.r,t.g=Mn.g,t.b=Mn.b,t}getStyle(t=jn){re.workingToColorSpace(Mn.copy(this),t);let n=Mn.r,i=Mn.g,r=Mn.b;return t!==jn?`color(${t} ${n.toFixed(3)} ${i.toFixed(3)} ${r.toFixed(3)})`:`rgb(${Math.round(n*255)},${Math.round(i*255)},${Math.round(r*255)})`}offsetHSL(t,n,i){return this.getHSL(bs),this.setHSL(bs.h+t,bs.s+n,bs.l+i)}add(t){return this.r+=t.r,this.g+=t.g,this.b+=t.b,this}addColors(t,n){return this.r=t.r+n.r,this.g=t.g+n.g,this.b=t.b+n.b,this}addScalar(t){return this.r+=t,this.g+=t,this.b+=t,this}sub(t){return this.r=Math.max(0,this.r-t.r),this.g=Math.max(0,this.g-t.g),this.b=Math.max(0,this.b-t.b),this}multiply(t){return this.r*=t.r,this.g*=t.g,this.b*=t.b,this}multiplyScalar(t){return this.r*=t,this.g*=t,this.b*=t,this}lerp(t,n){return this.r+=(t.r-this.r)*n,this.g+=(t.g-this.g)*n,this.b+=(t.b-this.b)*n,this}lerpColors(t,n,i){return this.r=t.r+(n.r-t.r)*i,this.g=t.g+(n.g-t.g)*i,this.b=t.b+(n.b-t.b)*i,this}lerpHSL(t,n){this.getHSL(bs),t.getHSL(bh);let i=wl(bs.h,bh.h,n),r=wl(bs.s,bh.s,n),s=wl(bs.l,bh.l,n);return this.setHSL(i,r,s),this}setFromVector3(t){return this.r=t.x,this.g=t.y,this.b=t.z,this}applyMatrix3(t){let n=this.r,i=this.g,r=this.b,s=t.elements;return this.r=s[0]*n+s[3]*i+s[6]*r,this.g=s[1]*n+s[4]*i+s[7]*r,this.b=s[2]*n+s[5]*i+s[8]*r,this}equals(t){return t.r===this.r&&t.g===this.g&&t.b===this.b}fromArray(t,n=0){return this.r=t[n],this.g=t[n+1],this.b=t[n+2],this}toArray(t=[],n=0){return t[n]=this.r,t[n+1]=this.g,t[n+2]=this.b,t}fromBufferAttribute(t,n){return this.r=t.getX(n),this.g=t.getY(n),this.b=t.getZ(n),this}toJSON(){return this.getHex()}*[Symbol.iterator](){yield this.r,yield this.g,yield this.b}},Mn=new Wt;Wt.NAMES=i2;var Ll=class extends dn{constructor(){super(),this.isScene=!0,this.type="Scene",this.background=null,this.environment=null,this.fog=null,this.backgroundBlurriness=0,this.backgroundIntensity=1,this.backgroundRotation=new qr,this.environmentIntensity=1,this.environmentRotation=new qr,this.overrideMaterial=null,typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}copy(t,n){return super.copy(t,n),this.background=t.background!==null?t.background.clone():null,this.environment=t.environment!==null?t.environment.clone():null,this.fog=t.fog!==null?t.fog.clone():null,this.backgroundBlurriness=t.backgroundBlurriness,this.backgroundIntensity=t.backgroundIntensity,this.backgroundRotation.copy(t.backgroundRotation),this.environmentIntensity=t.environmentIntensity,this.environmentRotation.copy(t.environmentRotation),this.overrideMaterial=t.overrideMaterial!==null?t.overrideMaterial.clone():null,this.matrixAutoUpdate=t.matrixAutoUpdate,this}toJSON(t){let n=super.toJSON(t);return this.fog!==null&&(n.object.fog=this.fog.toJSON()),n.object.backgroundBlurriness=this.backgroundBlurriness,n.object.backgroundIntensity=this.backgroundIntensity,n.object.backgroundRotation=this.backgroundRotation.toArray(),n.object.environmentIntensity=this.environmentIntensity,n.object.environmentRotation=this.environmentRotation.toArray(),n}},ki=new k,Gr=new k,p_=new k,Vr=new k,Fa=new k,Oa=new k,tE=new k,m_=new k,g_=new k,y_=new k,__=new pe,x_=new pe,v_=new pe,Ts=class e{constructor(t=new k,n=new k,i=new k){this.a=t,this.b=n,this.c=i}static getNormal(t,n,i,r){r.subVectors(i,n),ki.subVectors(t,n),r.cross(ki);let s=r.lengthSq();return s>0?r.multiplyScalar(1/Math.sqrt(s)):r.set(0,0,0)}static getBarycoord(t,n,i,r,s){ki.subVectors(r,n),Gr.subVectors(i,n),p_.subVectors(t,n);let o=ki.dot(ki),a=ki.dot(Gr),c=ki.dot(p_),l=Gr.dot(Gr),u=Gr.dot(p_),h=o*l-a*a;if(h===0)return s.set(0,0,0),null;let f=1/h,d=(l*c-a*u)*f,p=(o*u-a*c)*f;return s.set(1-d-p,p,d)}static containsPoint(t,n,i,r){return this.getBarycoord(t,n,i,r,Vr)===null?!1:Vr.x>=0&&Vr.y>=0&&Vr.x+Vr.y<=1}static getInterpolation(t,n,i,r,s,o,a,c){return this.getBarycoord(t,n,i,r,Vr)===null?(c.x=0,c.y=0,"z"in c&&(c.z=0),"w"in c&&(c.w=0),null):(c.setScalar(0),c.addScaledVector(s,Vr.x),c.addScaledVector(o,Vr.y),c.addScaledVector(a,Vr.z),c)}static getInterpolatedAttribute(t,n,i,r,s,o){return __.setScalar(0),x_.setScalar(0),v_.setScalar(0),__.fromBufferAttribute(t,n),x_.fromBufferAttribute(t,i),v_.fromBufferAttribute(t,r),o.setScalar(0),o.addScaledVector(__,s.x),o.addScaledVector(x_,s.y),o.addScaledVector(v_,s.z),o}static isFrontFacing(t,n,i,r){return ki.subVectors(i,n),Gr.subVectors(t,n),ki.cross(Gr).dot(r)<0}set(t,n,i){return this.a.copy(t),this.b.copy(n),this.c.copy(i),this}setFromPointsAndIndices(t,n,i,r){return this.a.copy(t[n]),this.b.copy(t[i]),this.c.copy(t[r]),this}setFromAttributeAndIndices(t,n,i,r){return this.a.fromBufferAttribute(t,n),this.b.fromBufferAttribute(t,i),this.c.fromBufferAttribute(t,r),this}clone(){return new this.constructor().copy(this)}copy(t){return this.a.copy(t.a),this.b.copy(t.b),this.c.copy(t.c),this}getArea(){return ki.subVectors(this.c,this.b),Gr.subVectors(this.a,this.b),ki.cross(Gr).length()*.5}getMidpoint(t){return t.addVectors(this.a,this.b).add(this.c).multiplyScalar(1/3)}getNormal(t){return e.getNormal(this.a,this.b,this.c,t)}getPlane(t){return t.setFromCoplanarPoints(this.a,this.b,this.c)}getBarycoord(t,n){return e.getBarycoord(t,this.a,this.b,this.c,n)}getInterpolation(t,n,i,r,s){return e.getInterpolation(t,this.a,this.b,this.c,n,i,r,s)}containsPoint(t){return e.containsPoint(t,this.a,this.b,this.c)}isFrontFacing(t){return e.isFrontFacing(this.a,this.b,this.c,t)}intersectsBox(t){return t.intersectsTriangle(this)}closestPointToPoint(t,n){let i=this.a,r=this.b,s=this.c,o,a;Fa.subVectors(r,i),Oa.subVectors(s,i),m_.subVectors(t,i);let c=Fa.dot(m_),l=Oa.dot(m_);if(c<=0&&l<=0)return n.copy(i);g_.subVectors(t,r);let u=Fa.dot(g_),h=Oa.dot(g_);if(u>=0&&h<=u)return n.copy(r);let f=c*h-u*l;if(f<=0&&c>=0&&u<=0&&c-u>0)return o=c/(c-u),n.copy(i).addScaledVector(Fa,o);y_.subVectors(t,s);let d=Fa.dot(y_),p=Oa.dot(y_);if(p>=0&&d<=p)return n.copy(s);let y=d*l-c*p;if(y<=0&&l>=0&&p<=0)return a=l/(l-p),n.copy(i).addScaledVector(Oa,a);let m=u*p-d*h;if(m<=0&&h-u>=0&&d-p>=0)return tE.subVectors(s,r),a=(h-u)/(h-u+(d-p)),n.copy(r).addScaledVector(tE,a);let g=1/(m+y+f);return o=y*g,a=f*g,n.copy(i).addScaledVector(Fa,o).addScaledVector(Oa,a)}equals(t){return t.a.equals(this.a)&&t.b.equals(this.b)&&t.c.equals(this.c)}},cn=class{constructor(t=new k(1/0,1/0,1/0),n=new k(-1/0,-1/0,-1/0)){this.isBox3=!0,this.min=t,this.max=n}set(t,n){return this.min.copy(t),this.max.copy(n),this}setFromArray(t){this.makeEmpty();for(let n=0,i=t.length;n<i;n+=3)this.expandByPoint(zi.fromArray(t,n));return this}setFromBufferAttribute(t){this.makeEmpty();for(let n=0,i=t.count;n<i;n++)this.expandByPoint(zi.fromBufferAttribute(t,n));return this}setFromPoints(t){this.makeEmpty();for(let n=0,i=t.length;n<i;n++)this.expandByPoint(t[n]);return this}setFromCenterAndSize(t,n){let i=zi.copy(n).multiplyScalar(.5);return this.min.copy(t).sub(i),this.max.copy(t).add(i),this}setFromObject(t,n=!1){return this.makeEmpty(),this.expandByObject(t,n)}clone(){return new this.constructor().copy(this)}copy(t){return this.min.copy(t.min),this.max.copy(t.max),this}makeEmpty(){return this.min.x=this.min.y=this.min.z=1/0,this.max.x=this.max.y=this.max.z=-1/0,this}isEmpty(){return this.max.x<this.min.x||this.max.y<this.min.y||this.max.z<this.min.z}getCenter(t){return this.isEmpty()?t.set(0,0,0):t.addVectors(this.min,this.max).multiplyScalar(.5)}getSize(t){return this.isEmpty()?t.set(0,0,0):t.subVectors(this.max,this.min)}expandByPoint(t){return this.min.min(t),this.max.max(t),this}expandByVector(t){return this.min.sub(t),this.max.add(t),this}expandByScalar(t){return this.min.addScalar(-t),this.max.addScalar(t),this}expandByObject(t,n=!1){t.updateWorldMatrix(!1,!1);let i=t.geometry;if(i!==void 0){let s=i.getAttribute("position");if(n===!0&&s!==void 0&&t.isInstancedMesh!==!0&&t.isBatchedMesh!==!0)for(let o=0,a=s.count;o<a;o++)t.isMesh===!0?t.getVertexPosition(o,zi):zi.fromBufferAttribute(s,o),zi.applyMatrix4(t.matrixWorld),this.expandByPoint(zi);else t.boundingBox!==void 0?(t.boundingBox===null&&t.computeBoundingBox(),Mh.copy(t.boundingBox)):(i.boundingBox===null&&i.computeBoundingBox(),Mh.copy(i.boundingBox)),Mh.applyMatrix4(t.matrixWorld),this.union(Mh)}let r=t.children;for(let s=0,o=r.length;s<o;s++)this.expandByObject(r[s],n);return this}containsPoint(t){return t.x>=this.min.x&&t.x<=this.max.x&&t.y>=this.min.y&&t.y<=this.max.y&&t.z>=this.min.z&&t.z<=this.max.z}containsBox(t){return this.min.x<=t.min.x&&t.max.x<=this.max.x&&this.min.y<=t.min.y&&t.max.y<=this.max.y&&this.min.z<=t.min.z&&t.max.z<=this.max.z}getParameter(t,n){return n.set((t.x-this.min.x)/(this.max.x-this.min.x),(t.y-this.min.y)/(this.max.y-this.min.y),(t.z-this.min.z)/(this.max.z-this.min.z))}intersectsBox(t){return t.max.x>=this.min.x&&t.min.x<=this.max.x&&t.max.y>=this.min.y&&t.min.y<=this.max.y&&t.max.z>=this.min.z&&t.min.z<=this.max.z}intersectsSphere(t){return this.clampPoint(t.center,zi),zi.distanceToSquared(t.center)<=t.radius*t.radius}intersectsPlane(t){let n,i;return t.normal.x>0?(n=t.normal.x*this.min.x,i=t.normal.x*this.max.x):(n=t.normal.x*this.max.x,i=t.normal.x*this.min.x),t.normal.y>0?(n+=t.normal.y*this.min.y,i+=t.normal.y*this.max.y):(n+=t.normal.y*this.max.y,i+=t.normal.y*this.min.y),t.normal.z>0?(n+=t.normal.z*this.min.z,i+=t.normal.z*this.max.z):(n+=t.normal.z*this.max.z,i+=t.normal.z*this.min.z),n<=-t.constant&&i>=-t.constant}intersectsTriangle(t){if(this.isEmpty())return!1;this.getCenter(_l),Sh.subVectors(this.max,_l),Ba.subVectors(t.a,_l),ka.subVectors(t.b,_l),za.subVectors(t.c,_l),Ms.subVectors(ka,Ba),Ss.subVectors(za,ka),So.subVectors(Ba,za);let n=[0,-Ms.z,Ms.y,0,-Ss.z,Ss.y,0,-So.z,So.y,Ms.z,0,-Ms.x,Ss.z,0,-Ss.x,So.z,0,-So.x,-Ms.y,Ms.x,0,-Ss.y,Ss.x,0,-So.y,So.x,0];return!b_(n,Ba,ka,za,Sh)||(n=[1,0,0,0,1,0,0,0,1],!b_(n,Ba,ka,za,Sh))?!1:(wh.crossVectors(Ms,Ss),n=[wh.x,wh.y,wh.z],b_(n,Ba,ka,za,Sh))}clampPoint(t,n){return n.copy(t).clamp(this.min,this.max)}distanceToPoint(t){return this.clampPoint(t,zi).distanceTo(t)}getBoundingSphere(t){return this.isEmpty()?t.makeEmpty():(this.getCenter(t.center),t.radius=this.getSize(zi).length()*.5),t}intersect(t){return this.min.max(t.min),this.max.min(t.max),this.isEmpty()&&this.makeEmpty(),this}union(t){return this.min.min(t.min),this.max.max(t.max),this}applyMatrix4(t){return this.isEmpty()?this:(Hr[0].set(this.min.x,this.min.y,this.min.z).applyMatrix4(t),Hr[1].set(this.min.x,this.min.y,this.max.z).applyMatrix4(t),Hr[2].set(this.min.x,this.max.y,this.min.z).applyMatrix4(t),Hr[3].set(this.min.x,this.max.y,this.max.z).applyMatrix4(t),Hr[4].set(this.max.x,this.min.y,this.min.z).applyMatrix4(t),Hr[5].set(this.max.x,this.min.y,this.max.z).applyMatrix4(t),Hr[6].set(this.max.x,this.max.y,this.min.z).applyMatrix4(t),Hr[7].set(this.max.x,this.max.y,this.max.z).applyMatrix4(t),this.setFromPoints(Hr),this)}translate(t){return this.min.add(t),this.max.add(t),this}equals(t){return t.min.equals(this.min)&&t.max.equals(this.max)}toJSON(){return{min:this.min.toArray(),max:this.max.toArray()}}fromJSON(t){return this.min.fromArray(t.min),this.max.fromArray(t.max),this}},Hr=[new k,new k,new k,new k,new k,new k,new k,new k],zi=new k,Mh=new cn,Ba=new k,ka=new k,za=new k,Ms=new k,Ss=new k,So=new k,_l=new k,Sh=new k,wh=new k,wo=new k;function b_(e,t,n,i,r){for(let s=0,o=e.length-3;s<=o;s+=3){wo.fromArray(e,s);let a=r.x*Math.abs(wo.x)+r.y*Math.abs(wo.y)+r.z*Math.abs(wo.z),c=t.dot(wo),l=n.dot(wo),u=i.dot(wo);if(Math.max(-Math.max(c,l,u),Math.min(c,l,u))>a)return!1}return!0}var ke=new k,Th=new Ft,VU=0,ze=class extends Gi{constructor(t,n,i=!1){if(super(),Array.isArray(t))throw new TypeError("THREE.BufferAttribute: array should be a Typed Array.");this.isBufferAttribute=!0,Object.defineProperty(this,"id",{value:VU++}),this.name="",this.array=t,this.itemSize=n,this.count=t!==void 0?t.length/n:0,this.normalized=i,this.usage=cx,this.updateRanges=[],this.gpuType=Wi,this.version=0,this._normalizationScale=t!==void 0?dp(t):void 0}onUploadCallback(){}set needsUpdate(t){t===!0&&this.version++}setUsage(t){return this.usage=t,this}addUpdateRange(t,n){this.updateRanges.push({start:t,count:n})}clearUpdateRanges(){this.updateRanges.length=0}copy(t){return this.name=t.name,this.array=new t.array.constructor(t.array),this.itemSize=t.itemSize,this.count=t.count,this.normalized=t.normalized,this.usage=t.usage,this.gpuType=t.gpuType,this._normalizationScale=t._normalizationScale,this}copyAt(t,n,i){t*=this.itemSize,i*=n.itemSize;for(let r=0,s=this.itemSize;r<s;r++)this.array[t+r]=n.array[i+r];return this}copyArray(t){return this.array.set(t),this}applyMatrix3(t){if(this.itemSize===2)for(let n=0,i=this.count;n<i;n++)Th.fromBufferAttribute(this,n),Th.applyMatrix3(t),this.setXY(n,Th.x,Th.y);else if(this.itemSize===3)for(let n=0,i=this.count;n<i;n++)ke.fromBufferAttribute(this,n),ke.applyMatrix3(t),this.setXYZ(n,ke.x,ke.y,ke.z);return this}applyMatrix4(t){for(let n=0,i=this.count;n<i;n++)ke.fromBufferAttribute(this,n),ke.applyMatrix4(t),this.setXYZ(n,ke.x,ke.y,ke.z);return this}applyNormalMatrix(t){for(let n=0,i=this.count;n<i;n++)ke.fromBufferAttribute(this,n),ke.applyNormalMatrix(t),this.setXYZ(n,ke.x,ke.y,ke.z);return this}transformDirection(t){for(let n=0,i=this.count;n<i;n++)ke.fromBufferAttribute(this,n),ke.transformDirection(t),this.setXYZ(n,ke.x,ke.y,ke.z);return this}set(t,n=0){return this.array.set(t,n),this}getComponent(t,n){let i=this.array[t*this.itemSize+n];return this.normalized&&(i=this._denormalize(i)),i}setComponent(t,n,i){return this.normalized&&(i=this._normalize(i)),this.array[t*this.itemSize+n]=i,this}getX(t){let n=this.array[t*this.itemSize];return this.normalized&&(n=this._denormalize(n)),n}setX(t,n){return this.normalized&&(n=this._normalize(n)),this.array[t*this.itemSize]=n,this}getY(t){let n=this.array[t*this.itemSize+1];return this.normalized&&(n=this._denormalize(n)),n}setY(t,n){return this.normalized&&(n=this._normalize(n)),this.array[t*this.itemSize+1]=n,this}getZ(t){let n=this.array[t*this.itemSize+2];return this.normalized&&(n=this._denormalize(n)),n}setZ(t,n){return this.normalized&&(n=this._normalize(n)),this.array[t*this.itemSize+2]=n,this}getW(t){let n=this.array[t*this.itemSize+3];return this.normalized&&(n=this._denormalize(n)),n}setW(t,n){return this.normalized&&(n=this._normalize(n)),this.array[t*this.itemSize+3]=n,this}setXY(t,n,i){return t*=this.itemSize,this.normalized&&(n=this._normalize(n),i=this._normalize(i)),this.array[t+0]=n,this.array[t+1]=i,this}setXYZ(t,n,i,r){return t*=this.itemSize,this.normalized&&(n=this._normalize(n),i=this._normalize(i),r=this._normalize(r)),this.array[t+0]=n,this.array[t+1]=i,this.array[t+2]=r,this}setXYZW(t,n,i,r,s){return t*=this.itemSize,this.normalized&&(n=this._normalize(n),i=this._normalize(i),r=this._normalize(r),s=this._normalize(s)),this.array[t+0]=n,this.array[t+1]=i,this.array[t+2]=r,this.array[t+3]=s,this}onUpload(t){return this.onUploadCallback=t,this}clone(){return new this.constructor(this.array,this.itemSize).copy(this)}toJSON(){let t={itemSize:this.itemSize,type:this.array.constructor.name,array:Array.from(this.array),normalized:this.normalized};return t.name=this.name,t.usage=this.usage,t.gpuType=this.gpuType,t}dispose(){this.dispatchEvent({type:"dispose"})}_denormalize(t){let n=this._normalizationScale;return n!==void 0?Math.max(t/n,-1):hx(t,this.array)}_normalize(t){let n=this._normalizationScale;return n!==void 0?Math.round(t*n):dx(t,this.array)}};var Nl=class extends ze{constructor(t,n,i){super(new Uint16Array(t),n,i)}};var Dl=class extends ze{constructor(t,n,i){super(new Uint32Array(t),n,i)}};var ge=class extends ze{constructor(t,n,i){super(new Float32Array(t),n,i)}},HU=new cn,xl=new k,M_=new k,Ei=class{constructor(t=new k,n=-1){this.isSphere=!0,this.center=t,this.radius=n}set(t,n){return this.center.copy(t),this.radius=n,this}setFromPoints(t,n){let i=this.center;n!==void 0?i.copy(n):HU.setFromPoints(t).getCenter(i);let r=0;for(let s=0,o=t.length;s<o;s++)r=Math.max(r,i.distanceToSquared(t[s]));return this.radius=Math.sqrt(r),this}copy(t){return this.center.copy(t.center),this.radius=t.radius,this}isEmpty(){return this.radius<0}makeEmpty(){return this.center.set(0,0,0),this.radius=-1,this}containsPoint(t){return t.distanceToSquared(this.center)<=this.radius*this.radius}distanceToPoint(t){return t.distanceTo(this.center)-this.radius}intersectsSphere(t){let n=this.radius+t.radius;return t.center.distanceToSquared(this.center)<=n*n}intersectsBox(t){return t.intersectsSphere(this)}intersectsPlane(t){return Math.abs(t.distanceToPoint(this.center))<=this.radius}clampPoint(t,n){let i=this.center.distanceToSquared(t);return n.copy(t),i>this.radius*this.radius&&(n.sub(this.center).normalize(),n.multiplyScalar(this.radius).add(this.center)),n}getBoundingBox(t){return this.isEmpty()?(t.makeEmpty(),t):(t.set(this.center,this.center),t.expandByScalar(this.radius),t)}applyMatrix4(t){return this.center.applyMatrix4(t),this.radius=this.radius*t.getMaxScaleOnAxis(),this}translate(t){return this.center.add(t),this}expandByPoint(t){if(this.isEmpty())return this.center.copy(t),this.radius=0,this;xl.subVectors(t,this.center);let n=xl.lengthSq();if(n>this.radius*this.radius){let i=Math.sqrt(n),r=(i-this.radius)*.5;this.center.addScaledVector(xl,r/i),this.radius+=r}return this}union(t){return t.isEmpty()?this:this.isEmpty()?(this.copy(t),this):(this.center.equals(t.center)===!0?this.radius=Math.max(this.radius,t.radius):(M_.subVectors(t.center,this.center).setLength(t.radius),this.expandByPoint(xl.copy(t.center).add(M_)),this.expandByPoint(xl.copy(t.center).sub(M_))),this)}equals(t){return t.center.equals(this.center)&&t.radius===this.radius}clone(){return new this.constructor().copy(this)}toJSON(){return{radius:this.radius,center:this.center.toArray()}}fromJSON(t){return this.radius=t.radius,this.center.fromArray(t.center),this}},WU=0,Ti=new ee,S_=new dn,Ga=new k,Kn=new cn,vl=new cn,on=new k,De=class e extends Gi{constructor(){super(),this.isBufferGeometry=!0,Object.defineProperty(this,"id",{value:WU++}),this.uuid=zs(),this.name="",this.type="BufferGeometry",this.index=null,this.indirect=null,this.indirectOffset=0,this.attributes={},this.morphAttributes={},this.morphTargetsRelative=!1,this.groups=[],this.boundingBox=null,this.boundingSphere=null,this.drawRange={start:0,count:1/0},this.userData={},this._transformed=!1}getIndex(){return this.index}setIndex(t){return Array.isArray(t)?this.index=new(mU(t)?Dl:Nl)(t,1):this.index=t,this}setIndirect(t,n=0){return this.indirect=t,this.indirectOffset=n,this}getIndirect(){return this.indirect}getAttribute(t){return this.attributes[t]}setAttribute(t,n){return this.attributes[t]=n,this}deleteAttribute(t){return delete this.attributes[t],this}hasAttribute(t){return this.attributes[t]!==void 0}addGroup(t,n,i=0){this.groups.push({start:t,count:n,materialIndex:i})}clearGroups(){this.groups=[]}setDrawRange(t,n){this.drawRange.start=t,this.drawRange.count=n}applyMatrix4(t){let n=this.attributes.position;n!==void 0&&(n.applyMatrix4(t),n.needsUpdate=!0);let i=this.attributes.normal;if(i!==void 0){let s=new zt().getNormalMatrix(t);i.applyNormalMatrix(s),i.needsUpdate=!0}let r=this.attributes.tangent;return r!==void 0&&(r.transformDirection(t),r.needsUpdate=!0),this.boundingBox!==null&&this.computeBoundingBox(),this.boundingSphere!==null&&this.computeBoundingSphere(),this._transformed=!0,this}applyQuaternion(t){return Ti.makeRotationFromQuaternion(t),this.applyMatrix4(Ti),this}rotateX(t){return Ti.makeRotationX(t),this.applyMatrix4(Ti),this}rotateY(t){return Ti.makeRotationY(t),this.applyMatrix4(Ti),this}rotateZ(t){return Ti.makeRotationZ(t),this.applyMatrix4(Ti),this}translate(t,n,i){return Ti.makeTranslation(t,n,i),this.applyMatrix4(Ti),this}scale(t,n,i){return Ti.makeScale(t,n,i),this.applyMatrix4(Ti),this}lookAt(t){return S_.lookAt(t),S_.updateMatrix(),this.applyMatrix4(S_.matrix),this}center(){return this.computeBoundingBox(),this.boundingBox.getCenter(Ga).negate(),this.translate(Ga.x,Ga.y,Ga.z),this}setFromPoints(t){let n=this.getAttribute("position");if(n===void 0){let i=[];for(let r=0,s=t.length;r<s;r++){let o=t[r];i.push(o.x,o.y,o.z||0)}this.setAttribute("position",new ge(i,3))}else{let i=Math.min(t.length,n.count);for(let r=0;r<i;r++){let s=t[r];n.setXYZ(r,s.x,s.y,s.z||0)}t.length>n.count&&Ut("BufferGeometry: Buffer size too small for points data. Use .dispose() and create a new geometry."),n.needsUpdate=!0}return this}computeBoundingBox(){this.boundingBox===null&&(this.boundingBox=new cn);let t=this.attributes.position,n=this.morphAttributes.position;if(t&&t.isGLBufferAttribute){kt("BufferGeometry.computeBoundingBox(): GLBufferAttribute requires a manual bounding box.",this),this.boundingBox.set(new k(-1/0,-1/0,-1/0),new k(1/0,1/0,1/0));return}if(t!==void 0){if(this.boundingBox.setFromBufferAttribute(t),n)for(let i=0,r=n.length;i<r;i++){let s=n[i];Kn.setFromBufferAttribute(s),this.morphTargetsRelative?(on.addVectors(this.boundingBox.min,Kn.min),this.boundingBox.expandByPoint(on),on.addVectors(this.boundingBox.max,Kn.max),this.boundingBox.expandByPoint(on)):(this.boundingBox.expandByPoint(Kn.min),this.boundingBox.expandByPoint(Kn.max))}}else this.boundingBox.makeEmpty();(isNaN(this.boundingBox.min.x)||isNaN(this.boundingBox.min.y)||isNaN(this.boundingBox.min.z))&&kt('BufferGeometry.computeBoundingBox(): Computed min/max have NaN values. The "position" attribute is likely to have NaN values.',this)}computeBoundingSphere(){this.boundingSphere===null&&(this.boundingSphere=new Ei);let t=this.attributes.position,n=this.morphAttributes.position;if(t&&t.isGLBufferAttribute){kt("BufferGeometry.computeBoundingSphere(): GLBufferAttribute requires a manual bounding sphere.",this),this.boundingSphere.set(new k,1/0);return}if(t){let i=this.boundingSphere.center;if(Kn.setFromBufferAttribute(t),n)for(let s=0,o=n.length;s<o;s++){let a=n[s];vl.setFromBufferAttribute(a),this.morphTargetsRelative?(on.addVectors(Kn.min,vl.min),Kn.expandByPoint(on),on.addVectors(Kn.max,vl.max),Kn.expandByPoint(on)):(Kn.expandByPoint(vl.min),Kn.expandByPoint(vl.max))}Kn.getCenter(i);let r=0;for(let s=0,o=t.count;s<o;s++)on.fromBufferAttribute(t,s),r=Math.max(r,i.distanceToSquared(on));if(n)for(let s=0,o=n.length;s<o;s++){let a=n[s],c=this.morphTargetsRelative;for(let l=0,u=a.count;l<u;l++)on.fromBufferAttribute(a,l),c&&(Ga.fromBufferAttribute(t,l),on.add(Ga)),r=Math.max(r,i.distanceToSquared(on))}this.boundingSphere.radius=Math.sqrt(r),isNaN(this.boundingSphere.radius)&&kt('BufferGeometry.computeBoundingSphere(): Computed radius is NaN. The "position" attribute is likely to have NaN values.',this)}}computeTangents(){let t=this.index,n=this.attributes;if(t===null||n.position===void 0||n.normal===void 0||n.uv===void 0){kt("BufferGeometry: .computeTangents() failed. Missing required attributes (index, position, normal or uv)");return}let i=n.position,r=n.normal,s=n.uv,o=this.getAttribute("tangent");(o===void 0||o.count!==i.count)&&(o=new ze(new Float32Array(4*i.count),4),this.setAttribute("tangent",o));let a=[],c=[],l=new Uint8Array(i.count);for(let C=0;C<i.count;C++)a[C]=new k,c[C]=new k;let u=new k,h=new k,f=new k,d=new Ft,p=new Ft,y=new Ft,m=new k,g=new k;function x(C,E,I){l[C]=l[E]=l[I]=1,u.fromBufferAttribute(i,C),h.fromBufferAttribute(i,E),f.fromBufferAttribute(i,I),d.fromBufferAttribute(s,C),p.fromBufferAttribute(s,E),y.fromBufferAttribute(s,I),h.sub(u),f.sub(u),p.sub(d),y.sub(d);let R=1/(p.x*y.y-y.x*p.y);isFinite(R)&&(m.copy(h).multiplyScalar(y.y).addScaledVector(f,-p.y).multiplyScalar(R),g.copy(f).multiplyScalar(p.x).addScaledVector(h,-y.x).multiplyScalar(R),a[C].add(m),a[E].add(m),a[I].add(m),c[C].add(g),c[E].add(g),c[I].add(g))}let S=this.groups;S.length===0&&(S=[{start:0,count:t.count}]);for(let C=0,E=S.length;C<E;++C){let I=S[C],R=I.start,U=I.count;for(let P=R,L=R+U;P<L;P+=3)x(t.getX(P+0),t.getX(P+1),t.getX(P+2))}let v=new k,w=new k,b=new k,_=new k;function M(C){b.fromBufferAttribute(r,C),_.copy(b);let E=a[C];v.copy(E),v.sub(b.multiplyScalar(b.dot(E))).normalize(),w.crossVectors(_,E);let R=w.dot(c[C])<0?-1:1;o.setXYZW(C,v.x,v.y,v.z,R)}for(let C=0,E=i.count;C<E;++C)l[C]&&M(C);this._transformed=!0}computeVertexNormals(){let t=this.index,n=this.getAttribute("position");if(n!==void 0){let i=this.getAttribute("normal");if(i===void 0||i.count!==n.count)i=new ze(new Float32Array(n.count*3),3),this.setAttribute("normal",i);else for(let f=0,d=i.count;f<d;f++)i.setXYZ(f,0,0,0);let r=new k,s=new k,o=new k,a=new k,c=new k,l=new k,u=new k,h=new k;if(t)for(let f=0,d=t.count;f<d;f+=3){let p=t.getX(f+0),y=t.getX(f+1),m=t.getX(f+2);r.fromBufferAttribute(n,p),s.fromBufferAttribute(n,y),o.fromBufferAttribute(n,m),u.subVectors(o,s),h.subVectors(r,s),u.cross(h),a.fromBufferAttribute(i,p),c.fromBufferAttribute(i,y),l.fromBufferAttribute(i,m),a.add(u),c.add(u),l.add(u),i.setXYZ(p,a.x,a.y,a.z),i.setXYZ(y,c.x,c.y,c.z),i.setXYZ(m,l.x,l.y,l.z)}else for(let f=0,d=n.count;f<d;f+=3)r.fromBufferAttribute(n,f+0),s.fromBufferAttribute(n,f+1),o.fromBufferAttribute(n,f+2),u.subVectors(o,s),h.subVectors(r,s),u.cross(h),i.setXYZ(f+0,u.x,u.y,u.z),i.setXYZ(f+1,u.x,u.y,u.z),i.setXYZ(f+2,u.x,u.y,u.z);this.normalizeNormals(),i.needsUpdate=!0}}normalizeNormals(){let t=this.attributes.normal;for(let n=0,i=t.count;n<i;n++)on.fromBufferAttribute(t,n),on.normalize(),t.setXYZ(n,on.x,on.y,on.z)}toNonIndexed(){function t(a,c){let l=a.array,u=a.itemSize,h=a.normalized,f=new l.constructor(c.length*u),d=0,p=0;for(let y=0,m=c.length;y<m;y++){a.isInterleavedBufferAttribute?d=c[y]*a.data.stride+a.offset:d=c[y]*u;for(let g=0;g<u;g++)f[p++]=l[d++]}return new ze(f,u,h)}if(this.index===null)return Ut("BufferGeometry.toNonIndexed(): BufferGeometry is already non-indexed."),this;let n=new e,i=this.index.array,r=this.attributes;for(let a in r){let c=r[a],l=t(c,i);n.setAttribute(a,l)}let s=this.morphAttributes;for(let a in s){let c=[],l=s[a];for(let u=0,h=l.length;u<h;u++){let f=l[u],d=t(f,i);c.push(d)}n.morphAttributes[a]=c}n.morphTargetsRelative=this.morphTargetsRelative;let o=this.groups;for(let a=0,c=o.length;a<c;a++){let l=o[a];n.addGroup(l.start,l.count,l.materialIndex)}return n}toJSON(){let t={metadata:{version:4.7,type:"BufferGeometry",generator:"BufferGeometry.toJSON"}};if(t.uuid=this.uuid,t.type=this.parameters!==void 0&&this._transformed===!0?"BufferGeometry":this.type,t.name=this.name,Object.keys(this.userData).length>0&&(t.userData=this.userData),this.parameters!==void 0&&this._transformed!==!0){let c=this.parameters;for(let l in c)c[l]!==void 0&&(t[l]=c[l]);return t}t.data={attributes:{}};let n=this.index;n!==null&&(t.data.index={type:n.array.constructor.name,array:Array.prototype.slice.call(n.array)});let i=this.attributes;for(let c in i){let l=i[c];t.data.attributes[c]=l.toJSON(t.data)}let r={},s=!1;for(let c in this.morphAttributes){let l=this.morphAttributes[c],u=[];for(let h=0,f=l.length;h<f;h++){let d=l[h];u.push(d.toJSON(t.data))}u.length>0&&(r[c]=u,s=!0)}s&&(t.data.morphAttributes=r,t.data.morphTargetsRelative=this.morphTargetsRelative);let o=this.groups;o.length>0&&(t.data.groups=JSON.parse(JSON.stringify(o)));let a=this.boundingSphere;return a!==null&&(t.data.boundingSphere=a.toJSON()),t}clone(){return new this.constructor().copy(this)}copy(t){this.index=null,this.attributes={},this.morphAttributes={},this.groups=[],this.boundingBox=null,this.boundingSphere=null;let n={};this.name=t.name;let i=t.index;i!==null&&this.setIndex(i.clone());let r=t.attributes;for(let l in r){let u=r[l];this.setAttribute(l,u.clone(n))}let s=t.morphAttributes;for(let l in s){let u=[],h=s[l];for(let f=0,d=h.length;f<d;f++)u.push(h[f].clone(n));this.morphAttributes[l]=u}this.morphTargetsRelative=t.morphTargetsRelative;let o=t.groups;for(let l=0,u=o.length;l<u;l++){let h=o[l];this.addGroup(h.start,h.count,h.materialIndex)}let a=t.boundingBox;a!==null&&(this.boundingBox=a.clone());let c=t.boundingSphere;return c!==null&&(this.boundingSphere=c.clone()),this.drawRange.start=t.drawRange.start,this.drawRange.count=t.drawRange.count,this.userData=t.userData,this._transformed=t._transformed,this}dispose(){this.dispatchEvent({type:"dispose"})}},sd=class{constructor(t,n){this.isInterleavedBuffer=!0,this.array=t,this.stride=n,this.count=t!==void 0?t.length/n:0,this.usage=cx,this.updateRanges=[],this.version=0,this.uuid=zs()}onUploadCallback(){}set needsUpdate(t){t===!0&&this.version++}setUsage(t){return this.usage=t,this}addUpdateRange(t,n){this.updateRanges.push({start:t,count:n})}clearUpdateRanges(){this.updateRanges.length=0}copy(t){return this.array=new t.array.constructor(t.array),this.count=t.count,this.stride=t.stride,this.usage=t.usage,this}copyAt(t,n,i){t*=this.stride,i*=n.stride;for(let r=0,s=this.stride;r<s;r++)this.array[t+r]=n.array[i+r];return this}set(t,n=0){return this.array.set(t,n),this}clone(t){t.arrayBuffers===void 0&&(t.arrayBuffers={});let n=eE(this.array);t.arrayBuffers[n]===void 0&&(t.arrayBuffers[n]=this.array.slice(0).buffer);let i=new this.array.constructor(t.arrayBuffers[n]),r=new this.constructor(i,this.stride);return r.setUsage(this.usage),r}onUpload(t){return this.onUploadCallback=t,this}toJSON(t){t.arrayBuffers===void 0&&(t.arrayBuffers={});let n=eE(this.array);t.arrayBuffers[n]===void 0&&(t.arrayBuffers[n]=Array.from(new Uint32Array(this.array.slice(0).buffer)));let i={uuid:this.uuid,buffer:n,type:this.array.constructor.name,stride:this.stride};return i.usage=this.usage,i}};function eE(e){return e.buffer._uuid===void 0&&(e.buffer._uuid=zs()),e.byteOffset===0&&e.byteLength===e.buffer.byteLength?e.buffer._uuid:e.buffer._uuid+":"+e.byteOffset+":"+e.byteLength}var In=new k,Vi=class e{constructor(t,n,i,r=!1){this.isInterleavedBufferAttribute=!0,this.name="",this.data=t,this.itemSize=n,this.offset=i,this.normalized=r,this._normalizationScale=t!==void 0?dp(t.array):void 0}get count(){return this.data.count}get array(){return this.data.array}set needsUpdate(t){this.data.needsUpdate=t}applyMatrix4(t){for(let n=0,i=this.data.count;n<i;n++)In.fromBufferAttribute(this,n),In.applyMatrix4(t),this.setXYZ(n,In.x,In.y,In.z);return this}applyNormalMatrix(t){for(let n=0,i=this.count;n<i;n++)In.fromBufferAttribute(this,n),In.applyNormalMatrix(t),this.setXYZ(n,In.x,In.y,In.z);return this}transformDirection(t){for(let n=0,i=this.count;n<i;n++)In.fromBufferAttribute(this,n),In.transformDirection(t),this.setXYZ(n,In.x,In.y,In.z);return this}getComponent(t,n){let i=this.array[t*this.data.stride+this.offset+n];return this.normalized&&(i=this._denormalize(i)),i}setComponent(t,n,i){return this.normalized&&(i=this._normalize(i)),this.data.array[t*this.data.stride+this.offset+n]=i,this}setX(t,n){return this.normalized&&(n=this._normalize(n)),this.data.array[t*this.data.stride+this.offset]=n,this}setY(t,n){return this.normalized&&(n=this._normalize(n)),this.data.array[t*this.data.stride+this.offset+1]=n,this}setZ(t,n){return this.normalized&&(n=this._normalize(n)),this.data.array[t*this.data.stride+this.offset+2]=n,this}setW(t,n){return this.normalized&&(n=this._normalize(n)),this.data.array[t*this.data.stride+this.offset+3]=n,this}getX(t){let n=this.data.array[t*this.data.stride+this.offset];return this.normalized&&(n=this._denormalize(n)),n}getY(t){let n=this.data.array[t*this.data.stride+this.offset+1];return this.normalized&&(n=this._denormalize(n)),n}getZ(t){let n=this.data.array[t*this.data.stride+this.offset+2];return this.normalized&&(n=this._denormalize(n)),n}getW(t){let n=this.data.array[t*this.data.stride+this.offset+3];return this.normalized&&(n=this._denormalize(n)),n}setXY(t,n,i){return t=t*this.data.stride+this.offset,this.normalized&&(n=this._normalize(n),i=this._normalize(i)),this.data.array[t+0]=n,this.data.array[t+1]=i,this}setXYZ(t,n,i,r){return t=t*this.data.stride+this.offset,this.normalized&&(n=this._normalize(n),i=this._normalize(i),r=this._normalize(r)),this.data.array[t+0]=n,this.data.array[t+1]=i,this.data.array[t+2]=r,this}setXYZW(t,n,i,r,s){return t=t*this.data.stride+this.offset,this.normalized&&(n=this._normalize(n),i=this._normalize(i),r=this._normalize(r),s=this._normalize(s)),this.data.array[t+0]=n,this.data.array[t+1]=i,this.data.array[t+2]=r,this.data.array[t+3]=s,this}clone(t){if(t===void 0){Rl("InterleavedBufferAttribute.clone(): Cloning an interleaved buffer attribute will de-interleave buffer data.");let n=[];for(let i=0;i<this.count;i++){let r=i*this.data.stride+this.offset;for(let s=0;s<this.itemSize;s++)n.push(this.data.array[r+s])}return new ze(new this.array.constructor(n),this.itemSize,this.normalized)}else return t.interleavedBuffers===void 0&&(t.interleavedBuffers={}),t.interleavedBuffers[this.data.uuid]===void 0&&(t.interleavedBuffers[this.data.uuid]=this.data.clone(t)),new e(t.interleavedBuffers[this.data.uuid],this.itemSize,this.offset,this.normalized)}toJSON(t){if(t===void 0){Rl("InterleavedBufferAttribute.toJSON(): Serializing an interleaved buffer attribute will de-interleave buffer data.");let n=[];for(let i=0;i<this.count;i++){let r=i*this.data.stride+this.offset;for(let s=0;s<this.itemSize;s++)n.push(this.data.array[r+s])}return{itemSize:this.itemSize,type:this.array.constructor.name,array:n,normalized:this.normalized}}else return t.interleavedBuffers===void 0&&(t.interleavedBuffers={}),t.interleavedBuffers[this.data.uuid]===void 0&&(t.interleavedBuffers[this.data.uuid]=this.data.toJSON(t)),{isInterleavedBufferAttribute:!0,itemSize:this.itemSize,data:this.data.uuid,offset:this.offset,normalized:this.normalized}}_denormalize(t){let n=this._normalizationScale;return n!==void 0?Math.max(t/n,-1):hx(t,this.data.array)}_normalize(t){let n=this._normalizationScale;return n!==void 0?Math.round(t*n):dx(t,this.data.array)}},w_=new k,$U=new k,XU=new zt,Qn=class{constructor(t=new k(1,0,0),n=0){this.isPlane=!0,this.normal=t,this.constant=n}set(t,n){return this.normal.copy(t),this.constant=n,this}setComponents(t,n,i,r){return this.normal.set(t,n,i),this.constant=r,this}setFromNormalAndCoplanarPoint(t,n){return this.normal.copy(t),this.constant=-n.dot(this.normal),this}setFromCoplanarPoints(t,n,i){let r=w_.subVectors(i,n).cross($U.subVectors(t,n)).normalize();return this.setFromNormalAndCoplanarPoint(r,t),this}copy(t){return this.normal.copy(t.normal),this.constant=t.constant,this}normalize(){let t=1/this.normal.length();return this.normal.multiplyScalar(t),this.constant*=t,this}negate(){return this.constant*=-1,this.normal.negate(),this}distanceToPoint(t){return this.normal.dot(t)+this.constant}distanceToSphere(t){return this.distanceToPoint(t.center)-t.radius}projectPoint(t,n){return n.copy(t).addScaledVector(this.normal,-this.distanceToPoint(t))}intersectLine(t,n,i=!0){let r=t.delta(w_),s=this.normal.dot(r);if(s===0)return this.distanceToPoint(t.start)===0?n.copy(t.start):null;let o=-(t.start.dot(this.normal)+this.constant)/s;return i===!0&&(o<0||o>1)?null:n.copy(t.start).addScaledVector(r,o)}intersectsLine(t){let n=this.distanceToPoint(t.start),i=this.distanceToPoint(t.end);return n<0&&i>0||i<0&&n>0}intersectsBox(t){return t.intersectsPlane(this)}intersectsSphere(t){return t.intersectsPlane(this)}coplanarPoint(t){return t.copy(this.normal).multiplyScalar(-this.constant)}applyMatrix4(t,n){let i=n||XU.getNormalMatrix(t),r=this.coplanarPoint(w_).applyMatrix4(t),s=this.normal.applyMatrix3(i).normalize();return this.constant=-r.dot(s),this}translate(t){return this.constant-=t.dot(this.normal),this}equals(t){return t.normal.equals(this.normal)&&t.constant===this.constant}clone(){return new this.constructor().copy(this)}toJSON(){return{normal:this.normal.toArray(),constant:this.constant}}fromJSON(t){return this.normal.fromArray(t.normal),this.constant=t.constant,this}},qU=0,mr=class extends Gi{constructor(){super(),this.isMaterial=!0,Object.defineProperty(this,"id",{value:qU++}),this.uuid=zs(),this.name="",this.type="Material",this.blending=oc,this.side=Bs,this.vertexColors=!1,this.opacity=1,this.transparent=!1,this.alphaHash=!1,this.blendSrc=V_,this.blendDst=H_,this.blendEquation=Ro,this.blendSrcAlpha=null,this.blendDstAlpha=null,this.blendEquationAlpha=null,this.blendColor=new Wt(0,0,0),this.blendAlpha=0,this.depthFunc=Ya,this.depthTest=!0,this.depthWrite=!0,this.stencilWriteMask=255,this.stencilFunc=qE,this.stencilRef=0,this.stencilFuncMask=255,this.stencilFail=$h,this.stencilZFail=$h,this.stencilZPass=$h,this.stencilWrite=!1,this.clippingPlanes=null,this.clipIntersection=!1,this.clipShadows=!1,this.shadowSide=null,this.colorWrite=!0,this.precision=null,this.polygonOffset=!1,this.polygonOffsetFactor=0,this.polygonOffsetUnits=0,this.dithering=!1,this.alphaToCoverage=!1,this.premultipliedAlpha=!1,this.forceSinglePass=!1,this.allowOverride=!0,this.visible=!0,this.toneMapped=!0,this.userData={},this.version=0,this._alphaTest=0}get alphaTest(){return this._alphaTest}set alphaTest(t){this._alphaTest>0!=t>0&&this.version++,this._alphaTest=t}onBeforeRender(){}onBeforeCompile(){}customProgramCacheKey(){return this.onBeforeCompile.toString()}setValues(t){if(t!==void 0)for(let n in t){let i=t[n];if(i===void 0){Ut(`Material: parameter '${n}' has value of undefined.`);continue}let r=this[n];if(r===void 0){Ut(`Material: '${n}' is not a property of THREE.${this.type}.`);continue}r&&r.isColor?r.set(i):r&&r.isVector2&&i&&i.isVector2||r&&r.isEuler&&i&&i.isEuler||r&&r.isVector3&&i&&i.isVector3?r.copy(i):this[n]=i}}toJSON(t){let n=t===void 0||typeof t=="string";n&&(t={textures:{},images:{}});let i={metadata:{version:4.7,type:"Material",generator:"Material.toJSON"}};i.uuid=this.uuid,i.type=this.type,i.blending=this.blending,i.side=this.side,i.shadowSide=this.shadowSide,i.vertexColors=this.vertexColors,i.opacity=this.opacity,i.transparent=this.transparent,i.blendSrc=this.blendSrc,i.blendDst=this.blendDst,i.blendEquation=this.blendEquation,i.blendSrcAlpha=this.blendSrcAlpha,i.blendDstAlpha=this.blendDstAlpha,i.blendEquationAlpha=this.blendEquationAlpha,i.blendColor=this.blendColor.getHex(),i.blendAlpha=this.blendAlpha,i.depthFunc=this.depthFunc,i.depthTest=this.depthTest,i.depthWrite=this.depthWrite,i.colorWrite=this.colorWrite,i.clipIntersection=this.clipIntersection,i.clipShadows=this.clipShadows,i.stencilWriteMask=this.stencilWriteMask,i.stencilFunc=this.stencilFunc,i.stencilRef=this.stencilRef,i.stencilFuncMask=this.stencilFuncMask,i.stencilFail=this.stencilFail,i.stencilZFail=this.stencilZFail,i.stencilZPass=this.stencilZPass,i.stencilWrite=this.stencilWrite,i.polygonOffset=this.polygonOffset,i.polygonOffsetFactor=this.polygonOffsetFactor,i.polygonOffsetUnits=this.polygonOffsetUnits,i.dithering=this.dithering,i.alphaTest=this.alphaTest,i.alphaHash=this.alphaHash,i.alphaToCoverage=this.alphaToCoverage,i.premultipliedAlpha=this.premultipliedAlpha,i.forceSinglePass=this.forceSinglePass,i.allowOverride=this.allowOverride,i.visible=this.visible,i.toneMapped=this.toneMapped,i.name=this.name,this.color&&this.color.isColor&&(i.color=this.color.getHex()),this.roughness!==void 0&&(i.roughness=this.roughness),this.metalness!==void 0&&(i.metalness=this.metalness),this.sheen!==void 0&&(i.sheen=this.sheen),this.sheenColor&&this.sheenColor.isColor&&(i.sheenColor=this.sheenColor.getHex()),this.sheenRoughness!==void 0&&(i.sheenRoughness=this.sheenRoughness),this.emissive&&this.emissive.isColor&&(i.emissive=this.emissive.getHex()),this.emissiveIntensity!==void 0&&(i.emissiveIntensity=this.emissiveIntensity),this.specular&&this.specular.isColor&&(i.specular=this.specular.getHex()),this.specularIntensity!==void 0&&(i.specularIntensity=this.specularIntensity),this.specularColor&&this.specularColor.isColor&&(i.specularColor=this.specularColor.getHex()),this.shininess!==void 0&&(i.shininess=this.shininess),this.clearcoat!==void 0&&(i.clearcoat=this.clearcoat),this.clearcoatRoughness!==void 0&&(i.clearcoatRoughness=this.clearcoatRoughness),this.diffuseRoughness!==void 0&&(i.diffuseRoughness=this.diffuseRoughness),this.diffuseRoughnessMap&&this.diffuseRoughnessMap.isTexture&&(i.diffuseRoughnessMap=this.diffuseRoughnessMap.toJSON(t).uuid),this.clearcoatMap&&this.clearcoatMap.isTexture&&(i.clearcoatMap=this.clearcoatMap.toJSON(t).uuid),this.clearcoatRoughnessMap&&this.clearcoatRoughnessMap.isTexture&&(i.clearcoatRoughnessMap=this.clearcoatRoughnessMap.toJSON(t).uuid),this.clearcoatNormalMap&&this.clearcoatNormalMap.isTexture&&(i.clearcoatNormalMap=this.clearcoatNormalMap.toJSON(t).uuid,i.clearcoatNormalScale=this.clearcoatNormalScale.toArray()),this.sheenColorMap&&this.sheenColorMap.isTexture&&(i.sheenColorMap=this.sheenColorMap.toJSON(t).uuid),this.sheenRoughnessMap&&this.sheenRoughnessMap.isTexture&&(i.sheenRoughnessMap=this.sheenRoughnessMap.toJSON(t).uuid),this.dispersion!==void 0&&(i.dispersion=this.dispersion),this.retroreflectivity!==void 0&&(i.retroreflectivity=this.retroreflectivity),this.iridescence!==void 0&&(i.iridescence=this.iridescence),this.iridescenceIOR!==void 0&&(i.iridescenceIOR=this.iridescenceIOR),this.iridescenceThicknessMinimum!==void 0&&(i.iridescenceThicknessMinimum=this.iridescenceThicknessMinimum),this.iridescenceThicknessMaximum!==void 0&&(i.iridescenceThicknessMaximum=this.iridescenceThicknessMaximum),this.iridescenceMap&&this.iridescenceMap.isTexture&&(i.iridescenceMap=this.iridescenceMap.toJSON(t).uuid),this.iridescenceThicknessMap&&this.iridescenceThicknessMap.isTexture&&(i.iridescenceThicknessMap=this.iridescenceThicknessMap.toJSON(t).uuid),this.anisotropy!==void 0&&(i.anisotropy=this.anisotropy),this.anisotropyRotation!==void 0&&(i.anisotropyRotation=this.anisotropyRotation),this.anisotropyMap&&this.anisotropyMap.isTexture&&(i.anisotropyMap=this.anisotropyMap.toJSON(t).uuid),this.map&&this.map.isTexture&&(i.map=this.map.toJSON(t).uuid),this.matcap&&this.matcap.isTexture&&(i.matcap=this.matcap.toJSON(t).uuid),this.alphaMap&&this.alphaMap.isTexture&&(i.alphaMap=this.alphaMap.toJSON(t).uuid),this.lightMap&&this.lightMap.isTexture&&(i.lightMap=this.lightMap.toJSON(t).uuid,i.lightMapIntensity=this.lightMapIntensity),this.aoMap&&this.aoMap.isTexture&&(i.aoMap=this.aoMap.toJSON(t).uuid,i.aoMapIntensity=this.aoMapIntensity),this.bumpMap&&this.bumpMap.isTexture&&(i.bumpMap=this.bumpMap.toJSON(t).uuid,i.bumpScale=this.bumpScale),this.normalMap&&this.normalMap.isTexture&&(i.normalMap=this.normalMap.toJSON(t).uuid,i.normalMapType=this.normalMapType,i.normalScale=this.normalScale.toArray()),this.displacementMap&&this.displacementMap.isTexture&&(i.displacementMap=this.displacementMap.toJSON(t).uuid,i.displacementScale=this.displacementScale,i.displacementBias=this.displacementBias),this.roughnessMap&&this.roughnessMap.isTexture&&(i.roughnessMap=this.roughnessMap.toJSON(t).uuid),this.metalnessMap&&this.metalnessMap.isTexture&&(i.metalnessMap=this.metalnessMap.toJSON(t).uuid),this.emissiveMap&&this.emissiveMap.isTexture&&(i.emissiveMap=this.emissiveMap.toJSON(t).uuid),this.specularMap&&this.specularMap.isTexture&&(i.specularMap=this.specularMap.toJSON(t).uuid),this.specularIntensityMap&&this.specularIntensityMap.isTexture&&(i.specularIntensityMap=this.specularIntensityMap.toJSON(t).uuid),this.specularColorMap&&this.specularColorMap.isTexture&&(i.specularColorMap=this.specularColorMap.toJSON(t).uuid),this.envMap&&this.envMap.isTexture&&(i.envMap=this.envMap.toJSON(t).uuid,this.combine!==void 0&&(i.combine=this.combine)),this.envMapRotation!==void 0&&(i.envMapRotation=this.envMapRotation.toArray()),this.envMapIntensity!==void 0&&(i.envMapIntensity=this.envMapIntensity),this.reflectivity!==void 0&&(i.reflectivity=this.reflectivity),this.refractionRatio!==void 0&&(i.refractionRatio=this.refractionRatio),this.gradientMap&&this.gradientMap.isTexture&&(i.gradientMap=this.gradientMap.toJSON(t).uuid),this.transmission!==void 0&&(i.transmission=this.transmission),this.transmissionMap&&this.transmissionMap.isTexture&&(i.transmissionMap=this.transmissionMap.toJSON(t).uuid),this.thickness!==void 0&&(i.thickness=this.thickness),this.thicknessMap&&this.thicknessMap.isTexture&&(i.thicknessMap=this.thicknessMap.toJSON(t).uuid),this.attenuationDistance!==void 0&&(i.attenuationDistance=this.attenuationDistance),this.attenuationColor!==void 0&&(i.attenuationColor=this.attenuationColor.getHex()),this.size!==void 0&&(i.size=this.size),this.sizeAttenuation!==void 0&&(i.sizeAttenuation=this.sizeAttenuation),Array.isArray(this.clippingPlanes)&&this.clippingPlanes.length>0&&(i.clippingPlanes=this.clippingPlanes.map(s=>s.toJSON())),this.rotation!==void 0&&(i.rotation=this.rotation),this.depthPacking!==void 0&&(i.depthPacking=this.depthPacking),this.linewidth!==void 0&&(i.linewidth=this.linewidth),this.linecap!==void 0&&(i.linecap=this.linecap),this.linejoin!==void 0&&(i.linejoin=this.linejoin),this.dashSize!==void 0&&(i.dashSize=this.dashSize),this.gapSize!==void 0&&(i.gapSize=this.gapSize),this.scale!==void 0&&(i.scale=this.scale),this.wireframe!==void 0&&(i.wireframe=this.wireframe),this.wireframeLinewidth!==void 0&&(i.wireframeLinewidth=this.wireframeLinewidth),this.wireframeLinecap!==void 0&&(i.wireframeLinecap=this.wireframeLinecap),this.wireframeLinejoin!==void 0&&(i.wireframeLinejoin=this.wireframeLinejoin),this.flatShading!==void 0&&(i.flatShading=this.flatShading),this.fog!==void 0&&(i.fog=this.fog),Object.keys(this.userData).length>0&&(i.userData=this.userData);function r(s){let o=[];for(let a in s){let c=s[a];delete c.metadata,o.push(c)}return o}if(n){let s=r(t.textures),o=r(t.images);s.length>0&&(i.textures=s),o.length>0&&(i.images=o)}return i}fromJSON(t,n){if(t.uuid!==void 0&&(this.uuid=t.uuid),t.name!==void 0&&(this.name=t.name),t.color!==void 0&&this.color!==void 0&&this.color.setHex(t.color),t.roughness!==void 0&&(this.roughness=t.roughness),t.metalness!==void 0&&(this.metalness=t.metalness),t.sheen!==void 0&&(this.sheen=t.sheen),t.sheenColor!==void 0&&(this.sheenColor=new Wt().setHex(t.sheenColor)),t.sheenRoughness!==void 0&&(this.sheenRoughness=t.sheenRoughness),t.emissive!==void 0&&this.emissive!==void 0&&this.emissive.setHex(t.emissive),t.specular!==void 0&&this.specular!==void 0&&this.specular.setHex(t.specular),t.specularIntensity!==void 0&&(this.specularIntensity=t.specularIntensity),t.specularColor!==void 0&&this.specularColor!==void 0&&this.specularColor.setHex(t.specularColor),t.shininess!==void 0&&(this.shininess=t.shininess),t.clearcoat!==void 0&&(this.clearcoat=t.clearcoat),t.clearcoatRoughness!==void 0&&(this.clearcoatRoughness=t.clearcoatRoughness),t.diffuseRoughness!==void 0&&(this.diffuseRoughness=t.diffuseRoughness),t.dispersion!==void 0&&(this.dispersion=t.dispersion),t.retroreflectivity!==void 0&&(this.retroreflectivity=t.retroreflectivity),t.iridescence!==void 0&&(this.iridescence=t.iridescence),t.iridescenceIOR!==void 0&&(this.iridescenceIOR=t.iridescenceIOR),t.iridescenceThicknessMinimum!==void 0&&(this.iridescenceThicknessMinimum=t.iridescenceThicknessMinimum),t.iridescenceThicknessMaximum!==void 0&&(this.iridescenceThicknessMaximum=t.iridescenceThicknessMaximum),t.iridescenceThicknessRange!==void 0&&(this.iridescenceThicknessMinimum=t.iridescenceThicknessRange[0],this.iridescenceThicknessMaximum=t.iridescenceThicknessRange[1]),t.transmission!==void 0&&(this.transmission=t.transmission),t.thickness!==void 0&&(this.thickness=t.thickness),t.attenuationDistance!==void 0&&(this.attenuationDistance=t.attenuationDistance),t.attenuationColor!==void 0&&this.attenuationColor!==void 0&&this.attenuationColor.setHex(t.attenuationColor),t.anisotropy!==void 0&&(this.anisotropy=t.anisotropy),t.anisotropyRotation!==void 0&&(this.anisotropyRotation=t.anisotropyRotation),t.fog!==void 0&&(this.fog=t.fog),t.flatShading!==void 0&&(this.flatShading=t.flatShading),t.blending!==void 0&&(this.blending=t.blending),t.combine!==void 0&&(this.combine=t.combine),t.side!==void 0&&(this.side=t.side),t.shadowSide!==void 0&&(this.shadowSide=t.shadowSide),t.opacity!==void 0&&(this.opacity=t.opacity),t.transparent!==void 0&&(this.transparent=t.transparent),t.alphaTest!==void 0&&(this.alphaTest=t.alphaTest),t.alphaHash!==void 0&&(this.alphaHash=t.alphaHash),t.depthFunc!==void 0&&(this.depthFunc=t.depthFunc),t.depthTest!==void 0&&(this.depthTest=t.depthTest),t.depthWrite!==void 0&&(this.depthWrite=t.depthWrite),t.colorWrite!==void 0&&(this.colorWrite=t.colorWrite),t.clippingPlanes!==void 0&&(this.clippingPlanes=t.clippingPlanes.map(i=>new Qn().fromJSON(i))),t.clipIntersection!==void 0&&(this.clipIntersection=t.clipIntersection),t.clipShadows!==void 0&&(this.clipShadows=t.clipShadows),t.depthPacking!==void 0&&(this.depthPacking=t.depthPacking),t.blendSrc!==void 0&&(this.blendSrc=t.blendSrc),t.blendDst!==void 0&&(this.blendDst=t.blendDst),t.blendEquation!==void 0&&(this.blendEquation=t.blendEquation),t.blendSrcAlpha!==void 0&&(this.blendSrcAlpha=t.blendSrcAlpha),t.blendDstAlpha!==void 0&&(this.blendDstAlpha=t.blendDstAlpha),t.blendEquationAlpha!==void 0&&(this.blendEquationAlpha=t.blendEquationAlpha),t.blendColor!==void 0&&this.blendColor!==void 0&&this.blendColor.setHex(t.blendColor),t.blendAlpha!==void 0&&(this.blendAlpha=t.blendAlpha),t.stencilWriteMask!==void 0&&(this.stencilWriteMask=t.stencilWriteMask),t.stencilFunc!==void 0&&(this.stencilFunc=t.stencilFunc),t.stencilRef!==void 0&&(this.stencilRef=t.stencilRef),t.stencilFuncMask!==void 0&&(this.stencilFuncMask=t.stencilFuncMask),t.stencilFail!==void 0&&(this.stencilFail=t.stencilFail),t.stencilZFail!==void 0&&(this.stencilZFail=t.stencilZFail),t.stencilZPass!==void 0&&(this.stencilZPass=t.stencilZPass),t.stencilWrite!==void 0&&(this.stencilWrite=t.stencilWrite),t.wireframe!==void 0&&(this.wireframe=t.wireframe),t.wireframeLinewidth!==void 0&&(this.wireframeLinewidth=t.wireframeLinewidth),t.wireframeLinecap!==void 0&&(this.wireframeLinecap=t.wireframeLinecap),t.wireframeLinejoin!==void 0&&(this.wireframeLinejoin=t.wireframeLinejoin),t.rotation!==void 0&&(this.rotation=t.rotation),t.linewidth!==void 0&&(this.linewidth=t.linewidth),t.linecap!==void 0&&(this.linecap=t.linecap),t.linejoin!==void 0&&(this.linejoin=t.linejoin),t.dashSize!==void 0&&(this.dashSize=t.dashSize),t.gapSize!==void 0&&(this.gapSize=t.gapSize),t.scale!==void 0&&(this.scale=t.scale),t.polygonOffset!==void 0&&(this.polygonOffset=t.polygonOffset),t.polygonOffsetFactor!==void 0&&(this.polygonOffsetFactor=t.polygonOffsetFactor),t.polygonOffsetUnits!==void 0&&(this.polygonOffsetUnits=t.polygonOffsetUnits),t.dithering!==void 0&&(this.dithering=t.dithering),t.alphaToCoverage!==void 0&&(this.alphaToCoverage=t.alphaToCoverage),t.premultipliedAlpha!==void 0&&(this.premultipliedAlpha=t.premultipliedAlpha),t.forceSinglePass!==void 0&&(this.forceSinglePass=t.forceSinglePass),t.allowOverride!==void 0&&(this.allowOverride=t.allowOverride),t.visible!==void 0&&(this.visible=t.visible),t.toneMapped!==void 0&&(this.toneMapped=t.toneMapped),t.userData!==void 0&&(this.userData=t.userData),t.vertexColors!==void 0&&(typeof t.vertexColors=="number"?this.vertexColors=t.vertexColors>0:this.vertexColors=t.vertexColors),t.size!==void 0&&(this.size=t.size),t.sizeAttenuation!==void 0&&(this.sizeAttenuation=t.sizeAttenuation),t.map!==void 0&&(this.map=n[t.map]||null),t.matcap!==void 0&&(this.matcap=n[t.matcap]||null),t.alphaMap!==void 0&&(this.alphaMap=n[t.alphaMap]||null),t.bumpMap!==void 0&&(this.bumpMap=n[t.bumpMap]||null),t.bumpScale!==void 0&&(this.bumpScale=t.bumpScale),t.normalMap!==void 0&&(this.normalMap=n[t.normalMap]||null),t.normalMapType!==void 0&&(this.normalMapType=t.normalMapType),t.normalScale!==void 0){let i=t.normalScale;Array.isArray(i)===!1&&(i=[i,i]),this.normalScale=new Ft().fromArray(i)}return t.displacementMap!==void 0&&(this.displacementMap=n[t.displacementMap]||null),t.displacementScale!==void 0&&(this.displacementScale=t.displacementScale),t.displacementBias!==void 0&&(this.displacementBias=t.displacementBias),t.roughnessMap!==void 0&&(this.roughnessMap=n[t.roughnessMap]||null),t.metalnessMap!==void 0&&(this.metalnessMap=n[t.metalnessMap]||null),t.emissiveMap!==void 0&&(this.emissiveMap=n[t.emissiveMap]||null),t.emissiveIntensity!==void 0&&(this.emissiveIntensity=t.emissiveIntensity),t.specularMap!==void 0&&(this.specularMap=n[t.specularMap]||null),t.specularIntensityMap!==void 0&&(this.specularIntensityMap=n[t.specularIntensityMap]||null),t.specularColorMap!==void 0&&(this.specularColorMap=n[t.specularColorMap]||null),t.envMap!==void 0&&(this.envMap=n[t.envMap]||null),t.envMapRotation!==void 0&&this.envMapRotation.fromArray(t.envMapRotation),t.envMapIntensity!==void 0&&(this.envMapIntensity=t.envMapIntensity),t.reflectivity!==void 0&&(this.reflectivity=t.reflectivity),t.refractionRatio!==void 0&&(this.refractionRatio=t.refractionRatio),t.lightMap!==void 0&&(this.lightMap=n[t.lightMap]||null),t.lightMapIntensity!==void 0&&(this.lightMapIntensity=t.lightMapIntensity),t.aoMap!==void 0&&(this.aoMap=n[t.aoMap]||null),t.aoMapIntensity!==void 0&&(this.aoMapIntensity=t.aoMapIntensity),t.gradientMap!==void 0&&(this.gradientMap=n[t.gradientMap]||null),t.clearcoatMap!==void 0&&(this.clearcoatMap=n[t.clearcoatMap]||null),t.clearcoatRoughnessMap!==void 0&&(this.clearcoatRoughnessMap=n[t.clearcoatRoughnessMap]||null),t.clearcoatNormalMap!==void 0&&(this.clearcoatNormalMap=n[t.clearcoatNormalMap]||null),t.clearcoatNormalScale!==void 0&&(this.clearcoatNormalScale=new Ft().fromArray(t.clearcoatNormalScale)),t.diffuseRoughnessMap!==void 0&&(this.diffuseRoughnessMap=n[t.diffuseRoughnessMap]||null),t.iridescenceMap!==void 0&&(this.iridescenceMap=n[t.iridescenceMap]||null),t.iridescenceThicknessMap!==void 0&&(this.iridescenceThicknessMap=n[t.iridescenceThicknessMap]||null),t.transmissionMap!==void 0&&(this.transmissionMap=n[t.transmissionMap]||null),t.thicknessMap!==void 0&&(this.thicknessMap=n[t.thicknessMap]||null),t.anisotropyMap!==void 0&&(this.anisotropyMap=n[t.anisotropyMap]||null),t.sheenColorMap!==void 0&&(this.sheenColorMap=n[t.sheenColorMap]||null),t.sheenRoughnessMap!==void 0&&(this.sheenRoughnessMap=n[t.sheenRoughnessMap]||null),this}clone(){return new this.constructor().copy(this)}copy(t){this.name=t.name,this.blending=t.blending,this.side=t.side,this.vertexColors=t.vertexColors,this.opacity=t.opacity,this.transparent=t.transparent,this.blendSrc=t.blendSrc,this.blendDst=t.blendDst,this.blendEquation=t.blendEquation,this.blendSrcAlpha=t.blendSrcAlpha,this.blendDstAlpha=t.blendDstAlpha,this.blendEquationAlpha=t.blendEquationAlpha,this.blendColor.copy(t.blendColor),this.blendAlpha=t.blendAlpha,this.depthFunc=t.depthFunc,this.depthTest=t.depthTest,this.depthWrite=t.depthWrite,this.stencilWriteMask=t.stencilWriteMask,this.stencilFunc=t.stencilFunc,this.stencilRef=t.stencilRef,this.stencilFuncMask=t.stencilFuncMask,this.stencilFail=t.stencilFail,this.stencilZFail=t.stencilZFail,this.stencilZPass=t.stencilZPass,this.stencilWrite=t.stencilWrite;let n=t.clippingPlanes,i=null;if(n!==null){let r=n.length;i=new Array(r);for(let s=0;s!==r;++s)i[s]=n[s].clone()}return this.clippingPlanes=i,this.clipIntersection=t.clipIntersection,this.clipShadows=t.clipShadows,this.shadowSide=t.shadowSide,this.colorWrite=t.colorWrite,this.precision=t.precision,this.polygonOffset=t.polygonOffset,this.polygonOffsetFactor=t.polygonOffsetFactor,this.polygonOffsetUnits=t.polygonOffsetUnits,this.dithering=t.dithering,this.alphaTest=t.alphaTest,this.alphaHash=t.alphaHash,this.alphaToCoverage=t.alphaToCoverage,this.premultipliedAlpha=t.premultipliedAlpha,this.forceSinglePass=t.forceSinglePass,this.allowOverride=t.allowOverride,this.visible=t.visible,this.toneMapped=t.toneMapped,this.userData=JSON.parse(JSON.stringify(t.userData)),this}dispose(){this.dispatchEvent({type:"dispose"})}set needsUpdate(t){t===!0&&this.version++}};var Wr=new k,T_=new k,Ah=new k,Eh=new k,As=class{constructor(t=new k,n=new k(0,0,-1)){this.origin=t,this.direction=n}set(t,n){return this.origin.copy(t),this.direction.copy(n),this}copy(t){return this.origin.copy(t.origin),this.direction.copy(t.direction),this}at(t,n){return n.copy(this.origin).addScaledVector(this.direction,t)}lookAt(t){return this.direction.copy(t).sub(this.origin).normalize(),this}recast(t){return this.origin.copy(this.at(t,Wr)),this}closestPointToPoint(t,n){n.subVectors(t,this.origin);let i=n.dot(this.direction);return i<0?n.copy(this.origin):n.copy(this.origin).addScaledVector(this.direction,i)}distanceToPoint(t){return Math.sqrt(this.distanceSqToPoint(t))}distanceSqToPoint(t){let n=Wr.subVectors(t,this.origin).dot(this.direction);return n<0?this.origin.distanceToSquared(t):(Wr.copy(this.origin).addScaledVector(this.direction,n),Wr.distanceToSquared(t))}distanceSqToSegment(t,n,i,r){T_.copy(t).add(n).multiplyScalar(.5),Ah.copy(n).sub(t).normalize(),Eh.copy(this.origin).sub(T_);let s=t.distanceTo(n)*.5,o=-this.direction.dot(Ah),a=Eh.dot(this.direction),c=-Eh.dot(Ah),l=Eh.lengthSq(),u=Math.abs(1-o*o),h,f,d,p;if(u>0)if(h=o*c-a,f=o*a-c,p=s*u,h>=0)if(f>=-p)if(f<=p){let y=1/u;h*=y,f*=y,d=h*(h+o*f+2*a)+f*(o*h+f+2*c)+l}else f=s,h=Math.max(0,-(o*f+a)),d=-h*h+f*(f+2*c)+l;else f=-s,h=Math.max(0,-(o*f+a)),d=-h*h+f*(f+2*c)+l;else f<=-p?(h=Math.max(0,-(-o*s+a)),f=h>0?-s:Math.min(Math.max(-s,-c),s),d=-h*h+f*(f+2*c)+l):f<=p?(h=0,f=Math.min(Math.max(-s,-c),s),d=f*(f+2*c)+l):(h=Math.max(0,-(o*s+a)),f=h>0?s:Math.min(Math.max(-s,-c),s),d=-h*h+f*(f+2*c)+l);else f=o>0?-s:s,h=Math.max(0,-(o*f+a)),d=-h*h+f*(f+2*c)+l;return i&&i.copy(this.origin).addScaledVector(this.direction,h),r&&r.copy(T_).addScaledVector(Ah,f),d}intersectSphere(t,n){if(t.radius<0)return null;Wr.subVectors(t.center,this.origin);let i=Wr.dot(this.direction),r=Wr.dot(Wr)-i*i,s=t.radius*t.radius;if(r>s)return null;let o=Math.sqrt(s-r),a=i-o,c=i+o;return c<0?null:a<0?this.at(c,n):this.at(a,n)}intersectsSphere(t){return t.radius<0?!1:this.distanceSqToPoint(t.center)<=t.radius*t.radius}distanceToPlane(t){let n=t.normal.dot(this.direction);if(n===0)return t.distanceToPoint(this.origin)===0?0:null;let i=-(this.origin.dot(t.normal)+t.constant)/n;return i>=0?i:null}intersectPlane(t,n){let i=this.distanceToPlane(t);return i===null?null:this.at(i,n)}intersectsPlane(t){let n=t.distanceToPoint(this.origin);return n===0||t.normal.dot(this.direction)*n<0}intersectBox(t,n){let i,r,s,o,a,c,l=1/this.direction.x,u=1/this.direction.y,h=1/this.direction.z,f=this.origin;return l>=0?(i=(t.min.x-f.x)*l,r=(t.max.x-f.x)*l):(i=(t.max.x-f.x)*l,r=(t.min.x-f.x)*l),u>=0?(s=(t.min.y-f.y)*u,o=(t.max.y-f.y)*u):(s=(t.max.y-f.y)*u,o=(t.min.y-f.y)*u),i>o||s>r||((s>i||isNaN(i))&&(i=s),(o<r||isNaN(r))&&(r=o),h>=0?(a=(t.min.z-f.z)*h,c=(t.max.z-f.z)*h):(a=(t.max.z-f.z)*h,c=(t.min.z-f.z)*h),i>c||a>r)||((a>i||i!==i)&&(i=a),(c<r||r!==r)&&(r=c),r<0)?null:this.at(i>=0?i:r,n)}intersectsBox(t){return this.intersectBox(t,Wr)!==null}intersectTriangle(t,n,i,r,s){let o=this.origin,a=this.direction,c=a.x,l=a.y,u=a.z,h=t.x-o.x,f=t.y-o.y,d=t.z-o.z,p=n.x-o.x,y=n.y-o.y,m=n.z-o.z,g=i.x-o.x,x=i.y-o.y,S=i.z-o.z,v=Math.abs(c),w=Math.abs(l),b=Math.abs(u),_,M,C,E,I,R,U,P,L,O,D,Y;if(v>=w&&v>=b?(C=c,R=h,L=p,Y=g,c>=0?(_=l,M=u,E=f,I=d,U=y,P=m,O=x,D=S):(_=u,M=l,E=d,I=f,U=m,P=y,O=S,D=x)):w>=b?(C=l,R=f,L=y,Y=x,l>=0?(_=u,M=c,E=d,I=h,U=m,P=p,O=S,D=g):(_=c,M=u,E=h,I=d,U=p,P=m,O=g,D=S)):(C=u,R=d,L=m,Y=S,u>=0?(_=c,M=l,E=h,I=f,U=p,P=y,O=g,D=x):(_=l,M=c,E=f,I=h,U=y,P=p,O=x,D=g)),C===0)return null;let B=_/C,V=M/C,q=1/C,rt=E-B*R,ct=I-V*R,$=U-B*L,ot=P-V*L,ut=O-B*Y,st=D-V*Y,at=ut*ot-st*$,J=rt*st-ct*ut,_t=$*ct-ot*rt;if(r){if(at<0||J<0||_t<0)return null}else if((at<0||J<0||_t<0)&&(at>0||J>0||_t>0))return null;let lt=at+J+_t;if(lt===0)return null;let K=q*(at*R+J*L+_t*Y);return(lt>0?K<0:K>0)?null:this.at(K/lt,s)}applyMatrix4(t){return this.origin.applyMatrix4(t),this.direction.transformDirection(t),this}equals(t){return t.origin.equals(this.origin)&&t.direction.equals(this.direction)}clone(){return new this.constructor().copy(this)}},tc=class extends mr{constructor(t){super(),this.isMeshBasicMaterial=!0,this.type="MeshBasicMaterial",this.color=new Wt(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new qr,this.combine=Ad,this.reflectivity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.lightMap=t.lightMap,this.lightMapIntensity=t.lightMapIntensity,this.aoMap=t.aoMap,this.aoMapIntensity=t.aoMapIntensity,this.specularMap=t.specularMap,this.alphaMap=t.alphaMap,this.envMap=t.envMap,this.envMapRotation.copy(t.envMapRotation),this.combine=t.combine,this.reflectivity=t.reflectivity,this.refractionRatio=t.refractionRatio,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.wireframeLinecap=t.wireframeLinecap,this.wireframeLinejoin=t.wireframeLinejoin,this.fog=t.fog,this}},nE=new ee,To=new As,Ch=new Ei,iE=new k,Rh=new k,Ph=new k,Ih=new k,A_=new k,Lh=new k,rE=new k,Nh=new k,ln=class extends dn{constructor(t=new De,n=new tc){super(),this.isMesh=!0,this.type="Mesh",this.geometry=t,this.material=n,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.count=1,this.updateMorphTargets()}copy(t,n){return super.copy(t,n),t.morphTargetInfluences!==void 0?this.morphTargetInfluences=t.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,t.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},t.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(t.material)?t.material.slice():t.material,this.geometry=t.geometry,this}updateMorphTargets(){let n=this.geometry.morphAttributes,i=Object.keys(n);if(i.length>0){let r=n[i[0]];if(r!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let s=0,o=r.length;s<o;s++){let a=r[s].name||String(s);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=s}}}}getVertexPosition(t,n){let i=this.geometry,r=i.attributes.position,s=i.morphAttributes.position,o=i.morphTargetsRelative;n.fromBufferAttribute(r,t);let a=this.morphTargetInfluences;if(s&&a){Lh.set(0,0,0);for(let c=0,l=s.length;c<l;c++){let u=a[c],h=s[c];u!==0&&(A_.fromBufferAttribute(h,t),o?Lh.addScaledVector(A_,u):Lh.addScaledVector(A_.sub(n),u))}n.add(Lh)}return n}intersectsFrustum(t){return t.intersectsObject(this)}raycast(t,n){let i=this.geometry,r=this.material,s=this.matrixWorld;r!==void 0&&(i.boundingSphere===null&&i.computeBoundingSphere(),Ch.copy(i.boundingSphere),Ch.applyMatrix4(s),To.copy(t.ray).recast(t.near),!(Ch.containsPoint(To.origin)===!1&&(To.intersectSphere(Ch,iE)===null||To.origin.distanceToSquared(iE)>(t.far-t.near)**2))&&(nE.copy(s).invert(),To.copy(t.ray).applyMatrix4(nE),!(i.boundingBox!==null&&To.intersectsBox(i.boundingBox)===!1)&&this._computeIntersections(t,n,To)))}_computeIntersections(t,n,i){let r,s=this.geometry,o=this.material,a=s.index,c=s.attributes.position,l=s.attributes.uv,u=s.attributes.uv1,h=s.attributes.normal,f=s.groups,d=s.drawRange;if(a!==null)if(Array.isArray(o))for(let p=0,y=f.length;p<y;p++){let m=f[p],g=o[m.materialIndex],x=Math.max(m.start,d.start),S=Math.min(a.count,Math.min(m.start+m.count,d.start+d.count));for(let v=x,w=S;v<w;v+=3){let b=a.getX(v),_=a.getX(v+1),M=a.getX(v+2);r=Dh(this,g,t,i,l,u,h,b,_,M),r&&(r.faceIndex=Math.floor(v/3),r.face.materialIndex=m.materialIndex,n.push(r))}}else{let p=Math.max(0,d.start),y=Math.min(a.count,d.start+d.count);for(let m=p,g=y;m<g;m+=3){let x=a.getX(m),S=a.getX(m+1),v=a.getX(m+2);r=Dh(this,o,t,i,l,u,h,x,S,v),r&&(r.faceIndex=Math.floor(m/3),n.push(r))}}else if(c!==void 0)if(Array.isArray(o))for(let p=0,y=f.length;p<y;p++){let m=f[p],g=o[m.materialIndex],x=Math.max(m.start,d.start),S=Math.min(c.count,Math.min(m.start+m.count,d.start+d.count));for(let v=x,w=S;v<w;v+=3){let b=v,_=v+1,M=v+2;r=Dh(this,g,t,i,l,u,h,b,_,M),r&&(r.faceIndex=Math.floor(v/3),r.face.materialIndex=m.materialIndex,n.push(r))}}else{let p=Math.max(0,d.start),y=Math.min(c.count,d.start+d.count);for(let m=p,g=y;m<g;m+=3){let x=m,S=m+1,v=m+2;r=Dh(this,o,t,i,l,u,h,x,S,v),r&&(r.faceIndex=Math.floor(m/3),n.push(r))}}}};function YU(e,t,n,i,r,s,o,a){let c;if(t.side===Un?c=i.intersectTriangle(o,s,r,!0,a):c=i.intersectTriangle(r,s,o,t.side===Bs,a),c===null)return null;Nh.copy(a),Nh.applyMatrix4(e.matrixWorld);let l=n.ray.origin.distanceTo(Nh);return l<n.near||l>n.far?null:{distance:l,point:Nh.clone(),object:e}}function Dh(e,t,n,i,r,s,o,a,c,l){e.getVertexPosition(a,Rh),e.getVertexPosition(c,Ph),e.getVertexPosition(l,Ih);let u=YU(e,t,n,i,Rh,Ph,Ih,rE);if(u){let h=new k;Ts.getBarycoord(rE,Rh,Ph,Ih,h),r&&(u.uv=Ts.getInterpolatedAttribute(r,a,c,l,h,new Ft)),s&&(u.uv1=Ts.getInterpolatedAttribute(s,a,c,l,h,new Ft)),o&&(u.normal=Ts.getInterpolatedAttribute(o,a,c,l,h,new k),u.normal.dot(i.direction)>0&&u.normal.multiplyScalar(-1));let f={a,b:c,c:l,normal:new k,materialIndex:0};Ts.getNormal(Rh,Ph,Ih,f.normal),u.face=f,u.barycoord=h}return u}var od=class extends Dn{constructor(t=null,n=1,i=1,r,s,o,a,c,l=an,u=an,h,f){super(null,o,a,c,l,u,r,s,h,f),this.isDataTexture=!0,this.image={data:t,width:n,height:i},this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}};var Ao=new Ei,ZU=new Ft(.5,.5),Uh=new k,Es=class{constructor(t=new Qn,n=new Qn,i=new Qn,r=new Qn,s=new Qn,o=new Qn){this.planes=[t,n,i,r,s,o]}set(t,n,i,r,s,o){let a=this.planes;return a[0].copy(t),a[1].copy(n),a[2].copy(i),a[3].copy(r),a[4].copy(s),a[5].copy(o),this}copy(t){let n=this.planes;for(let i=0;i<6;i++)n[i].copy(t.planes[i]);return this}setFromProjectionMatrix(t,n=Ai,i=!1){let r=this.planes,s=t.elements,o=s[0],a=s[1],c=s[2],l=s[3],u=s[4],h=s[5],f=s[6],d=s[7],p=s[8],y=s[9],m=s[10],g=s[11],x=s[12],S=s[13],v=s[14],w=s[15];if(r[0].setComponents(l-o,d-u,g-p,w-x).normalize(),r[1].setComponents(l+o,d+u,g+p,w+x).normalize(),r[2].setComponents(l+a,d+h,g+y,w+S).normalize(),r[3].setComponents(l-a,d-h,g-y,w-S).normalize(),i)r[4].setComponents(c,f,m,v).normalize(),r[5].setComponents(l-c,d-f,g-m,w-v).normalize();else if(r[4].setComponents(l-c,d-f,g-m,w-v).normalize(),n===Ai)r[5].setComponents(l+c,d+f,g+m,w+v).normalize();else if(n===Za)r[5].setComponents(c,f,m,v).normalize();else throw new Error("THREE.Frustum.setFromProjectionMatrix(): Invalid coordinate system: "+n);return this}intersectsObject(t){if(t.boundingSphere!==void 0)t.boundingSphere===null&&t.computeBoundingSphere(),Ao.copy(t.boundingSphere).applyMatrix4(t.matrixWorld);else{let n=t.geometry;n.boundingSphere===null&&n.computeBoundingSphere(),Ao.copy(n.boundingSphere).applyMatrix4(t.matrixWorld)}return this.intersectsSphere(Ao)}intersectsSprite(t){Ao.center.set(0,0,0);let n=ZU.distanceTo(t.center);return Ao.radius=.7071067811865476+n,Ao.applyMatrix4(t.matrixWorld),this.intersectsSphere(Ao)}intersectsSphere(t){let n=this.planes,i=t.center,r=-t.radius;for(let s=0;s<6;s++)if(n[s].distanceToPoint(i)<r)return!1;return!0}intersectsBox(t){let n=this.planes;for(let i=0;i<6;i++){let r=n[i];if(Uh.x=r.normal.x>0?t.max.x:t.min.x,Uh.y=r.normal.y>0?t.max.y:t.min.y,Uh.z=r.normal.z>0?t.max.z:t.min.z,r.distanceToPoint(Uh)<0)return!1}return!0}containsPoint(t){let n=this.planes;for(let i=0;i<6;i++)if(n[i].distanceToPoint(t)<0)return!1;return!0}clone(){return new this.constructor().copy(this)}},sE=new ee,ad=class e{constructor(){this.coordinateSystem=Ai,this._frustums=[],this._count=0}setFromArrayCamera(t){let n=t.cameras,i=this._frustums;for(let r=0;r<n.length;r++){let s=n[r];sE.multiplyMatrices(s.projectionMatrix,s.matrixWorldInverse),i[r]===void 0&&(i[r]=new Es),i[r].setFromProjectionMatrix(sE,s.coordinateSystem,s.reversedDepth)}return this._count=n.length,this}getFrustum(t){return this._frustums[t]}intersectsObject(t){let n=this._frustums;for(let i=0;i<this._count;i++)if(n[i].intersectsObject(t))return!0;return!1}intersectsSprite(t){let n=this._frustums;for(let i=0;i<this._count;i++)if(n[i].intersectsSprite(t))return!0;return!1}intersectsSphere(t){let n=this._frustums;for(let i=0;i<this._count;i++)if(n[i].intersectsSphere(t))return!0;return!1}intersectsBox(t){let n=this._frustums;for(let i=0;i<this._count;i++)if(n[i].intersectsBox(t))return!0;return!1}containsPoint(t){let n=this._frustums;for(let i=0;i<this._count;i++)if(n[i].containsPoint(t))return!0;return!1}copy(t){this.coordinateSystem=t.coordinateSystem;let n=this._frustums,i=t._frustums;for(let r=0;r<t._count;r++)n[r]===void 0&&(n[r]=new Es),n[r].copy(i[r]);return this._count=t._count,this}clone(){return new e().copy(this)}};var Yr=class extends mr{constructor(t){super(),this.isLineBasicMaterial=!0,this.type="LineBasicMaterial",this.color=new Wt(16777215),this.map=null,this.linewidth=1,this.linecap="round",this.linejoin="round",this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.linewidth=t.linewidth,this.linecap=t.linecap,this.linejoin=t.linejoin,this.fog=t.fog,this}},cd=new k,ld=new k,oE=new ee,bl=new As,Fh=new Ei,E_=new k,aE=new k,ud=class extends dn{constructor(t=new De,n=new Yr){super(),this.isLine=!0,this.type="Line",this.geometry=t,this.material=n,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.updateMorphTargets()}copy(t,n){return super.copy(t,n),t.morphTargetInfluences!==void 0?this.morphTargetInfluences=t.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,t.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},t.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(t.material)?t.material.slice():t.material,this.geometry=t.geometry,this}computeLineDistances(){let t=this.geometry;if(t.index===null){let n=t.attributes.position,i=[0];for(let r=1,s=n.count;r<s;r++)cd.fromBufferAttribute(n,r-1),ld.fromBufferAttribute(n,r),i[r]=i[r-1],i[r]+=cd.distanceTo(ld);t.setAttribute("lineDistance",new ge(i,1))}else Ut("Line.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}intersectsFrustum(t){return t.intersectsObject(this)}raycast(t,n){let i=this.geometry,r=this.matrixWorld,s=t.params.Line.threshold,o=i.drawRange;if(i.boundingSphere===null&&i.computeBoundingSphere(),Fh.copy(i.boundingSphere),Fh.applyMatrix4(r),Fh.radius+=s,t.ray.intersectsSphere(Fh)===!1)return;oE.copy(r).invert(),bl.copy(t.ray).applyMatrix4(oE);let a=s/((this.scale.x+this.scale.y+this.scale.z)/3),c=a*a,l=this.isLineSegments?2:1,u=i.index,f=i.attributes.position;if(u!==null){let d=Math.max(0,o.start),p=Math.min(u.count,o.start+o.count);for(let y=d,m=p-1;y<m;y+=l){let g=u.getX(y),x=u.getX(y+1),S=Oh(this,t,bl,c,g,x,y);S&&n.push(S)}if(this.isLineLoop){let y=u.getX(p-1),m=u.getX(d),g=Oh(this,t,bl,c,y,m,p-1);g&&n.push(g)}}else{let d=Math.max(0,o.start),p=Math.min(f.count,o.start+o.count);for(let y=d,m=p-1;y<m;y+=l){let g=Oh(this,t,bl,c,y,y+1,y);g&&n.push(g)}if(this.isLineLoop){let y=Oh(this,t,bl,c,p-1,d,p-1);y&&n.push(y)}}}updateMorphTargets(){let n=this.geometry.morphAttributes,i=Object.keys(n);if(i.length>0){let r=n[i[0]];if(r!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let s=0,o=r.length;s<o;s++){let a=r[s].name||String(s);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=s}}}}};function Oh(e,t,n,i,r,s,o){let a=e.geometry.attributes.position;if(cd.fromBufferAttribute(a,r),ld.fromBufferAttribute(a,s),n.distanceSqToSegment(cd,ld,E_,aE)>i)return;E_.applyMatrix4(e.matrixWorld);let l=t.ray.origin.distanceTo(E_);if(!(l<t.near||l>t.far))return{distance:l,point:aE.clone().applyMatrix4(e.matrixWorld),index:o,face:null,faceIndex:null,barycoord:null,object:e}}var cE=new k,lE=new k,Cs=class extends ud{constructor(t,n){super(t,n),this.isLineSegments=!0,this.type="LineSegments"}computeLineDistances(){let t=this.geometry;if(t.index===null){let n=t.attributes.position,i=[];for(let r=0,s=n.count;r<s;r+=2)cE.fromBufferAttribute(n,r),lE.fromBufferAttribute(n,r+1),i[r]=r===0?0:i[r-1],i[r+1]=i[r]+cE.distanceTo(lE);t.setAttribute("lineDistance",new ge(i,1))}else Ut("LineSegments.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}};var ec=class extends mr{constructor(t){super(),this.isPointsMaterial=!0,this.type="PointsMaterial",this.color=new Wt(16777215),this.map=null,this.alphaMap=null,this.size=1,this.sizeAttenuation=!0,this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.alphaMap=t.alphaMap,this.size=t.size,this.sizeAttenuation=t.sizeAttenuation,this.fog=t.fog,this}},uE=new ee,D_=new As,Bh=new Ei,kh=new k,Ul=class extends dn{constructor(t=new De,n=new ec){super(),this.isPoints=!0,this.type="Points",this.geometry=t,this.material=n,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.updateMorphTargets()}copy(t,n){return super.copy(t,n),t.morphTargetInfluences!==void 0?this.morphTargetInfluences=t.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,t.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},t.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(t.material)?t.material.slice():t.material,this.geometry=t.geometry,this}intersectsFrustum(t){return t.intersectsObject(this)}raycast(t,n){let i=this.geometry,r=this.matrixWorld,s=t.params.Points.threshold,o=i.drawRange;if(i.boundingSphere===null&&i.computeBoundingSphere(),Bh.copy(i.boundingSphere),Bh.applyMatrix4(r),Bh.radius+=s,t.ray.intersectsSphere(Bh)===!1)return;uE.copy(r).invert(),D_.copy(t.ray).applyMatrix4(uE);let a=s/((this.scale.x+this.scale.y+this.scale.z)/3),c=a*a,l=i.index,h=i.attributes.position;if(l!==null){let f=Math.max(0,o.start),d=Math.min(l.count,o.start+o.count);for(let p=f,y=d;p<y;p++){let m=l.getX(p);kh.fromBufferAttribute(h,m),fE(kh,m,c,r,t,n,this)}}else{let f=Math.max(0,o.start),d=Math.min(h.count,o.start+o.count);for(let p=f,y=d;p<y;p++)kh.fromBufferAttribute(h,p),fE(kh,p,c,r,t,n,this)}}updateMorphTargets(){let n=this.geometry.morphAttributes,i=Object.keys(n);if(i.length>0){let r=n[i[0]];if(r!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let s=0,o=r.length;s<o;s++){let a=r[s].name||String(s);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=s}}}}};function fE(e,t,n,i,r,s,o){let a=D_.distanceSqToPoint(e);if(a<n){let c=new k;D_.closestPointToPoint(e,c),c.applyMatrix4(i);let l=r.ray.origin.distanceTo(c);if(l<r.near||l>r.far)return;s.push({distance:l,distanceToRay:Math.sqrt(a),point:c,index:t,face:null,faceIndex:null,barycoord:null,object:o})}}var Fl=class extends Dn{constructor(t=[],n=Po,i,r,s,o,a,c,l,u){super(t,n,i,r,s,o,a,c,l,u),this.isCubeTexture=!0,this.flipY=!1}get images(){return this.image}set images(t){this.image=t}},Ol=class extends Dn{constructor(t,n,i,r,s,o,a,c,l){super(t,n,i,r,s,o,a,c,l),this.isCanvasTexture=!0,this.needsUpdate=!0}};var Zr=class extends Dn{constructor(t,n,i=Hi,r,s,o,a=an,c=an,l,u=Xr,h=1){if(u!==Xr&&u!==Kr)throw new Error("THREE.DepthTexture: format must be either THREE.DepthFormat or THREE.DepthStencilFormat");let f={width:t,height:n,depth:h};super(f,r,s,o,a,c,u,i,l),this.isDepthTexture=!0,this.flipY=!1,this.generateMipmaps=!1,this.compareFunction=null}copy(t){return super.copy(t),this.source=new ja(Object.assign({},t.image)),this.compareFunction=t.compareFunction,this}toJSON(t){let n=super.toJSON(t);return n.compareFunction=this.compareFunction,n}},Bl=class extends Zr{constructor(t,n=Hi,i=Po,r,s,o=an,a=an,c,l=Xr){let u={width:t,height:t,depth:1},h=[u,u,u,u,u,u];super(t,t,n,i,r,s,o,a,c,l),this.image=h,this.isCubeDepthTexture=!0,this.isCubeTexture=!0}get images(){return this.image}set images(t){this.image=t}},kl=class extends Dn{constructor(t=null){super(),this.sourceTexture=t,this.isExternalTexture=!0}copy(t){return super.copy(t),this.sourceTexture=t.sourceTexture,this}},Rs=class e extends De{constructor(t=1,n=1,i=1,r=1,s=1,o=1){super(),this.type="BoxGeometry",this.parameters={width:t,height:n,depth:i,widthSegments:r,heightSegments:s,depthSegments:o};let a=this;r=Math.floor(r),s=Math.floor(s),o=Math.floor(o);let c=[],l=[],u=[],h=[],f=0,d=0;p("z","y","x",-1,-1,i,n,t,o,s,0),p("z","y","x",1,-1,i,n,-t,o,s,1),p("x","z","y",1,1,t,i,n,r,o,2),p("x","z","y",1,-1,t,i,-n,r,o,3),p("x","y","z",1,-1,t,n,i,r,s,4),p("x","y","z",-1,-1,t,n,-i,r,s,5),this.setIndex(c),this.setAttribute("position",new ge(l,3)),this.setAttribute("normal",new ge(u,3)),this.setAttribute("uv",new ge(h,2));function p(y,m,g,x,S,v,w,b,_,M,C){let E=v/_,I=w/M,R=v/2,U=w/2,P=b/2,L=_+1,O=M+1,D=0,Y=0,B=new k;for(let V=0;V<O;V++){let q=V*I-U;for(let rt=0;rt<L;rt++){let ct=rt*E-R;B[y]=ct*x,B[m]=q*S,B[g]=P,l.push(B.x,B.y,B.z),B[y]=0,B[m]=0,B[g]=b>0?1:-1,u.push(B.x,B.y,B.z),h.push(rt/_),h.push(1-V/M),D+=1}}for(let V=0;V<M;V++)for(let q=0;q<_;q++){let rt=f+q+L*V,ct=f+q+L*(V+1),$=f+(q+1)+L*(V+1),ot=f+(q+1)+L*V;c.push(rt,ct,ot),c.push(ct,$,ot),Y+=6}a.addGroup(d,Y,C),d+=Y,f+=D}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new e(t.width,t.height,t.depth,t.widthSegments,t.heightSegments,t.depthSegments)}},nc=class e extends De{constructor(t=1,n=1,i=4,r=8,s=1){super(),this.type="CapsuleGeometry",this.parameters={radius:t,height:n,capSegments:i,radialSegments:r,heightSegments:s},n=Math.max(0,n),i=Math.max(1,Math.floor(i)),r=Math.max(3,Math.floor(r)),s=Math.max(1,Math.floor(s));let o=[],a=[],c=[],l=[],u=n/2,h=Math.PI/2*t,f=n,d=2*h+f,p=i*2+s,y=r+1,m=new k,g=new k;for(let x=0;x<=p;x++){let S=0,v=0,w=0,b=0;if(x<=i){let C=x/i,E=C*Math.PI/2;v=-u-t*Math.cos(E),w=t*Math.sin(E),b=-t*Math.cos(E),S=C*h}else if(x<=i+s){let C=(x-i)/s;v=-u+C*n,w=t,b=0,S=h+C*f}else{let C=(x-i-s)/i,E=C*Math.PI/2;v=u+t*Math.sin(E),w=t*Math.cos(E),b=t*Math.sin(E),S=h+f+C*h}let _=Math.max(0,Math.min(1,S/d)),M=0;x===0?M=.5/r:x===p&&(M=-.5/r);for(let C=0;C<=r;C++){let E=C/r,I=E*Math.PI*2,R=Math.sin(I),U=Math.cos(I);g.x=-w*U,g.y=v,g.z=w*R,a.push(g.x,g.y,g.z),m.set(-w*U,b,w*R),m.normalize(),c.push(m.x,m.y,m.z),l.push(E+M,_)}if(x>0){let C=(x-1)*y;for(let E=0;E<r;E++){let I=C+E,R=C+E+1,U=x*y+E,P=x*y+E+1;o.push(I,R,U),o.push(R,P,U)}}}this.setIndex(o),this.setAttribute("position",new ge(a,3)),this.setAttribute("normal",new ge(c,3)),this.setAttribute("uv",new ge(l,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new e(t.radius,t.height,t.capSegments,t.radialSegments,t.heightSegments)}};var zl=class e extends De{constructor(t=1,n=1,i=1,r=32,s=1,o=!1,a=0,c=Math.PI*2){super(),this.type="CylinderGeometry",this.parameters={radiusTop:t,radiusBottom:n,height:i,radialSegments:r,heightSegments:s,openEnded:o,thetaStart:a,thetaLength:c};let l=this;r=Math.floor(r),s=Math.floor(s);let u=[],h=[],f=[],d=[],p=0,y=[],m=i/2,g=0;x(),o===!1&&(t>0&&S(!0),n>0&&S(!1)),this.setIndex(u),this.setAttribute("position",new ge(h,3)),this.setAttribute("normal",new ge(f,3)),this.setAttribute("uv",new ge(d,2));function x(){let v=new k,w=new k,b=0,_=(n-t)/i;for(let M=0;M<=s;M++){let C=[],E=M/s,I=E*(n-t)+t;for(let R=0;R<=r;R++){let U=R/r,P=U*c+a,L=Math.sin(P),O=Math.cos(P);w.x=I*L,w.y=-E*i+m,w.z=I*O,h.push(w.x,w.y,w.z),v.set(L,_,O).normalize(),f.push(v.x,v.y,v.z),d.push(U,1-E),C.push(p++)}y.push(C)}for(let M=0;M<r;M++)for(let C=0;C<s;C++){let E=y[C][M],I=y[C+1][M],R=y[C+1][M+1],U=y[C][M+1];(t>0||C!==0)&&(u.push(E,I,U),b+=3),(n>0||C!==s-1)&&(u.push(I,R,U),b+=3)}l.addGroup(g,b,0),g+=b}function S(v){let w=p,b=new Ft,_=new k,M=0,C=v===!0?t:n,E=v===!0?1:-1;for(let R=1;R<=r;R++)h.push(0,m*E,0),f.push(0,E,0),d.push(.5,.5),p++;let I=p;for(let R=0;R<=r;R++){let P=R/r*c+a,L=Math.cos(P),O=Math.sin(P);_.x=C*O,_.y=m*E,_.z=C*L,h.push(_.x,_.y,_.z),f.push(0,E,0),b.x=L*.5+.5,b.y=O*.5*E+.5,d.push(b.x,b.y),p++}for(let R=0;R<r;R++){let U=w+R,P=I+R;v===!0?u.push(P,P+1,U):u.push(P+1,P,U),M+=3}l.addGroup(g,M,v===!0?1:2),g+=M}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new e(t.radiusTop,t.radiusBottom,t.height,t.radialSegments,t.heightSegments,t.openEnded,t.thetaStart,t.thetaLength)}};var Eo=class e extends De{constructor(t=1,n=1,i=1,r=1){super(),this.type="PlaneGeometry",this.parameters={width:t,height:n,widthSegments:i,heightSegments:r};let s=t/2,o=n/2,a=Math.floor(i),c=Math.floor(r),l=a+1,u=c+1,h=t/a,f=n/c,d=[],p=[],y=[],m=[];for(let g=0;g<u;g++){let x=g*f-o;for(let S=0;S<l;S++){let v=S*h-s;p.push(v,-x,0),y.push(0,0,1),m.push(S/a),m.push(1-g/c)}}for(let g=0;g<c;g++)for(let x=0;x<a;x++){let S=x+l*g,v=x+l*(g+1),w=x+1+l*(g+1),b=x+1+l*g;d.push(S,v,b),d.push(v,w,b)}this.setIndex(d),this.setAttribute("position",new ge(p,3)),this.setAttribute("normal",new ge(y,3)),this.setAttribute("uv",new ge(m,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new e(t.width,t.height,t.widthSegments,t.heightSegments)}};var Ps=class e extends De{constructor(t=1,n=32,i=16,r=0,s=Math.PI*2,o=0,a=Math.PI){super(),this.type="SphereGeometry",this.parameters={radius:t,widthSegments:n,heightSegments:i,phiStart:r,phiLength:s,thetaStart:o,thetaLength:a},n=Math.max(3,Math.floor(n)),i=Math.max(2,Math.floor(i));let c=Math.min(o+a,Math.PI),l=0,u=[],h=new k,f=new k,d=[],p=[],y=[],m=[];for(let g=0;g<=i;g++){let x=[],S=g/i,v=o+S*a,w=t*Math.cos(v),b=Math.sqrt(t*t-w*w),_=0;g===0&&o===0?_=.5/n:g===i&&c===Math.PI&&(_=-.5/n);for(let M=0;M<=n;M++){let C=M/n,E=r+C*s;h.x=-b*Math.cos(E),h.y=w,h.z=b*Math.sin(E),p.push(h.x,h.y,h.z),f.copy(h).normalize(),y.push(f.x,f.y,f.z),m.push(C+_,1-S),x.push(l++)}u.push(x)}for(let g=0;g<i;g++)for(let x=0;x<n;x++){let S=u[g][x+1],v=u[g][x],w=u[g+1][x],b=u[g+1][x+1];(g!==0||o>0)&&d.push(S,v,b),(g!==i-1||c<Math.PI)&&d.push(v,w,b)}this.setIndex(d),this.setAttribute("position",new ge(p,3)),this.setAttribute("normal",new ge(y,3)),this.setAttribute("uv",new ge(m,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new e(t.radius,t.widthSegments,t.heightSegments,t.phiStart,t.phiLength,t.thetaStart,t.thetaLength)}};var Gl=class extends De{constructor(t=null){if(super(),this.type="WireframeGeometry",this.parameters={geometry:t},t!==null){let n=[],i=new Set,r=new k,s=new k;if(t.index!==null){let o=t.attributes.position,a=t.index,c=t.groups;c.length===0&&(c=[{start:0,count:a.count,materialIndex:0}]);for(let l=0,u=c.length;l<u;++l){let h=c[l],f=h.start,d=h.count;for(let p=f,y=f+d;p<y;p+=3)for(let m=0;m<3;m++){let g=a.getX(p+m),x=a.getX(p+(m+1)%3);r.fromBufferAttribute(o,g),s.fromBufferAttribute(o,x),hE(r,s,i)===!0&&(n.push(r.x,r.y,r.z),n.push(s.x,s.y,s.z))}}}else{let o=t.attributes.position;for(let a=0,c=o.count/3;a<c;a++)for(let l=0;l<3;l++){let u=3*a+l,h=3*a+(l+1)%3;r.fromBufferAttribute(o,u),s.fromBufferAttribute(o,h),hE(r,s,i)===!0&&(n.push(r.x,r.y,r.z),n.push(s.x,s.y,s.z))}}this.setAttribute("position",new ge(n,3))}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}};function hE(e,t,n){let i=`${e.x},${e.y},${e.z}-${t.x},${t.y},${t.z}`,r=`${t.x},${t.y},${t.z}-${e.x},${e.y},${e.z}`;return n.has(i)===!0||n.has(r)===!0?!1:(n.add(i),n.add(r),!0)}function Lo(e){let t={};for(let n in e){t[n]={};for(let i in e[n]){let r=e[n][i];if(dE(r))r.isRenderTargetTexture?(Ut("UniformsUtils: Textures of render targets cannot be cloned via cloneUniforms() or mergeUniforms()."),t[n][i]=null):t[n][i]=r.clone();else if(Array.isArray(r))if(dE(r[0])){let s=[];for(let o=0,a=r.length;o<a;o++)s[o]=r[o].clone();t[n][i]=s}else t[n][i]=r.slice();else t[n][i]=r}}return t}function wn(e){let t={};for(let n=0;n<e.length;n++){let i=Lo(e[n]);for(let r in i)t[r]=i[r]}return t}function dE(e){return e&&(e.isColor||e.isMatrix3||e.isMatrix4||e.isVector2||e.isVector3||e.isVector4||e.isTexture||e.isQuaternion)}function JU(e){let t=[];for(let n=0;n<e.length;n++)t.push(e[n].clone());return t}function px(e){let t=e.getRenderTarget();return t===null?e.outputColorSpace:t.isXRRenderTarget===!0?t.texture.colorSpace:re.workingColorSpace}var au={clone:Lo,merge:wn},KU=`void main() {
	gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
}`,jU=`void main() {
	gl_FragColor = vec4( 1.0, 0.0, 0.0, 1.0 );
}`,Ci=class extends mr{constructor(t){super(),this.isShaderMaterial=!0,this.type="ShaderMaterial",this.defines={},this.uniforms={},this.uniformsGroups=[],this.vertexShader=KU,this.fragmentShader=jU,this.linewidth=1,this.wireframe=!1,this.wireframeLinewidth=1,this.fog=!1,this.lights=!1,this.clipping=!1,this.forceSinglePass=!0,this.extensions={clipCullDistance:!1,multiDraw:!1},this.defaultAttributeValues={color:[1,1,1],uv:[0,0],uv1:[0,0]},this.index0AttributeName=void 0,this.uniformsNeedUpdate=!1,this.glslVersion=null,t!==void 0&&this.setValues(t)}copy(t){return super.copy(t),this.fragmentShader=t.fragmentShader,this.vertexShader=t.vertexShader,this.uniforms=Lo(t.uniforms),this.uniformsGroups=JU(t.uniformsGroups),this.defines=Object.assign({},t.defines),this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.fog=t.fog,this.lights=t.lights,this.clipping=t.clipping,this.extensions=Object.assign({},t.extensions),this.glslVersion=t.glslVersion,this.defaultAttributeValues=Object.assign({},t.defaultAttributeValues),this.index0AttributeName=t.index0AttributeName,this.uniformsNeedUpdate=t.uniformsNeedUpdate,this}toJSON(t){let n=super.toJSON(t);n.glslVersion=this.glslVersion,n.uniforms={};for(let r in this.uniforms){let o=this.uniforms[r].value;o&&o.isTexture?n.uniforms[r]={type:"t",value:o.toJSON(t).uuid}:o&&o.isColor?n.uniforms[r]={type:"c",value:o.getHex()}:o&&o.isVector2?n.uniforms[r]={type:"v2",value:o.toArray()}:o&&o.isVector3?n.uniforms[r]={type:"v3",value:o.toArray()}:o&&o.isVector4?n.uniforms[r]={type:"v4",value:o.toArray()}:o&&o.isMatrix3?n.uniforms[r]={type:"m3",value:o.toArray()}:o&&o.isMatrix4?n.uniforms[r]={type:"m4",value:o.toArray()}:n.uniforms[r]={value:o}}Object.keys(this.defines).length>0&&(n.defines=this.defines),n.vertexShader=this.vertexShader,n.fragmentShader=this.fragmentShader,n.lights=this.lights,n.clipping=this.clipping;let i={};for(let r in this.extensions)this.extensions[r]===!0&&(i[r]=!0);return Object.keys(i).length>0&&(n.extensions=i),n}fromJSON(t,n){if(super.fromJSON(t,n),t.uniforms!==void 0)for(let i in t.uniforms){let r=t.uniforms[i];switch(this.uniforms[i]={},r.type){case"t":this.uniforms[i].value=n[r.value]||null;break;case"c":this.uniforms[i].value=new Wt().setHex(r.value);break;case"v2":this.uniforms[i].value=new Ft().fromArray(r.value);break;case"v3":this.uniforms[i].value=new k().fromArray(r.value);break;case"v4":this.uniforms[i].value=new pe().fromArray(r.value);break;case"m3":this.uniforms[i].value=new zt().fromArray(r.value);break;case"m4":this.uniforms[i].value=new ee().fromArray(r.value);break;default:this.uniforms[i].value=r.value}}if(t.defines!==void 0&&(this.defines=t.defines),t.vertexShader!==void 0&&(this.vertexShader=t.vertexShader),t.fragmentShader!==void 0&&(this.fragmentShader=t.fragmentShader),t.glslVersion!==void 0&&(this.glslVersion=t.glslVersion),t.extensions!==void 0)for(let i in t.extensions)this.extensions[i]=t.extensions[i];return t.lights!==void 0&&(this.lights=t.lights),t.clipping!==void 0&&(this.clipping=t.clipping),this}},fd=class extends Ci{constructor(t){super(t),this.isRawShaderMaterial=!0,this.type="RawShaderMaterial"}};var Is=class extends mr{constructor(t){super(),this.isMeshLambertMaterial=!0,this.type="MeshLambertMaterial",this.color=new Wt(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.emissive=new Wt(0),this.emissiveIntensity=1,this.emissiveMap=null,this.bumpMap=null,this.bumpScale=1,this.normalMap=null,this.normalMapType=hp,this.normalScale=new Ft(1,1),this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new qr,this.combine=Ad,this.reflectivity=1,this.envMapIntensity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.flatShading=!1,this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.lightMap=t.lightMap,this.lightMapIntensity=t.lightMapIntensity,this.aoMap=t.aoMap,this.aoMapIntensity=t.aoMapIntensity,this.emissive.copy(t.emissive),this.emissiveMap=t.emissiveMap,this.emissiveIntensity=t.emissiveIntensity,this.bumpMap=t.bumpMap,this.bumpScale=t.bumpScale,this.normalMap=t.normalMap,this.normalMapType=t.normalMapType,this.normalScale.copy(t.normalScale),this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this.specularMap=t.specularMap,this.alphaMap=t.alphaMap,this.envMap=t.envMap,this.envMapRotation.copy(t.envMapRotation),this.combine=t.combine,this.reflectivity=t.reflectivity,this.envMapIntensity=t.envMapIntensity,this.refractionRatio=t.refractionRatio,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.wireframeLinecap=t.wireframeLinecap,this.wireframeLinejoin=t.wireframeLinejoin,this.flatShading=t.flatShading,this.fog=t.fog,this}},hd=class extends mr{constructor(t){super(),this.isMeshDepthMaterial=!0,this.type="MeshDepthMaterial",this.depthPacking=$E,this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.wireframe=!1,this.wireframeLinewidth=1,this.setValues(t)}copy(t){return super.copy(t),this.depthPacking=t.depthPacking,this.map=t.map,this.alphaMap=t.alphaMap,this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this}},dd=class extends mr{constructor(t){super(),this.isMeshDistanceMaterial=!0,this.type="MeshDistanceMaterial",this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.setValues(t)}copy(t){return super.copy(t),this.map=t.map,this.alphaMap=t.alphaMap,this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this}};function Va(e,t){return!e||e.constructor===t?e:typeof t.BYTES_PER_ELEMENT=="number"?new t(e):Array.prototype.slice.call(e)}function zh(e){return e!==void 0&&e.inTangents!==void 0&&e.outTangents!==void 0}var Ls=class{constructor(t,n,i,r){this.parameterPositions=t,this._cachedIndex=0,this.resultBuffer=r!==void 0?r:new n.constructor(i),this.sampleValues=n,this.valueSize=i,this.settings=null,this.DefaultSettings_={}}evaluate(t){let n=this.parameterPositions,i=this._cachedIndex,r=n[i],s=n[i-1];t:{e:{let o;n:{i:if(!(t<r)){for(let a=i+2;;){if(r===void 0){if(t<s)break i;return i=n.length,this._cachedIndex=i,this.copySampleValue_(i-1)}if(i===a)break;if(s=r,r=n[++i],t<r)break e}o=n.length;break n}if(!(t>=s)){let a=n[1];t<a&&(i=2,s=a);for(let c=i-2;;){if(s===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(i===c)break;if(r=s,s=n[--i-1],t>=s)break e}o=i,i=0;break n}break t}for(;i<o;){let a=i+o>>>1;t<n[a]?o=a:i=a+1}if(r=n[i],s=n[i-1],s===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(r===void 0)return i=n.length,this._cachedIndex=i,this.copySampleValue_(i-1)}this._cachedIndex=i,this.intervalChanged_(i,s,r)}return this.interpolate_(i,s,t,r)}getSettings_(){return this.settings||this.DefaultSettings_}copySampleValue_(t){let n=this.resultBuffer,i=this.sampleValues,r=this.valueSize,s=t*r;for(let o=0;o!==r;++o)n[o]=i[s+o];return n}interpolate_(){throw new Error("THREE.Interpolant: Call to abstract method.")}intervalChanged_(){}},pd=class extends Ls{constructor(t,n,i,r){super(t,n,i,r),this._weightPrev=-0,this._offsetPrev=-0,this._weightNext=-0,this._offsetNext=-0,this.DefaultSettings_={endingStart:I_,endingEnd:I_}}intervalChanged_(t,n,i){let r=this.parameterPositions,s=t-2,o=t+1,a=r[s],c=r[o];if(a===void 0)switch(this.getSettings_().endingStart){case L_:s=t,a=2*n-i;break;case N_:s=r.length-2,a=n+r[s]-r[s+1];break;default:s=t,a=i}if(c===void 0)switch(this.getSettings_().endingEnd){case L_:o=t,c=2*i-n;break;case N_:o=1,c=i+r[1]-r[0];break;default:o=t-1,c=n}let l=(i-n)*.5,u=this.valueSize;this._weightPrev=l/(n-a),this._weightNext=l/(c-i),this._offsetPrev=s*u,this._offsetNext=o*u}interpolate_(t,n,i,r){let s=this.resultBuffer,o=this.sampleValues,a=this.valueSize,c=t*a,l=c-a,u=this._offsetPrev,h=this._offsetNext,f=this._weightPrev,d=this._weightNext,p=(i-n)/(r-n),y=p*p,m=y*p,g=-f*m+2*f*y-f*p,x=(1+f)*m+(-1.5-2*f)*y+(-.5+f)*p+1,S=(-1-d)*m+(1.5+d)*y+.5*p,v=d*m-d*y;for(let w=0;w!==a;++w)s[w]=g*o[u+w]+x*o[l+w]+S*o[c+w]+v*o[h+w];return s}},md=class extends Ls{constructor(t,n,i,r){super(t,n,i,r)}interpolate_(t,n,i,r){let s=this.resultBuffer,o=this.sampleValues,a=this.valueSize,c=t*a,l=c-a,u=(i-n)/(r-n),h=1-u;for(let f=0;f!==a;++f)s[f]=o[l+f]*h+o[c+f]*u;return s}},gd=class extends Ls{constructor(t,n,i,r){super(t,n,i,r)}interpolate_(t){return this.copySampleValue_(t-1)}},yd=class extends Ls{interpolate_(t,n,i,r){let s=this.resultBuffer,o=this.sampleValues,a=this.valueSize,c=t*a,l=c-a,u=this.inTangents,h=this.outTangents;if(!u||!h){let p=(i-n)/(r-n),y=1-p;for(let m=0;m!==a;++m)s[m]=o[l+m]*y+o[c+m]*p;return s}let f=a*2,d=t-1;for(let p=0;p!==a;++p){let y=o[l+p],m=o[c+p],g=d*f+p*2,x=h[g],S=h[g+1],v=t*f+p*2,w=u[v],b=u[v+1],_=tF(i,n,x,w,r);s[p]=r2(_,y,S,b,m)}return s}};function r2(e,t,n,i,r){let s=1-e;return s*s*s*t+3*s*s*e*n+3*s*e*e*i+e*e*e*r}function QU(e,t,n,i,r){let s=1-e;return 3*s*s*(n-t)+6*s*e*(i-n)+3*e*e*(r-i)}function tF(e,t,n,i,r){let s=(e-t)/(r-t);for(let o=0;o<8;o++){let a=r2(s,t,n,i,r)-e;if(Math.abs(a)<1e-10)break;let c=QU(s,t,n,i,r);if(Math.abs(c)<1e-10)break;s=Math.max(0,Math.min(1,s-a/c))}return s}var ni=class{constructor(t,n,i,r){if(t===void 0)throw new Error("THREE.KeyframeTrack: track name is undefined");if(n===void 0||n.length===0)throw new Error("THREE.KeyframeTrack: no keyframes in track named "+t);this.name=t,this.times=Va(n,this.TimeBufferType),this.values=Va(i,this.ValueBufferType),this.setInterpolation(r||this.DefaultInterpolation)}static toJSON(t){let n=t.constructor,i;if(n.toJSON!==this.toJSON)i=n.toJSON(t);else{i={name:t.name,times:Va(t.times,Array),values:Va(t.values,Array)};let r=t.getInterpolation();r!==t.DefaultInterpolation&&(i.interpolation=r),zh(t.settings)&&(i.settings={inTangents:Va(t.settings.inTangents,Array),outTangents:Va(t.settings.outTangents,Array)})}return i.type=t.ValueTypeName,i}InterpolantFactoryMethodDiscrete(t){return new gd(this.times,this.values,this.getValueSize(),t)}InterpolantFactoryMethodLinear(t){return new md(this.times,this.values,this.getValueSize(),t)}InterpolantFactoryMethodSmooth(t){return new pd(this.times,this.values,this.getValueSize(),t)}InterpolantFactoryMethodBezier(t){let n=new yd(this.times,this.values,this.getValueSize(),t);return this.settings&&(n.inTangents=this.settings.inTangents,n.outTangents=this.settings.outTangents),n}setInterpolation(t){let n;switch(t){case Tl:n=this.InterpolantFactoryMethodDiscrete;break;case ed:n=this.InterpolantFactoryMethodLinear;break;case Wh:n=this.InterpolantFactoryMethodSmooth;break;case P_:n=this.InterpolantFactoryMethodBezier;break}if(n===void 0){let i="unsupported interpolation for "+this.ValueTypeName+" keyframe track named "+this.name;if(this.createInterpolant===void 0)if(t!==this.DefaultInterpolation)this.setInterpolation(this.DefaultInterpolation);else throw new Error(i);return Ut("KeyframeTrack:",i),this}return this.createInterpolant=n,this}getInterpolation(){switch(this.createInterpolant){case this.InterpolantFactoryMethodDiscrete:return Tl;case this.InterpolantFactoryMethodLinear:return ed;case this.InterpolantFactoryMethodSmooth:return Wh;case this.InterpolantFactoryMethodBezier:return P_}}getValueSize(){return this.values.length/this.times.length}shift(t){if(t!==0){let n=this.times;for(let i=0,r=n.length;i!==r;++i)n[i]+=t;zh(this.settings)&&(pE(this.settings.inTangents,t),pE(this.settings.outTangents,t))}return this}scale(t){if(t!==1){let n=this.times;for(let i=0,r=n.length;i!==r;++i)n[i]*=t;zh(this.settings)&&(mE(this.settings.inTangents,t),mE(this.settings.outTangents,t))}return this}trim(t,n){let i=this.times,r=i.length,s=0,o=r-1;for(;s!==r&&i[s]<t;)++s;for(;o!==-1&&i[o]>n;)--o;if(++o,s!==0||o!==r){s>=o&&(o=Math.max(o,1),s=o-1);let a=this.getValueSize();this.times=i.slice(s,o),this.values=this.values.slice(s*a,o*a)}return this}validate(){let t=!0,n=this.getValueSize();n-Math.floor(n)!==0&&(kt("KeyframeTrack: Invalid value size in track.",this),t=!1);let i=this.times,r=this.values,s=i.length;s===0&&(kt("KeyframeTrack: Track is empty.",this),t=!1);let o=null;for(let a=0;a!==s;a++){let c=i[a];if(typeof c=="number"&&isNaN(c)){kt("KeyframeTrack: Time is not a valid number.",this,a,c),t=!1;break}if(o!==null&&o>c){kt("KeyframeTrack: Out of order keys.",this,a,c,o),t=!1;break}o=c}if(r!==void 0&&gU(r))for(let a=0,c=r.length;a!==c;++a){let l=r[a];if(isNaN(l)){kt("KeyframeTrack: Value is not a valid number.",this,a,l),t=!1;break}}return t}optimize(){let t=this.times.slice(),n=this.values.slice(),i=this.getValueSize(),r=this.getInterpolation()===Wh,s=t.length-1,o=1;for(let a=1;a<s;++a){let c=!1,l=t[a],u=t[a+1];if(l!==u&&(a!==1||l!==t[0]))if(r)c=!0;else{let h=a*i,f=h-i,d=h+i;for(let p=0;p!==i;++p){let y=n[h+p];if(y!==n[f+p]||y!==n[d+p]){c=!0;break}}}if(c){if(a!==o){t[o]=t[a];let h=a*i,f=o*i;for(let d=0;d!==i;++d)n[f+d]=n[h+d]}++o}}if(s>0){t[o]=t[s];for(let a=s*i,c=o*i,l=0;l!==i;++l)n[c+l]=n[a+l];++o}return o!==t.length?(this.times=t.slice(0,o),this.values=n.slice(0,o*i)):(this.times=t,this.values=n),this}clone(){let t=this.times.slice(),n=this.values.slice(),i=this.constructor,r=new i(this.name,t,n);return r.createInterpolant=this.createInterpolant,zh(this.settings)&&(r.settings={inTangents:this.settings.inTangents.slice(),outTangents:this.settings.outTangents.slice()}),r}};function pE(e,t){for(let n=0,i=e.length;n!==i;n+=2)e[n]+=t}function mE(e,t){for(let n=0,i=e.length;n!==i;n+=2)e[n]*=t}ni.prototype.ValueTypeName="";ni.prototype.TimeBufferType=Float32Array;ni.prototype.ValueBufferType=Float32Array;ni.prototype.DefaultInterpolation=ed;var Ns=class extends ni{constructor(t,n,i){super(t,n,i)}};Ns.prototype.ValueTypeName="bool";Ns.prototype.ValueBufferType=Array;Ns.prototype.DefaultInterpolation=Tl;Ns.prototype.InterpolantFactoryMethodLinear=void 0;Ns.prototype.InterpolantFactoryMethodSmooth=void 0;var _d=class extends ni{constructor(t,n,i,r){super(t,n,i,r)}};_d.prototype.ValueTypeName="color";var xd=class extends ni{constructor(t,n,i,r){super(t,n,i,r)}};xd.prototype.ValueTypeName="number";var vd=class extends Ls{constructor(t,n,i,r){super(t,n,i,r)}interpolate_(t,n,i,r){let s=this.resultBuffer,o=this.sampleValues,a=this.valueSize,c=(i-n)/(r-n),l=t*a;for(let u=l+a;l!==u;l+=4)Sn.slerpFlat(s,0,o,l-a,o,l,c);return s}},Vl=class extends ni{constructor(t,n,i,r){super(t,n,i,r)}InterpolantFactoryMethodLinear(t){return new vd(this.times,this.values,this.getValueSize(),t)}};Vl.prototype.ValueTypeName="quaternion";Vl.prototype.InterpolantFactoryMethodSmooth=void 0;var Ds=class extends ni{constructor(t,n,i){super(t,n,i)}};Ds.prototype.ValueTypeName="string";Ds.prototype.ValueBufferType=Array;Ds.prototype.DefaultInterpolation=Tl;Ds.prototype.InterpolantFactoryMethodLinear=void 0;Ds.prototype.InterpolantFactoryMethodSmooth=void 0;var bd=class extends ni{constructor(t,n,i,r){super(t,n,i,r)}};bd.prototype.ValueTypeName="vector";var Md=class{constructor(t,n,i){let r=this,s=!1,o=0,a=0,c,l=[];this.onStart=void 0,this.onLoad=t,this.onProgress=n,this.onError=i,this._abortController=null,this.itemStart=function(u){a++,s===!1&&r.onStart!==void 0&&r.onStart(u,o,a),s=!0},this.itemEnd=function(u){o++,r.onProgress!==void 0&&r.onProgress(u,o,a),o===a&&(s=!1,r.onLoad!==void 0&&r.onLoad())},this.itemError=function(u){r.onError!==void 0&&r.onError(u)},this.resolveURL=function(u){return u=u.normalize("NFC"),c?c(u):u},this.setURLModifier=function(u){return c=u,this},this.addHandler=function(u,h){return l.push(u,h),this},this.removeHandler=function(u){let h=l.indexOf(u);return h!==-1&&l.splice(h,2),this},this.getHandler=function(u){for(let h=0,f=l.length;h<f;h+=2){let d=l[h],p=l[h+1];if(d.global&&(d.lastIndex=0),d.test(u))return p}return null},this.abort=function(){return this.abortController.abort(),this._abortController=null,this}}get abortController(){return this._abortController||(this._abortController=new AbortController),this._abortController}},s2=new Md,Sd=class{constructor(t){this.manager=t!==void 0?t:s2,this.crossOrigin="anonymous",this.withCredentials=!1,this.path="",this.resourcePath="",this.requestHeader={},this.priority="auto",this.cache="default",typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}load(){}loadAsync(t,n){let i=this;return new Promise(function(r,s){i.load(t,r,n,s)})}parse(){}setCrossOrigin(t){return this.crossOrigin=t,this}setWithCredentials(t){return this.withCredentials=t,this}setPath(t){return this.path=t,this}setResourcePath(t){return this.resourcePath=t,this}setRequestHeader(t){return this.requestHeader=t,this}setPriority(t){return this.priority=t,this}setCache(t){return this.cache=t,this}abort(){return this}};Sd.DEFAULT_MATERIAL_NAME="__DEFAULT";var Hl=class extends dn{static registerNode(t){this.prototype._lightNode=t}constructor(t,n=1){super(),this.isLight=!0,this.type="Light",this.color=new Wt(t),this.intensity=n}copy(t,n){return super.copy(t,n),this.color.copy(t.color),this.intensity=t.intensity,this}toJSON(t){let n=super.toJSON(t);return n.object.color=this.color.getHex(),n.object.intensity=this.intensity,n}};var C_=new ee,gE=new k,yE=new k,wd=class{constructor(t){this.camera=t,this.intensity=1,this.bias=0,this.biasNode=null,this.normalBias=0,this.radius=1,this.blurSamples=8,this.mapSize=new Ft(512,512),this.mapType=Hn,this.map=null,this.mapPass=null,this.matrix=new ee,this.autoUpdate=!0,this.needsUpdate=!1,this._frustum=new Es,this._frameExtents=new Ft(1,1),this._viewportCount=1,this._viewports=[new pe(0,0,1,1)]}getViewportCount(){return this._viewportCount}getCamera(){return this.camera}getFrustum(){return this._frustum}updateMatrices(t){let n=this.camera;gE.setFromMatrixPosition(t.matrixWorld),n.position.copy(gE),yE.setFromMatrixPosition(t.target.matrixWorld),n.lookAt(yE),n.updateMatrixWorld(),this._updateMatrix(n,this.matrix,this._frustum)}_updateMatrix(t,n,i,r){C_.multiplyMatrices(t.projectionMatrix,t.matrixWorldInverse),i.setFromProjectionMatrix(C_,t.coordinateSystem,t.reversedDepth);let s=this._frameExtents,o=r?r.z/s.x:1,a=r?r.w/s.y:1,c=r?r.x/s.x:0,l=r?r.y/s.y:0;t.coordinateSystem===Za||t.reversedDepth?n.set(.5*o,0,0,.5*o+c,0,.5*a,0,.5*a+l,0,0,1,0,0,0,0,1):n.set(.5*o,0,0,.5*o+c,0,.5*a,0,.5*a+l,0,0,.5,.5,0,0,0,1),n.multiply(C_)}getViewport(t){return this._viewports[t]}getFrameExtents(){return this._frameExtents}dispose(){this.map&&this.map.dispose(),this.mapPass&&this.mapPass.dispose()}copy(t){return this.camera=t.camera.clone(),this.intensity=t.intensity,this.bias=t.bias,this.radius=t.radius,this.autoUpdate=t.autoUpdate,this.needsUpdate=t.needsUpdate,this.normalBias=t.normalBias,this.blurSamples=t.blurSamples,this.mapSize.copy(t.mapSize),this.mapType=t.mapType,this.biasNode=t.biasNode,this}clone(){return new this.constructor().copy(this)}toJSON(){let t={};return t.intensity=this.intensity,t.bias=this.bias,t.normalBias=this.normalBias,t.radius=this.radius,t.blurSamples=this.blurSamples,t.mapSize=this.mapSize.toArray(),t.mapType=this.mapType,t.camera=this.camera.toJSON(!1).object,delete t.camera.matrix,t}},Gh=new k,Vh=new Sn,dr=new k,Wl=class extends dn{constructor(){super(),this.isCamera=!0,this.type="Camera",this.matrixWorldInverse=new ee,this.projectionMatrix=new ee,this.projectionMatrixInverse=new ee,this.coordinateSystem=Ai,this._reversedDepth=!1}get reversedDepth(){return this._reversedDepth}copy(t,n){return super.copy(t,n),this.matrixWorldInverse.copy(t.matrixWorldInverse),this.projectionMatrix.copy(t.projectionMatrix),this.projectionMatrixInverse.copy(t.projectionMatrixInverse),this.coordinateSystem=t.coordinateSystem,this}getWorldDirection(t){return super.getWorldDirection(t).negate()}updateMatrixWorld(t){super.updateMatrixWorld(t),this.matrixWorld.decompose(Gh,Vh,dr),dr.x===1&&dr.y===1&&dr.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(Gh,Vh,dr.set(1,1,1)).invert()}updateWorldMatrix(t,n,i=!1){super.updateWorldMatrix(t,n,i),this.matrixWorld.decompose(Gh,Vh,dr),dr.x===1&&dr.y===1&&dr.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(Gh,Vh,dr.set(1,1,1)).invert()}clone(){return new this.constructor().copy(this)}},ws=new k,_E=new Ft,xE=new Ft,Ln=class extends Wl{constructor(t=50,n=1,i=.1,r=2e3){super(),this.isPerspectiveCamera=!0,this.type="PerspectiveCamera",this.fov=t,this.zoom=1,this.near=i,this.far=r,this.focus=10,this.aspect=n,this.view=null,this.filmGauge=35,this.filmOffset=0,this.updateProjectionMatrix()}copy(t,n){return super.copy(t,n),this.fov=t.fov,this.zoom=t.zoom,this.near=t.near,this.far=t.far,this.focus=t.focus,this.aspect=t.aspect,this.view=t.view===null?null:Object.assign({},t.view),this.filmGauge=t.filmGauge,this.filmOffset=t.filmOffset,this}setFocalLength(t){let n=.5*this.getFilmHeight()/t;this.fov=Ka*2*Math.atan(n),this.updateProjectionMatrix()}getFocalLength(){let t=Math.tan(Sl*.5*this.fov);return .5*this.getFilmHeight()/t}getEffectiveFOV(){return Ka*2*Math.atan(Math.tan(Sl*.5*this.fov)/this.zoom)}getFilmWidth(){return this.filmGauge*Math.min(this.aspect,1)}getFilmHeight(){return this.filmGauge/Math.max(this.aspect,1)}getViewBounds(t,n,i){ws.set(-1,-1,.5).applyMatrix4(this.projectionMatrixInverse),n.set(ws.x,ws.y).multiplyScalar(-t/ws.z),ws.set(1,1,.5).applyMatrix4(this.projectionMatrixInverse),i.set(ws.x,ws.y).multiplyScalar(-t/ws.z)}getViewSize(t,n){return this.getViewBounds(t,_E,xE),n.subVectors(xE,_E)}setViewOffset(t,n,i,r,s,o){this.aspect=t/n,this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=t,this.view.fullHeight=n,this.view.offsetX=i,this.view.offsetY=r,this.view.width=s,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let t=this.near,n=t*Math.tan(Sl*.5*this.fov)/this.zoom,i=2*n,r=this.aspect*i,s=-.5*r,o=this.view;if(this.view!==null&&this.view.enabled){let c=o.fullWidth,l=o.fullHeight;s+=o.offsetX*r/c,n-=o.offsetY*i/l,r*=o.width/c,i*=o.height/l}let a=this.filmOffset;a!==0&&(s+=t*a/this.getFilmWidth()),this.projectionMatrix.makePerspective(s,s+r,n,n-i,t,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(t){let n=super.toJSON(t);return n.object.fov=this.fov,n.object.zoom=this.zoom,n.object.near=this.near,n.object.far=this.far,n.object.focus=this.focus,n.object.aspect=this.aspect,this.view!==null&&(n.object.view=Object.assign({},this.view)),n.object.filmGauge=this.filmGauge,n.object.filmOffset=this.filmOffset,n}};var $l=class extends Wl{constructor(t=-1,n=1,i=1,r=-1,s=.1,o=2e3){super(),this.isOrthographicCamera=!0,this.type="OrthographicCamera",this.zoom=1,this.view=null,this.left=t,this.right=n,this.top=i,this.bottom=r,this.near=s,this.far=o,this.updateProjectionMatrix()}copy(t,n){return super.copy(t,n),this.left=t.left,this.right=t.right,this.top=t.top,this.bottom=t.bottom,this.near=t.near,this.far=t.far,this.zoom=t.zoom,this.view=t.view===null?null:Object.assign({},t.view),this}setViewOffset(t,n,i,r,s,o){this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=t,this.view.fullHeight=n,this.view.offsetX=i,this.view.offsetY=r,this.view.width=s,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let t=(this.right-this.left)/(2*this.zoom),n=(this.top-this.bottom)/(2*this.zoom),i=(this.right+this.left)/2,r=(this.top+this.bottom)/2,s=i-t,o=i+t,a=r+n,c=r-n;if(this.view!==null&&this.view.enabled){let l=(this.right-this.left)/this.view.fullWidth/this.zoom,u=(this.top-this.bottom)/this.view.fullHeight/this.zoom;s+=l*this.view.offsetX,o=s+l*this.view.width,a-=u*this.view.offsetY,c=a-u*this.view.height}this.projectionMatrix.makeOrthographic(s,o,a,c,this.near,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(t){let n=super.toJSON(t);return n.object.zoom=this.zoom,n.object.left=this.left,n.object.right=this.right,n.object.top=this.top,n.object.bottom=this.bottom,n.object.near=this.near,n.object.far=this.far,this.view!==null&&(n.object.view=Object.assign({},this.view)),n}},U_=class extends wd{constructor(){super(new $l(-5,5,5,-5,.5,500)),this.isDirectionalLightShadow=!0}},Xl=class extends Hl{constructor(t,n){super(t,n),this.isDirectionalLight=!0,this.type="DirectionalLight",this.position.copy(dn.DEFAULT_UP),this.updateMatrix(),this.target=new dn,this.shadow=new U_}dispose(){super.dispose(),this.shadow.dispose()}copy(t){return super.copy(t),this.target=t.target.clone(),this.shadow=t.shadow.clone(),this}toJSON(t){let n=super.toJSON(t);return n.object.shadow=this.shadow.toJSON(),n.object.target=this.target.uuid,n}},ql=class extends Hl{constructor(t,n){super(t,n),this.isAmbientLight=!0,this.type="AmbientLight"}};var Yl=class extends De{constructor(){super(),this.isInstancedBufferGeometry=!0,this.type="InstancedBufferGeometry",this.instanceCount=1/0}copy(t){return super.copy(t),this.instanceCount=t.instanceCount,this}toJSON(){let t=super.toJSON();return t.instanceCount=this.instanceCount,t.isInstancedBufferGeometry=!0,t}};var Ha=-90,Wa=1,ic=class extends dn{constructor(t,n,i){super(),this.type="CubeCamera",this.renderTarget=i,this.coordinateSystem=null,this.activeMipmapLevel=0;let r=new Ln(Ha,Wa,t,n);r.layers=this.layers,this.add(r);let s=new Ln(Ha,Wa,t,n);s.layers=this.layers,this.add(s);let o=new Ln(Ha,Wa,t,n);o.layers=this.layers,this.add(o);let a=new Ln(Ha,Wa,t,n);a.layers=this.layers,this.add(a);let c=new Ln(Ha,Wa,t,n);c.layers=this.layers,this.add(c);let l=new Ln(Ha,Wa,t,n);l.layers=this.layers,this.add(l)}updateCoordinateSystem(){let t=this.coordinateSystem,n=this.children.concat(),[i,r,s,o,a,c]=n;for(let l of n)this.remove(l);if(t===Ai)i.up.set(0,1,0),i.lookAt(1,0,0),r.up.set(0,1,0),r.lookAt(-1,0,0),s.up.set(0,0,-1),s.lookAt(0,1,0),o.up.set(0,0,1),o.lookAt(0,-1,0),a.up.set(0,1,0),a.lookAt(0,0,1),c.up.set(0,1,0),c.lookAt(0,0,-1);else if(t===Za)i.up.set(0,-1,0),i.lookAt(-1,0,0),r.up.set(0,-1,0),r.lookAt(1,0,0),s.up.set(0,0,1),s.lookAt(0,1,0),o.up.set(0,0,-1),o.lookAt(0,-1,0),a.up.set(0,-1,0),a.lookAt(0,0,1),c.up.set(0,-1,0),c.lookAt(0,0,-1);else throw new Error("THREE.CubeCamera.updateCoordinateSystem(): Invalid coordinate system: "+t);for(let l of n)this.add(l),l.updateMatrixWorld()}update(t,n){this.parent===null&&this.updateMatrixWorld();let{renderTarget:i,activeMipmapLevel:r}=this;this.coordinateSystem!==t.coordinateSystem&&(this.coordinateSystem=t.coordinateSystem,this.updateCoordinateSystem());let[s,o,a,c,l,u]=this.children,h=t.getRenderTarget(),f=t.getActiveCubeFace(),d=t.getActiveMipmapLevel(),p=t.xr.enabled;t.xr.enabled=!1;let y=i.texture.mipmapsAutoUpdate;i.texture.mipmapsAutoUpdate=!1;let m=!1;t.isWebGLRenderer===!0?m=t.state.buffers.depth.getReversed():m=t.reversedDepthBuffer,t.setRenderTarget(i,0,r),m&&t.autoClear===!1&&t.clearDepth(),t.render(n,s),t.setRenderTarget(i,1,r),m&&t.autoClear===!1&&t.clearDepth(),t.render(n,o),t.setRenderTarget(i,2,r),m&&t.autoClear===!1&&t.clearDepth(),t.render(n,a),t.setRenderTarget(i,3,r),m&&t.autoClear===!1&&t.clearDepth(),t.render(n,c),t.setRenderTarget(i,4,r),m&&t.autoClear===!1&&t.clearDepth(),t.render(n,l),i.texture.mipmapsAutoUpdate=y,t.setRenderTarget(i,5,r),m&&t.autoClear===!1&&t.clearDepth(),t.render(n,u),t.setRenderTarget(h,f,d),t.xr.enabled=p,i.texture.needsPMREMUpdate=!0}},Td=class extends Ln{constructor(t=[]){super(),this.isArrayCamera=!0,this.isMultiViewCamera=!1,this.cameras=t,this.perCameraFrustumCulled=!1}};var mx="\\[\\]\\.:\\/",eF=new RegExp("["+mx+"]","g"),gx="[^"+mx+"]",nF="[^"+mx.replace("\\.","")+"]",iF=/((?:WC+[\/:])*)/.source.replace("WC",gx),rF=/(WCOD+)?/.source.replace("WCOD",nF),sF=/(?:\.(WC+)(?:\[(.+)\])?)?/.source.replace("WC",gx),oF=/\.(WC+)(?:\[(.+)\])?/.source.replace("WC",gx),aF=new RegExp("^"+iF+rF+sF+oF+"$"),cF=["material","materials","bones","map"],F_=class{constructor(t,n,i){let r=i||Te.parseTrackName(n);this._targetGroup=t,this._bindings=t.subscribe_(n,r)}getValue(t,n){this.bind();let i=this._targetGroup.nCachedObjects_,r=this._bindings[i];r!==void 0&&r.getValue(t,n)}setValue(t,n){let i=this._bindings;for(let r=this._targetGroup.nCachedObjects_,s=i.length;r!==s;++r)i[r].setValue(t,n)}bind(){let t=this._bindings;for(let n=this._targetGroup.nCachedObjects_,i=t.length;n!==i;++n)t[n].bind()}unbind(){let t=this._bindings;for(let n=this._targetGroup.nCachedObjects_,i=t.length;n!==i;++n)t[n].unbind()}},Te=class e{constructor(t,n,i){this.path=n,this.parsedPath=i||e.parseTrackName(n),this.node=e.findNode(t,this.parsedPath.nodeName),this.rootNode=t,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}static create(t,n,i){return t&&t.isAnimationObjectGroup?new e.Composite(t,n,i):new e(t,n,i)}static sanitizeNodeName(t){return t.replace(/\s/g,"_").replace(eF,"")}static parseTrackName(t){let n=aF.exec(t);if(n===null)throw new Error("THREE.PropertyBinding: Cannot parse trackName: "+t);let i={nodeName:n[2],objectName:n[3],objectIndex:n[4],propertyName:n[5],propertyIndex:n[6]},r=i.nodeName&&i.nodeName.lastIndexOf(".");if(r!==void 0&&r!==-1){let s=i.nodeName.substring(r+1);cF.indexOf(s)!==-1&&(i.nodeName=i.nodeName.substring(0,r),i.objectName=s)}if(i.propertyName===null||i.propertyName.length===0)throw new Error("THREE.PropertyBinding: can not parse propertyName from trackName: "+t);return i}static findNode(t,n){if(n===void 0||n===""||n==="."||n===-1||n===t.name||n===t.uuid)return t;if(t.skeleton){let i=t.skeleton.getBoneByName(n);if(i!==void 0)return i}if(t.children){let i=function(s){for(let o=0;o<s.length;o++){let a=s[o];if(a.name===n||a.uuid===n)return a;let c=i(a.children);if(c)return c}return null},r=i(t.children);if(r)return r}return null}_getValue_unavailable(){}_setValue_unavailable(){}_getValue_direct(t,n){t[n]=this.targetObject[this.propertyName]}_getValue_array(t,n){let i=this.resolvedProperty;for(let r=0,s=i.length;r!==s;++r)t[n++]=i[r]}_getValue_arrayElement(t,n){t[n]=this.resolvedProperty[this.propertyIndex]}_getValue_toArray(t,n){this.resolvedProperty.toArray(t,n)}_setValue_direct(t,n){this.targetObject[this.propertyName]=t[n]}_setValue_direct_setNeedsUpdate(t,n){this.targetObject[this.propertyName]=t[n],this.targetObject.needsUpdate=!0}_setValue_direct_setMatrixWorldNeedsUpdate(t,n){this.targetObject[this.propertyName]=t[n],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_array(t,n){let i=this.resolvedProperty;for(let r=0,s=i.length;r!==s;++r)i[r]=t[n++]}_setValue_array_setNeedsUpdate(t,n){let i=this.resolvedProperty;for(let r=0,s=i.length;r!==s;++r)i[r]=t[n++];this.targetObject.needsUpdate=!0}_setValue_array_setMatrixWorldNeedsUpdate(t,n){let i=this.resolvedProperty;for(let r=0,s=i.length;r!==s;++r)i[r]=t[n++];this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_arrayElement(t,n){this.resolvedProperty[this.propertyIndex]=t[n]}_setValue_arrayElement_setNeedsUpdate(t,n){this.resolvedProperty[this.propertyIndex]=t[n],this.targetObject.needsUpdate=!0}_setValue_arrayElement_setMatrixWorldNeedsUpdate(t,n){this.resolvedProperty[this.propertyIndex]=t[n],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_fromArray(t,n){this.resolvedProperty.fromArray(t,n)}_setValue_fromArray_setNeedsUpdate(t,n){this.resolvedProperty.fromArray(t,n),this.targetObject.needsUpdate=!0}_setValue_fromArray_setMatrixWorldNeedsUpdate(t,n){this.resolvedProperty.fromArray(t,n),this.targetObject.matrixWorldNeedsUpdate=!0}_getValue_unbound(t,n){this.bind(),this.getValue(t,n)}_setValue_unbound(t,n){this.bind(),this.setValue(t,n)}bind(){let t=this.node,n=this.parsedPath,i=n.objectName,r=n.propertyName,s=n.propertyIndex;if(t||(t=e.findNode(this.rootNode,n.nodeName),this.node=t),this.getValue=this._getValue_unavailable,this.setValue=this._setValue_unavailable,!t){Ut("PropertyBinding: No target node found for track: "+this.path+".");return}if(i){let l=n.objectIndex;switch(i){case"materials":if(!t.material){kt("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!t.material.materials){kt("PropertyBinding: Can not bind to material.materials as node.material does not have a materials array.",this);return}t=t.material.materials;break;case"bones":if(!t.skeleton){kt("PropertyBinding: Can not bind to bones as node does not have a skeleton.",this);return}t=t.skeleton.bones;for(let u=0;u<t.length;u++)if(t[u].name===l){l=u;break}break;case"map":if("map"in t){t=t.map;break}if(!t.material){kt("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!t.material.map){kt("PropertyBinding: Can not bind to material.map as node.material does not have a map.",this);return}t=t.material.map;break;default:if(t[i]===void 0){kt("PropertyBinding: Can not bind to objectName of node undefined.",this);return}t=t[i]}if(l!==void 0){if(t[l]===void 0){kt("PropertyBinding: Trying to bind to objectIndex of objectName, but is undefined.",this,t);return}t=t[l]}}let o=t[r];if(o===void 0){let l=n.nodeName;kt("PropertyBinding: Trying to update property for track: "+l+"."+r+" but it wasn't found.",t);return}let a=this.Versioning.None;this.targetObject=t,t.isMaterial===!0?a=this.Versioning.NeedsUpdate:t.isObject3D===!0&&(a=this.Versioning.MatrixWorldNeedsUpdate);let c=this.BindingType.Direct;if(s!==void 0){if(r==="morphTargetInfluences"){if(!t.geometry){kt("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.",this);return}if(!t.geometry.morphAttributes){kt("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.morphAttributes.",this);return}t.morphTargetDictionary[s]!==void 0&&(s=t.morphTargetDictionary[s])}c=this.BindingType.ArrayElement,this.resolvedProperty=o,this.propertyIndex=s}else o.fromArray!==void 0&&o.toArray!==void 0?(c=this.BindingType.HasFromToArray,this.resolvedProperty=o):Array.isArray(o)?(c=this.BindingType.EntireArray,this.resolvedProperty=o):this.propertyName=r;this.getValue=this.GetterByBindingType[c],this.setValue=this.SetterByBindingTypeAndVersioning[c][a]}unbind(){this.node=null,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}};Te.Composite=F_;Te.prototype.BindingType={Direct:0,EntireArray:1,ArrayElement:2,HasFromToArray:3};Te.prototype.Versioning={None:0,NeedsUpdate:1,MatrixWorldNeedsUpdate:2};Te.prototype.GetterByBindingType=[Te.prototype._getValue_direct,Te.prototype._getValue_array,Te.prototype._getValue_arrayElement,Te.prototype._getValue_toArray];Te.prototype.SetterByBindingTypeAndVersioning=[[Te.prototype._setValue_direct,Te.prototype._setValue_direct_setNeedsUpdate,Te.prototype._setValue_direct_setMatrixWorldNeedsUpdate],[Te.prototype._setValue_array,Te.prototype._setValue_array_setNeedsUpdate,Te.prototype._setValue_array_setMatrixWorldNeedsUpdate],[Te.prototype._setValue_arrayElement,Te.prototype._setValue_arrayElement_setNeedsUpdate,Te.prototype._setValue_arrayElement_setMatrixWorldNeedsUpdate],[Te.prototype._setValue_fromArray,Te.prototype._setValue_fromArray_setNeedsUpdate,Te.prototype._setValue_fromArray_setMatrixWorldNeedsUpdate]];var qV=new Float32Array(1);var Us=class extends sd{constructor(t,n,i=1){super(t,n),this.isInstancedInterleavedBuffer=!0,this.meshPerAttribute=i}copy(t){return super.copy(t),this.meshPerAttribute=t.meshPerAttribute,this}clone(t){let n=super.clone(t);return n.meshPerAttribute=this.meshPerAttribute,n}toJSON(t){let n=super.toJSON(t);return n.isInstancedInterleavedBuffer=!0,n.meshPerAttribute=this.meshPerAttribute,n}};var rc=class{constructor(t=1,n=0,i=0){this.radius=t,this.phi=n,this.theta=i}set(t,n,i){return this.radius=t,this.phi=n,this.theta=i,this}copy(t){return this.radius=t.radius,this.phi=t.phi,this.theta=t.theta,this}makeSafe(){return this.phi=Ht(this.phi,1e-6,Math.PI-1e-6),this}setFromVector3(t){return this.setFromCartesianCoords(t.x,t.y,t.z)}setFromCartesianCoords(t,n,i){return this.radius=Math.sqrt(t*t+n*n+i*i),this.radius===0?(this.theta=0,this.phi=0):(this.theta=Math.atan2(t,i),this.phi=Math.acos(Ht(n/this.radius,-1,1))),this}clone(){return new this.constructor().copy(this)}};var O_=class{static{this.prototype.isMatrix2=!0}constructor(t,n,i,r){this.elements=[1,0,0,1],t!==void 0&&this.set(t,n,i,r)}identity(){return this.set(1,0,0,1),this}fromArray(t,n=0){for(let i=0;i<4;i++)this.elements[i]=t[i+n];return this}set(t,n,i,r){let s=this.elements;return s[0]=t,s[2]=n,s[1]=i,s[3]=r,this}};var vE=new k,Hh=new k,$a=new k,Xa=new k,R_=new k,lF=new k,uF=new k,Zl=class{constructor(t=new k,n=new k){this.start=t,this.end=n}set(t,n){return this.start.copy(t),this.end.copy(n),this}copy(t){return this.start.copy(t.start),this.end.copy(t.end),this}getCenter(t){return t.addVectors(this.start,this.end).multiplyScalar(.5)}delta(t){return t.subVectors(this.end,this.start)}distanceSq(){return this.start.distanceToSquared(this.end)}distance(){return this.start.distanceTo(this.end)}at(t,n){return this.delta(n).multiplyScalar(t).add(this.start)}closestPointToPointParameter(t,n){vE.subVectors(t,this.start),Hh.subVectors(this.end,this.start);let i=Hh.dot(Hh);if(i===0)return 0;let s=Hh.dot(vE)/i;return n&&(s=Ht(s,0,1)),s}closestPointToPoint(t,n,i){let r=this.closestPointToPointParameter(t,n);return this.delta(i).multiplyScalar(r).add(this.start)}distanceSqToLine3(t,n=lF,i=uF){let r=10000000000000001e-32,s,o,a=this.start,c=t.start,l=this.end,u=t.end;$a.subVectors(l,a),Xa.subVectors(u,c),R_.subVectors(a,c);let h=$a.dot($a),f=Xa.dot(Xa),d=Xa.dot(R_);if(h<=r&&f<=r)return n.copy(a),i.copy(c),n.distanceToSquared(i);if(h<=r)s=0,o=d/f,o=Ht(o,0,1);else{let p=$a.dot(R_);if(f<=r)o=0,s=Ht(-p/h,0,1);else{let y=$a.dot(Xa),m=h*f-y*y;m!==0?s=Ht((y*d-p*f)/m,0,1):s=0,o=(y*s+d)/f,o<0?(o=0,s=Ht(-p/h,0,1)):o>1&&(o=1,s=Ht((y-p)/h,0,1))}}return n.copy(a).addScaledVector($a,s),i.copy(c).addScaledVector(Xa,o),n.distanceToSquared(i)}applyMatrix4(t){return this.start.applyMatrix4(t),this.end.applyMatrix4(t),this}equals(t){return t.start.equals(this.start)&&t.end.equals(this.end)}clone(){return new this.constructor().copy(this)}};var Jl=class extends Cs{constructor(t=10,n=10,i=4473924,r=8947848){i=new Wt(i),r=new Wt(r);let s=n/2,o=t/n,a=t/2,c=[],l=[];for(let f=0,d=0,p=-a;f<=n;f++,p+=o){c.push(-a,0,p,a,0,p),c.push(p,0,-a,p,0,a);let y=f===s?i:r;y.toArray(l,d),d+=3,y.toArray(l,d),d+=3,y.toArray(l,d),d+=3,y.toArray(l,d),d+=3}let u=new De;u.setAttribute("position",new ge(c,3)),u.setAttribute("color",new ge(l,3));let h=new Yr({vertexColors:!0,toneMapped:!1});super(u,h),this.type="GridHelper"}dispose(){super.dispose(),this.geometry.dispose(),this.material.dispose()}};var Kl=class extends Gi{constructor(t,n=null){super(),this.object=t,this.domElement=n,this.enabled=!0,this.state=-1,this.keys={},this.mouseButtons={LEFT:null,MIDDLE:null,RIGHT:null},this.touches={ONE:null,TWO:null}}connect(t){this.domElement!==null&&this.disconnect(),this.domElement=t}disconnect(){}dispose(){}update(){}};function yx(e,t,n,i){let r=fF(i);switch(n){case nx:return e*t;case rx:return e*t/r.components*r.byteLength;case Nd:return e*t/r.components*r.byteLength;case ks:return e*t*2/r.components*r.byteLength;case Dd:return e*t*2/r.components*r.byteLength;case ix:return e*t*3/r.components*r.byteLength;case Xi:return e*t*4/r.components*r.byteLength;case Ud:return e*t*4/r.components*r.byteLength;case tu:case eu:return Math.floor((e+3)/4)*Math.floor((t+3)/4)*8;case nu:case iu:return Math.floor((e+3)/4)*Math.floor((t+3)/4)*16;case Od:case kd:return Math.max(e,16)*Math.max(t,8)/4;case Fd:case Bd:return Math.max(e,8)*Math.max(t,8)/2;case zd:case Gd:case Hd:case Wd:return Math.floor((e+3)/4)*Math.floor((t+3)/4)*8;case Vd:case ru:case $d:return Math.floor((e+3)/4)*Math.floor((t+3)/4)*16;case Xd:return Math.floor((e+3)/4)*Math.floor((t+3)/4)*16;case qd:return Math.floor((e+4)/5)*Math.floor((t+3)/4)*16;case Yd:return Math.floor((e+4)/5)*Math.floor((t+4)/5)*16;case Zd:return Math.floor((e+5)/6)*Math.floor((t+4)/5)*16;case Jd:return Math.floor((e+5)/6)*Math.floor((t+5)/6)*16;case Kd:return Math.floor((e+7)/8)*Math.floor((t+4)/5)*16;case jd:return Math.floor((e+7)/8)*Math.floor((t+5)/6)*16;case Qd:return Math.floor((e+7)/8)*Math.floor((t+7)/8)*16;case tp:return Math.floor((e+9)/10)*Math.floor((t+4)/5)*16;case ep:return Math.floor((e+9)/10)*Math.floor((t+5)/6)*16;case np:return Math.floor((e+9)/10)*Math.floor((t+7)/8)*16;case ip:return Math.floor((e+9)/10)*Math.floor((t+9)/10)*16;case rp:return Math.floor((e+11)/12)*Math.floor((t+9)/10)*16;case sp:return Math.floor((e+11)/12)*Math.floor((t+11)/12)*16;case op:case ap:case cp:return Math.ceil(e/4)*Math.ceil(t/4)*16;case lp:case up:return Math.ceil(e/4)*Math.ceil(t/4)*8;case su:case fp:return Math.ceil(e/4)*Math.ceil(t/4)*16}throw new Error(`Unable to determine texture byte length for ${n} format.`)}function fF(e){switch(e){case Hn:case j_:return{byteLength:1,components:1};case cc:case Q_:case $i:return{byteLength:2,components:1};case Id:case Ld:return{byteLength:2,components:4};case Hi:case Pd:case Wi:return{byteLength:4,components:1};case tx:case ex:return{byteLength:4,components:3}}throw new Error(`THREE.TextureUtils: Unknown texture type ${e}.`)}typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("register",{detail:{revision:"187"}}));typeof window<"u"&&(window.__THREE__?Ut("WARNING: Multiple instances of Three.js being imported."):window.__THREE__="187");function E2(){let e=null,t=!1,n=null,i=null;function r(s,o){i=e.requestAnimationFrame(r),n(s,o)}return{start:function(){t!==!0&&n!==null&&e!==null&&(i=e.requestAnimationFrame(r),t=!0)},stop:function(){e!==null&&e.cancelAnimationFrame(i),t=!1},setAnimationLoop:function(s){n=s},setContext:function(s){e=s}}}function dF(e){let t=new WeakMap;function n(a,c){let l=a.array,u=a.usage,h=l.byteLength,f=e.createBuffer();e.bindBuffer(c,f),e.bufferData(c,l,u),a.onUploadCallback();let d;if(l instanceof Float32Array)d=e.FLOAT;else if(typeof Float16Array<"u"&&l instanceof Float16Array)d=e.HALF_FLOAT;else if(l instanceof Uint16Array)a.isFloat16BufferAttribute?d=e.HALF_FLOAT:d=e.UNSIGNED_SHORT;else if(l instanceof Int16Array)d=e.SHORT;else if(l instanceof Uint32Array)d=e.UNSIGNED_INT;else if(l instanceof Int32Array)d=e.INT;else if(l instanceof Int8Array)d=e.BYTE;else if(l instanceof Uint8Array)d=e.UNSIGNED_BYTE;else if(l instanceof Uint8ClampedArray)d=e.UNSIGNED_BYTE;else throw new Error("THREE.WebGLAttributes: Unsupported buffer data format: "+l);return{buffer:f,type:d,bytesPerElement:l.BYTES_PER_ELEMENT,version:a.version,size:h}}function i(a,c,l){let u=c.array,h=c.updateRanges;if(e.bindBuffer(l,a),h.length===0)e.bufferSubData(l,0,u);else{h.sort((d,p)=>d.start-p.start);let f=0;for(let d=1;d<h.length;d++){let p=h[f],y=h[d];y.start<=p.start+p.count+1?p.count=Math.max(p.count,y.start+y.count-p.start):(++f,h[f]=y)}h.length=f+1;for(let d=0,p=h.length;d<p;d++){let y=h[d];e.bufferSubData(l,y.start*u.BYTES_PER_ELEMENT,u,y.start,y.count)}c.clearUpdateRanges()}c.onUploadCallback()}function r(a){return a.isInterleavedBufferAttribute&&(a=a.data),t.get(a)}function s(a){a.isInterleavedBufferAttribute&&(a=a.data);let c=t.get(a);c&&(e.deleteBuffer(c.buffer),t.delete(a))}function o(a,c){if(a.isInterleavedBufferAttribute&&(a=a.data),a.isGLBufferAttribute){let u=t.get(a);(!u||u.version<a.version)&&t.set(a,{buffer:a.buffer,type:a.type,bytesPerElement:a.elementSize,version:a.version});return}let l=t.get(a);if(l===void 0)t.set(a,n(a,c));else if(l.version<a.version){if(l.size!==a.array.byteLength)throw new Error("THREE.WebGLAttributes: The size of the buffer attribute's array buffer does not match the original size. Resizing buffer attributes is not supported.");i(l.buffer,a,c),l.version=a.version}}return{get:r,remove:s,update:o}}var pF=`#ifdef USE_ALPHAHASH
	if ( diffuseColor.a < getAlphaHashThreshold( vPosition ) ) discard;
#endif`,mF=`#ifdef USE_ALPHAHASH
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
#endif`,gF=`#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, vAlphaMapUv ).g;
#endif`,yF=`#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,_F=`#ifdef USE_ALPHATEST
	#ifdef ALPHA_TO_COVERAGE
	diffuseColor.a = smoothstep( alphaTest, alphaTest + fwidth( diffuseColor.a ), diffuseColor.a );
	if ( diffuseColor.a == 0.0 ) discard;
	#else
	if ( diffuseColor.a < alphaTest ) discard;
	#endif
#endif`,xF=`#ifdef USE_ALPHATEST
	uniform float alphaTest;
#endif`,vF=`#ifdef USE_AOMAP
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
#endif`,bF=`#ifdef USE_AOMAP
	uniform sampler2D aoMap;
	uniform float aoMapIntensity;
#endif`,MF=`#ifdef USE_BATCHING
	#if ! defined( GL_ANGLE_multi_draw )
	#define gl_DrawID _gl_DrawID
	uniform int _gl_DrawID;
	#endif
	uniform highp sampler2D batchingTexture;
	uniform highp usampler2D batchingIdTexture;
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
	float getIndirectIndex( const in int i ) {
		int size = textureSize( batchingIdTexture, 0 ).x;
		int x = i % size;
		int y = i / size;
		return float( texelFetch( batchingIdTexture, ivec2( x, y ), 0 ).r );
	}
#endif
#ifdef USE_BATCHING_COLOR
	uniform sampler2D batchingColorTexture;
	vec4 getBatchingColor( const in float i ) {
		int size = textureSize( batchingColorTexture, 0 ).x;
		int j = int( i );
		int x = j % size;
		int y = j / size;
		return texelFetch( batchingColorTexture, ivec2( x, y ), 0 );
	}
#endif`,SF=`#ifdef USE_BATCHING
	mat4 batchingMatrix = getBatchingMatrix( getIndirectIndex( gl_DrawID ) );
#endif`,wF=`vec3 transformed = vec3( position );
#ifdef USE_ALPHAHASH
	vPosition = vec3( position );
#endif`,TF=`vec3 objectNormal = vec3( normal );
#ifdef USE_TANGENT
	vec3 objectTangent = vec3( tangent.xyz );
#endif`,AF=`float G_BlinnPhong_Implicit( ) {
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
} // validated`,EF=`#ifdef USE_IRIDESCENCE
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
#endif`,CF=`#ifdef USE_BUMPMAP
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
#endif`,RF=`#if NUM_CLIPPING_PLANES > 0
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
#endif`,PF=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
	uniform vec4 clippingPlanes[ NUM_CLIPPING_PLANES ];
#endif`,IF=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
#endif`,LF=`#if NUM_CLIPPING_PLANES > 0
	vClipPosition = - mvPosition.xyz;
#endif`,NF=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	diffuseColor *= vColor;
#endif`,DF=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	varying vec4 vColor;
#endif`,UF=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	varying vec4 vColor;
#endif`,FF=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	vColor = vec4( 1.0 );
#endif
#ifdef USE_COLOR_ALPHA
	vColor *= color;
#elif defined( USE_COLOR )
	vColor.rgb *= color;
#endif
#ifdef USE_INSTANCING_COLOR
	vColor.rgb *= instanceColor.rgb;
#endif
#ifdef USE_BATCHING_COLOR
	vColor *= getBatchingColor( getIndirectIndex( gl_DrawID ) );
#endif`,OF=`#define PI 3.141592653589793
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
#define inverseTransformDirection transformDirectionByInverseViewMatrix
vec3 transformNormalByInverseViewMatrix( in vec3 normal, in mat4 viewMatrix ) {
	return normalize( ( vec4( normal, 0.0 ) * viewMatrix ).xyz );
}
vec3 transformDirectionByInverseViewMatrix( in vec3 dir, in mat4 viewMatrix ) {
	return normalize( ( vec4( dir, 0.0 ) * viewMatrix ).xyz );
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
} // validated`,BF=`vec3 transformedNormal = objectNormal;
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
#endif`,kF=`#ifdef USE_DISPLACEMENTMAP
	uniform sampler2D displacementMap;
	uniform float displacementScale;
	uniform float displacementBias;
#endif`,zF=`#ifdef USE_DISPLACEMENTMAP
	transformed += normalize( objectNormal ) * ( texture2D( displacementMap, vDisplacementMapUv ).x * displacementScale + displacementBias );
#endif`,GF=`#ifdef USE_EMISSIVEMAP
	vec4 emissiveColor = texture2D( emissiveMap, vEmissiveMapUv );
	#ifdef DECODE_VIDEO_TEXTURE_EMISSIVE
		emissiveColor = sRGBTransferEOTF( emissiveColor );
	#endif
	totalEmissiveRadiance *= emissiveColor.rgb;
#endif`,VF=`#ifdef USE_EMISSIVEMAP
	uniform sampler2D emissiveMap;
#endif`,HF="gl_FragColor = linearToOutputTexel( gl_FragColor );",WF=`vec4 LinearTransferOETF( in vec4 value ) {
	return value;
}
vec4 sRGBTransferEOTF( in vec4 value ) {
	return vec4( mix( pow( value.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), value.rgb * 0.0773993808, vec3( lessThanEqual( value.rgb, vec3( 0.04045 ) ) ) ), value.a );
}
vec4 sRGBTransferOETF( in vec4 value ) {
	return vec4( mix( pow( value.rgb, vec3( 0.41666 ) ) * 1.055 - vec3( 0.055 ), value.rgb * 12.92, vec3( lessThanEqual( value.rgb, vec3( 0.0031308 ) ) ) ), value.a );
}`,$F=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vec3 cameraToFrag;
		if ( isOrthographic ) {
			cameraToFrag = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToFrag = normalize( vWorldPosition - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vec3 reflectVec = reflect( cameraToFrag, worldNormal );
		#else
			vec3 reflectVec = refract( cameraToFrag, worldNormal, refractionRatio );
		#endif
	#else
		vec3 reflectVec = vReflect;
	#endif
	#ifdef ENVMAP_TYPE_CUBE
		vec4 envColor = textureCube( envMap, envMapRotation * reflectVec );
		#ifdef ENVMAP_BLENDING_MULTIPLY
			outgoingLight = mix( outgoingLight, outgoingLight * envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_MIX )
			outgoingLight = mix( outgoingLight, envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_ADD )
			outgoingLight += envColor.xyz * specularStrength * reflectivity;
		#endif
	#endif
#endif`,XF=`#ifdef USE_ENVMAP
	uniform float envMapIntensity;
	uniform mat3 envMapRotation;
	uniform samplerCube envMap;
	#ifdef ENVMAP_TYPE_PMREM
		float roughnessToMip( const in float roughness ) {
			float r = clamp( roughness, 0.0, 1.0 );
			return ENVMAP_MAX_LOD * r * ( 2.0 - r );
		}
	#endif
#endif`,qF=`#ifdef USE_ENVMAP
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
#endif`,YF=`#ifdef USE_ENVMAP
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		
		varying vec3 vWorldPosition;
	#else
		varying vec3 vReflect;
		uniform float refractionRatio;
	#endif
#endif`,ZF=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vWorldPosition = worldPosition.xyz;
	#else
		vec3 cameraToVertex;
		if ( isOrthographic ) {
			cameraToVertex = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToVertex = normalize( worldPosition.xyz - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vReflect = reflect( cameraToVertex, worldNormal );
		#else
			vReflect = refract( cameraToVertex, worldNormal, refractionRatio );
		#endif
	#endif
#endif`,JF=`#ifdef USE_FOG
	vFogDepth = - mvPosition.z;
#endif`,KF=`#ifdef USE_FOG
	varying float vFogDepth;
#endif`,jF=`#ifdef USE_FOG
	#ifdef FOG_EXP2
		float fogFactor = 1.0 - exp( - fogDensity * fogDensity * vFogDepth * vFogDepth );
	#else
		float fogFactor = smoothstep( fogNear, fogFar, vFogDepth );
	#endif
	gl_FragColor.rgb = mix( gl_FragColor.rgb, fogColor, fogFactor );
#endif`,QF=`#ifdef USE_FOG
	uniform vec3 fogColor;
	varying float vFogDepth;
	#ifdef FOG_EXP2
		uniform float fogDensity;
	#else
		uniform float fogNear;
		uniform float fogFar;
	#endif
#endif`,tO=`#ifdef USE_GRADIENTMAP
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
}`,eO=`#ifdef USE_LIGHTMAP
	uniform sampler2D lightMap;
	uniform float lightMapIntensity;
#endif`,nO=`LambertMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularStrength = specularStrength;`,iO=`varying vec3 vViewPosition;
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
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Lambert`,rO=`uniform bool receiveShadow;
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
	vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
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
#if NUM_SUN_LIGHTS > 0
	struct SunLight {
		vec3 direction;
		vec3 color;
	};
	uniform SunLight sunLights[ NUM_SUN_LIGHTS ];
	void getSunLightInfo( const in SunLight sunLight, out IncidentLight light ) {
		light.color = sunLight.color;
		light.direction = sunLight.direction;
		light.visible = true;
	}
#endif
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
#endif
#include <lightprobes_pars_fragment>`,sO=`#ifdef USE_ENVMAP
	vec3 getIBLIrradiance( const in vec3 normal ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * worldNormal, ENVMAP_MAX_LOD );
			return PI * envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	vec3 getIBLRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 reflectVec = reflect( - viewDir, normal );
			reflectVec = normalize( mix( reflectVec, normal, pow4( roughness ) ) );
			reflectVec = transformDirectionByInverseViewMatrix( reflectVec, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * reflectVec, roughnessToMip( roughness ) );
			return envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	#ifdef USE_RETROREFLECTION
		vec3 getIBLRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 retroVec = normalize( mix( viewDir, normal, pow4( roughness ) ) );
				retroVec = transformDirectionByInverseViewMatrix( retroVec, viewMatrix );
				vec4 envMapColor = textureLod( envMap, envMapRotation * retroVec, roughnessToMip( roughness ) );
				return envMapColor.rgb * envMapIntensity;
			#else
				return vec3( 0.0 );
			#endif
		}
	#endif
	#ifdef USE_ANISOTROPY
		vec3 getIBLAnisotropyRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 bentNormal = cross( bitangent, viewDir );
				bentNormal = normalize( cross( bentNormal, bitangent ) );
				bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
				return getIBLRadiance( viewDir, bentNormal, roughness );
			#else
				return vec3( 0.0 );
			#endif
		}
		#ifdef USE_RETROREFLECTION
			vec3 getIBLAnisotropyRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
				#ifdef ENVMAP_TYPE_PMREM
					vec3 bentNormal = cross( bitangent, viewDir );
					bentNormal = normalize( cross( bentNormal, bitangent ) );
					bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
					return getIBLRetroRadiance( viewDir, bentNormal, roughness );
				#else
					return vec3( 0.0 );
				#endif
			}
		#endif
	#endif
#endif`,oO=`ToonMaterial material;
material.diffuseColor = diffuseColor.rgb;`,aO=`varying vec3 vViewPosition;
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
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Toon`,cO=`BlinnPhongMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularColor = specular;
material.specularShininess = shininess;
material.specularStrength = specularStrength;`,lO=`varying vec3 vViewPosition;
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
#define RE_IndirectDiffuse		RE_IndirectDiffuse_BlinnPhong`,uO=`PhysicalMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.diffuseContribution = diffuseColor.rgb * ( 1.0 - metalnessFactor );
material.metalness = metalnessFactor;
vec3 dxy = max( abs( dFdx( nonPerturbedNormal ) ), abs( dFdy( nonPerturbedNormal ) ) );
float geometryRoughness = max( max( dxy.x, dxy.y ), dxy.z );
material.roughness = max( roughnessFactor, 0.045 );
material.roughness += geometryRoughness;
material.roughness = min( material.roughness, 1.0 );
#ifdef USE_DIFFUSE_ROUGHNESS
	float diffuseRoughnessFactor = diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		diffuseRoughnessFactor *= texture2D( diffuseRoughnessMap, vDiffuseRoughnessMapUv ).r;
	#endif
	material.diffuseRoughness = saturate( diffuseRoughnessFactor );
#endif
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
	material.specularColor = min( pow2( ( material.ior - 1.0 ) / ( material.ior + 1.0 ) ) * specularColorFactor, vec3( 1.0 ) ) * specularIntensityFactor;
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
#else
	material.specularColor = vec3( 0.04 );
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
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
	material.clearcoat = saturate( material.clearcoat );	material.clearcoatRoughness = max( material.clearcoatRoughness, 0.045 );
	material.clearcoatRoughness += geometryRoughness;
	material.clearcoatRoughness = min( material.clearcoatRoughness, 1.0 );
#endif
#ifdef USE_DISPERSION
	material.dispersion = dispersion;
#endif
#ifdef USE_RETROREFLECTION
	material.retroreflectivity = retroreflectivity;
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
	material.sheenRoughness = clamp( sheenRoughness, 0.0001, 1.0 );
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
#endif`,fO=`uniform sampler2D dfgLUT;
struct PhysicalMaterial {
	vec3 diffuseColor;
	vec3 diffuseContribution;
	vec3 specularColor;
	vec3 specularColorBlended;
	float roughness;
	float metalness;
	float specularF90;
	float dispersion;
	vec2 dfg;
	vec3 multiScatteringCompensation;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float diffuseRoughness;
	#endif
	#ifdef USE_RETROREFLECTION
		float retroreflectivity;
	#endif
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
		vec3 iridescenceF0Dielectric;
		vec3 iridescenceF0Metallic;
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
#ifdef USE_DIFFUSE_ROUGHNESS
	const float EON_EPSILON = 1e-7;
	float FON_DirectionalAlbedo( const in float mu, const in float roughness, const in float A ) {
		float muComp = 1.0 - mu;
		float gOverPi = muComp * ( 0.0571085289 + muComp * ( 0.491881867 + muComp * ( - 0.332181442 + muComp * 0.0714429953 ) ) );
		return A * ( 1.0 + roughness * gOverPi );
	}
	vec3 BRDF_EON( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 diffuseColor, const in float roughness ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return BRDF_Lambert( rho );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float s = dot( lightDir, viewDir ) - dotNL * dotNV;
		float sOverT = ( s > 0.0 ) ? s / max( max( dotNL, dotNV ), EON_EPSILON ) : s;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		vec3 singleScatter = rho * RECIPROCAL_PI * A * ( 1.0 + roughness * sOverT );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		float albedoV = FON_DirectionalAlbedo( dotNV, roughness, A );
		float albedoL = FON_DirectionalAlbedo( dotNL, roughness, A );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		vec3 multiScatter = rhoMultiScatter * RECIPROCAL_PI
			* max( EON_EPSILON, 1.0 - albedoV )
			* max( EON_EPSILON, 1.0 - albedoL )
			/ max( EON_EPSILON, 1.0 - averageAlbedo );
		return singleScatter + multiScatter;
	}
	vec3 EON_DirectionalAlbedo( const in vec3 diffuseColor, const in float roughness, const in float dotNV ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return rho;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		float directionalAlbedo = FON_DirectionalAlbedo( dotNV, roughness, A );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		return rho * directionalAlbedo + rhoMultiScatter * ( 1.0 - directionalAlbedo );
	}
#endif
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
		return 0.5 / max( gv + gl, EPSILON );
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
		float roughness = max( material.clearcoatRoughness, 0.045 );
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
	vec3 f0 = material.specularColorBlended;
	float f90 = material.specularF90;
	float roughness = max( material.roughness, 0.045 );
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
		float alphaT = max( material.alphaT, alpha );
		float V = V_GGX_SmithCorrelated_Anisotropic( alphaT, alpha, dotTV, dotBV, dotTL, dotBL, dotNV, dotNL );
		float D = D_GGX_Anisotropic( alphaT, alpha, dotNH, dotTH, dotBH );
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
	mat3 mat = mInv * transpose( mat3( T1, T2, N ) );
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
	float rInv = 1.0 / ( roughness + 0.1 );
	float a = -1.9362 + 1.0678 * roughness + 0.4573 * r2 - 0.8469 * rInv;
	float b = -0.6014 + 0.5538 * roughness - 0.4670 * r2 - 0.1255 * rInv;
	float DG = exp( a * dotNV + b );
	return saturate( DG );
}
vec3 EnvironmentBRDF( const in vec3 normal, const in vec3 viewDir, const in vec3 specularColor, const in float specularF90, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	vec2 fab = texture2D( dfgLUT, vec2( roughness, dotNV ) ).rg;
	return specularColor * fab.x + specularF90 * fab.y;
}
#ifdef USE_IRIDESCENCE
void computeMultiscatteringIridescence( const in vec2 fab, const in vec3 specularColor, const in float specularF90, const in float iridescence, const in vec3 iridescenceF0, inout vec3 singleScatter, inout vec3 multiScatter ) {
#else
void computeMultiscattering( const in vec2 fab, const in vec3 specularColor, const in float specularF90, inout vec3 singleScatter, inout vec3 multiScatter ) {
#endif
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
		vec3 fresnel = ( material.specularColorBlended * t2.x + ( material.specularF90 - material.specularColorBlended ) * t2.y );
		reflectedLight.directSpecular += lightColor * fresnel * LTC_Evaluate( normal, viewDir, position, mInv, rectCoords );
		reflectedLight.directDiffuse += lightColor * material.diffuseContribution * LTC_Evaluate( normal, viewDir, position, mat3( 1.0 ), rectCoords );
		#ifdef USE_CLEARCOAT
			vec3 Ncc = geometryClearcoatNormal;
			vec2 uvClearcoat = LTC_Uv( Ncc, viewDir, material.clearcoatRoughness );
			vec4 t1Clearcoat = texture2D( ltc_1, uvClearcoat );
			vec4 t2Clearcoat = texture2D( ltc_2, uvClearcoat );
			mat3 mInvClearcoat = mat3(
				vec3( t1Clearcoat.x, 0, t1Clearcoat.y ),
				vec3(             0, 1,             0 ),
				vec3( t1Clearcoat.z, 0, t1Clearcoat.w )
			);
			vec3 fresnelClearcoat = material.clearcoatF0 * t2Clearcoat.x + ( material.clearcoatF90 - material.clearcoatF0 ) * t2Clearcoat.y;
			clearcoatSpecularDirect += lightColor * fresnelClearcoat * LTC_Evaluate( Ncc, viewDir, position, mInvClearcoat, rectCoords );
		#endif
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
 
 		float sheenAlbedoV = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
 		float sheenAlbedoL = IBLSheenBRDF( geometryNormal, directLight.direction, material.sheenRoughness );
 
 		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * max( sheenAlbedoV, sheenAlbedoL );
 
 		irradiance *= sheenEnergyComp;
 
 	#endif
	vec3 specularBRDF = BRDF_GGX( directLight.direction, geometryViewDir, geometryNormal, material );
	#ifdef USE_RETROREFLECTION
		vec3 retroViewDir = reflect( - geometryViewDir, geometryNormal );
		vec3 retroSpecularBRDF = BRDF_GGX( directLight.direction, retroViewDir, geometryNormal, material );
		specularBRDF = mix( specularBRDF, retroSpecularBRDF, saturate( material.retroreflectivity ) );
	#endif
	reflectedLight.directSpecular += irradiance * specularBRDF * material.multiScatteringCompensation;
	vec3 halfDir = normalize( directLight.direction + geometryViewDir );
	float dotVH = saturate( dot( geometryViewDir, halfDir ) );
	vec3 F = F_Schlick( material.specularColor, material.specularF90, dotVH );
	#ifdef USE_RETROREFLECTION
		vec3 retroHalfDir = normalize( directLight.direction + retroViewDir );
		float dotRetroVH = saturate( dot( retroViewDir, retroHalfDir ) );
		vec3 retroF = F_Schlick( material.specularColor, material.specularF90, dotRetroVH );
		F = mix( F, retroF, saturate( material.retroreflectivity ) );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		vec3 diffuseBRDF = BRDF_EON( directLight.direction, geometryViewDir, geometryNormal, material.diffuseColor, material.diffuseRoughness ) * ( 1.0 - material.metalness );
	#else
		vec3 diffuseBRDF = BRDF_Lambert( material.diffuseContribution );
	#endif
	reflectedLight.directDiffuse += irradiance * diffuseBRDF * ( 1.0 - F );
}
void RE_IndirectDiffuse_Physical( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 singleScattering = vec3( 0.0 );
	vec3 multiScattering = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScattering, multiScattering );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScattering, multiScattering );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuseAlbedo = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness );
		vec3 diffuse = irradiance * RECIPROCAL_PI * diffuseAlbedo * ( 1.0 - singleScattering - multiScattering );
	#else
		vec3 diffuse = irradiance * BRDF_Lambert( material.diffuseContribution ) * ( 1.0 - singleScattering - multiScattering );
	#endif
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		sheenSpecularIndirect += irradiance * material.sheenColor * sheenAlbedo * RECIPROCAL_PI;
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		diffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectDiffuse += diffuse;
}
void RE_IndirectSpecular_Physical( const in vec3 radiance, const in vec3 irradiance, const in vec3 clearcoatRadiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight) {
	#ifdef USE_CLEARCOAT
		clearcoatSpecularIndirect += clearcoatRadiance * EnvironmentBRDF( geometryClearcoatNormal, geometryViewDir, material.clearcoatF0, material.clearcoatF90, material.clearcoatRoughness );
	#endif
	#ifdef USE_SHEEN
		sheenSpecularIndirect += irradiance * material.sheenColor * IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness ) * RECIPROCAL_PI;
 	#endif
	vec3 singleScatteringDielectric = vec3( 0.0 );
	vec3 multiScatteringDielectric = vec3( 0.0 );
	vec3 singleScatteringMetallic = vec3( 0.0 );
	vec3 multiScatteringMetallic = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscatteringIridescence( material.dfg, material.diffuseColor, material.specularF90, material.iridescence, material.iridescenceF0Metallic, singleScatteringMetallic, multiScatteringMetallic );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscattering( material.dfg, material.diffuseColor, material.specularF90, singleScatteringMetallic, multiScatteringMetallic );
	#endif
	vec3 singleScattering = mix( singleScatteringDielectric, singleScatteringMetallic, material.metalness );
	vec3 multiScattering = mix( multiScatteringDielectric, multiScatteringMetallic, material.metalness );
	vec3 totalScatteringDielectric = singleScatteringDielectric + multiScatteringDielectric;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuse = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness ) * ( 1.0 - totalScatteringDielectric );
	#else
		vec3 diffuse = material.diffuseContribution * ( 1.0 - totalScatteringDielectric );
	#endif
	vec3 cosineWeightedIrradiance = irradiance * RECIPROCAL_PI;
	vec3 indirectSpecular = radiance * singleScattering;
	indirectSpecular += multiScattering * cosineWeightedIrradiance;
	vec3 indirectDiffuse = diffuse * cosineWeightedIrradiance;
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		indirectSpecular *= sheenEnergyComp;
		indirectDiffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectSpecular += indirectSpecular;
	reflectedLight.indirectDiffuse += indirectDiffuse;
}
#define RE_Direct				RE_Direct_Physical
#define RE_Direct_RectArea		RE_Direct_RectArea_Physical
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Physical
#define RE_IndirectSpecular		RE_IndirectSpecular_Physical
float computeSpecularOcclusion( const in float dotNV, const in float ambientOcclusion, const in float roughness ) {
	return saturate( pow( dotNV + ambientOcclusion, exp2( - 16.0 * roughness - 1.0 ) ) - 1.0 + ambientOcclusion );
}`,hO=`
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
		vec3 iridescenceFresnelDielectric = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.specularColor );
		vec3 iridescenceFresnelMetallic = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.diffuseColor );
		material.iridescenceFresnel = mix( iridescenceFresnelDielectric, iridescenceFresnelMetallic, material.metalness );
		material.iridescenceF0Dielectric = Schlick_to_F0( iridescenceFresnelDielectric, 1.0, dotNVi );
		material.iridescenceF0Metallic = Schlick_to_F0( iridescenceFresnelMetallic, 1.0, dotNVi );
	}
#endif
#ifdef STANDARD
	float dotNVms = saturate( dot( geometryNormal, geometryViewDir ) );
	material.dfg = texture2D( dfgLUT, vec2( material.roughness, dotNVms ) ).rg;
	#if ( NUM_SUN_LIGHTS > 0 || NUM_DIR_LIGHTS > 0 || NUM_POINT_LIGHTS > 0 || NUM_SPOT_LIGHTS > 0 )
		float EssMs = material.dfg.x + material.dfg.y;
		material.multiScatteringCompensation = 1.0 + material.specularColorBlended * ( 1.0 / EssMs - 1.0 );
	#endif
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
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_POINT_LIGHT_SHADOWS ) && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
		pointLightShadow = pointLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getPointShadow( pointShadowMap[ i ], pointLightShadow.shadowMapSize, pointLightShadow.shadowIntensity, pointLightShadow.shadowBias, pointLightShadow.shadowRadius, vPointShadowCoord[ i ], pointLightShadow.shadowCameraNear, pointLightShadow.shadowCameraFar ) : 1.0;
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
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( spotShadowMap[ i ], spotLightShadow.shadowMapSize, spotLightShadow.shadowIntensity, spotLightShadow.shadowBias, spotLightShadow.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SUN_LIGHTS > 0 ) && defined( RE_Direct )
	SunLight sunLight;
	#if defined( USE_SHADOWMAP ) && NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHTS; i ++ ) {
		sunLight = sunLights[ i ];
		getSunLightInfo( sunLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SUN_LIGHT_SHADOWS )
		sunLightShadow = sunLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getSunShadow( sunShadowMap[ i ], sunLightShadow, UNROLLED_LOOP_INDEX ) : 1.0;
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
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( directionalShadowMap[ i ], directionalLightShadow.shadowMapSize, directionalLightShadow.shadowIntensity, directionalLightShadow.shadowBias, directionalLightShadow.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
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
	#if NUM_LIGHT_PROBE_GRIDS > 0
		vec3 probeWorldPos = ( ( vec4( geometryPosition, 1.0 ) - viewMatrix[ 3 ] ) * viewMatrix ).xyz;
		vec3 probeWorldNormal = transformNormalByInverseViewMatrix( geometryNormal, viewMatrix );
		int probeGrid = - 1;
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( isInsideLightProbeGrid( probeWorldPos, probeWorldNormal, probesMin[ i ], probesMax[ i ], probesResolution[ i ] ) ) probeGrid = UNROLLED_LOOP_INDEX;
		}
		#pragma unroll_loop_end
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( probeGrid == UNROLLED_LOOP_INDEX ) irradiance += getLightProbeGridIrradiance( probesSH[ i ], probesMin[ i ], probesMax[ i ], probesResolution[ i ], probeWorldPos, probeWorldNormal );
		}
		#pragma unroll_loop_end
	#endif
#endif
#if defined( RE_IndirectSpecular )
	vec3 radiance = vec3( 0.0 );
	vec3 clearcoatRadiance = vec3( 0.0 );
#endif`,dO=`#if defined( RE_IndirectDiffuse )
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		vec3 lightMapIrradiance = lightMapTexel.rgb * lightMapIntensity;
		irradiance += lightMapIrradiance;
	#endif
	#if defined( USE_ENVMAP ) && defined( ENVMAP_TYPE_PMREM )
		#if defined( STANDARD ) || defined( LAMBERT ) || defined( PHONG )
			iblIrradiance += getIBLIrradiance( geometryNormal );
		#endif
	#endif
#endif
#if defined( USE_ENVMAP ) && defined( RE_IndirectSpecular )
	#ifdef USE_ANISOTROPY
		vec3 iblRadiance = getIBLAnisotropyRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
	#else
		vec3 iblRadiance = getIBLRadiance( geometryViewDir, geometryNormal, material.roughness );
	#endif
	#ifdef USE_RETROREFLECTION
		#ifdef USE_ANISOTROPY
			vec3 retroIBLRadiance = getIBLAnisotropyRetroRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
		#else
			vec3 retroIBLRadiance = getIBLRetroRadiance( geometryViewDir, geometryNormal, material.roughness );
		#endif
		iblRadiance = mix( iblRadiance, retroIBLRadiance, saturate( material.retroreflectivity ) );
	#endif
	radiance += iblRadiance;
	#ifdef USE_CLEARCOAT
		clearcoatRadiance += getIBLRadiance( geometryViewDir, geometryClearcoatNormal, material.clearcoatRoughness );
	#endif
#endif`,pO=`#if defined( RE_IndirectDiffuse )
	#if defined( LAMBERT ) || defined( PHONG )
		irradiance += iblIrradiance;
	#endif
	RE_IndirectDiffuse( irradiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif
#if defined( RE_IndirectSpecular )
	RE_IndirectSpecular( radiance, iblIrradiance, clearcoatRadiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif`,mO=`#if NUM_LIGHT_PROBE_GRIDS > 0
uniform highp sampler3D probesSH[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMin[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMax[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesResolution[ NUM_LIGHT_PROBE_GRIDS ];
bool isInsideLightProbeGrid( vec3 worldPos, vec3 worldNormal, vec3 probesMin, vec3 probesMax, vec3 probesResolution ) {
	vec3 spacing = ( probesMax - probesMin ) / probesResolution;
	vec3 samplePos = worldPos + worldNormal * spacing * 0.5;
	vec3 margin = spacing * 0.01;
	return all( greaterThanEqual( samplePos, probesMin - margin ) ) && all( lessThanEqual( samplePos, probesMax + margin ) );
}
vec3 getLightProbeGridIrradiance( highp sampler3D probesSH, vec3 probesMin, vec3 probesMax, vec3 probesResolution, vec3 worldPos, vec3 worldNormal ) {
	vec3 res = probesResolution;
	vec3 gridRange = probesMax - probesMin;
	vec3 probeSpacing = gridRange / res;
	vec3 samplePos = worldPos + worldNormal * probeSpacing * 0.5;
	vec3 uvw = clamp( ( samplePos - probesMin ) / gridRange, 0.5 / res, 1.0 - 0.5 / res );
	float nz          = res.z;
	float paddedSlices = nz + 2.0;
	float atlasDepth  = 7.0 * paddedSlices;
	float uvZBase     = uvw.z * nz + 1.0;
	vec4 s0 = texture( probesSH, vec3( uvw.xy, ( uvZBase                       ) / atlasDepth ) );
	vec4 s1 = texture( probesSH, vec3( uvw.xy, ( uvZBase +       paddedSlices   ) / atlasDepth ) );
	vec4 s2 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 2.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s3 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 3.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s4 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 4.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s5 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 5.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s6 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 6.0 * paddedSlices   ) / atlasDepth ) );
	vec3 c0 = s0.xyz;
	vec3 c1 = vec3( s0.w, s1.xy );
	vec3 c2 = vec3( s1.zw, s2.x );
	vec3 c3 = s2.yzw;
	vec3 c4 = s3.xyz;
	vec3 c5 = vec3( s3.w, s4.xy );
	vec3 c6 = vec3( s4.zw, s5.x );
	vec3 c7 = s5.yzw;
	vec3 c8 = s6.xyz;
	float x = worldNormal.x, y = worldNormal.y, z = worldNormal.z;
	vec3 result = c0 * 0.886227;
	result += c1 * 2.0 * 0.511664 * y;
	result += c2 * 2.0 * 0.511664 * z;
	result += c3 * 2.0 * 0.511664 * x;
	result += c4 * 2.0 * 0.429043 * x * y;
	result += c5 * 2.0 * 0.429043 * y * z;
	result += c6 * ( 0.743125 * z * z - 0.247708 );
	result += c7 * 2.0 * 0.429043 * x * z;
	result += c8 * 0.429043 * ( x * x - y * y );
	return max( result, vec3( 0.0 ) );
}
#endif`,gO=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	gl_FragDepth = vIsPerspective == 0.0 ? gl_FragCoord.z : log2( vFragDepth ) * logDepthBufFC * 0.5;
#endif`,yO=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	uniform float logDepthBufFC;
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,_O=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,xO=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	vFragDepth = 1.0 + gl_Position.w;
	vIsPerspective = float( isPerspectiveMatrix( projectionMatrix ) );
#endif`,vO=`#ifdef USE_MAP
	vec4 sampledDiffuseColor = texture2D( map, vMapUv );
	#ifdef DECODE_VIDEO_TEXTURE
		sampledDiffuseColor = sRGBTransferEOTF( sampledDiffuseColor );
	#endif
	diffuseColor *= sampledDiffuseColor;
#endif`,bO=`#ifdef USE_MAP
	uniform sampler2D map;
#endif`,MO=`#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
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
#endif`,SO=`#if defined( USE_POINTS_UV )
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
#endif`,wO=`float metalnessFactor = metalness;
#ifdef USE_METALNESSMAP
	vec4 texelMetalness = texture2D( metalnessMap, vMetalnessMapUv );
	metalnessFactor *= texelMetalness.b;
#endif`,TO=`#ifdef USE_METALNESSMAP
	uniform sampler2D metalnessMap;
#endif`,AO=`#ifdef USE_INSTANCING_MORPH
	float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	float morphTargetBaseInfluence = texelFetch( morphTexture, ivec2( 0, gl_InstanceID ), 0 ).r;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		morphTargetInfluences[i] =  texelFetch( morphTexture, ivec2( i + 1, gl_InstanceID ), 0 ).r;
	}
#endif`,EO=`#if defined( USE_MORPHCOLORS )
	#if defined( USE_COLOR_ALPHA )
		vColor *= morphTargetBaseInfluence;
	#elif defined( USE_COLOR )
		vColor.rgb *= morphTargetBaseInfluence;
	#endif
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		#if defined( USE_COLOR_ALPHA )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor += getMorph( gl_VertexID, i, 2 ) * morphTargetInfluences[ i ];
		#elif defined( USE_COLOR )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor.rgb += getMorph( gl_VertexID, i, 2 ).rgb * morphTargetInfluences[ i ];
		#endif
	}
#endif`,CO=`#ifdef USE_MORPHNORMALS
	objectNormal *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) objectNormal += getMorph( gl_VertexID, i, 1 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,RO=`#ifdef USE_MORPHTARGETS
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
#endif`,PO=`#ifdef USE_MORPHTARGETS
	transformed *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) transformed += getMorph( gl_VertexID, i, 0 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,IO=`float faceDirection = gl_FrontFacing ? 1.0 : - 1.0;
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
	#ifdef DOUBLE_SIDED
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
	#ifdef DOUBLE_SIDED
		tbn2[0] *= faceDirection;
		tbn2[1] *= faceDirection;
	#endif
#endif
vec3 nonPerturbedNormal = normal;`,LO=`#ifdef USE_NORMALMAP_OBJECTSPACE
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
	#if defined( USE_PACKED_NORMALMAP )
		mapN = vec3( mapN.xy, sqrt( saturate( 1.0 - dot( mapN.xy, mapN.xy ) ) ) );
	#endif
	mapN.xy *= normalScale;
	normal = normalize( tbn * mapN );
#elif defined( USE_BUMPMAP )
	normal = perturbNormalArb( - vViewPosition, normal, dHdxy_fwd(), faceDirection );
#endif`,NO=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,DO=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,UO=`#ifndef FLAT_SHADED
	vNormal = normalize( transformedNormal );
	#ifdef USE_TANGENT
		vTangent = normalize( transformedTangent );
		vBitangent = normalize( cross( vNormal, vTangent ) * tangent.w );
		#ifdef FLIP_SIDED
			vBitangent = - vBitangent;
		#endif
	#endif
#endif`,FO=`#ifdef USE_NORMALMAP
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
#endif`,OO=`#ifdef USE_CLEARCOAT
	vec3 clearcoatNormal = nonPerturbedNormal;
#endif`,BO=`#ifdef USE_CLEARCOAT_NORMALMAP
	vec3 clearcoatMapN = texture2D( clearcoatNormalMap, vClearcoatNormalMapUv ).xyz * 2.0 - 1.0;
	clearcoatMapN.xy *= clearcoatNormalScale;
	clearcoatNormal = normalize( tbn2 * clearcoatMapN );
#endif`,kO=`#ifdef USE_CLEARCOATMAP
	uniform sampler2D clearcoatMap;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform sampler2D clearcoatNormalMap;
	uniform vec2 clearcoatNormalScale;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform sampler2D clearcoatRoughnessMap;
#endif`,zO=`#ifdef USE_IRIDESCENCEMAP
	uniform sampler2D iridescenceMap;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform sampler2D iridescenceThicknessMap;
#endif`,GO=`#ifdef OPAQUE
diffuseColor.a = 1.0;
#endif
#ifdef USE_TRANSMISSION
diffuseColor.a *= material.transmissionAlpha;
#endif
gl_FragColor = vec4( outgoingLight, diffuseColor.a );`,VO=`vec3 packNormalToRGB( const in vec3 normal ) {
	return normalize( normal ) * 0.5 + 0.5;
}
vec3 unpackRGBToNormal( const in vec3 rgb ) {
	return 2.0 * rgb.xyz - 1.0;
}
const float PackUpscale = 256. / 255.;const float UnpackDownscale = 255. / 256.;const float ShiftRight8 = 1. / 256.;
const float Inv255 = 1. / 255.;
const vec4 PackFactors = vec4( 1.0, 256.0, 256.0 * 256.0, 256.0 * 256.0 * 256.0 );
const vec2 UnpackFactors2 = vec2( UnpackDownscale, 1.0 / PackFactors.g );
const vec3 UnpackFactors3 = vec3( UnpackDownscale / PackFactors.rg, 1.0 / PackFactors.b );
const vec4 UnpackFactors4 = vec4( UnpackDownscale / PackFactors.rgb, 1.0 / PackFactors.a );
vec4 packDepthToRGBA( const in float v ) {
	if( v <= 0.0 )
		return vec4( 0., 0., 0., 0. );
	if( v >= 1.0 )
		return vec4( 1., 1., 1., 1. );
	float vuf;
	float af = modf( v * PackFactors.a, vuf );
	float bf = modf( vuf * ShiftRight8, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec4( vuf * Inv255, gf * PackUpscale, bf * PackUpscale, af );
}
vec3 packDepthToRGB( const in float v ) {
	if( v <= 0.0 )
		return vec3( 0., 0., 0. );
	if( v >= 1.0 )
		return vec3( 1., 1., 1. );
	float vuf;
	float bf = modf( v * PackFactors.b, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec3( vuf * Inv255, gf * PackUpscale, bf );
}
vec2 packDepthToRG( const in float v ) {
	if( v <= 0.0 )
		return vec2( 0., 0. );
	if( v >= 1.0 )
		return vec2( 1., 1. );
	float vuf;
	float gf = modf( v * 256., vuf );
	return vec2( vuf * Inv255, gf );
}
float unpackRGBAToDepth( const in vec4 v ) {
	return dot( v, UnpackFactors4 );
}
float unpackRGBToDepth( const in vec3 v ) {
	return dot( v, UnpackFactors3 );
}
float unpackRGToDepth( const in vec2 v ) {
	return v.r * UnpackFactors2.r + v.g * UnpackFactors2.g;
}
vec4 pack2HalfToRGBA( const in vec2 v ) {
	vec4 r = vec4( v.x, fract( v.x * 255.0 ), v.y, fract( v.y * 255.0 ) );
	return vec4( r.x - r.y / 255.0, r.y, r.z - r.w / 255.0, r.w );
}
vec2 unpackRGBATo2Half( const in vec4 v ) {
	return vec2( v.x + ( v.y / 255.0 ), v.z + ( v.w / 255.0 ) );
}
float viewZToOrthographicDepth( const in float viewZ, const in float near, const in float far ) {
	return ( viewZ + near ) / ( near - far );
}
float orthographicDepthToViewZ( const in float depth, const in float near, const in float far ) {
	#ifdef USE_REVERSED_DEPTH_BUFFER
	
		return depth * ( far - near ) - far;
	#else
		return depth * ( near - far ) - near;
	#endif
}
float viewZToPerspectiveDepth( const in float viewZ, const in float near, const in float far ) {
	return ( ( near + viewZ ) * far ) / ( ( far - near ) * viewZ );
}
float perspectiveDepthToViewZ( const in float depth, const in float near, const in float far ) {
	
	#ifdef USE_REVERSED_DEPTH_BUFFER
		return ( near * far ) / ( ( near - far ) * depth - near );
	#else
		return ( near * far ) / ( ( far - near ) * depth - far );
	#endif
}`,HO=`#ifdef PREMULTIPLIED_ALPHA
	gl_FragColor.rgb *= gl_FragColor.a;
#endif`,WO=`vec4 mvPosition = vec4( transformed, 1.0 );
#ifdef USE_BATCHING
	mvPosition = batchingMatrix * mvPosition;
#endif
#ifdef USE_INSTANCING
	mvPosition = instanceMatrix * mvPosition;
#endif
mvPosition = modelViewMatrix * mvPosition;
gl_Position = projectionMatrix * mvPosition;`,$O=`#ifdef DITHERING
	gl_FragColor.rgb = dithering( gl_FragColor.rgb );
#endif`,XO=`#ifdef DITHERING
	vec3 dithering( vec3 color ) {
		float grid_position = rand( gl_FragCoord.xy );
		vec3 dither_shift_RGB = vec3( 0.25 / 255.0, -0.25 / 255.0, 0.25 / 255.0 );
		dither_shift_RGB = mix( 2.0 * dither_shift_RGB, -2.0 * dither_shift_RGB, grid_position );
		return color + dither_shift_RGB;
	}
#endif`,qO=`float roughnessFactor = roughness;
#ifdef USE_ROUGHNESSMAP
	vec4 texelRoughness = texture2D( roughnessMap, vRoughnessMapUv );
	roughnessFactor *= texelRoughness.g;
#endif`,YO=`#ifdef USE_ROUGHNESSMAP
	uniform sampler2D roughnessMap;
#endif`,ZO=`#if NUM_SPOT_LIGHT_COORDS > 0
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#if NUM_SPOT_LIGHT_MAPS > 0
	uniform sampler2D spotLightMap[ NUM_SPOT_LIGHT_MAPS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		#define SUN_LIGHT_CASCADES 2
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#else
			uniform sampler2D sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#endif
		uniform mat4 sunShadowMatrix[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		uniform vec4 sunShadowCascade[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
		struct SunLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SunLightShadow sunLightShadows[ NUM_SUN_LIGHT_SHADOWS ];
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#else
			uniform sampler2D directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#endif
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#else
			uniform sampler2D spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#endif
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform samplerCubeShadow pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#elif defined( SHADOWMAP_TYPE_BASIC )
			uniform samplerCube pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#endif
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float interleavedGradientNoise( vec2 position ) {
			return fract( 52.9829189 * fract( dot( position, vec2( 0.06711056, 0.00583715 ) ) ) );
		}
		vec2 vogelDiskSample( int sampleIndex, int samplesCount, float phi ) {
			const float goldenAngle = 2.399963229728653;
			float r = sqrt( ( float( sampleIndex ) + 0.5 ) / float( samplesCount ) );
			float theta = float( sampleIndex ) * goldenAngle + phi;
			return vec2( cos( theta ), sin( theta ) ) * r;
		}
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float getShadow( sampler2DShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 texelSize = vec2( 1.0 ) / shadowMapSize;
				vec2 radius = shadowRadius * texelSize;
				float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
				shadow = (
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 0, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 1, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 2, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 3, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 4, 5, phi ) * radius, shadowCoord.z ) )
				) * 0.2;
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#elif defined( SHADOWMAP_TYPE_VSM )
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 distribution = texture2D( shadowMap, shadowCoord.xy ).rg;
				float mean = distribution.x;
				float variance = distribution.y * distribution.y;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					float hard_shadow = step( mean, shadowCoord.z );
				#else
					float hard_shadow = step( shadowCoord.z, mean );
				#endif
				
				if ( hard_shadow == 1.0 ) {
					shadow = 1.0;
				} else {
					variance = max( variance, 0.0000001 );
					float d = shadowCoord.z - mean;
					float p_max = variance / ( variance + d * d );
					p_max = clamp( ( p_max - 0.3 ) / 0.65, 0.0, 1.0 );
					shadow = max( hard_shadow, p_max );
				}
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#else
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				float depth = texture2D( shadowMap, shadowCoord.xy ).r;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					shadow = step( depth, shadowCoord.z );
				#else
					shadow = step( shadowCoord.z, depth );
				#endif
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#endif
	#if NUM_SUN_LIGHT_SHADOWS > 0
		float getSunShadow(
			#if defined( SHADOWMAP_TYPE_PCF )
				sampler2DShadow shadowMap,
			#else
				sampler2D shadowMap,
			#endif
			SunLightShadow sunLightShadow,
			int shadowIndex
		) {
			vec4 shadowWorldPosition = vec4( vSunShadowWorldPosition.xyz + vSunShadowWorldNormal * sunLightShadow.shadowNormalBias, 1.0 );
			float viewDepth = vSunShadowWorldPosition.w;
			int cascadeOffset = shadowIndex * SUN_LIGHT_CASCADES;
			float shadow = 1.0;
			for ( int i = SUN_LIGHT_CASCADES - 1; i >= 0; i -- ) {
				vec4 cascade = sunShadowCascade[ cascadeOffset + i ];
				if ( viewDepth >= cascade.x && viewDepth < cascade.y ) {
					float cascadeShadow = getShadow(
						shadowMap,
						sunLightShadow.shadowMapSize,
						sunLightShadow.shadowIntensity,
						sunLightShadow.shadowBias,
						sunLightShadow.shadowRadius,
						sunShadowMatrix[ cascadeOffset + i ] * shadowWorldPosition
					);
					shadow = mix( cascadeShadow, shadow, smoothstep( cascade.z, cascade.y, viewDepth ) );
				}
			}
			return shadow;
		}
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
	#if defined( SHADOWMAP_TYPE_PCF )
	float getPointShadow( samplerCubeShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 bd3D = normalize( lightToPosition );
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float lightDistance = length( lightToPosition );
			float depthRange = shadowCameraFar - shadowCameraNear;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				float depthA = - shadowCameraNear / depthRange - shadowBias;
				float depthB = shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#else
				float depthA = shadowCameraFar / depthRange + shadowBias;
				float depthB = - shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#endif
			float texelSize = shadowRadius / shadowMapSize.x;
			vec3 absDir = abs( bd3D );
			vec3 tangent = absDir.x > absDir.z ? vec3( 0.0, 1.0, 0.0 ) : vec3( 1.0, 0.0, 0.0 );
			tangent = normalize( cross( bd3D, tangent ) );
			vec3 bitangent = cross( bd3D, tangent );
			float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
			shadow = 0.0;
			for ( int i = 0; i < 5; i ++ ) {
				vec2 offset = vogelDiskSample( i, 5, phi );
				vec3 direction = bd3D + ( tangent * offset.x + bitangent * offset.y ) * texelSize;
				vec3 absDirection = abs( direction );
				float dp = depthA + depthB / max( max( absDirection.x, absDirection.y ), absDirection.z );
				shadow += texture( shadowMap, vec4( direction, dp ) );
			}
			shadow *= 0.2;
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#elif defined( SHADOWMAP_TYPE_BASIC )
	float getPointShadow( samplerCube shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float dp = ( shadowCameraFar * ( viewSpaceZ - shadowCameraNear ) ) / ( viewSpaceZ * ( shadowCameraFar - shadowCameraNear ) );
			dp += shadowBias;
			vec3 bd3D = normalize( lightToPosition );
			float depth = textureCube( shadowMap, bd3D ).r;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				depth = 1.0 - depth;
			#endif
			shadow = step( dp, depth );
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#endif
	#endif
#endif`,JO=`#if NUM_SPOT_LIGHT_COORDS > 0
	uniform mat4 spotLightMatrix[ NUM_SPOT_LIGHT_COORDS ];
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		uniform mat4 directionalShadowMatrix[ NUM_DIR_LIGHT_SHADOWS ];
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		struct SpotLightShadow {
			float shadowIntensity;
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
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
#endif`,KO=`#if ( defined( USE_SHADOWMAP ) && ( NUM_DIR_LIGHT_SHADOWS > 0 || NUM_SUN_LIGHT_SHADOWS > 0 || NUM_POINT_LIGHT_SHADOWS > 0 ) ) || ( NUM_SPOT_LIGHT_COORDS > 0 )
	#ifdef HAS_NORMAL
		vec3 shadowWorldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
	#else
		vec3 shadowWorldNormal = vec3( 0.0 );
	#endif
	vec4 shadowWorldPosition;
#endif
#if defined( USE_SHADOWMAP )
	#if NUM_SUN_LIGHT_SHADOWS > 0
		vSunShadowWorldPosition = vec4( worldPosition.xyz, - mvPosition.z );
		vSunShadowWorldNormal = shadowWorldNormal;
	#endif
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
#endif`,jO=`float getShadowMask() {
	float shadow = 1.0;
	#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHT_SHADOWS; i ++ ) {
		sunLight = sunLightShadows[ i ];
		shadow *= receiveShadow ? getSunShadow( sunShadowMap[ i ], sunLight, UNROLLED_LOOP_INDEX ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
		directionalLight = directionalLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( directionalShadowMap[ i ], directionalLight.shadowMapSize, directionalLight.shadowIntensity, directionalLight.shadowBias, directionalLight.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_SHADOWS; i ++ ) {
		spotLight = spotLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( spotShadowMap[ i ], spotLight.shadowMapSize, spotLight.shadowIntensity, spotLight.shadowBias, spotLight.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0 && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
	PointLightShadow pointLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
		pointLight = pointLightShadows[ i ];
		shadow *= receiveShadow ? getPointShadow( pointShadowMap[ i ], pointLight.shadowMapSize, pointLight.shadowIntensity, pointLight.shadowBias, pointLight.shadowRadius, vPointShadowCoord[ i ], pointLight.shadowCameraNear, pointLight.shadowCameraFar ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#endif
	return shadow;
}`,QO=`#ifdef USE_SKINNING
	mat4 boneMatX = getBoneMatrix( skinIndex.x );
	mat4 boneMatY = getBoneMatrix( skinIndex.y );
	mat4 boneMatZ = getBoneMatrix( skinIndex.z );
	mat4 boneMatW = getBoneMatrix( skinIndex.w );
#endif`,t4=`#ifdef USE_SKINNING
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
#endif`,e4=`#ifdef USE_SKINNING
	vec4 skinVertex = bindMatrix * vec4( transformed, 1.0 );
	vec4 skinned = vec4( 0.0 );
	skinned += boneMatX * skinVertex * skinWeight.x;
	skinned += boneMatY * skinVertex * skinWeight.y;
	skinned += boneMatZ * skinVertex * skinWeight.z;
	skinned += boneMatW * skinVertex * skinWeight.w;
	transformed = ( bindMatrixInverse * skinned ).xyz;
#endif`,n4=`#ifdef USE_SKINNING
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
#endif`,i4=`float specularStrength;
#ifdef USE_SPECULARMAP
	vec4 texelSpecular = texture2D( specularMap, vSpecularMapUv );
	specularStrength = texelSpecular.r;
#else
	specularStrength = 1.0;
#endif`,r4=`#ifdef USE_SPECULARMAP
	uniform sampler2D specularMap;
#endif`,s4=`#if defined( TONE_MAPPING )
	gl_FragColor.rgb = toneMapping( gl_FragColor.rgb );
#endif`,o4=`#ifndef saturate
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
vec3 CineonToneMapping( vec3 color ) {
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
vec3 CustomToneMapping( vec3 color ) { return color; }`,a4=`#ifdef USE_TRANSMISSION
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
	vec3 n = transformNormalByInverseViewMatrix( normal, viewMatrix );
	vec4 transmitted = getIBLVolumeRefraction(
		n, v, material.roughness, material.diffuseContribution, material.specularColorBlended, material.specularF90,
		pos, modelMatrix, viewMatrix, projectionMatrix, material.dispersion, material.ior, material.thickness,
		material.attenuationColor, material.attenuationDistance );
	material.transmissionAlpha = mix( material.transmissionAlpha, transmitted.a, material.transmission );
	totalDiffuse = mix( totalDiffuse, transmitted.rgb, material.transmission );
#endif`,c4=`#ifdef USE_TRANSMISSION
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
#endif`,l4=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
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
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	varying vec2 vDiffuseRoughnessMapUv;
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
#endif`,u4=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
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
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	uniform mat3 diffuseRoughnessMapTransform;
	varying vec2 vDiffuseRoughnessMapUv;
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
#endif`,f4=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
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
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	vDiffuseRoughnessMapUv = ( diffuseRoughnessMapTransform * vec3( DIFFUSE_ROUGHNESSMAP_UV, 1 ) ).xy;
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
#endif`,h4=`#if defined( USE_ENVMAP ) || defined( DISTANCE ) || defined ( USE_SHADOWMAP ) || defined ( USE_TRANSMISSION ) || NUM_SPOT_LIGHT_COORDS > 0
	vec4 worldPosition = vec4( transformed, 1.0 );
	#ifdef USE_BATCHING
		worldPosition = batchingMatrix * worldPosition;
	#endif
	#ifdef USE_INSTANCING
		worldPosition = instanceMatrix * worldPosition;
	#endif
	worldPosition = modelMatrix * worldPosition;
#endif`,d4=`varying vec2 vUv;
uniform mat3 uvTransform;
void main() {
	vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	gl_Position = vec4( position.xy, 1.0, 1.0 );
}`,p4=`uniform sampler2D t2D;
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
}`,m4=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,g4=`uniform float backgroundBlurriness;
uniform float backgroundIntensity;
uniform mat3 backgroundRotation;
varying vec3 vWorldDirection;
#include <envmap_common_pars_fragment>
void main() {
	#ifdef ENVMAP_TYPE_PMREM
		vec4 texColor = textureLod( envMap, backgroundRotation * vWorldDirection, roughnessToMip( backgroundBlurriness ) );
	#else
		vec4 texColor = textureCube( envMap, backgroundRotation * vWorldDirection );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,y4=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,_4=`uniform samplerCube tCube;
uniform float tFlip;
uniform float opacity;
varying vec3 vWorldDirection;
void main() {
	vec4 texColor = textureCube( tCube, vec3( tFlip * vWorldDirection.x, vWorldDirection.yz ) );
	gl_FragColor = texColor;
	gl_FragColor.a *= opacity;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,x4=`#include <common>
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
}`,v4=`#if DEPTH_PACKING == 3200
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
	#ifdef USE_REVERSED_DEPTH_BUFFER
		float fragCoordZ = vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ];
	#else
		float fragCoordZ = 0.5 * vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ] + 0.5;
	#endif
	#if DEPTH_PACKING == 3200
		gl_FragColor = vec4( vec3( 1.0 - fragCoordZ ), opacity );
	#elif DEPTH_PACKING == 3201
		gl_FragColor = packDepthToRGBA( fragCoordZ );
	#elif DEPTH_PACKING == 3202
		gl_FragColor = vec4( packDepthToRGB( fragCoordZ ), 1.0 );
	#elif DEPTH_PACKING == 3203
		gl_FragColor = vec4( packDepthToRG( fragCoordZ ), 0.0, 1.0 );
	#endif
}`,b4=`#define DISTANCE
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
}`,M4=`#define DISTANCE
uniform vec3 referencePosition;
uniform float nearDistance;
uniform float farDistance;
varying vec3 vWorldPosition;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	float dist = length( vWorldPosition - referencePosition );
	dist = ( dist - nearDistance ) / ( farDistance - nearDistance );
	dist = saturate( dist );
	gl_FragColor = vec4( dist, 0.0, 0.0, 1.0 );
}`,S4=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
}`,w4=`uniform sampler2D tEquirect;
varying vec3 vWorldDirection;
#include <common>
void main() {
	vec3 direction = normalize( vWorldDirection );
	vec2 sampleUV = equirectUv( direction );
	gl_FragColor = texture2D( tEquirect, sampleUV );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,T4=`uniform float scale;
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
}`,A4=`uniform vec3 diffuse;
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
}`,E4=`#include <common>
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
}`,C4=`uniform vec3 diffuse;
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
}`,R4=`#define LAMBERT
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
}`,P4=`#define LAMBERT
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
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
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
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
}`,I4=`#define MATCAP
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
}`,L4=`#define MATCAP
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
}`,N4=`#define NORMAL
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
}`,D4=`#define NORMAL
uniform float opacity;
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
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
	gl_FragColor = vec4( normalize( normal ) * 0.5 + 0.5, diffuseColor.a );
	#ifdef OPAQUE
		gl_FragColor.a = 1.0;
	#endif
}`,U4=`#define PHONG
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
}`,F4=`#define PHONG
uniform vec3 diffuse;
uniform vec3 emissive;
uniform vec3 specular;
uniform float shininess;
uniform float opacity;
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
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
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
}`,O4=`#define STANDARD
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
}`,B4=`#define STANDARD
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
#ifdef USE_DIFFUSE_ROUGHNESS
	uniform float diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		uniform sampler2D diffuseRoughnessMap;
	#endif
#endif
#ifdef USE_DISPERSION
	uniform float dispersion;
#endif
#ifdef USE_RETROREFLECTION
	uniform float retroreflectivity;
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
 
		outgoingLight = outgoingLight + sheenSpecularDirect + sheenSpecularIndirect;
 
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
}`,k4=`#define TOON
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
}`,z4=`#define TOON
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
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
}`,G4=`uniform float size;
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
}`,V4=`uniform vec3 diffuse;
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
}`,H4=`#include <common>
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
}`,W4=`uniform vec3 color;
uniform float opacity;
#include <common>
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
	#include <premultiplied_alpha_fragment>
}`,$4=`uniform float rotation;
uniform vec2 center;
#include <common>
#include <uv_pars_vertex>
#include <fog_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	vec4 mvPosition = modelViewMatrix[ 3 ];
	vec2 scale = vec2( length( modelMatrix[ 0 ].xyz ), length( modelMatrix[ 1 ].xyz ) );
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
}`,X4=`uniform vec3 diffuse;
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
}`,jt={alphahash_fragment:pF,alphahash_pars_fragment:mF,alphamap_fragment:gF,alphamap_pars_fragment:yF,alphatest_fragment:_F,alphatest_pars_fragment:xF,aomap_fragment:vF,aomap_pars_fragment:bF,batching_pars_vertex:MF,batching_vertex:SF,begin_vertex:wF,beginnormal_vertex:TF,bsdfs:AF,iridescence_fragment:EF,bumpmap_pars_fragment:CF,clipping_planes_fragment:RF,clipping_planes_pars_fragment:PF,clipping_planes_pars_vertex:IF,clipping_planes_vertex:LF,color_fragment:NF,color_pars_fragment:DF,color_pars_vertex:UF,color_vertex:FF,common:OF,defaultnormal_vertex:BF,displacementmap_pars_vertex:kF,displacementmap_vertex:zF,emissivemap_fragment:GF,emissivemap_pars_fragment:VF,colorspace_fragment:HF,colorspace_pars_fragment:WF,envmap_fragment:$F,envmap_common_pars_fragment:XF,envmap_pars_fragment:qF,envmap_pars_vertex:YF,envmap_physical_pars_fragment:sO,envmap_vertex:ZF,fog_vertex:JF,fog_pars_vertex:KF,fog_fragment:jF,fog_pars_fragment:QF,gradientmap_pars_fragment:tO,lightmap_pars_fragment:eO,lights_lambert_fragment:nO,lights_lambert_pars_fragment:iO,lights_pars_begin:rO,lights_toon_fragment:oO,lights_toon_pars_fragment:aO,lights_phong_fragment:cO,lights_phong_pars_fragment:lO,lights_physical_fragment:uO,lights_physical_pars_fragment:fO,lights_fragment_begin:hO,lights_fragment_maps:dO,lights_fragment_end:pO,lightprobes_pars_fragment:mO,logdepthbuf_fragment:gO,logdepthbuf_pars_fragment:yO,logdepthbuf_pars_vertex:_O,logdepthbuf_vertex:xO,map_fragment:vO,map_pars_fragment:bO,map_particle_fragment:MO,map_particle_pars_fragment:SO,metalnessmap_fragment:wO,metalnessmap_pars_fragment:TO,morphinstance_vertex:AO,morphcolor_vertex:EO,morphnormal_vertex:CO,morphtarget_pars_vertex:RO,morphtarget_vertex:PO,normal_fragment_begin:IO,normal_fragment_maps:LO,normal_pars_fragment:NO,normal_pars_vertex:DO,normal_vertex:UO,normalmap_pars_fragment:FO,clearcoat_normal_fragment_begin:OO,clearcoat_normal_fragment_maps:BO,clearcoat_pars_fragment:kO,iridescence_pars_fragment:zO,opaque_fragment:GO,packing:VO,premultiplied_alpha_fragment:HO,project_vertex:WO,dithering_fragment:$O,dithering_pars_fragment:XO,roughnessmap_fragment:qO,roughnessmap_pars_fragment:YO,shadowmap_pars_fragment:ZO,shadowmap_pars_vertex:JO,shadowmap_vertex:KO,shadowmask_pars_fragment:jO,skinbase_vertex:QO,skinning_pars_vertex:t4,skinning_vertex:e4,skinnormal_vertex:n4,specularmap_fragment:i4,specularmap_pars_fragment:r4,tonemapping_fragment:s4,tonemapping_pars_fragment:o4,transmission_fragment:a4,transmission_pars_fragment:c4,uv_pars_fragment:l4,uv_pars_vertex:u4,uv_vertex:f4,worldpos_vertex:h4,background_vert:d4,background_frag:p4,backgroundCube_vert:m4,backgroundCube_frag:g4,cube_vert:y4,cube_frag:_4,depth_vert:x4,depth_frag:v4,distance_vert:b4,distance_frag:M4,equirect_vert:S4,equirect_frag:w4,linedashed_vert:T4,linedashed_frag:A4,meshbasic_vert:E4,meshbasic_frag:C4,meshlambert_vert:R4,meshlambert_frag:P4,meshmatcap_vert:I4,meshmatcap_frag:L4,meshnormal_vert:N4,meshnormal_frag:D4,meshphong_vert:U4,meshphong_frag:F4,meshphysical_vert:O4,meshphysical_frag:B4,meshtoon_vert:k4,meshtoon_frag:z4,points_vert:G4,points_frag:V4,shadow_vert:H4,shadow_frag:W4,sprite_vert:$4,sprite_frag:X4},wt={common:{diffuse:{value:new Wt(16777215)},opacity:{value:1},map:{value:null},mapTransform:{value:new zt},alphaMap:{value:null},alphaMapTransform:{value:new zt},alphaTest:{value:0}},specularmap:{specularMap:{value:null},specularMapTransform:{value:new zt}},envmap:{envMap:{value:null},envMapRotation:{value:new zt},reflectivity:{value:1},ior:{value:1.5},refractionRatio:{value:.98},dfgLUT:{value:null}},aomap:{aoMap:{value:null},aoMapIntensity:{value:1},aoMapTransform:{value:new zt}},lightmap:{lightMap:{value:null},lightMapIntensity:{value:1},lightMapTransform:{value:new zt}},bumpmap:{bumpMap:{value:null},bumpMapTransform:{value:new zt},bumpScale:{value:1}},normalmap:{normalMap:{value:null},normalMapTransform:{value:new zt},normalScale:{value:new Ft(1,1)}},displacementmap:{displacementMap:{value:null},displacementMapTransform:{value:new zt},displacementScale:{value:1},displacementBias:{value:0}},emissivemap:{emissiveMap:{value:null},emissiveMapTransform:{value:new zt}},metalnessmap:{metalnessMap:{value:null},metalnessMapTransform:{value:new zt}},roughnessmap:{roughnessMap:{value:null},roughnessMapTransform:{value:new zt}},gradientmap:{gradientMap:{value:null}},fog:{fogDensity:{value:25e-5},fogNear:{value:1},fogFar:{value:2e3},fogColor:{value:new Wt(16777215)}},lights:{ambientLightColor:{value:[]},lightProbe:{value:[]},sunLights:{value:[],properties:{direction:{},color:{}}},sunLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},sunShadowMatrix:{value:[]},sunShadowCascade:{value:[]},directionalLights:{value:[],properties:{direction:{},color:{}}},directionalLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},directionalShadowMatrix:{value:[]},spotLights:{value:[],properties:{color:{},position:{},direction:{},distance:{},coneCos:{},penumbraCos:{},decay:{}}},spotLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},spotLightMap:{value:[]},spotLightMatrix:{value:[]},pointLights:{value:[],properties:{color:{},position:{},decay:{},distance:{}}},pointLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{},shadowCameraNear:{},shadowCameraFar:{}}},pointShadowMatrix:{value:[]},hemisphereLights:{value:[],properties:{direction:{},skyColor:{},groundColor:{}}},rectAreaLights:{value:[],properties:{color:{},position:{},width:{},height:{}}},ltc_1:{value:null},ltc_2:{value:null},probesSH:{value:[]},probesMin:{value:[]},probesMax:{value:[]},probesResolution:{value:[]}},points:{diffuse:{value:new Wt(16777215)},opacity:{value:1},size:{value:1},scale:{value:1},map:{value:null},alphaMap:{value:null},alphaMapTransform:{value:new zt},alphaTest:{value:0},uvTransform:{value:new zt}},sprite:{diffuse:{value:new Wt(16777215)},opacity:{value:1},center:{value:new Ft(.5,.5)},rotation:{value:0},map:{value:null},mapTransform:{value:new zt},alphaMap:{value:null},alphaMapTransform:{value:new zt},alphaTest:{value:0}}},Fn={basic:{uniforms:wn([wt.common,wt.specularmap,wt.envmap,wt.aomap,wt.lightmap,wt.fog]),vertexShader:jt.meshbasic_vert,fragmentShader:jt.meshbasic_frag},lambert:{uniforms:wn([wt.common,wt.specularmap,wt.envmap,wt.aomap,wt.lightmap,wt.emissivemap,wt.bumpmap,wt.normalmap,wt.displacementmap,wt.fog,wt.lights,{emissive:{value:new Wt(0)},envMapIntensity:{value:1}}]),vertexShader:jt.meshlambert_vert,fragmentShader:jt.meshlambert_frag},phong:{uniforms:wn([wt.common,wt.specularmap,wt.envmap,wt.aomap,wt.lightmap,wt.emissivemap,wt.bumpmap,wt.normalmap,wt.displacementmap,wt.fog,wt.lights,{emissive:{value:new Wt(0)},specular:{value:new Wt(1118481)},shininess:{value:30},envMapIntensity:{value:1}}]),vertexShader:jt.meshphong_vert,fragmentShader:jt.meshphong_frag},standard:{uniforms:wn([wt.common,wt.envmap,wt.aomap,wt.lightmap,wt.emissivemap,wt.bumpmap,wt.normalmap,wt.displacementmap,wt.roughnessmap,wt.metalnessmap,wt.fog,wt.lights,{emissive:{value:new Wt(0)},roughness:{value:1},metalness:{value:0},envMapIntensity:{value:1}}]),vertexShader:jt.meshphysical_vert,fragmentShader:jt.meshphysical_frag},toon:{uniforms:wn([wt.common,wt.aomap,wt.lightmap,wt.emissivemap,wt.bumpmap,wt.normalmap,wt.displacementmap,wt.gradientmap,wt.fog,wt.lights,{emissive:{value:new Wt(0)}}]),vertexShader:jt.meshtoon_vert,fragmentShader:jt.meshtoon_frag},matcap:{uniforms:wn([wt.common,wt.bumpmap,wt.normalmap,wt.displacementmap,wt.fog,{matcap:{value:null}}]),vertexShader:jt.meshmatcap_vert,fragmentShader:jt.meshmatcap_frag},points:{uniforms:wn([wt.points,wt.fog]),vertexShader:jt.points_vert,fragmentShader:jt.points_frag},dashed:{uniforms:wn([wt.common,wt.fog,{scale:{value:1},dashSize:{value:1},totalSize:{value:2}}]),vertexShader:jt.linedashed_vert,fragmentShader:jt.linedashed_frag},depth:{uniforms:wn([wt.common,wt.displacementmap]),vertexShader:jt.depth_vert,fragmentShader:jt.depth_frag},normal:{uniforms:wn([wt.common,wt.bumpmap,wt.normalmap,wt.displacementmap,{opacity:{value:1}}]),vertexShader:jt.meshnormal_vert,fragmentShader:jt.meshnormal_frag},sprite:{uniforms:wn([wt.sprite,wt.fog]),vertexShader:jt.sprite_vert,fragmentShader:jt.sprite_frag},background:{uniforms:{uvTransform:{value:new zt},t2D:{value:null},backgroundIntensity:{value:1}},vertexShader:jt.background_vert,fragmentShader:jt.background_frag},backgroundCube:{uniforms:{envMap:{value:null},backgroundBlurriness:{value:0},backgroundIntensity:{value:1},backgroundRotation:{value:new zt}},vertexShader:jt.backgroundCube_vert,fragmentShader:jt.backgroundCube_frag},cube:{uniforms:{tCube:{value:null},tFlip:{value:-1},opacity:{value:1}},vertexShader:jt.cube_vert,fragmentShader:jt.cube_frag},equirect:{uniforms:{tEquirect:{value:null}},vertexShader:jt.equirect_vert,fragmentShader:jt.equirect_frag},distance:{uniforms:wn([wt.common,wt.displacementmap,{referencePosition:{value:new k},nearDistance:{value:1},farDistance:{value:1e3}}]),vertexShader:jt.distance_vert,fragmentShader:jt.distance_frag},shadow:{uniforms:wn([wt.lights,wt.fog,{color:{value:new Wt(0)},opacity:{value:1}}]),vertexShader:jt.shadow_vert,fragmentShader:jt.shadow_frag}};Fn.physical={uniforms:wn([Fn.standard.uniforms,{clearcoat:{value:0},clearcoatMap:{value:null},clearcoatMapTransform:{value:new zt},clearcoatNormalMap:{value:null},clearcoatNormalMapTransform:{value:new zt},clearcoatNormalScale:{value:new Ft(1,1)},clearcoatRoughness:{value:0},clearcoatRoughnessMap:{value:null},clearcoatRoughnessMapTransform:{value:new zt},diffuseRoughness:{value:0},diffuseRoughnessMap:{value:null},diffuseRoughnessMapTransform:{value:new zt},dispersion:{value:0},retroreflectivity:{value:0},iridescence:{value:0},iridescenceMap:{value:null},iridescenceMapTransform:{value:new zt},iridescenceIOR:{value:1.3},iridescenceThicknessMinimum:{value:100},iridescenceThicknessMaximum:{value:400},iridescenceThicknessMap:{value:null},iridescenceThicknessMapTransform:{value:new zt},sheen:{value:0},sheenColor:{value:new Wt(0)},sheenColorMap:{value:null},sheenColorMapTransform:{value:new zt},sheenRoughness:{value:1},sheenRoughnessMap:{value:null},sheenRoughnessMapTransform:{value:new zt},transmission:{value:0},transmissionMap:{value:null},transmissionMapTransform:{value:new zt},transmissionSamplerSize:{value:new Ft},transmissionSamplerMap:{value:null},thickness:{value:0},thicknessMap:{value:null},thicknessMapTransform:{value:new zt},attenuationDistance:{value:0},attenuationColor:{value:new Wt(0)},specularColor:{value:new Wt(1,1,1)},specularColorMap:{value:null},specularColorMapTransform:{value:new zt},specularIntensity:{value:1},specularIntensityMap:{value:null},specularIntensityMapTransform:{value:new zt},anisotropyVector:{value:new Ft},anisotropyMap:{value:null},anisotropyMapTransform:{value:new zt}}]),vertexShader:jt.meshphysical_vert,fragmentShader:jt.meshphysical_frag};var pp={r:0,b:0,g:0},q4=new ee,C2=new zt;C2.set(-1,0,0,0,1,0,0,0,1);function Y4(e,t,n,i,r,s){let o=new Wt(0),a=r===!0?0:1,c,l,u=null,h=0,f=null;function d(x){let S=x.isScene===!0?x.background:null;if(S&&S.isTexture){let v=x.backgroundBlurriness>0;S=t.get(S,v)}return S}function p(x){let S=!1,v=d(x);v===null?m(o,a):v&&v.isColor&&(m(v,1),S=!0);let w=e.xr.getEnvironmentBlendMode();w==="additive"?n.buffers.color.setClear(0,0,0,1,s):w==="alpha-blend"&&n.buffers.color.setClear(0,0,0,0,s),(e.autoClear||S)&&(n.buffers.depth.setTest(!0),n.buffers.depth.setMask(!0),n.buffers.color.setMask(!0),e.clear(e.autoClearColor,e.autoClearDepth,e.autoClearStencil))}function y(x,S){let v=d(S);v&&v.isCubeTexture?(l===void 0&&(l=new ln(new Rs(1,1,1),new Ci({name:"BackgroundCubeMaterial",uniforms:Lo(Fn.backgroundCube.uniforms),vertexShader:Fn.backgroundCube.vertexShader,fragmentShader:Fn.backgroundCube.fragmentShader,side:Un,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),l.geometry.deleteAttribute("normal"),l.geometry.deleteAttribute("uv"),l.onBeforeRender=function(w,b,_){this.matrixWorld.copyPosition(_.matrixWorld)},Object.defineProperty(l.material,"envMap",{get:function(){return this.uniforms.envMap.value}}),i.update(l)),l.material.uniforms.envMap.value=v,l.material.uniforms.backgroundBlurriness.value=S.backgroundBlurriness,l.material.uniforms.backgroundIntensity.value=S.backgroundIntensity,l.material.uniforms.backgroundRotation.value.setFromMatrix4(q4.makeRotationFromEuler(S.backgroundRotation)).transpose(),v.isRenderTargetTexture===!1&&l.material.uniforms.backgroundRotation.value.premultiply(C2),l.material.toneMapped=re.getTransfer(v.colorSpace)!==de,(u!==v||h!==v.version||f!==e.toneMapping)&&(l.material.needsUpdate=!0,u=v,h=v.version,f=e.toneMapping),l.layers.enableAll(),x.unshift(l,l.geometry,l.material,0,0,null)):v&&v.isTexture&&(c===void 0&&(c=new ln(new Eo(2,2),new Ci({name:"BackgroundMaterial",uniforms:Lo(Fn.background.uniforms),vertexShader:Fn.background.vertexShader,fragmentShader:Fn.background.fragmentShader,side:Bs,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),c.geometry.deleteAttribute("normal"),Object.defineProperty(c.material,"map",{get:function(){return this.uniforms.t2D.value}}),i.update(c)),c.material.uniforms.t2D.value=v,c.material.uniforms.backgroundIntensity.value=S.backgroundIntensity,c.material.toneMapped=re.getTransfer(v.colorSpace)!==de,v.matrixAutoUpdate===!0&&v.updateMatrix(),c.material.uniforms.uvTransform.value.copy(v.matrix),(u!==v||h!==v.version||f!==e.toneMapping)&&(c.material.needsUpdate=!0,u=v,h=v.version,f=e.toneMapping),c.layers.enableAll(),x.unshift(c,c.geometry,c.material,0,0,null))}function m(x,S){x.getRGB(pp,px(e)),n.buffers.color.setClear(pp.r,pp.g,pp.b,S,s)}function g(){l!==void 0&&(l.geometry.dispose(),l.material.dispose(),l=void 0),c!==void 0&&(c.geometry.dispose(),c.material.dispose(),c=void 0)}return{getClearColor:function(){return o},setClearColor:function(x,S=1){o.set(x),a=S,m(o,a)},getClearAlpha:function(){return a},setClearAlpha:function(x){a=x,m(o,a)},render:p,addToRenderList:y,dispose:g}}function Z4(e,t){let n=e.getParameter(e.MAX_VERTEX_ATTRIBS),i={},r=f(null),s=r,o=!1;function a(I,R,U,P,L){let O=!1,D=h(I,P,U,R);s!==D&&(s=D,l(s.object)),O=d(I,P,U,L),O&&p(I,P,U,L),L!==null&&t.update(L,e.ELEMENT_ARRAY_BUFFER),(O||o)&&(o=!1,v(I,R,U,P),L!==null&&e.bindBuffer(e.ELEMENT_ARRAY_BUFFER,t.get(L).buffer))}function c(){return e.createVertexArray()}function l(I){return e.bindVertexArray(I)}function u(I){return e.deleteVertexArray(I)}function h(I,R,U,P){let L=P.wireframe===!0,O=i[R.id];O===void 0&&(O={},i[R.id]=O);let D=I.isInstancedMesh===!0?I.id:0,Y=O[D];Y===void 0&&(Y={},O[D]=Y);let B=Y[U.id];B===void 0&&(B={},Y[U.id]=B);let V=B[L];return V===void 0&&(V=f(c()),B[L]=V),V}function f(I){let R=[],U=[],P=[];for(let L=0;L<n;L++)R[L]=0,U[L]=0,P[L]=0;return{geometry:null,program:null,wireframe:!1,newAttributes:R,enabledAttributes:U,attributeDivisors:P,object:I,attributes:{},index:null}}function d(I,R,U,P){let L=s.attributes,O=R.attributes,D=0,Y=U.getAttributes();for(let B in Y)if(Y[B].location>=0){let q=L[B],rt=O[B];if(rt===void 0&&(B==="instanceMatrix"&&I.instanceMatrix&&(rt=I.instanceMatrix),B==="instanceColor"&&I.instanceColor&&(rt=I.instanceColor)),q===void 0||q.attribute!==rt||rt&&q.data!==rt.data)return!0;D++}return s.attributesNum!==D||s.index!==P}function p(I,R,U,P){let L={},O=R.attributes,D=0,Y=U.getAttributes();for(let B in Y)if(Y[B].location>=0){let q=O[B];q===void 0&&(B==="instanceMatrix"&&I.instanceMatrix&&(q=I.instanceMatrix),B==="instanceColor"&&I.instanceColor&&(q=I.instanceColor));let rt={};rt.attribute=q,q&&q.data&&(rt.data=q.data),L[B]=rt,D++}s.attributes=L,s.attributesNum=D,s.index=P}function y(){let I=s.newAttributes;for(let R=0,U=I.length;R<U;R++)I[R]=0}function m(I){g(I,0)}function g(I,R){let U=s.newAttributes,P=s.enabledAttributes,L=s.attributeDivisors;U[I]=1,P[I]===0&&(e.enableVertexAttribArray(I),P[I]=1),L[I]!==R&&(e.vertexAttribDivisor(I,R),L[I]=R)}function x(){let I=s.newAttributes,R=s.enabledAttributes;for(let U=0,P=R.length;U<P;U++)R[U]!==I[U]&&(e.disableVertexAttribArray(U),R[U]=0)}function S(I,R,U,P,L,O,D){D===!0?e.vertexAttribIPointer(I,R,U,L,O):e.vertexAttribPointer(I,R,U,P,L,O)}function v(I,R,U,P){y();let L=P.attributes,O=U.getAttributes(),D=R.defaultAttributeValues;for(let Y in O){let B=O[Y];if(B.location>=0){let V=L[Y];if(V===void 0&&(Y==="instanceMatrix"&&I.instanceMatrix&&(V=I.instanceMatrix),Y==="instanceColor"&&I.instanceColor&&(V=I.instanceColor)),V!==void 0){let q=V.normalized,rt=V.itemSize,ct=t.get(V);if(ct===void 0)continue;let $=ct.buffer,ot=ct.type,ut=ct.bytesPerElement,st=ot===e.INT||ot===e.UNSIGNED_INT||V.gpuType===Pd;if(V.isInterleavedBufferAttribute){let at=V.data,J=at.isInterleavedBuffer===!0?at.stride:at.itemSize,_t=V.offset;if(at.isInstancedInterleavedBuffer||at.isInstancedBufferAttribute){for(let lt=0;lt<B.locationSize;lt++)g(B.location+lt,at.meshPerAttribute);I.isInstancedMesh!==!0&&P._maxInstanceCount===void 0&&(P._maxInstanceCount=at.meshPerAttribute*at.count)}else for(let lt=0;lt<B.locationSize;lt++)m(B.location+lt);e.bindBuffer(e.ARRAY_BUFFER,$);for(let lt=0;lt<B.locationSize;lt++)S(B.location+lt,rt/B.locationSize,ot,q,J*ut,(_t+rt/B.locationSize*lt)*ut,st)}else{if(V.isInstancedBufferAttribute){for(let at=0;at<B.locationSize;at++)g(B.location+at,V.meshPerAttribute);I.isInstancedMesh!==!0&&P._maxInstanceCount===void 0&&(P._maxInstanceCount=V.meshPerAttribute*V.count)}else for(let at=0;at<B.locationSize;at++)m(B.location+at);e.bindBuffer(e.ARRAY_BUFFER,$);for(let at=0;at<B.locationSize;at++)S(B.location+at,rt/B.locationSize,ot,q,rt*ut,rt/B.locationSize*at*ut,st)}}else if(D!==void 0){let q=D[Y];if(q!==void 0)switch(q.length){case 2:e.vertexAttrib2fv(B.location,q);break;case 3:e.vertexAttrib3fv(B.location,q);break;case 4:e.vertexAttrib4fv(B.location,q);break;default:e.vertexAttrib1fv(B.location,q)}}}}x()}function w(){C();for(let I in i){let R=i[I];for(let U in R){let P=R[U];for(let L in P){let O=P[L];for(let D in O)u(O[D].object),delete O[D];delete P[L]}}delete i[I]}}function b(I){if(i[I.id]===void 0)return;let R=i[I.id];for(let U in R){let P=R[U];for(let L in P){let O=P[L];for(let D in O)u(O[D].object),delete O[D];delete P[L]}}delete i[I.id]}function _(I){for(let R in i){let U=i[R];for(let P in U){let L=U[P];if(L[I.id]===void 0)continue;let O=L[I.id];for(let D in O)u(O[D].object),delete O[D];delete L[I.id]}}}function M(I){for(let R in i){let U=i[R],P=I.isInstancedMesh===!0?I.id:0,L=U[P];if(L!==void 0){for(let O in L){let D=L[O];for(let Y in D)u(D[Y].object),delete D[Y];delete L[O]}delete U[P],Object.keys(U).length===0&&delete i[R]}}}function C(){E(),o=!0,s!==r&&(s=r,l(s.object))}function E(){r.geometry=null,r.program=null,r.wireframe=!1}return{setup:a,reset:C,resetDefaultState:E,dispose:w,releaseStatesOfGeometry:b,releaseStatesOfObject:M,releaseStatesOfProgram:_,initAttributes:y,enableAttribute:m,disableUnusedAttributes:x}}function J4(e,t,n){let i;function r(c){i=c}function s(c,l){e.drawArrays(i,c,l),n.update(l,i,1)}function o(c,l,u){u!==0&&(e.drawArraysInstanced(i,c,l,u),n.update(l,i,u))}function a(c,l,u){if(u===0)return;t.get("WEBGL_multi_draw").multiDrawArraysWEBGL(i,c,0,l,0,u);let f=0;for(let d=0;d<u;d++)f+=l[d];n.update(f,i,1)}this.setMode=r,this.render=s,this.renderInstances=o,this.renderMultiDraw=a}function K4(e,t,n,i){let r;function s(){if(r!==void 0)return r;if(t.has("EXT_texture_filter_anisotropic")===!0){let _=t.get("EXT_texture_filter_anisotropic");r=e.getParameter(_.MAX_TEXTURE_MAX_ANISOTROPY_EXT)}else r=0;return r}function o(_){return!(_!==Xi&&i.convert(_)!==e.getParameter(e.IMPLEMENTATION_COLOR_READ_FORMAT))}function a(_){let M=_===$i&&(t.has("EXT_color_buffer_half_float")||t.has("EXT_color_buffer_float"));return!(_!==Hn&&_!==Wi&&!M&&i.convert(_)!==e.getParameter(e.IMPLEMENTATION_COLOR_READ_TYPE))}function c(_){if(_==="highp"){if(e.getShaderPrecisionFormat(e.VERTEX_SHADER,e.HIGH_FLOAT).precision>0&&e.getShaderPrecisionFormat(e.FRAGMENT_SHADER,e.HIGH_FLOAT).precision>0)return"highp";_="mediump"}return _==="mediump"&&e.getShaderPrecisionFormat(e.VERTEX_SHADER,e.MEDIUM_FLOAT).precision>0&&e.getShaderPrecisionFormat(e.FRAGMENT_SHADER,e.MEDIUM_FLOAT).precision>0?"mediump":"lowp"}let l=n.precision!==void 0?n.precision:"highp",u=c(l);u!==l&&(Ut("WebGLRenderer:",l,"not supported, using",u,"instead."),l=u);let h=n.reversedDepthBuffer===!0&&t.has("EXT_clip_control"),f=n.logarithmicDepthBuffer===!0&&h===!1;n.reversedDepthBuffer===!0&&h===!1&&Ut("WebGLRenderer: Unable to use reversed depth buffer due to missing EXT_clip_control extension. Fallback to default depth buffer."),n.logarithmicDepthBuffer===!0&&h===!0&&Ut("WebGLRenderer: Logarithmic depth buffer is ignored when reversed depth buffer is enabled.");let d=e.getParameter(e.MAX_TEXTURE_IMAGE_UNITS),p=e.getParameter(e.MAX_VERTEX_TEXTURE_IMAGE_UNITS),y=e.getParameter(e.MAX_TEXTURE_SIZE),m=e.getParameter(e.MAX_CUBE_MAP_TEXTURE_SIZE),g=e.getParameter(e.MAX_VERTEX_ATTRIBS),x=e.getParameter(e.MAX_VERTEX_UNIFORM_VECTORS),S=e.getParameter(e.MAX_VARYING_VECTORS),v=e.getParameter(e.MAX_FRAGMENT_UNIFORM_VECTORS),w=e.getParameter(e.MAX_SAMPLES),b=e.getParameter(e.SAMPLES);return{isWebGL2:!0,getMaxAnisotropy:s,getMaxPrecision:c,textureFormatReadable:o,textureTypeReadable:a,precision:l,logarithmicDepthBuffer:f,reversedDepthBuffer:h,maxTextures:d,maxVertexTextures:p,maxTextureSize:y,maxCubemapSize:m,maxAttributes:g,maxVertexUniforms:x,maxVaryings:S,maxFragmentUniforms:v,maxSamples:w,samples:b}}function j4(e){let t=this,n=null,i=0,r=!1,s=!1,o=new Qn,a=new zt,c={value:null,needsUpdate:!1};this.uniform=c,this.numPlanes=0,this.numIntersection=0,this.init=function(h,f){let d=h.length!==0||f||i!==0||r;return r=f,i=h.length,d},this.beginShadows=function(){s=!0,u(null)},this.endShadows=function(){s=!1},this.setGlobalState=function(h,f){n=u(h,f,0)},this.setState=function(h,f,d){let p=h.clippingPlanes,y=h.clipIntersection,m=h.clipShadows,g=e.get(h);if(!r||p===null||p.length===0||s&&!m)s?u(null):l();else{let x=s?0:i,S=x*4,v=g.clippingState||null;c.value=v,v=u(p,f,S,d);for(let w=0;w!==S;++w)v[w]=n[w];g.clippingState=v,this.numIntersection=y?this.numPlanes:0,this.numPlanes+=x}};function l(){c.value!==n&&(c.value=n,c.needsUpdate=i>0),t.numPlanes=i,t.numIntersection=0}function u(h,f,d,p){let y=h!==null?h.length:0,m=null;if(y!==0){if(m=c.value,p!==!0||m===null){let g=d+y*4,x=f.matrixWorldInverse;a.getNormalMatrix(x),(m===null||m.length<g)&&(m=new Float32Array(g));for(let S=0,v=d;S!==y;++S,v+=4)o.copy(h[S]).applyMatrix4(x,a),o.normal.toArray(m,v),m[v+3]=o.constant}c.value=m,c.needsUpdate=!0}return t.numPlanes=y,t.numIntersection=0,m}}var uu=class extends ei{constructor(t=1,n={}){super(t,t,n),this.isWebGLCubeRenderTarget=!0;let i={width:t,height:t,depth:1},r=[i,i,i,i,i,i];this.texture=new Fl(r),this._setTextureOptions(n),this.texture.isRenderTargetTexture=!0}fromEquirectangularTexture(t,n){this.texture.type=n.type,this.texture.colorSpace=n.colorSpace,this.texture.generateMipmaps=n.generateMipmaps,this.texture.minFilter=n.minFilter,this.texture.magFilter=n.magFilter;let i={uniforms:{tEquirect:{value:null}},vertexShader:`

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
			`},r=new Rs(5,5,5),s=new Ci({name:"CubemapFromEquirect",uniforms:Lo(i.uniforms),vertexShader:i.vertexShader,fragmentShader:i.fragmentShader,side:Un,blending:Co});s.uniforms.tEquirect.value=n;let o=new ln(r,s),a=n.minFilter;return n.minFilter===Jr&&(n.minFilter=Nn),new ic(1,10,this).update(t,o),n.minFilter=a,o.geometry.dispose(),o.material.dispose(),this}clear(t,n=!0,i=!0,r=!0){let s=t.getRenderTarget();for(let o=0;o<6;o++)t.setRenderTarget(this,o),t.clear(n,i,r);t.setRenderTarget(s)}},o2=256,Q4=3,t5=20,R2=256,P2=16,e5=3,n5=new k,i5=new Wt,gp=class e{constructor(t){this._renderer=t,this._cubeSize=0,this._sourceTarget=null,this._cubeCamera=new ic(1,10,null),this._boxMesh=new ln(new Rs(5,5,5),null),this._cubemapMaterial=null,this._equirectMaterial=null,this._blurMaterial=null,this._ggxMaterial=null,this._integrationMaterial=null}fromScene(t,n=0,i=.1,r=100,s={}){let{size:o=256,position:a=n5}=s,c=this._renderer;this._setSize(o);let l=this._allocateTarget(),u=this._getSourceTarget(!0);n>0&&(u.texture.mipmapsAutoUpdate=!1);let h=c.autoClear,f=c.autoClearColor,d=c.autoClearDepth,p=c.autoClearStencil,y=t.background;c.autoClear=!0,c.autoClearColor=!0,c.autoClearDepth=!0,c.autoClearStencil=!0,y===null&&(t.background=c.getClearColor(i5));let m=new ic(i,r,u);return m.position.copy(a),m.update(c,t),c.autoClear=h,c.autoClearColor=f,c.autoClearDepth=d,c.autoClearStencil=p,t.background=y,n>0&&(u.texture.mipmapsAutoUpdate=!0,this._blur(l,n)),this._applyPMREM(l),l}fromEquirectangular(t,n=null){return this._fromTexture(t,n)}fromCubemap(t,n=null){return this._fromTexture(t,n)}compileCubemapShader(){this._cubemapMaterial===null&&(this._cubemapMaterial=l2(),this._compileMaterial(this._cubemapMaterial))}compileEquirectangularShader(){this._equirectMaterial===null&&(this._equirectMaterial=c2(),this._compileMaterial(this._equirectMaterial))}dispose(){this._sourceTarget!==null&&this._sourceTarget.dispose(),this._cubemapMaterial!==null&&this._cubemapMaterial.dispose(),this._equirectMaterial!==null&&this._equirectMaterial.dispose(),this._blurMaterial!==null&&this._blurMaterial.dispose(),this._ggxMaterial!==null&&this._ggxMaterial.dispose(),this._integrationMaterial!==null&&this._integrationMaterial.dispose(),this._boxMesh.geometry.dispose()}static lodToRoughness(t,n){return n>0?1-Math.sqrt(1-t/n):0}_setSize(t){this._cubeSize=Math.max(o2,fx(t))}_fromTexture(t,n){t.mapping===Po||t.mapping===ac?this._setSize(t.image.length===0?o2:t.image[0].width||t.image[0].image.width):this._setSize(t.image.width/4);let i=n||this._allocateTarget();return this._textureToCubemap(t),this._applyPMREM(i),i}_allocateTarget(){let t=this._cubeSize,n=a2(t,!1,!1),i=Math.log2(t)-Q4;for(let r=0;r<=i;r++)n.texture.mipmaps.push({width:t>>r,height:t>>r});return n.texture.name="PMREM",n.texture.isPMREMTexture=!0,n}_getSourceTarget(t=!1){let n=this._cubeSize,i=this._sourceTarget;return(i===null||i.width!==n||t&&i.depthBuffer===!1)&&(i!==null&&i.dispose(),this._sourceTarget=a2(n,!0,t)),this._sourceTarget}_compileMaterial(t){this._boxMesh.material=t,this._renderer.compile(this._boxMesh,this._cubeCamera.children[0])}_renderCube(t,n,i){let r=this._boxMesh,s=this._cubeCamera;r.material=i,s.renderTarget=t,s.activeMipmapLevel=n;let o=t.width>>n;t.viewport.set(0,0,o,o),s.update(this._renderer,r),t.viewport.set(0,0,t.width,t.height)}_textureToCubemap(t){let n;t.mapping===Po||t.mapping===ac?(this._cubemapMaterial===null&&(this._cubemapMaterial=l2()),n=this._cubemapMaterial,n.uniforms.flipEnvMap.value=t.isRenderTargetTexture===!1?-1:1):(this._equirectMaterial===null&&(this._equirectMaterial=c2()),n=this._equirectMaterial),n.uniforms.envMap.value=t,this._renderCube(this._getSourceTarget(),0,n)}_applyPMREM(t){this._ggxMaterial===null&&(this._ggxMaterial=r5(),this._integrationMaterial=s5());let n=this._cubeSize,i=t.texture.mipmaps.length-1,r=this._ggxMaterial.uniforms;r.envMap.value=this._sourceTarget.texture;let s=this._integrationMaterial.uniforms;s.envMap.value=this._sourceTarget.texture,s.sourceLod.value=Math.log2(n/P2);for(let o=0;o<=i;o++){let a=e.lodToRoughness(o,i);if(o>i-e5)s.roughness.value=a,this._renderCube(t,o,this._integrationMaterial);else{let c=a>0?Math.log2(n)+.5*Math.log2(6/(R2*Math.pow(a,4)))+.5:0;r.roughness.value=a,r.lodBias.value=c,this._renderCube(t,o,this._ggxMaterial)}}}_blur(t,n){this._blurMaterial===null&&(this._blurMaterial=o5());let i=this._blurMaterial,r=i.uniforms,s=this._sourceTarget;r.sigma.value=Math.min(n,Math.PI)/Math.SQRT2,r.envMap.value=s.texture,this._renderCube(t,0,i),r.envMap.value=t.texture,this._renderCube(s,0,i)}};function a2(e,t,n){return new uu(e,{minFilter:Jr,generateMipmaps:t,type:$i,colorSpace:Al,depthBuffer:n})}function fu(e,t,n){return new Ci({name:e,uniforms:t,vertexShader:jt.cube_vert,fragmentShader:n,side:Un,blending:Co,depthTest:!1,depthWrite:!1})}function r5(){return fu("PMREMGGXConvolution",{envMap:{value:null},roughness:{value:0},lodBias:{value:0}},`

		#define GGX_SAMPLES ${R2}u

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float lodBias;

		#include <common>

		// Van der Corput radical inverse
		float radicalInverse_VdC( uint bits ) {

			bits = ( bits << 16u ) | ( bits >> 16u );
			bits = ( ( bits & 0x55555555u ) << 1u ) | ( ( bits & 0xAAAAAAAAu ) >> 1u );
			bits = ( ( bits & 0x33333333u ) << 2u ) | ( ( bits & 0xCCCCCCCCu ) >> 2u );
			bits = ( ( bits & 0x0F0F0F0Fu ) << 4u ) | ( ( bits & 0xF0F0F0F0u ) >> 4u );
			bits = ( ( bits & 0x00FF00FFu ) << 8u ) | ( ( bits & 0xFF00FF00u ) >> 8u );
			return float( bits ) * 2.3283064365386963e-10; // / 0x100000000

		}

		// Hammersley sequence
		vec2 hammersley( uint i, uint N ) {

			return vec2( float( i ) / float( N ), radicalInverse_VdC( i ) );

		}

		void main() {

			vec3 N = normalize( vWorldDirection );

			// For very low roughness, just sample the environment directly
			if ( roughness < 0.001 ) {

				gl_FragColor = vec4( textureLod( envMap, N, 0.0 ).rgb, 1.0 );
				return;

			}

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			// Tangent space basis for VNDF sampling
			vec3 up = abs( N.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, N ) );
			vec3 bitangent = cross( N, tangent );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			for ( uint i = 0u; i < GGX_SAMPLES; i ++ ) {

				vec2 Xi = hammersley( i, GGX_SAMPLES );

				// With V = N, sample the reflected direction directly.
				float invQ = 1.0 / ( 1.0 - Xi.x + alpha2 * Xi.x );
				float NdotL = ( 1.0 - Xi.x - alpha2 * Xi.x ) * invQ;

				if ( NdotL > 0.0 ) {

					float phi = 2.0 * PI * Xi.y;
					float sinTheta = 2.0 * alpha * sqrt( Xi.x * ( 1.0 - Xi.x ) ) * invQ;
					vec3 L = N * NdotL + ( tangent * cos( phi ) + bitangent * sin( phi ) ) * sinTheta;

					// Match the source mip to the sample's solid angle. The terms
					// independent of the sample are precomputed in lodBias.
					float d = alpha2 * invQ;
					float lod = max( log2( d ) + lodBias, 0.0 );

					// Weight by NdotL for the split-sum approximation
					prefilteredColor += textureLod( envMap, L, lod ).rgb * NdotL;
					totalWeight += NdotL;

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function s5(){return fu("PMREMGGXIntegration",{envMap:{value:null},roughness:{value:0},sourceLod:{value:0},sourceSize:{value:P2}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float sourceLod;
		uniform int sourceSize;

		void main() {

			vec3 N = normalize( vWorldDirection );

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			float texelSize = 2.0 / float( sourceSize );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			// Pair opposite texels: only the one in N's hemisphere contributes.
			for ( int face = 0; face < 3; face ++ ) {

				for ( int y = 0; y < sourceSize; y ++ ) {

					for ( int x = 0; x < sourceSize; x ++ ) {

						vec2 uv = ( vec2( x, y ) + 0.5 ) * texelSize - 1.0;
						vec3 texelDirection = face == 0 ? vec3( 1.0, uv ) : ( face == 1 ? vec3( uv.x, 1.0, uv.y ) : vec3( uv, 1.0 ) );

						float invDistance = inversesqrt( 1.0 + dot( uv, uv ) );
						float NdotL = dot( N, texelDirection );
						texelDirection *= NdotL < 0.0 ? - 1.0 : 1.0;
						NdotL = abs( NdotL ) * invDistance;

						// With V = N, NdotH squared is ( 1 + NdotL ) / 2. Common factors
						// in the GGX distribution and texel solid angle cancel when normalized.
						float d = 1.0 + alpha2 + ( alpha2 - 1.0 ) * NdotL;
						float weight = NdotL * invDistance * invDistance * invDistance / ( d * d );

						prefilteredColor += textureLod( envMap, texelDirection, sourceLod ).rgb * weight;
						totalWeight += weight;

					}

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function o5(){return fu("PMREMSphericalGaussianBlur",{envMap:{value:null},sigma:{value:0}},`

		#define SAMPLES ${t5}
		#define GOLDEN_ANGLE 2.39996322973

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float sigma;

		#include <common>

		void main() {

			vec3 outputDirection = normalize( vWorldDirection );

			vec3 up = abs( outputDirection.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, outputDirection ) );
			vec3 bitangent = cross( outputDirection, tangent );

			// Truncate the kernel at three standard deviations or at the antipode.
			float thetaMax = min( 3.0 * sigma, PI );
			float truncation = 1.0 - exp( - 0.5 * thetaMax * thetaMax / ( sigma * sigma ) );

			vec3 accumColor = vec3( 0.0 );
			float accumWeight = 0.0;

			for ( int i = 0; i < SAMPLES; i ++ ) {

				// Stratified inverse-CDF sampling of the Gaussian, placed on a golden-angle spiral.
				float stratum = ( float( i ) + 0.5 ) / float( SAMPLES );
				float theta = sigma * sqrt( - 2.0 * log( 1.0 - stratum * truncation ) );
				float phi = float( i ) * GOLDEN_ANGLE;

				vec3 offset = cos( phi ) * tangent + sin( phi ) * bitangent;
				vec3 sampleDirection = cos( theta ) * outputDirection + sin( theta ) * offset;

				// Correct the planar sample density to solid angle.
				float weight = sin( theta ) / theta;

				accumColor += weight * textureLod( envMap, sampleDirection, 0.0 ).rgb;
				accumWeight += weight;

			}

			gl_FragColor = vec4( accumColor / accumWeight, 1.0 );

		}
	`)}function c2(){return fu("PMREMEquirectangularToCubemap",{envMap:{value:null}},`

		varying vec3 vWorldDirection;

		uniform sampler2D envMap;

		#include <common>

		void main() {

			// Average four subpixel samples to preserve small, bright features.
			vec3 direction = normalize( vWorldDirection );
			vec3 dx = dFdx( direction ) * 0.25;
			vec3 dy = dFdy( direction ) * 0.25;

			vec3 color = textureLod( envMap, equirectUv( normalize( direction - dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction - dx + dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx + dy ) ), 0.0 ).rgb;
			gl_FragColor = vec4( color * 0.25, 1.0 );

		}
	`)}function l2(){return fu("PMREMCubemapToCubemap",{envMap:{value:null},flipEnvMap:{value:-1}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float flipEnvMap;

		void main() {

			gl_FragColor = vec4( textureCube( envMap, vec3( flipEnvMap * vWorldDirection.x, vWorldDirection.yz ) ).rgb, 1.0 );

		}
	`)}function a5(e){let t=new WeakMap,n=new WeakMap,i=null;function r(f,d=!1){return f==null?null:d?o(f):s(f)}function s(f){if(f&&f.isTexture){let d=f.mapping;if(d===Ed||d===Cd)if(t.has(f)){let p=t.get(f).texture;return a(p,f.mapping)}else{let p=f.image;if(p&&p.height>0){let y=new uu(p.height);return y.fromEquirectangularTexture(e,f),t.set(f,y),f.addEventListener("dispose",l),a(y.texture,f.mapping)}else return null}}return f}function o(f){if(f&&f.isTexture&&f.isPMREMTexture!==!0){let d=f.mapping,p=d===Ed||d===Cd,y=d===Po||d===ac;if(p||y){let m=n.get(f),g=m!==void 0?m.texture.pmremVersion:0;if(f.isRenderTargetTexture&&f.pmremVersion!==g)return i===null&&(i=new gp(e)),m=p?i.fromEquirectangular(f,m):i.fromCubemap(f,m),m.texture.pmremVersion=f.pmremVersion,n.set(f,m),m.texture;if(m!==void 0)return m.texture;{let x=f.image;return p&&x&&x.height>0||y&&x&&c(x)?(i===null&&(i=new gp(e)),m=p?i.fromEquirectangular(f):i.fromCubemap(f),m.texture.pmremVersion=f.pmremVersion,n.set(f,m),f.addEventListener("dispose",u),m.texture):null}}}return f}function a(f,d){return d===Ed?f.mapping=Po:d===Cd&&(f.mapping=ac),f}function c(f){let d=0,p=6;for(let y=0;y<p;y++)f[y]!==void 0&&d++;return d===p}function l(f){let d=f.target;d.removeEventListener("dispose",l);let p=t.get(d);p!==void 0&&(t.delete(d),p.dispose())}function u(f){let d=f.target;d.removeEventListener("dispose",u);let p=n.get(d);p!==void 0&&(n.delete(d),p.dispose())}function h(){t=new WeakMap,n=new WeakMap,i!==null&&(i.dispose(),i=null)}return{get:r,dispose:h}}function c5(e){let t={};function n(i){if(t[i]!==void 0)return t[i];let r=e.getExtension(i);return t[i]=r,r}return{has:function(i){return n(i)!==null},init:function(){n("EXT_color_buffer_float"),n("WEBGL_clip_cull_distance"),n("OES_texture_float_linear"),n("EXT_color_buffer_half_float"),n("WEBGL_multisampled_render_to_texture"),n("WEBGL_render_shared_exponent")},get:function(i){let r=n(i);return r===null&&Ml("WebGLRenderer: "+i+" extension not supported."),r}}}function l5(e,t,n,i){let r={},s=new WeakMap,o=new FinalizationRegistry(p=>delete r[p]);function a(p){c(p.target)}function c(p){p.index!==null&&t.remove(p.index);for(let m in p.attributes)t.remove(p.attributes[m]);p.removeEventListener("dispose",a),delete r[p.id],o.unregister(p);let y=s.get(p);y&&(t.remove(y),s.delete(p)),i.releaseStatesOfGeometry(p),p.isInstancedBufferGeometry===!0&&delete p._maxInstanceCount,n.memory.geometries--}function l(p,y){return r[y.id]!==void 0||(y.addEventListener("dispose",a),r[y.id]=new WeakRef(y),o.register(y,y.id,y),n.memory.geometries++),y}function u(p){let y=p.attributes;for(let m in y)t.update(y[m],e.ARRAY_BUFFER)}function h(p){let y=p.index,m=p.attributes.position,g=0;if(m===void 0)return;let x=y!==null?y.array.length:m.array.length/3-1,S=m.count>=65535?Dl:Nl,v=new S(Math.ceil(x/3)*6,1),w=v.array;if(y!==null){let _=y.array;g=y.version;for(let M=0,C=0;M<x;M+=3){let E=_[M+0],I=_[M+1],R=_[M+2];w[C++]=E,w[C++]=I,w[C++]=I,w[C++]=R,w[C++]=R,w[C++]=E}}else{g=m.version;for(let _=0,M=0;_<x;_+=3){let C=_+0,E=_+1,I=_+2;w[M++]=C,w[M++]=E,w[M++]=E,w[M++]=I,w[M++]=I,w[M++]=C}}v.version=g;let b=s.get(p);b&&t.remove(b),s.set(p,v)}function f(p){let y=s.get(p);if(y){let m=p.index;m!==null&&y.version<m.version&&h(p)}else h(p);return s.get(p)}function d(){for(let p in r){let y=r[p].deref();y!==void 0&&c(y)}}return{get:l,update:u,getWireframeAttribute:f,dispose:d}}function u5(e,t,n){let i;function r(h){i=h}let s,o;function a(h){s=h.type,o=h.bytesPerElement}function c(h,f){e.drawElements(i,f,s,h*o),n.update(f,i,1)}function l(h,f,d){d!==0&&(e.drawElementsInstanced(i,f,s,h*o,d),n.update(f,i,d))}function u(h,f,d){if(d===0)return;t.get("WEBGL_multi_draw").multiDrawElementsWEBGL(i,f,0,s,h,0,d);let y=0;for(let m=0;m<d;m++)y+=f[m];n.update(y,i,1)}this.setMode=r,this.setIndex=a,this.render=c,this.renderInstances=l,this.renderMultiDraw=u}function f5(e){let t={geometries:0,textures:0},n={frame:0,calls:0,triangles:0,points:0,lines:0};function i(s,o,a){switch(n.calls++,o){case e.TRIANGLES:n.triangles+=a*(s/3);break;case e.LINES:n.lines+=a*(s/2);break;case e.LINE_STRIP:n.lines+=a*(s-1);break;case e.LINE_LOOP:n.lines+=a*s;break;case e.POINTS:n.points+=a*s;break;default:kt("WebGLInfo: Unknown draw mode:",o);break}}function r(){n.calls=0,n.triangles=0,n.points=0,n.lines=0}return{memory:t,render:n,programs:null,autoReset:!0,reset:r,update:i}}function h5(e,t,n){let i=new WeakMap,r=new pe;function s(o,a,c){let l=o.morphTargetInfluences,u=a.morphAttributes.position||a.morphAttributes.normal||a.morphAttributes.color,h=u!==void 0?u.length:0,f=i.get(a);if(f===void 0||f.count!==h){let C=function(){_.dispose(),i.delete(a),a.removeEventListener("dispose",C)};f!==void 0&&f.texture.dispose();let d=a.morphAttributes.position!==void 0,p=a.morphAttributes.normal!==void 0,y=a.morphAttributes.color!==void 0,m=a.morphAttributes.position||[],g=a.morphAttributes.normal||[],x=a.morphAttributes.color||[],S=0;d===!0&&(S=1),p===!0&&(S=2),y===!0&&(S=3);let v=a.attributes.position.count*S,w=1;v>t.maxTextureSize&&(w=Math.ceil(v/t.maxTextureSize),v=t.maxTextureSize);let b=new Float32Array(v*w*4*h),_=new Pl(b,v,w,h);_.type=Wi,_.needsUpdate=!0;let M=S*4;for(let E=0;E<h;E++){let I=m[E],R=g[E],U=x[E],P=v*w*4*E;for(let L=0;L<I.count;L++){let O=L*M;d===!0&&(r.fromBufferAttribute(I,L),b[P+O+0]=r.x,b[P+O+1]=r.y,b[P+O+2]=r.z,b[P+O+3]=0),p===!0&&(r.fromBufferAttribute(R,L),b[P+O+4]=r.x,b[P+O+5]=r.y,b[P+O+6]=r.z,b[P+O+7]=0),y===!0&&(r.fromBufferAttribute(U,L),b[P+O+8]=r.x,b[P+O+9]=r.y,b[P+O+10]=r.z,b[P+O+11]=U.itemSize===4?r.w:1)}}f={count:h,texture:_,size:new Ft(v,w)},i.set(a,f),a.addEventListener("dispose",C)}if(o.isInstancedMesh===!0&&o.morphTexture!==null)c.getUniforms().setValue(e,"morphTexture",o.morphTexture,n);else{let d=0;for(let y=0;y<l.length;y++)d+=l[y];let p=a.morphTargetsRelative?1:1-d;c.getUniforms().setValue(e,"morphTargetBaseInfluence",p),c.getUniforms().setValue(e,"morphTargetInfluences",l)}c.getUniforms().setValue(e,"morphTargetsTexture",f.texture,n),c.getUniforms().setValue(e,"morphTargetsTextureSize",f.size)}return{update:s}}function d5(e,t,n,i,r){let s=new WeakMap;function o(l){let u=r.render.frame,h=l.geometry,f=t.get(l,h);if(s.get(f)!==u&&(t.update(f),s.set(f,u)),l.isInstancedMesh&&(l.hasEventListener("dispose",c)===!1&&l.addEventListener("dispose",c),s.get(l)!==u&&(n.update(l.instanceMatrix,e.ARRAY_BUFFER),l.instanceColor!==null&&n.update(l.instanceColor,e.ARRAY_BUFFER),s.set(l,u))),l.isSkinnedMesh){let d=l.skeleton;s.get(d)!==u&&(d.update(),s.set(d,u))}return f}function a(){s=new WeakMap}function c(l){let u=l.target;u.removeEventListener("dispose",c),i.releaseStatesOfObject(u),n.remove(u.instanceMatrix),u.instanceColor!==null&&n.remove(u.instanceColor)}return{update:o,dispose:a}}var p5={[W_]:"LINEAR_TONE_MAPPING",[$_]:"REINHARD_TONE_MAPPING",[X_]:"CINEON_TONE_MAPPING",[q_]:"ACES_FILMIC_TONE_MAPPING",[Z_]:"AGX_TONE_MAPPING",[J_]:"NEUTRAL_TONE_MAPPING",[Y_]:"CUSTOM_TONE_MAPPING"};function m5(e,t,n,i,r,s){let o=new ei(t,n,{type:e,depthBuffer:r,stencilBuffer:s,samples:i?4:0,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,resolveDepthBuffer:!1,resolveStencilBuffer:!1}),a=null,c=null,l=null,u=new De;u.setAttribute("position",new ge([-1,3,0,-1,-1,0,3,-1,0],3)),u.setAttribute("uv",new ge([0,2,0,0,2,0],2));let h=new fd({uniforms:{tDiffuse:{value:null}},vertexShader:`
			precision highp float;

			uniform mat4 modelViewMatrix;
			uniform mat4 projectionMatrix;

			attribute vec3 position;
			attribute vec2 uv;

			varying vec2 vUv;

			void main() {
				vUv = uv;
				gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
			}`,fragmentShader:`
			precision highp float;

			uniform sampler2D tDiffuse;

			varying vec2 vUv;

			#include <tonemapping_pars_fragment>
			#include <colorspace_pars_fragment>

			void main() {
				gl_FragColor = texture2D( tDiffuse, vUv );

				#ifdef LINEAR_TONE_MAPPING
					gl_FragColor.rgb = LinearToneMapping( gl_FragColor.rgb );
				#elif defined( REINHARD_TONE_MAPPING )
					gl_FragColor.rgb = ReinhardToneMapping( gl_FragColor.rgb );
				#elif defined( CINEON_TONE_MAPPING )
					gl_FragColor.rgb = CineonToneMapping( gl_FragColor.rgb );
				#elif defined( ACES_FILMIC_TONE_MAPPING )
					gl_FragColor.rgb = ACESFilmicToneMapping( gl_FragColor.rgb );
				#elif defined( AGX_TONE_MAPPING )
					gl_FragColor.rgb = AgXToneMapping( gl_FragColor.rgb );
				#elif defined( NEUTRAL_TONE_MAPPING )
					gl_FragColor.rgb = NeutralToneMapping( gl_FragColor.rgb );
				#elif defined( CUSTOM_TONE_MAPPING )
					gl_FragColor.rgb = CustomToneMapping( gl_FragColor.rgb );
				#endif

				#ifdef SRGB_TRANSFER
					gl_FragColor = sRGBTransferOETF( gl_FragColor );
				#endif
			}`,depthTest:!1,depthWrite:!1}),f=new ln(u,h),d=new $l(-1,1,1,-1,0,1),p=null,y=null,m=!1,g,x=null,S=[],v=!1;this.setSize=function(w,b){o.setSize(w,b),a!==null&&a.setSize(w,b),c!==null&&c.setSize(w,b);for(let _=0;_<S.length;_++){let M=S[_];M.setSize&&M.setSize(w,b)}},this.setEffects=function(w){S=w,v=S.length>0&&S[0].isRenderPass===!0;let b=o.width,_=o.height;S.length>0&&a===null&&(a=new ei(b,_,{type:$i,depthBuffer:!1,stencilBuffer:!1}),c=new ei(b,_,{type:$i,depthBuffer:!1,stencilBuffer:!1}));let M=r===!0&&S.some(C=>C.needsDepthTexture===!0);M!==(o.depthTexture!==null)&&(M===!0&&l===null&&(l=new Zr(b,_),s===!0&&(l.format=Kr,l.type=Io)),o.dispose(),o.depthTexture=M?l:null,o.resolveDepthBuffer=M,o.storeMultisampledDepthBuffer=M);for(let C=0;C<S.length;C++){let E=S[C];E.setSize&&E.setSize(b,_),M&&E.needsDepthTexture===!0&&E.setDepthTexture&&E.setDepthTexture(l)}},this.begin=function(w,b){if(m||w.toneMapping===gr&&S.length===0)return!1;if(x=b,b!==null){let _=b.width,M=b.height;(o.width!==_||o.height!==M)&&this.setSize(_,M)}return v===!1&&w.setRenderTarget(o),g=w.toneMapping,w.toneMapping=gr,!0},this.hasRenderPass=function(){return v},this.end=function(w,b){w.toneMapping=g,m=!0;let _=o,M=a;for(let C=0;C<S.length;C++){let E=S[C];E.enabled!==!1&&(E.render(w,M,_,b),E.needsSwap!==!1&&(_=M,M=M===a?c:a))}if(p!==w.outputColorSpace||y!==w.toneMapping){p=w.outputColorSpace,y=w.toneMapping,h.defines={},re.getTransfer(p)===de&&(h.defines.SRGB_TRANSFER="");let C=p5[y];C&&(h.defines[C]=""),h.needsUpdate=!0}h.uniforms.tDiffuse.value=_.texture,w.setRenderTarget(x),w.render(f,d),x=null,m=!1},this.isCompositing=function(){return m},this.dispose=function(){o.dispose(),a!==null&&a.dispose(),c!==null&&c.dispose(),u.dispose(),h.dispose()}}var I2=new Dn,L2=new Zr(1,1),N2=new Bl(1),D2=new Pl,U2=new rd,F2=new Fl,u2=[],f2=[],h2=new Float32Array(16),d2=new Float32Array(9),p2=new Float32Array(4);function uc(e,t,n){let i=e[0];if(i<=0||i>0)return e;let r=t*n,s=u2[r];if(s===void 0&&(s=new Float32Array(r),u2[r]=s),t!==0){i.toArray(s,0);for(let o=1,a=0;o!==t;++o)a+=n,e[o].toArray(s,a)}return s}function Xe(e,t){if(e.length!==t.length)return!1;for(let n=0,i=e.length;n<i;n++)if(e[n]!==t[n])return!1;return!0}function qe(e,t){for(let n=0,i=t.length;n<i;n++)e[n]=t[n]}function _p(e,t){let n=f2[t];n===void 0&&(n=new Int32Array(t),f2[t]=n);for(let i=0;i!==t;++i)n[i]=e.allocateTextureUnit();return n}function g5(e,t){let n=this.cache;n[0]!==t&&(e.uniform1f(this.addr,t),n[0]=t)}function y5(e,t){let n=this.cache;if(t.x!==void 0)(n[0]!==t.x||n[1]!==t.y)&&(e.uniform2f(this.addr,t.x,t.y),n[0]=t.x,n[1]=t.y);else{if(Xe(n,t))return;e.uniform2fv(this.addr,t),qe(n,t)}}function _5(e,t){let n=this.cache;if(t.x!==void 0)(n[0]!==t.x||n[1]!==t.y||n[2]!==t.z)&&(e.uniform3f(this.addr,t.x,t.y,t.z),n[0]=t.x,n[1]=t.y,n[2]=t.z);else if(t.r!==void 0)(n[0]!==t.r||n[1]!==t.g||n[2]!==t.b)&&(e.uniform3f(this.addr,t.r,t.g,t.b),n[0]=t.r,n[1]=t.g,n[2]=t.b);else{if(Xe(n,t))return;e.uniform3fv(this.addr,t),qe(n,t)}}function x5(e,t){let n=this.cache;if(t.x!==void 0)(n[0]!==t.x||n[1]!==t.y||n[2]!==t.z||n[3]!==t.w)&&(e.uniform4f(this.addr,t.x,t.y,t.z,t.w),n[0]=t.x,n[1]=t.y,n[2]=t.z,n[3]=t.w);else{if(Xe(n,t))return;e.uniform4fv(this.addr,t),qe(n,t)}}function v5(e,t){let n=this.cache,i=t.elements;if(i===void 0){if(Xe(n,t))return;e.uniformMatrix2fv(this.addr,!1,t),qe(n,t)}else{if(Xe(n,i))return;p2.set(i),e.uniformMatrix2fv(this.addr,!1,p2),qe(n,i)}}function b5(e,t){let n=this.cache,i=t.elements;if(i===void 0){if(Xe(n,t))return;e.uniformMatrix3fv(this.addr,!1,t),qe(n,t)}else{if(Xe(n,i))return;d2.set(i),e.uniformMatrix3fv(this.addr,!1,d2),qe(n,i)}}function M5(e,t){let n=this.cache,i=t.elements;if(i===void 0){if(Xe(n,t))return;e.uniformMatrix4fv(this.addr,!1,t),qe(n,t)}else{if(Xe(n,i))return;h2.set(i),e.uniformMatrix4fv(this.addr,!1,h2),qe(n,i)}}function S5(e,t){let n=this.cache;n[0]!==t&&(e.uniform1i(this.addr,t),n[0]=t)}function w5(e,t){let n=this.cache;if(t.x!==void 0)(n[0]!==t.x||n[1]!==t.y)&&(e.uniform2i(this.addr,t.x,t.y),n[0]=t.x,n[1]=t.y);else{if(Xe(n,t))return;e.uniform2iv(this.addr,t),qe(n,t)}}function T5(e,t){let n=this.cache;if(t.x!==void 0)(n[0]!==t.x||n[1]!==t.y||n[2]!==t.z)&&(e.uniform3i(this.addr,t.x,t.y,t.z),n[0]=t.x,n[1]=t.y,n[2]=t.z);else{if(Xe(n,t))return;e.uniform3iv(this.addr,t),qe(n,t)}}function A5(e,t){let n=this.cache;if(t.x!==void 0)(n[0]!==t.x||n[1]!==t.y||n[2]!==t.z||n[3]!==t.w)&&(e.uniform4i(this.addr,t.x,t.y,t.z,t.w),n[0]=t.x,n[1]=t.y,n[2]=t.z,n[3]=t.w);else{if(Xe(n,t))return;e.uniform4iv(this.addr,t),qe(n,t)}}function E5(e,t){let n=this.cache;n[0]!==t&&(e.uniform1ui(this.addr,t),n[0]=t)}function C5(e,t){let n=this.cache;if(t.x!==void 0)(n[0]!==t.x||n[1]!==t.y)&&(e.uniform2ui(this.addr,t.x,t.y),n[0]=t.x,n[1]=t.y);else{if(Xe(n,t))return;e.uniform2uiv(this.addr,t),qe(n,t)}}function R5(e,t){let n=this.cache;if(t.x!==void 0)(n[0]!==t.x||n[1]!==t.y||n[2]!==t.z)&&(e.uniform3ui(this.addr,t.x,t.y,t.z),n[0]=t.x,n[1]=t.y,n[2]=t.z);else{if(Xe(n,t))return;e.uniform3uiv(this.addr,t),qe(n,t)}}function P5(e,t){let n=this.cache;if(t.x!==void 0)(n[0]!==t.x||n[1]!==t.y||n[2]!==t.z||n[3]!==t.w)&&(e.uniform4ui(this.addr,t.x,t.y,t.z,t.w),n[0]=t.x,n[1]=t.y,n[2]=t.z,n[3]=t.w);else{if(Xe(n,t))return;e.uniform4uiv(this.addr,t),qe(n,t)}}function xp(e){return e.version===0&&(e.compareFunction=ax,e.needsUpdate=!0),e}function I5(e,t,n){let i=this.cache,r=n.allocateTextureUnit();i[0]!==r&&(e.uniform1i(this.addr,r),i[0]=r);let s;this.type===e.SAMPLER_2D_SHADOW?s=xp(L2):s=I2,n.setTexture2D(t||s,r)}function L5(e,t,n){let i=this.cache,r=n.allocateTextureUnit();i[0]!==r&&(e.uniform1i(this.addr,r),i[0]=r),n.setTexture3D(t||U2,r)}function N5(e,t,n){let i=this.cache,r=n.allocateTextureUnit();i[0]!==r&&(e.uniform1i(this.addr,r),i[0]=r);let s;this.type===e.SAMPLER_CUBE_SHADOW?s=xp(N2):s=F2,n.setTextureCube(t||s,r)}function D5(e,t,n){let i=this.cache,r=n.allocateTextureUnit();i[0]!==r&&(e.uniform1i(this.addr,r),i[0]=r),n.setTexture2DArray(t||D2,r)}function U5(e){switch(e){case 5126:return g5;case 35664:return y5;case 35665:return _5;case 35666:return x5;case 35674:return v5;case 35675:return b5;case 35676:return M5;case 5124:case 35670:return S5;case 35667:case 35671:return w5;case 35668:case 35672:return T5;case 35669:case 35673:return A5;case 5125:return E5;case 36294:return C5;case 36295:return R5;case 36296:return P5;case 35678:case 36198:case 36298:case 36306:case 35682:return I5;case 35679:case 36299:case 36307:return L5;case 35680:case 36300:case 36308:case 36293:return N5;case 36289:case 36303:case 36311:case 36292:return D5}}function F5(e,t){e.uniform1fv(this.addr,t)}function O5(e,t){let n=uc(t,this.size,2);e.uniform2fv(this.addr,n)}function B5(e,t){let n=uc(t,this.size,3);e.uniform3fv(this.addr,n)}function k5(e,t){let n=uc(t,this.size,4);e.uniform4fv(this.addr,n)}function z5(e,t){let n=uc(t,this.size,4);e.uniformMatrix2fv(this.addr,!1,n)}function G5(e,t){let n=uc(t,this.size,9);e.uniformMatrix3fv(this.addr,!1,n)}function V5(e,t){let n=uc(t,this.size,16);e.uniformMatrix4fv(this.addr,!1,n)}function H5(e,t){e.uniform1iv(this.addr,t)}function W5(e,t){e.uniform2iv(this.addr,t)}function $5(e,t){e.uniform3iv(this.addr,t)}function X5(e,t){e.uniform4iv(this.addr,t)}function q5(e,t){e.uniform1uiv(this.addr,t)}function Y5(e,t){e.uniform2uiv(this.addr,t)}function Z5(e,t){e.uniform3uiv(this.addr,t)}function J5(e,t){e.uniform4uiv(this.addr,t)}function K5(e,t,n){let i=this.cache,r=t.length,s=_p(n,r);Xe(i,s)||(e.uniform1iv(this.addr,s),qe(i,s));let o;this.type===e.SAMPLER_2D_SHADOW?o=xp(L2):o=I2;for(let a=0;a!==r;++a)n.setTexture2D(t[a]||o,s[a])}function j5(e,t,n){let i=this.cache,r=t.length,s=_p(n,r);Xe(i,s)||(e.uniform1iv(this.addr,s),qe(i,s));for(let o=0;o!==r;++o)n.setTexture3D(t[o]||U2,s[o])}function Q5(e,t,n){let i=this.cache,r=t.length,s=_p(n,r);Xe(i,s)||(e.uniform1iv(this.addr,s),qe(i,s));let o;this.type===e.SAMPLER_CUBE_SHADOW?o=xp(N2):o=F2;for(let a=0;a!==r;++a)n.setTextureCube(t[a]||o,s[a])}function tB(e,t,n){let i=this.cache,r=t.length,s=_p(n,r);Xe(i,s)||(e.uniform1iv(this.addr,s),qe(i,s));for(let o=0;o!==r;++o)n.setTexture2DArray(t[o]||D2,s[o])}function eB(e){switch(e){case 5126:return F5;case 35664:return O5;case 35665:return B5;case 35666:return k5;case 35674:return z5;case 35675:return G5;case 35676:return V5;case 5124:case 35670:return H5;case 35667:case 35671:return W5;case 35668:case 35672:return $5;case 35669:case 35673:return X5;case 5125:return q5;case 36294:return Y5;case 36295:return Z5;case 36296:return J5;case 35678:case 36198:case 36298:case 36306:case 35682:return K5;case 35679:case 36299:case 36307:return j5;case 35680:case 36300:case 36308:case 36293:return Q5;case 36289:case 36303:case 36311:case 36292:return tB}}var vx=class{constructor(t,n,i){this.id=t,this.addr=i,this.cache=[],this.type=n.type,this.setValue=U5(n.type)}},bx=class{constructor(t,n,i){this.id=t,this.addr=i,this.cache=[],this.type=n.type,this.size=n.size,this.setValue=eB(n.type)}},Mx=class{constructor(t){this.id=t,this.seq=[],this.map={}}setValue(t,n,i){let r=this.seq;for(let s=0,o=r.length;s!==o;++s){let a=r[s];a.setValue(t,n[a.id],i)}}},_x=/(\w+)(\])?(\[|\.)?/g;function m2(e,t){e.seq.push(t),e.map[t.id]=t}function nB(e,t,n){let i=e.name,r=i.length;for(_x.lastIndex=0;;){let s=_x.exec(i),o=_x.lastIndex,a=s[1],c=s[2]==="]",l=s[3];if(c&&(a=a|0),l===void 0||l==="["&&o+2===r){m2(n,l===void 0?new vx(a,e,t):new bx(a,e,t));break}else{let h=n.map[a];h===void 0&&(h=new Mx(a),m2(n,h)),n=h}}}var lc=class{constructor(t,n){this.seq=[],this.map={};let i=t.getProgramParameter(n,t.ACTIVE_UNIFORMS);for(let o=0;o<i;++o){let a=t.getActiveUniform(n,o),c=t.getUniformLocation(n,a.name);nB(a,c,this)}let r=[],s=[];for(let o of this.seq)o.type===t.SAMPLER_2D_SHADOW||o.type===t.SAMPLER_CUBE_SHADOW||o.type===t.SAMPLER_2D_ARRAY_SHADOW?r.push(o):s.push(o);r.length>0&&(this.seq=r.concat(s))}setValue(t,n,i,r){let s=this.map[n];s!==void 0&&s.setValue(t,i,r)}setOptional(t,n,i){let r=n[i];r!==void 0&&this.setValue(t,i,r)}static upload(t,n,i,r){for(let s=0,o=n.length;s!==o;++s){let a=n[s],c=i[a.id];c.needsUpdate!==!1&&a.setValue(t,c.value,r)}}static seqWithValue(t,n){let i=[];for(let r=0,s=t.length;r!==s;++r){let o=t[r];o.id in n&&i.push(o)}return i}};function g2(e,t,n){let i=e.createShader(t);return e.shaderSource(i,n),e.compileShader(i),i}var iB=37297,rB=0;function sB(e,t){let n=e.split(`
`),i=[],r=Math.max(t-6,0),s=Math.min(t+6,n.length);for(let o=r;o<s;o++){let a=o+1;i.push(`${a===t?">":" "} ${a}: ${n[o]}`)}return i.join(`
`)}var y2=new zt;function oB(e){re._getMatrix(y2,re.workingColorSpace,e);let t=`mat3( ${y2.elements.map(n=>n.toFixed(4))} )`;switch(re.getTransfer(e)){case El:return[t,"LinearTransferOETF"];case de:return[t,"sRGBTransferOETF"];default:return Ut("WebGLProgram: Unsupported color space: ",e),[t,"LinearTransferOETF"]}}function _2(e,t,n){let i=e.getShaderParameter(t,e.COMPILE_STATUS),s=(e.getShaderInfoLog(t)||"").trim();if(i&&s==="")return"";let o=/ERROR: 0:(\d+)/.exec(s);if(o){let a=parseInt(o[1]);return n.toUpperCase()+`

`+s+`

`+sB(e.getShaderSource(t),a)}else return s}function aB(e,t){let n=oB(t);return[`vec4 ${e}( vec4 value ) {`,`	return ${n[1]}( vec4( ${n[0]} * value.rgb, value.a ) );`,"}"].join(`
`)}var cB={[W_]:"Linear",[$_]:"Reinhard",[X_]:"Cineon",[q_]:"ACESFilmic",[Z_]:"AgX",[J_]:"Neutral",[Y_]:"Custom"};function lB(e,t){let n=cB[t];return n===void 0?(Ut("WebGLProgram: Unsupported toneMapping:",t),"vec3 "+e+"( vec3 color ) { return LinearToneMapping( color ); }"):"vec3 "+e+"( vec3 color ) { return "+n+"ToneMapping( color ); }"}var mp=new k;function uB(){re.getLuminanceCoefficients(mp);let e=mp.x.toFixed(4),t=mp.y.toFixed(4),n=mp.z.toFixed(4);return["float luminance( const in vec3 rgb ) {",`	const vec3 weights = vec3( ${e}, ${t}, ${n} );`,"	return dot( weights, rgb );","}"].join(`
`)}function fB(e){return[e.extensionClipCullDistance?"#extension GL_ANGLE_clip_cull_distance : require":"",e.extensionMultiDraw?"#extension GL_ANGLE_multi_draw : require":""].filter(lu).join(`
`)}function hB(e){let t=[];for(let n in e){let i=e[n];i!==!1&&t.push("#define "+n+" "+i)}return t.join(`
`)}function dB(e,t){let n={},i=e.getProgramParameter(t,e.ACTIVE_ATTRIBUTES);for(let r=0;r<i;r++){let s=e.getActiveAttrib(t,r),o=s.name,a=1;s.type===e.FLOAT_MAT2&&(a=2),s.type===e.FLOAT_MAT3&&(a=3),s.type===e.FLOAT_MAT4&&(a=4),n[o]={type:s.type,location:e.getAttribLocation(t,o),locationSize:a}}return n}function lu(e){return e!==""}function x2(e,t){let n=t.numSpotLightShadows+t.numSpotLightMaps-t.numSpotLightShadowsWithMaps;return e.replace(/NUM_SUN_LIGHTS/g,t.numSunLights).replace(/NUM_DIR_LIGHTS/g,t.numDirLights).replace(/NUM_SPOT_LIGHTS/g,t.numSpotLights).replace(/NUM_SPOT_LIGHT_MAPS/g,t.numSpotLightMaps).replace(/NUM_SPOT_LIGHT_COORDS/g,n).replace(/NUM_RECT_AREA_LIGHTS/g,t.numRectAreaLights).replace(/NUM_POINT_LIGHTS/g,t.numPointLights).replace(/NUM_HEMI_LIGHTS/g,t.numHemiLights).replace(/NUM_SUN_LIGHT_SHADOWS/g,t.numSunLightShadows).replace(/NUM_DIR_LIGHT_SHADOWS/g,t.numDirLightShadows).replace(/NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS/g,t.numSpotLightShadowsWithMaps).replace(/NUM_SPOT_LIGHT_SHADOWS/g,t.numSpotLightShadows).replace(/NUM_POINT_LIGHT_SHADOWS/g,t.numPointLightShadows).replace(/NUM_LIGHT_PROBE_GRIDS/g,t.numLightProbeGrids)}function v2(e,t){return e.replace(/NUM_CLIPPING_PLANES/g,t.numClippingPlanes).replace(/UNION_CLIPPING_PLANES/g,t.numClippingPlanes-t.numClipIntersection)}var pB=/^[ \t]*#include +<([\w\d./]+)>/gm;function Sx(e){return e.replace(pB,mB)}function mB(e,t){let n=jt[t];if(n===void 0)throw new Error("THREE.WebGLProgram: Can not resolve #include <"+t+">");return Sx(n)}var gB=/#pragma unroll_loop_start\s+for\s*\(\s*int\s+i\s*=\s*(\d+)\s*;\s*i\s*<\s*(\d+)\s*;\s*i\s*\+\+\s*\)\s*{([\s\S]+?)}\s+#pragma unroll_loop_end/g;function b2(e){return e.replace(gB,yB)}function yB(e,t,n,i){let r="";for(let s=parseInt(t);s<parseInt(n);s++)r+=i.replace(/\[\s*i\s*\]/g,"[ "+s+" ]").replace(/UNROLLED_LOOP_INDEX/g,s);return r}function M2(e){let t=`precision ${e.precision} float;
	precision ${e.precision} int;
	precision ${e.precision} sampler2D;
	precision ${e.precision} samplerCube;
	precision ${e.precision} sampler3D;
	precision ${e.precision} sampler2DArray;
	precision ${e.precision} sampler2DShadow;
	precision ${e.precision} samplerCubeShadow;
	precision ${e.precision} sampler2DArrayShadow;
	precision ${e.precision} isampler2D;
	precision ${e.precision} isampler3D;
	precision ${e.precision} isamplerCube;
	precision ${e.precision} isampler2DArray;
	precision ${e.precision} usampler2D;
	precision ${e.precision} usampler3D;
	precision ${e.precision} usamplerCube;
	precision ${e.precision} usampler2DArray;
	`;return e.precision==="highp"?t+=`
#define HIGH_PRECISION`:e.precision==="mediump"?t+=`
#define MEDIUM_PRECISION`:e.precision==="lowp"&&(t+=`
#define LOW_PRECISION`),t}var _B={[jl]:"SHADOWMAP_TYPE_PCF",[sc]:"SHADOWMAP_TYPE_VSM"};function xB(e){return _B[e.shadowMapType]||"SHADOWMAP_TYPE_BASIC"}var vB={[ac]:"ENVMAP_MODE_REFRACTION"};function bB(e){return e.envMap===!1?"ENVMAP_MODE_REFLECTION":vB[e.envMapMode]||"ENVMAP_MODE_REFLECTION"}var MB={[Ad]:"ENVMAP_BLENDING_MULTIPLY",[VE]:"ENVMAP_BLENDING_MIX",[HE]:"ENVMAP_BLENDING_ADD"};function SB(e){return e.envMap===!1?"ENVMAP_BLENDING_NONE":MB[e.combine]||"ENVMAP_BLENDING_NONE"}function wB(e,t,n,i){let r=e.getContext(),s=n.defines,o=n.vertexShader,a=n.fragmentShader,c=xB(n),l=n.envMapPMREM===!0?"ENVMAP_TYPE_PMREM":"ENVMAP_TYPE_CUBE",u=bB(n),h=SB(n),f=fB(n),d=hB(s),p=r.createProgram(),y,m,g=n.glslVersion?"#version "+n.glslVersion+`
`:"";n.isRawShaderMaterial?(y=["#define SHADER_TYPE "+n.shaderType,"#define SHADER_NAME "+n.shaderName,d].filter(lu).join(`
`),y.length>0&&(y+=`
`),m=["#define SHADER_TYPE "+n.shaderType,"#define SHADER_NAME "+n.shaderName,d].filter(lu).join(`
`),m.length>0&&(m+=`
`)):(y=[M2(n),"#define SHADER_TYPE "+n.shaderType,"#define SHADER_NAME "+n.shaderName,d,n.extensionClipCullDistance?"#define USE_CLIP_DISTANCE":"",n.batching?"#define USE_BATCHING":"",n.batchingColor?"#define USE_BATCHING_COLOR":"",n.instancing?"#define USE_INSTANCING":"",n.instancingColor?"#define USE_INSTANCING_COLOR":"",n.instancingMorph?"#define USE_INSTANCING_MORPH":"",n.useFog&&n.fog?"#define USE_FOG":"",n.useFog&&n.fogExp2?"#define FOG_EXP2":"",n.map?"#define USE_MAP":"",n.envMap?"#define USE_ENVMAP":"",n.envMap?"#define "+u:"",n.lightMap?"#define USE_LIGHTMAP":"",n.aoMap?"#define USE_AOMAP":"",n.bumpMap?"#define USE_BUMPMAP":"",n.normalMap?"#define USE_NORMALMAP":"",n.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",n.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",n.displacementMap?"#define USE_DISPLACEMENTMAP":"",n.emissiveMap?"#define USE_EMISSIVEMAP":"",n.anisotropy?"#define USE_ANISOTROPY":"",n.anisotropyMap?"#define USE_ANISOTROPYMAP":"",n.clearcoatMap?"#define USE_CLEARCOATMAP":"",n.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",n.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",n.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",n.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",n.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",n.specularMap?"#define USE_SPECULARMAP":"",n.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",n.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",n.roughnessMap?"#define USE_ROUGHNESSMAP":"",n.metalnessMap?"#define USE_METALNESSMAP":"",n.alphaMap?"#define USE_ALPHAMAP":"",n.alphaHash?"#define USE_ALPHAHASH":"",n.transmission?"#define USE_TRANSMISSION":"",n.transmissionMap?"#define USE_TRANSMISSIONMAP":"",n.thicknessMap?"#define USE_THICKNESSMAP":"",n.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",n.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",n.mapUv?"#define MAP_UV "+n.mapUv:"",n.alphaMapUv?"#define ALPHAMAP_UV "+n.alphaMapUv:"",n.lightMapUv?"#define LIGHTMAP_UV "+n.lightMapUv:"",n.aoMapUv?"#define AOMAP_UV "+n.aoMapUv:"",n.emissiveMapUv?"#define EMISSIVEMAP_UV "+n.emissiveMapUv:"",n.bumpMapUv?"#define BUMPMAP_UV "+n.bumpMapUv:"",n.normalMapUv?"#define NORMALMAP_UV "+n.normalMapUv:"",n.displacementMapUv?"#define DISPLACEMENTMAP_UV "+n.displacementMapUv:"",n.metalnessMapUv?"#define METALNESSMAP_UV "+n.metalnessMapUv:"",n.roughnessMapUv?"#define ROUGHNESSMAP_UV "+n.roughnessMapUv:"",n.anisotropyMapUv?"#define ANISOTROPYMAP_UV "+n.anisotropyMapUv:"",n.clearcoatMapUv?"#define CLEARCOATMAP_UV "+n.clearcoatMapUv:"",n.clearcoatNormalMapUv?"#define CLEARCOAT_NORMALMAP_UV "+n.clearcoatNormalMapUv:"",n.clearcoatRoughnessMapUv?"#define CLEARCOAT_ROUGHNESSMAP_UV "+n.clearcoatRoughnessMapUv:"",n.diffuseRoughnessMapUv?"#define DIFFUSE_ROUGHNESSMAP_UV "+n.diffuseRoughnessMapUv:"",n.iridescenceMapUv?"#define IRIDESCENCEMAP_UV "+n.iridescenceMapUv:"",n.iridescenceThicknessMapUv?"#define IRIDESCENCE_THICKNESSMAP_UV "+n.iridescenceThicknessMapUv:"",n.sheenColorMapUv?"#define SHEEN_COLORMAP_UV "+n.sheenColorMapUv:"",n.sheenRoughnessMapUv?"#define SHEEN_ROUGHNESSMAP_UV "+n.sheenRoughnessMapUv:"",n.specularMapUv?"#define SPECULARMAP_UV "+n.specularMapUv:"",n.specularColorMapUv?"#define SPECULAR_COLORMAP_UV "+n.specularColorMapUv:"",n.specularIntensityMapUv?"#define SPECULAR_INTENSITYMAP_UV "+n.specularIntensityMapUv:"",n.transmissionMapUv?"#define TRANSMISSIONMAP_UV "+n.transmissionMapUv:"",n.thicknessMapUv?"#define THICKNESSMAP_UV "+n.thicknessMapUv:"",n.vertexTangents&&n.flatShading===!1?"#define USE_TANGENT":"",n.vertexNormals?"#define HAS_NORMAL":"",n.vertexColors?"#define USE_COLOR":"",n.vertexAlphas?"#define USE_COLOR_ALPHA":"",n.vertexUv1s?"#define USE_UV1":"",n.vertexUv2s?"#define USE_UV2":"",n.vertexUv3s?"#define USE_UV3":"",n.pointsUvs?"#define USE_POINTS_UV":"",n.flatShading?"#define FLAT_SHADED":"",n.skinning?"#define USE_SKINNING":"",n.morphTargets?"#define USE_MORPHTARGETS":"",n.morphNormals&&n.flatShading===!1?"#define USE_MORPHNORMALS":"",n.morphColors?"#define USE_MORPHCOLORS":"",n.morphTargetsCount>0?"#define MORPHTARGETS_TEXTURE_STRIDE "+n.morphTextureStride:"",n.morphTargetsCount>0?"#define MORPHTARGETS_COUNT "+n.morphTargetsCount:"",n.doubleSided?"#define DOUBLE_SIDED":"",n.flipSided?"#define FLIP_SIDED":"",n.shadowMapEnabled?"#define USE_SHADOWMAP":"",n.shadowMapEnabled?"#define "+c:"",n.sizeAttenuation?"#define USE_SIZEATTENUATION":"",n.numLightProbes>0?"#define USE_LIGHT_PROBES":"",n.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",n.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 modelMatrix;","uniform mat4 modelViewMatrix;","uniform mat4 projectionMatrix;","uniform mat4 viewMatrix;","uniform mat3 normalMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;","#ifdef USE_INSTANCING","	attribute mat4 instanceMatrix;","#endif","#ifdef USE_INSTANCING_COLOR","	attribute vec3 instanceColor;","#endif","#ifdef USE_INSTANCING_MORPH","	uniform sampler2D morphTexture;","#endif","attribute vec3 position;","attribute vec3 normal;","attribute vec2 uv;","#ifdef USE_UV1","	attribute vec2 uv1;","#endif","#ifdef USE_UV2","	attribute vec2 uv2;","#endif","#ifdef USE_UV3","	attribute vec2 uv3;","#endif","#ifdef USE_TANGENT","	attribute vec4 tangent;","#endif","#if defined( USE_COLOR_ALPHA )","	attribute vec4 color;","#elif defined( USE_COLOR )","	attribute vec3 color;","#endif","#ifdef USE_SKINNING","	attribute vec4 skinIndex;","	attribute vec4 skinWeight;","#endif",`
`].filter(lu).join(`
`),m=[M2(n),"#define SHADER_TYPE "+n.shaderType,"#define SHADER_NAME "+n.shaderName,d,n.useFog&&n.fog?"#define USE_FOG":"",n.useFog&&n.fogExp2?"#define FOG_EXP2":"",n.alphaToCoverage?"#define ALPHA_TO_COVERAGE":"",n.map?"#define USE_MAP":"",n.matcap?"#define USE_MATCAP":"",n.envMap?"#define USE_ENVMAP":"",n.envMap?"#define "+l:"",n.envMap?"#define "+u:"",n.envMap?"#define "+h:"",n.envMapPMREM?"#define ENVMAP_MAX_LOD "+n.envMapMaxLod+".0":"",n.envMapPMREM?"#define ENVMAP_SIZE "+n.envMapSize+".0":"",n.lightMap?"#define USE_LIGHTMAP":"",n.aoMap?"#define USE_AOMAP":"",n.bumpMap?"#define USE_BUMPMAP":"",n.normalMap?"#define USE_NORMALMAP":"",n.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",n.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",n.packedNormalMap?"#define USE_PACKED_NORMALMAP":"",n.emissiveMap?"#define USE_EMISSIVEMAP":"",n.anisotropy?"#define USE_ANISOTROPY":"",n.anisotropyMap?"#define USE_ANISOTROPYMAP":"",n.clearcoat?"#define USE_CLEARCOAT":"",n.clearcoatMap?"#define USE_CLEARCOATMAP":"",n.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",n.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",n.diffuseRoughness?"#define USE_DIFFUSE_ROUGHNESS":"",n.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",n.dispersion?"#define USE_DISPERSION":"",n.retroreflection?"#define USE_RETROREFLECTION":"",n.iridescence?"#define USE_IRIDESCENCE":"",n.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",n.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",n.specularMap?"#define USE_SPECULARMAP":"",n.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",n.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",n.roughnessMap?"#define USE_ROUGHNESSMAP":"",n.metalnessMap?"#define USE_METALNESSMAP":"",n.alphaMap?"#define USE_ALPHAMAP":"",n.alphaTest?"#define USE_ALPHATEST":"",n.alphaHash?"#define USE_ALPHAHASH":"",n.sheen?"#define USE_SHEEN":"",n.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",n.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",n.transmission?"#define USE_TRANSMISSION":"",n.transmissionMap?"#define USE_TRANSMISSIONMAP":"",n.thicknessMap?"#define USE_THICKNESSMAP":"",n.vertexTangents&&n.flatShading===!1?"#define USE_TANGENT":"",n.vertexColors||n.instancingColor?"#define USE_COLOR":"",n.vertexAlphas||n.batchingColor?"#define USE_COLOR_ALPHA":"",n.vertexUv1s?"#define USE_UV1":"",n.vertexUv2s?"#define USE_UV2":"",n.vertexUv3s?"#define USE_UV3":"",n.pointsUvs?"#define USE_POINTS_UV":"",n.gradientMap?"#define USE_GRADIENTMAP":"",n.flatShading?"#define FLAT_SHADED":"",n.doubleSided?"#define DOUBLE_SIDED":"",n.flipSided?"#define FLIP_SIDED":"",n.shadowMapEnabled?"#define USE_SHADOWMAP":"",n.shadowMapEnabled?"#define "+c:"",n.premultipliedAlpha?"#define PREMULTIPLIED_ALPHA":"",n.numLightProbes>0?"#define USE_LIGHT_PROBES":"",n.decodeVideoTexture?"#define DECODE_VIDEO_TEXTURE":"",n.decodeVideoTextureEmissive?"#define DECODE_VIDEO_TEXTURE_EMISSIVE":"",n.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",n.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 viewMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;",n.toneMapping!==gr?"#define TONE_MAPPING":"",n.toneMapping!==gr?jt.tonemapping_pars_fragment:"",n.toneMapping!==gr?lB("toneMapping",n.toneMapping):"",n.dithering?"#define DITHERING":"",n.opaque?"#define OPAQUE":"",jt.colorspace_pars_fragment,aB("linearToOutputTexel",n.outputColorSpace),uB(),n.useDepthPacking?"#define DEPTH_PACKING "+n.depthPacking:"",`
`].filter(lu).join(`
`)),o=Sx(o),o=x2(o,n),o=v2(o,n),a=Sx(a),a=x2(a,n),a=v2(a,n),o=b2(o),a=b2(a),n.isRawShaderMaterial!==!0&&(g=`#version 300 es
`,y=[f,"#define attribute in","#define varying out","#define texture2D texture"].join(`
`)+`
`+y,m=["#define varying in",n.glslVersion===lx?"":"layout(location = 0) out highp vec4 pc_fragColor;",n.glslVersion===lx?"":"#define gl_FragColor pc_fragColor","#define gl_FragDepthEXT gl_FragDepth","#define texture2D texture","#define textureCube texture","#define texture2DProj textureProj","#define texture2DLodEXT textureLod","#define texture2DProjLodEXT textureProjLod","#define textureCubeLodEXT textureLod","#define texture2DGradEXT textureGrad","#define texture2DProjGradEXT textureProjGrad","#define textureCubeGradEXT textureGrad"].join(`
`)+`
`+m);let x=g+y+o,S=g+m+a,v=g2(r,r.VERTEX_SHADER,x),w=g2(r,r.FRAGMENT_SHADER,S);r.attachShader(p,v),r.attachShader(p,w),n.index0AttributeName!==void 0?r.bindAttribLocation(p,0,n.index0AttributeName):n.hasPositionAttribute===!0&&r.bindAttribLocation(p,0,"position"),r.linkProgram(p);function b(E){if(e.debug.checkShaderErrors){let I=r.getProgramInfoLog(p)||"",R=r.getShaderInfoLog(v)||"",U=r.getShaderInfoLog(w)||"",P=I.trim(),L=R.trim(),O=U.trim(),D=!0,Y=!0;if(r.getProgramParameter(p,r.LINK_STATUS)===!1)if(D=!1,typeof e.debug.onShaderError=="function")e.debug.onShaderError(r,p,v,w);else{let B=_2(r,v,"vertex"),V=_2(r,w,"fragment");kt("WebGLProgram: Shader Error "+r.getError()+" - VALIDATE_STATUS "+r.getProgramParameter(p,r.VALIDATE_STATUS)+`

Material Name: `+E.name+`
Material Type: `+E.type+`

Program Info Log: `+P+`
`+B+`
`+V)}else P!==""?Ut("WebGLProgram: Program Info Log:",P):(L===""||O==="")&&(Y=!1);Y&&(E.diagnostics={runnable:D,programLog:P,vertexShader:{log:L,prefix:y},fragmentShader:{log:O,prefix:m}})}r.deleteShader(v),r.deleteShader(w),_=new lc(r,p),M=dB(r,p)}let _;this.getUniforms=function(){return _===void 0&&b(this),_};let M;this.getAttributes=function(){return M===void 0&&b(this),M};let C=n.rendererExtensionParallelShaderCompile===!1;return this.isReady=function(){return C===!1&&(C=r.getProgramParameter(p,iB)),C},this.destroy=function(){i.releaseStatesOfProgram(this),r.deleteProgram(p),this.program=void 0},this.type=n.shaderType,this.name=n.shaderName,this.id=rB++,this.cacheKey=t,this.usedTimes=1,this.program=p,this.vertexShader=v,this.fragmentShader=w,this}var TB=0,wx=class{constructor(){this.shaderCache=new Map,this.materialCache=new Map}update(t,n,i){let r=this._getShaderCacheForMaterial(t);return r.has(n)===!1&&(r.add(n),n.usedTimes++),r.has(i)===!1&&(r.add(i),i.usedTimes++),this}remove(t){let n=this.materialCache.get(t);for(let i of n)i.usedTimes--,i.usedTimes===0&&this.shaderCache.delete(i.code);return this.materialCache.delete(t),this}getVertexShaderStage(t){return this._getShaderStage(t.vertexShader)}getFragmentShaderStage(t){return this._getShaderStage(t.fragmentShader)}dispose(){this.shaderCache.clear(),this.materialCache.clear()}_getShaderCacheForMaterial(t){let n=this.materialCache,i=n.get(t);return i===void 0&&(i=new Set,n.set(t,i)),i}_getShaderStage(t){let n=this.shaderCache,i=n.get(t);return i===void 0&&(i=new Tx(t),n.set(t,i)),i}},Tx=class{constructor(t){this.id=TB++,this.code=t,this.usedTimes=0}};function AB(e){return e===ks||e===ru||e===su}function EB(e,t,n,i,r,s){let o=new Il,a=new wx,c=new Set,l=[],u=new Map,h=i.logarithmicDepthBuffer,f={MeshDepthMaterial:"depth",MeshDistanceMaterial:"distance",MeshNormalMaterial:"normal",MeshBasicMaterial:"basic",MeshLambertMaterial:"lambert",MeshPhongMaterial:"phong",MeshToonMaterial:"toon",MeshStandardMaterial:"physical",MeshPhysicalMaterial:"physical",MeshMatcapMaterial:"matcap",LineBasicMaterial:"basic",LineDashedMaterial:"dashed",PointsMaterial:"points",ShadowMaterial:"shadow",SpriteMaterial:"sprite"};function d(_){return c.add(_),_===0?"uv":`uv${_}`}function p(_,M,C,E,I,R){let U=E.fog,P=I.geometry,L=_.isMeshStandardMaterial||_.isMeshLambertMaterial||_.isMeshPhongMaterial?E.environment:null,O=_.isMeshStandardMaterial||_.isMeshLambertMaterial&&!_.envMap||_.isMeshPhongMaterial&&!_.envMap,D=t.get(_.envMap||L,O),Y=f[_.type],B=i.precision;_.precision!==null&&(B=i.getMaxPrecision(_.precision),B!==_.precision&&Ut("WebGLProgram.getParameters:",_.precision,"not supported, using",B,"instead."));let V=P.morphAttributes.position||P.morphAttributes.normal||P.morphAttributes.color,q=V!==void 0?V.length:0,rt=0;P.morphAttributes.position!==void 0&&(rt=1),P.morphAttributes.normal!==void 0&&(rt=2),P.morphAttributes.color!==void 0&&(rt=3);let ct,$,ot,ut;if(Y){let At=Fn[Y];ct=At.vertexShader,$=At.fragmentShader}else{ct=_.vertexShader,$=_.fragmentShader;let At=a.getVertexShaderStage(_),me=a.getFragmentShaderStage(_);a.update(_,At,me),ot=At.id,ut=me.id}let st=e.getRenderTarget(),at=e.state.buffers.depth.getReversed(),J=I.isInstancedMesh===!0,_t=I.isBatchedMesh===!0,lt=!!_.map,K=!!_.matcap,Nt=!!D,Mt=Nt&&D.isPMREMTexture===!0,$t=!!_.aoMap,Zt=!!_.lightMap,ye=!!_.bumpMap&&_.wireframe===!1,fe=!!_.normalMap,yn=!!_.displacementMap,Ze=!!_.emissiveMap,ii=!!_.metalnessMap,ri=!!_.roughnessMap,si=_.anisotropy>0,G=_.clearcoat>0,oi=_.diffuseRoughness>0,Ae=_.dispersion>0,Ee=_.retroreflectivity>0,Tt=_.iridescence>0,Ge=_.sheen>0,Ot=_.transmission>0,Gt=si&&!!_.anisotropyMap,N=G&&!!_.clearcoatMap,T=G&&!!_.clearcoatNormalMap,W=G&&!!_.clearcoatRoughnessMap,ft=oi&&!!_.diffuseRoughnessMap,nt=Tt&&!!_.iridescenceMap,pt=Tt&&!!_.iridescenceThicknessMap,vt=Ge&&!!_.sheenColorMap,Q=Ge&&!!_.sheenRoughnessMap,tt=!!_.specularMap,gt=!!_.specularColorMap,F=!!_.specularIntensityMap,et=Ot&&!!_.transmissionMap,j=Ot&&!!_.thicknessMap,yt=!!_.gradientMap,dt=!!_.alphaMap,mt=_.alphaTest>0,Lt=!!_.alphaHash,Kt=!!_.extensions,ht=gr;_.toneMapped&&(st===null||st.isXRRenderTarget===!0)&&(ht=e.toneMapping);let Dt=Mt?D.isCompressedCubeTexture?D.image[0].mipmaps:D.mipmaps:null,Jt={shaderID:Y,shaderType:_.type,shaderName:_.name,vertexShader:ct,fragmentShader:$,defines:_.defines,customVertexShaderID:ot,customFragmentShaderID:ut,isRawShaderMaterial:_.isRawShaderMaterial===!0,glslVersion:_.glslVersion,precision:B,batching:_t,batchingColor:_t&&I._colorsTexture!==null,instancing:J,instancingColor:J&&I.instanceColor!==null,instancingMorph:J&&I.morphTexture!==null,outputColorSpace:st===null?e.outputColorSpace:st.isXRRenderTarget===!0?st.texture.colorSpace:re.workingColorSpace,alphaToCoverage:!!_.alphaToCoverage,map:lt,matcap:K,envMap:Nt,envMapMode:Nt&&D.mapping,envMapPMREM:Mt,envMapMaxLod:Mt?Dt.length-1:null,envMapSize:Mt?Dt[0].width:null,aoMap:$t,lightMap:Zt,bumpMap:ye,normalMap:fe,displacementMap:yn,emissiveMap:Ze,normalMapObjectSpace:fe&&_.normalMapType===XE,normalMapTangentSpace:fe&&_.normalMapType===hp,packedNormalMap:fe&&_.normalMapType===hp&&AB(_.normalMap.format),metalnessMap:ii,roughnessMap:ri,anisotropy:si,anisotropyMap:Gt,clearcoat:G,clearcoatMap:N,clearcoatNormalMap:T,clearcoatRoughnessMap:W,diffuseRoughness:oi,diffuseRoughnessMap:ft,dispersion:Ae,retroreflection:Ee,iridescence:Tt,iridescenceMap:nt,iridescenceThicknessMap:pt,sheen:Ge,sheenColorMap:vt,sheenRoughnessMap:Q,specularMap:tt,specularColorMap:gt,specularIntensityMap:F,transmission:Ot,transmissionMap:et,thicknessMap:j,gradientMap:yt,opaque:_.transparent===!1&&_.blending===oc&&_.alphaToCoverage===!1,alphaMap:dt,alphaTest:mt,alphaHash:Lt,combine:_.combine,mapUv:lt&&d(_.map.channel),aoMapUv:$t&&d(_.aoMap.channel),lightMapUv:Zt&&d(_.lightMap.channel),bumpMapUv:ye&&d(_.bumpMap.channel),normalMapUv:fe&&d(_.normalMap.channel),displacementMapUv:yn&&d(_.displacementMap.channel),emissiveMapUv:Ze&&d(_.emissiveMap.channel),metalnessMapUv:ii&&d(_.metalnessMap.channel),roughnessMapUv:ri&&d(_.roughnessMap.channel),anisotropyMapUv:Gt&&d(_.anisotropyMap.channel),clearcoatMapUv:N&&d(_.clearcoatMap.channel),clearcoatNormalMapUv:T&&d(_.clearcoatNormalMap.channel),clearcoatRoughnessMapUv:W&&d(_.clearcoatRoughnessMap.channel),diffuseRoughnessMapUv:ft&&d(_.diffuseRoughnessMap.channel),iridescenceMapUv:nt&&d(_.iridescenceMap.channel),iridescenceThicknessMapUv:pt&&d(_.iridescenceThicknessMap.channel),sheenColorMapUv:vt&&d(_.sheenColorMap.channel),sheenRoughnessMapUv:Q&&d(_.sheenRoughnessMap.channel),specularMapUv:tt&&d(_.specularMap.channel),specularColorMapUv:gt&&d(_.specularColorMap.channel),specularIntensityMapUv:F&&d(_.specularIntensityMap.channel),transmissionMapUv:et&&d(_.transmissionMap.channel),thicknessMapUv:j&&d(_.thicknessMap.channel),alphaMapUv:dt&&d(_.alphaMap.channel),vertexTangents:!!P.attributes.tangent&&(fe||si),vertexNormals:!!P.attributes.normal,vertexColors:_.vertexColors,vertexAlphas:_.vertexColors===!0&&!!P.attributes.color&&P.attributes.color.itemSize===4,pointsUvs:I.isPoints===!0&&!!P.attributes.uv&&(lt||dt),fog:!!U,useFog:_.fog===!0,fogExp2:!!U&&U.isFogExp2,flatShading:_.wireframe===!1&&(_.flatShading===!0||P.attributes.normal===void 0&&fe===!1&&(_.isMeshLambertMaterial||_.isMeshPhongMaterial||_.isMeshStandardMaterial||_.isMeshPhysicalMaterial)),sizeAttenuation:_.sizeAttenuation===!0,logarithmicDepthBuffer:h,reversedDepthBuffer:at,skinning:I.isSkinnedMesh===!0,hasPositionAttribute:P.attributes.position!==void 0,morphTargets:P.morphAttributes.position!==void 0,morphNormals:P.morphAttributes.normal!==void 0,morphColors:P.morphAttributes.color!==void 0,morphTargetsCount:q,morphTextureStride:rt,numSunLights:M.sun.length,numDirLights:M.directional.length,numPointLights:M.point.length,numSpotLights:M.spot.length,numSpotLightMaps:M.spotLightMap.length,numRectAreaLights:M.rectArea.length,numHemiLights:M.hemi.length,numSunLightShadows:M.sunShadowMap.length,numDirLightShadows:M.directionalShadowMap.length,numPointLightShadows:M.pointShadowMap.length,numSpotLightShadows:M.spotShadowMap.length,numSpotLightShadowsWithMaps:M.numSpotLightShadowsWithMaps,numLightProbes:M.numLightProbes,numLightProbeGrids:R.filter(At=>At.texture!==null).length,numClippingPlanes:s.numPlanes,numClipIntersection:s.numIntersection,dithering:_.dithering,shadowMapEnabled:e.shadowMap.enabled&&C.length>0,shadowMapType:e.shadowMap.type,toneMapping:ht,decodeVideoTexture:lt&&_.map.isVideoTexture===!0&&re.getTransfer(_.map.colorSpace)===de,decodeVideoTextureEmissive:Ze&&_.emissiveMap.isVideoTexture===!0&&re.getTransfer(_.emissiveMap.colorSpace)===de,premultipliedAlpha:_.premultipliedAlpha,doubleSided:_.side===Ri,flipSided:_.side===Un,useDepthPacking:_.depthPacking>=0,depthPacking:_.depthPacking||0,index0AttributeName:_.index0AttributeName,extensionClipCullDistance:Kt&&_.extensions.clipCullDistance===!0&&n.has("WEBGL_clip_cull_distance"),extensionMultiDraw:(Kt&&_.extensions.multiDraw===!0||_t)&&n.has("WEBGL_multi_draw"),rendererExtensionParallelShaderCompile:n.has("KHR_parallel_shader_compile"),customProgramCacheKey:_.customProgramCacheKey()};return Jt.vertexUv1s=c.has(1),Jt.vertexUv2s=c.has(2),Jt.vertexUv3s=c.has(3),c.clear(),Jt}function y(_){let M=[];if(_.shaderID?M.push(_.shaderID):(M.push(_.customVertexShaderID),M.push(_.customFragmentShaderID)),_.defines!==void 0)for(let C in _.defines)M.push(C),M.push(_.defines[C]);return _.isRawShaderMaterial===!1&&(m(M,_),g(M,_),M.push(e.outputColorSpace)),M.push(_.customProgramCacheKey),M.join()}function m(_,M){_.push(M.precision),_.push(M.outputColorSpace),_.push(M.envMapMode),_.push(M.envMapPMREM),_.push(M.envMapMaxLod),_.push(M.envMapSize),_.push(M.mapUv),_.push(M.alphaMapUv),_.push(M.lightMapUv),_.push(M.aoMapUv),_.push(M.bumpMapUv),_.push(M.normalMapUv),_.push(M.displacementMapUv),_.push(M.emissiveMapUv),_.push(M.metalnessMapUv),_.push(M.roughnessMapUv),_.push(M.anisotropyMapUv),_.push(M.clearcoatMapUv),_.push(M.clearcoatNormalMapUv),_.push(M.clearcoatRoughnessMapUv),_.push(M.diffuseRoughnessMapUv),_.push(M.iridescenceMapUv),_.push(M.iridescenceThicknessMapUv),_.push(M.sheenColorMapUv),_.push(M.sheenRoughnessMapUv),_.push(M.specularMapUv),_.push(M.specularColorMapUv),_.push(M.specularIntensityMapUv),_.push(M.transmissionMapUv),_.push(M.thicknessMapUv),_.push(M.combine),_.push(M.fogExp2),_.push(M.sizeAttenuation),_.push(M.morphTargetsCount),_.push(M.numSunLights),_.push(M.numDirLights),_.push(M.numPointLights),_.push(M.numSpotLights),_.push(M.numSpotLightMaps),_.push(M.numHemiLights),_.push(M.numRectAreaLights),_.push(M.numSunLightShadows),_.push(M.numDirLightShadows),_.push(M.numPointLightShadows),_.push(M.numSpotLightShadows),_.push(M.numSpotLightShadowsWithMaps),_.push(M.numLightProbes),_.push(M.numLightProbeGrids),_.push(M.shadowMapType),_.push(M.toneMapping),_.push(M.numClippingPlanes),_.push(M.numClipIntersection),_.push(M.depthPacking)}function g(_,M){o.disableAll(),M.instancing&&o.enable(0),M.instancingColor&&o.enable(1),M.instancingMorph&&o.enable(2),M.matcap&&o.enable(3),M.envMap&&o.enable(4),M.normalMapObjectSpace&&o.enable(5),M.normalMapTangentSpace&&o.enable(6),M.clearcoat&&o.enable(7),M.iridescence&&o.enable(8),M.alphaTest&&o.enable(9),M.vertexColors&&o.enable(10),M.vertexAlphas&&o.enable(11),M.vertexUv1s&&o.enable(12),M.vertexUv2s&&o.enable(13),M.vertexUv3s&&o.enable(14),M.vertexTangents&&o.enable(15),M.anisotropy&&o.enable(16),M.alphaHash&&o.enable(17),M.batching&&o.enable(18),M.dispersion&&o.enable(19),M.retroreflection&&o.enable(24),M.diffuseRoughness&&o.enable(25),M.batchingColor&&o.enable(20),M.gradientMap&&o.enable(21),M.packedNormalMap&&o.enable(22),M.vertexNormals&&o.enable(23),_.push(o.mask),o.disableAll(),M.fog&&o.enable(0),M.useFog&&o.enable(1),M.flatShading&&o.enable(2),M.logarithmicDepthBuffer&&o.enable(3),M.reversedDepthBuffer&&o.enable(4),M.skinning&&o.enable(5),M.morphTargets&&o.enable(6),M.morphNormals&&o.enable(7),M.morphColors&&o.enable(8),M.premultipliedAlpha&&o.enable(9),M.shadowMapEnabled&&o.enable(10),M.doubleSided&&o.enable(11),M.flipSided&&o.enable(12),M.useDepthPacking&&o.enable(13),M.dithering&&o.enable(14),M.transmission&&o.enable(15),M.sheen&&o.enable(16),M.opaque&&o.enable(17),M.pointsUvs&&o.enable(18),M.decodeVideoTexture&&o.enable(19),M.decodeVideoTextureEmissive&&o.enable(20),M.alphaToCoverage&&o.enable(21),M.numLightProbeGrids>0&&o.enable(22),M.hasPositionAttribute&&o.enable(23),_.push(o.mask)}function x(_){let M=f[_.type],C;if(M){let E=Fn[M];C=au.clone(E.uniforms)}else C=_.uniforms;return C}function S(_,M){let C=u.get(M);return C!==void 0?++C.usedTimes:(C=new wB(e,M,_,r),l.push(C),u.set(M,C)),C}function v(_){if(--_.usedTimes===0){let M=l.indexOf(_);l[M]=l[l.length-1],l.pop(),u.delete(_.cacheKey),_.destroy()}}function w(_){a.remove(_)}function b(){a.dispose()}return{getParameters:p,getProgramCacheKey:y,getUniforms:x,acquireProgram:S,releaseProgram:v,releaseShaderCache:w,programs:l,dispose:b}}function CB(){let e=new WeakMap;function t(o){return e.has(o)}function n(o){let a=e.get(o);return a===void 0&&(a={},e.set(o,a)),a}function i(o){e.delete(o)}function r(o,a,c){e.get(o)[a]=c}function s(){e=new WeakMap}return{has:t,get:n,remove:i,update:r,dispose:s}}function RB(e,t){return e.groupOrder!==t.groupOrder?e.groupOrder-t.groupOrder:e.renderOrder!==t.renderOrder?e.renderOrder-t.renderOrder:e.material.id!==t.material.id?e.material.id-t.material.id:e.materialVariant!==t.materialVariant?e.materialVariant-t.materialVariant:e.z!==t.z?e.z-t.z:e.id-t.id}function S2(e,t){return e.groupOrder!==t.groupOrder?e.groupOrder-t.groupOrder:e.renderOrder!==t.renderOrder?e.renderOrder-t.renderOrder:e.z!==t.z?t.z-e.z:e.id-t.id}function w2(){let e=[],t=0,n=[],i=[],r=[];function s(){t=0,n.length=0,i.length=0,r.length=0}function o(f){let d=0;return f.isInstancedMesh&&(d+=2),f.isSkinnedMesh&&(d+=1),d}function a(f,d,p,y,m,g){let x=e[t];return x===void 0?(x={id:f.id,object:f,geometry:d,material:p,materialVariant:o(f),groupOrder:y,renderOrder:f.renderOrder,z:m,group:g},e[t]=x):(x.id=f.id,x.object=f,x.geometry=d,x.material=p,x.materialVariant=o(f),x.groupOrder=y,x.renderOrder=f.renderOrder,x.z=m,x.group=g),t++,x}function c(f,d,p,y,m,g,x){x.reversedDepth===!0&&(m=-m);let S=a(f,d,p,y,m,g);p.transmission>0?i.push(S):p.transparent===!0?r.push(S):n.push(S)}function l(f,d,p,y,m,g){let x=a(f,d,p,y,m,g);p.transmission>0?i.unshift(x):p.transparent===!0?r.unshift(x):n.unshift(x)}function u(f,d){n.length>1&&n.sort(f||RB),i.length>1&&i.sort(d||S2),r.length>1&&r.sort(d||S2)}function h(){for(let f=t,d=e.length;f<d;f++){let p=e[f];if(p.id===null)break;p.id=null,p.object=null,p.geometry=null,p.material=null,p.group=null}}return{opaque:n,transmissive:i,transparent:r,init:s,push:c,unshift:l,finish:h,sort:u}}function PB(){let e=new WeakMap;function t(i,r){let s=e.get(i),o;return s===void 0?(o=new w2,e.set(i,[o])):r>=s.length?(o=new w2,s.push(o)):o=s[r],o}function n(){e=new WeakMap}return{get:t,dispose:n}}function IB(){let e={};return{get:function(t){if(e[t.id]!==void 0)return e[t.id];let n;switch(t.type){case"SunLight":case"DirectionalLight":n={direction:new k,color:new Wt};break;case"SpotLight":n={position:new k,direction:new k,color:new Wt,distance:0,coneCos:0,penumbraCos:0,decay:0};break;case"PointLight":n={position:new k,color:new Wt,distance:0,decay:0};break;case"HemisphereLight":n={direction:new k,skyColor:new Wt,groundColor:new Wt};break;case"RectAreaLight":n={color:new Wt,position:new k,halfWidth:new k,halfHeight:new k};break}return e[t.id]=n,n}}}function LB(){let e={};return{get:function(t){if(e[t.id]!==void 0)return e[t.id];let n;switch(t.type){case"SunLight":case"DirectionalLight":n={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new Ft};break;case"SpotLight":n={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new Ft};break;case"PointLight":n={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new Ft,shadowCameraNear:1,shadowCameraFar:1e3};break}return e[t.id]=n,n}}}var NB=0;function DB(e,t){return(t.castShadow?2:0)-(e.castShadow?2:0)+(t.map?1:0)-(e.map?1:0)}function UB(e){let t=new IB,n=LB(),i={version:0,hash:{sunLength:-1,directionalLength:-1,pointLength:-1,spotLength:-1,rectAreaLength:-1,hemiLength:-1,numSunShadows:-1,numDirectionalShadows:-1,numPointShadows:-1,numSpotShadows:-1,numSpotMaps:-1,numLightProbes:-1},ambient:[0,0,0],probe:[],sun:[],sunShadow:[],sunShadowMap:[],sunShadowMatrix:[],sunShadowCascade:[],directional:[],directionalShadow:[],directionalShadowMap:[],directionalShadowMatrix:[],spot:[],spotLightMap:[],spotShadow:[],spotShadowMap:[],spotLightMatrix:[],rectArea:[],rectAreaLTC1:null,rectAreaLTC2:null,point:[],pointShadow:[],pointShadowMap:[],pointShadowMatrix:[],hemi:[],numSpotLightShadowsWithMaps:0,numLightProbes:0};for(let l=0;l<9;l++)i.probe.push(new k);let r=new k,s=new ee,o=new ee;function a(l){let u=0,h=0,f=0;for(let R=0;R<9;R++)i.probe[R].set(0,0,0);let d=0,p=0,y=0,m=0,g=0,x=0,S=0,v=0,w=0,b=0,_=0,M=0,C=0,E=0;l.sort(DB);for(let R=0,U=l.length;R<U;R++){let P=l[R],L=P.color,O=P.intensity,D=P.distance,Y=null;if(P.shadow&&P.shadow.map&&(P.shadow.map.texture.format===ks?Y=P.shadow.map.texture:Y=P.shadow.map.depthTexture||P.shadow.map.texture),P.isAmbientLight)u+=L.r*O,h+=L.g*O,f+=L.b*O;else if(P.isLightProbe){for(let B=0;B<9;B++)i.probe[B].addScaledVector(P.sh.coefficients[B],O);E++}else if(P.isSunLight){let B=t.get(P);if(B.color.copy(P.color).multiplyScalar(P.intensity),P.castShadow){let V=P.shadow,q=n.get(P);q.shadowIntensity=V.intensity,q.shadowBias=V.bias,q.shadowNormalBias=V.normalBias,q.shadowRadius=V.radius,q.shadowMapSize.copy(V.mapSize).multiply(V.getFrameExtents()),i.sunShadow[p]=q,i.sunShadowMap[p]=Y;let rt=V.getViewportCount();for(let ct=0;ct<rt;ct++)i.sunShadowMatrix[y+ct]=V.getMatrix(ct),i.sunShadowCascade[y+ct]=V._cascadeData[ct];y+=rt,p++}i.sun[d]=B,d++}else if(P.isDirectionalLight){let B=t.get(P);if(B.color.copy(P.color).multiplyScalar(P.intensity),P.castShadow){let V=P.shadow,q=n.get(P);q.shadowIntensity=V.intensity,q.shadowBias=V.bias,q.shadowNormalBias=V.normalBias,q.shadowRadius=V.radius,q.shadowMapSize=V.mapSize,i.directionalShadow[m]=q,i.directionalShadowMap[m]=Y,i.directionalShadowMatrix[m]=P.shadow.matrix,w++}i.directional[m]=B,m++}else if(P.isSpotLight){let B=t.get(P);B.position.setFromMatrixPosition(P.matrixWorld),B.color.copy(L).multiplyScalar(O),B.distance=D,B.coneCos=Math.cos(P.angle),B.penumbraCos=Math.cos(P.angle*(1-P.penumbra)),B.decay=P.decay,i.spot[x]=B;let V=P.shadow;if(P.map&&(i.spotLightMap[M]=P.map,M++,V.updateMatrices(P),P.castShadow&&C++),i.spotLightMatrix[x]=V.matrix,P.castShadow){let q=n.get(P);q.shadowIntensity=V.intensity,q.shadowBias=V.bias,q.shadowNormalBias=V.normalBias,q.shadowRadius=V.radius,q.shadowMapSize=V.mapSize,i.spotShadow[x]=q,i.spotShadowMap[x]=Y,_++}x++}else if(P.isRectAreaLight){let B=t.get(P);B.color.copy(L).multiplyScalar(O),B.halfWidth.set(P.width*.5,0,0),B.halfHeight.set(0,P.height*.5,0),i.rectArea[S]=B,S++}else if(P.isPointLight){let B=t.get(P);if(B.color.copy(P.color).multiplyScalar(P.intensity),B.distance=P.distance,B.decay=P.decay,P.castShadow){let V=P.shadow,q=n.get(P);q.shadowIntensity=V.intensity,q.shadowBias=V.bias,q.shadowNormalBias=V.normalBias,q.shadowRadius=V.radius,q.shadowMapSize=V.mapSize,q.shadowCameraNear=V.camera.near,q.shadowCameraFar=V.camera.far,i.pointShadow[g]=q,i.pointShadowMap[g]=Y,i.pointShadowMatrix[g]=P.shadow.matrix,b++}i.point[g]=B,g++}else if(P.isHemisphereLight){let B=t.get(P);B.skyColor.copy(P.color).multiplyScalar(O),B.groundColor.copy(P.groundColor).multiplyScalar(O),i.hemi[v]=B,v++}}S>0&&(e.has("OES_texture_float_linear")===!0?(i.rectAreaLTC1=wt.LTC_FLOAT_1,i.rectAreaLTC2=wt.LTC_FLOAT_2):(i.rectAreaLTC1=wt.LTC_HALF_1,i.rectAreaLTC2=wt.LTC_HALF_2)),i.ambient[0]=u,i.ambient[1]=h,i.ambient[2]=f;let I=i.hash;(I.sunLength!==d||I.directionalLength!==m||I.pointLength!==g||I.spotLength!==x||I.rectAreaLength!==S||I.hemiLength!==v||I.numSunShadows!==p||I.numDirectionalShadows!==w||I.numPointShadows!==b||I.numSpotShadows!==_||I.numSpotMaps!==M||I.numLightProbes!==E)&&(i.sun.length=d,i.directional.length=m,i.spot.length=x,i.rectArea.length=S,i.point.length=g,i.hemi.length=v,i.sunShadow.length=p,i.sunShadowMap.length=p,i.sunShadowMatrix.length=y,i.sunShadowCascade.length=y,i.directionalShadow.length=w,i.directionalShadowMap.length=w,i.directionalShadowMatrix.length=w,i.pointShadow.length=b,i.pointShadowMap.length=b,i.pointShadowMatrix.length=b,i.spotShadow.length=_,i.spotShadowMap.length=_,i.spotLightMatrix.length=_+M-C,i.spotLightMap.length=M,i.numSpotLightShadowsWithMaps=C,i.numLightProbes=E,I.sunLength=d,I.directionalLength=m,I.pointLength=g,I.spotLength=x,I.rectAreaLength=S,I.hemiLength=v,I.numSunShadows=p,I.numDirectionalShadows=w,I.numPointShadows=b,I.numSpotShadows=_,I.numSpotMaps=M,I.numLightProbes=E,i.version=NB++)}function c(l,u){let h=0,f=0,d=0,p=0,y=0,m=0,g=u.matrixWorldInverse;for(let x=0,S=l.length;x<S;x++){let v=l[x];if(v.isSunLight){let w=i.sun[h];w.direction.setFromMatrixPosition(v.matrixWorld),w.direction.transformDirection(g),h++}else if(v.isDirectionalLight){let w=i.directional[f];w.direction.setFromMatrixPosition(v.matrixWorld),r.setFromMatrixPosition(v.target.matrixWorld),w.direction.sub(r),w.direction.transformDirection(g),f++}else if(v.isSpotLight){let w=i.spot[p];w.position.setFromMatrixPosition(v.matrixWorld),w.position.applyMatrix4(g),w.direction.setFromMatrixPosition(v.matrixWorld),r.setFromMatrixPosition(v.target.matrixWorld),w.direction.sub(r),w.direction.transformDirection(g),p++}else if(v.isRectAreaLight){let w=i.rectArea[y];w.position.setFromMatrixPosition(v.matrixWorld),w.position.applyMatrix4(g),o.identity(),s.copy(v.matrixWorld),s.premultiply(g),o.extractRotation(s),w.halfWidth.set(v.width*.5,0,0),w.halfHeight.set(0,v.height*.5,0),w.halfWidth.applyMatrix4(o),w.halfHeight.applyMatrix4(o),y++}else if(v.isPointLight){let w=i.point[d];w.position.setFromMatrixPosition(v.matrixWorld),w.position.applyMatrix4(g),d++}else if(v.isHemisphereLight){let w=i.hemi[m];w.direction.setFromMatrixPosition(v.matrixWorld),w.direction.transformDirection(g),m++}}}return{setup:a,setupView:c,state:i}}function T2(e){let t=new UB(e),n=[],i=[],r=[];function s(h){u.camera=h,n.length=0,i.length=0,r.length=0}function o(h){h.isLightProbeGrid?r.push(h):n.push(h)}function a(h){i.push(h)}function c(){t.setup(n),r.sort((h,f)=>h.priority-f.priority||h.id-f.id)}function l(h){t.setupView(n,h)}let u={lightsArray:n,shadowsArray:i,lightProbeGridArray:r,camera:null,lights:t,transmissionRenderTarget:{},textureUnits:0};return{init:s,state:u,setupLights:c,setupLightsView:l,pushLight:o,pushShadow:a}}function FB(e){let t=new WeakMap;function n(r,s=0){let o=t.get(r),a;return o===void 0?(a=new T2(e),t.set(r,[a])):s>=o.length?(a=new T2(e),o.push(a)):a=o[s],a}function i(){t=new WeakMap}return{get:n,dispose:i}}var OB=`void main() {
	gl_Position = vec4( position, 1.0 );
}`,BB=`uniform sampler2D shadow_pass;
uniform vec2 resolution;
uniform float radius;
void main() {
	const float samples = float( VSM_SAMPLES );
	float mean = 0.0;
	float squared_mean = 0.0;
	float uvStride = samples <= 1.0 ? 0.0 : 2.0 / ( samples - 1.0 );
	float uvStart = samples <= 1.0 ? 0.0 : - 1.0;
	for ( float i = 0.0; i < samples; i ++ ) {
		float uvOffset = uvStart + i * uvStride;
		#ifdef HORIZONTAL_PASS
			vec2 distribution = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( uvOffset, 0.0 ) * radius ) / resolution ).rg;
			mean += distribution.x;
			squared_mean += distribution.y * distribution.y + distribution.x * distribution.x;
		#else
			float depth = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( 0.0, uvOffset ) * radius ) / resolution ).r;
			mean += depth;
			squared_mean += depth * depth;
		#endif
	}
	mean = mean / samples;
	squared_mean = squared_mean / samples;
	float std_dev = sqrt( max( 0.0, squared_mean - mean * mean ) );
	gl_FragColor = vec4( mean, std_dev, 0.0, 1.0 );
}`,kB=[new k(1,0,0),new k(-1,0,0),new k(0,1,0),new k(0,-1,0),new k(0,0,1),new k(0,0,-1)],zB=[new k(0,-1,0),new k(0,-1,0),new k(0,0,1),new k(0,0,-1),new k(0,-1,0),new k(0,-1,0)],A2=new ee,cu=new k,xx=new k;function GB(e,t,n){let i=new Es,r=new Ft,s=new Ft,o=new pe,a=new hd,c=new dd,l={},u=n.maxTextureSize,h={[Bs]:Un,[Un]:Bs,[Ri]:Ri},f=new Ci({defines:{VSM_SAMPLES:8},uniforms:{shadow_pass:{value:null},resolution:{value:new Ft},radius:{value:4}},vertexShader:OB,fragmentShader:BB}),d=f.clone();d.defines.HORIZONTAL_PASS=1;let p=new De;p.setAttribute("position",new ze(new Float32Array([-1,-1,.5,3,-1,.5,-1,3,.5]),3));let y=new ln(p,f),m=this;this.enabled=!1,this.autoUpdate=!0,this.needsUpdate=!1,this.type=jl;let g=this.type;this.render=function(b,_,M){if(m.enabled===!1||m.autoUpdate===!1&&m.needsUpdate===!1||b.length===0)return;this.type===SE&&(Ut("WebGLShadowMap: PCFSoftShadowMap has been removed. Using PCFShadowMap instead."),this.type=jl);let C=e.getRenderTarget(),E=e.getActiveCubeFace(),I=e.getActiveMipmapLevel(),R=e.state;R.setBlending(Co),R.buffers.depth.getReversed()===!0?R.buffers.color.setClear(0,0,0,0):R.buffers.color.setClear(1,1,1,1),R.buffers.depth.setTest(!0),R.setScissorTest(!1);let U=g!==this.type;U&&_.traverse(function(P){P.material&&(Array.isArray(P.material)?P.material.forEach(L=>L.needsUpdate=!0):P.material.needsUpdate=!0)});for(let P=0,L=b.length;P<L;P++){let O=b[P],D=O.shadow;if(D===void 0){Ut("WebGLShadowMap:",O,"has no shadow.");continue}if(D.autoUpdate===!1&&D.needsUpdate===!1)continue;r.copy(D.mapSize);let Y=D.getFrameExtents();r.multiply(Y),s.copy(D.mapSize),(r.x>u||r.y>u)&&(r.x>u&&(s.x=Math.floor(u/Y.x),r.x=s.x*Y.x,D.mapSize.x=s.x),r.y>u&&(s.y=Math.floor(u/Y.y),r.y=s.y*Y.y,D.mapSize.y=s.y));let B=e.state.buffers.depth.getReversed();if(D.camera._reversedDepth=B,D.map===null||U===!0){if(D.map!==null&&(D.map.depthTexture!==null&&(D.map.depthTexture.dispose(),D.map.depthTexture=null),D.map.dispose()),this.type===sc){if(O.isPointLight){Ut("WebGLShadowMap: VSM shadow maps are not supported for PointLights. Use PCF or BasicShadowMap instead.");continue}D.map=new ei(r.x,r.y,{format:ks,type:$i,minFilter:Nn,magFilter:Nn,generateMipmaps:!1}),D.map.texture.name=O.name+".shadowMap",D.map.depthTexture=new Zr(r.x,r.y,Wi),D.map.depthTexture.name=O.name+".shadowMapDepth",D.map.depthTexture.format=Xr,D.map.depthTexture.compareFunction=null,D.map.depthTexture.minFilter=an,D.map.depthTexture.magFilter=an}else O.isPointLight?(D.map=new uu(r.x),D.map.depthTexture=new Bl(r.x,Hi)):(D.map=new ei(r.x,r.y),D.map.depthTexture=new Zr(r.x,r.y,Hi)),D.map.depthTexture.name=O.name+".shadowMap",D.map.depthTexture.format=Xr,this.type===jl?(D.map.depthTexture.compareFunction=B?ox:sx,D.map.depthTexture.minFilter=Nn,D.map.depthTexture.magFilter=Nn):(D.map.depthTexture.compareFunction=null,D.map.depthTexture.minFilter=an,D.map.depthTexture.magFilter=an);D.camera.updateProjectionMatrix()}D.map.isWebGLCubeRenderTarget!==!0&&(D.map.width!==r.x||D.map.height!==r.y)&&D.map.setSize(r.x,r.y);let V=D.map.isWebGLCubeRenderTarget?6:D.getViewportCount();O.isPointLight!==!0&&D.updateMatrices(O,M);let q=(D.camera.layers.mask&4294967294)!==0?D.camera.layers:M.layers;for(let rt=0;rt<V;rt++){let ct=D.getCamera(rt);if(O.isPointLight){let $=D.camera,ot=D.matrix,ut=O.distance||$.far;ut!==$.far&&($.far=ut,$.updateProjectionMatrix()),cu.setFromMatrixPosition(O.matrixWorld),$.position.copy(cu),xx.copy($.position),xx.add(kB[rt]),$.up.copy(zB[rt]),$.lookAt(xx),$.updateMatrixWorld(),ot.makeTranslation(-cu.x,-cu.y,-cu.z),A2.multiplyMatrices($.projectionMatrix,$.matrixWorldInverse),D._frustum.setFromProjectionMatrix(A2,$.coordinateSystem,$.reversedDepth)}if(D.map.isWebGLCubeRenderTarget)e.setRenderTarget(D.map,rt),e.clear();else{rt===0&&(e.setRenderTarget(D.map),e.clear());let $=D.getViewport(rt);o.set(s.x*$.x,s.y*$.y,s.x*$.z,s.y*$.w),R.viewport(o)}i=D.getFrustum(rt),v(_,M,ct,O,q,this.type)}D.isPointLightShadow!==!0&&this.type===sc&&x(D,M),D.needsUpdate=!1}g=this.type,m.needsUpdate=!1,e.setRenderTarget(C,E,I)};function x(b,_){let M=t.update(y);f.defines.VSM_SAMPLES!==b.blurSamples&&(f.defines.VSM_SAMPLES=b.blurSamples,d.defines.VSM_SAMPLES=b.blurSamples,f.needsUpdate=!0,d.needsUpdate=!0),b.mapPass===null?b.mapPass=new ei(r.x,r.y,{format:ks,type:$i}):(b.mapPass.width!==b.map.width||b.mapPass.height!==b.map.height)&&b.mapPass.setSize(b.map.width,b.map.height),f.uniforms.shadow_pass.value=b.map.depthTexture,f.uniforms.resolution.value.set(b.map.width,b.map.height),f.uniforms.radius.value=b.radius,e.setRenderTarget(b.mapPass),e.clear(),e.renderBufferDirect(_,null,M,f,y,null),d.uniforms.shadow_pass.value=b.mapPass.texture,d.uniforms.resolution.value.set(b.map.width,b.map.height),d.uniforms.radius.value=b.radius,e.setRenderTarget(b.map),e.clear(),e.renderBufferDirect(_,null,M,d,y,null)}function S(b,_,M,C){let E=null,I=M.isPointLight===!0?b.customDistanceMaterial:b.customDepthMaterial;if(I!==void 0)E=I;else if(E=M.isPointLight===!0?c:a,e.localClippingEnabled&&_.clipShadows===!0&&Array.isArray(_.clippingPlanes)&&_.clippingPlanes.length!==0||_.displacementMap&&_.displacementScale!==0||_.alphaMap&&_.alphaTest>0||_.map&&_.alphaTest>0||_.alphaToCoverage===!0){let R=E.uuid,U=_.uuid,P=l[R];P===void 0&&(P={},l[R]=P);let L=P[U];L===void 0&&(L=E.clone(),P[U]=L,_.addEventListener("dispose",w)),E=L}if(E.visible=_.visible,E.wireframe=_.wireframe,C===sc?E.side=_.shadowSide!==null?_.shadowSide:_.side:E.side=_.shadowSide!==null?_.shadowSide:h[_.side],E.alphaMap=_.alphaMap,E.alphaTest=_.alphaToCoverage===!0?.5:_.alphaTest,E.map=_.map,E.clipShadows=_.clipShadows,E.clippingPlanes=_.clippingPlanes,E.clipIntersection=_.clipIntersection,E.displacementMap=_.displacementMap,E.displacementScale=_.displacementScale,E.displacementBias=_.displacementBias,E.wireframeLinewidth=_.wireframeLinewidth,E.linewidth=_.linewidth,M.isPointLight===!0&&E.isMeshDistanceMaterial===!0){let R=e.properties.get(E);R.light=M}return E}function v(b,_,M,C,E,I){if(b.visible===!1)return;if(b.layers.test(E)&&(b.isMesh||b.isLine||b.isPoints)&&(b.castShadow||b.receiveShadow&&I===sc)&&(!b.frustumCulled||b.intersectsFrustum(i))){b.modelViewMatrix.multiplyMatrices(M.matrixWorldInverse,b.matrixWorld);let P=t.update(b),L=b.material;if(Array.isArray(L)){let O=P.groups;for(let D=0,Y=O.length;D<Y;D++){let B=O[D],V=L[B.materialIndex];if(V&&V.visible){let q=S(b,V,C,I);b.onBeforeShadow(e,b,_,M,P,q,B),e.renderBufferDirect(M,null,P,q,b,B),b.onAfterShadow(e,b,_,M,P,q,B)}}}else if(L.visible){let O=S(b,L,C,I);b.onBeforeShadow(e,b,_,M,P,O,null),e.renderBufferDirect(M,null,P,O,b,null),b.onAfterShadow(e,b,_,M,P,O,null)}}let U=b.children;for(let P=0,L=U.length;P<L;P++)v(U[P],_,M,C,E,I)}function w(b){b.target.removeEventListener("dispose",w);for(let M in l){let C=l[M],E=b.target.uuid;E in C&&(C[E].dispose(),delete C[E])}}}function VB(e,t){function n(){let F=!1,et=new pe,j=null,yt=new pe(0,0,0,0);return{setMask:function(dt){j!==dt&&!F&&(e.colorMask(dt,dt,dt,dt),j=dt)},setLocked:function(dt){F=dt},setClear:function(dt,mt,Lt,Kt,ht){ht===!0&&(dt*=Kt,mt*=Kt,Lt*=Kt),et.set(dt,mt,Lt,Kt),yt.equals(et)===!1&&(e.clearColor(dt,mt,Lt,Kt),yt.copy(et))},reset:function(){F=!1,j=null,yt.set(-1,0,0,0)}}}function i(){let F=!1,et=!1,j=null,yt=null,dt=null;return{setReversed:function(mt){if(et!==mt){let Lt=t.get("EXT_clip_control");mt?Lt.clipControlEXT(Lt.LOWER_LEFT_EXT,Lt.ZERO_TO_ONE_EXT):Lt.clipControlEXT(Lt.LOWER_LEFT_EXT,Lt.NEGATIVE_ONE_TO_ONE_EXT),et=mt;let Kt=dt;dt=null,this.setClear(Kt)}},getReversed:function(){return et},setTest:function(mt){mt?at(e.DEPTH_TEST):J(e.DEPTH_TEST)},setMask:function(mt){j!==mt&&!F&&(e.depthMask(mt),j=mt)},setFunc:function(mt){if(et&&(mt=n2[mt]),yt!==mt){switch(mt){case Xh:e.depthFunc(e.NEVER);break;case qh:e.depthFunc(e.ALWAYS);break;case Yh:e.depthFunc(e.LESS);break;case Ya:e.depthFunc(e.LEQUAL);break;case Zh:e.depthFunc(e.EQUAL);break;case Jh:e.depthFunc(e.GEQUAL);break;case Kh:e.depthFunc(e.GREATER);break;case jh:e.depthFunc(e.NOTEQUAL);break;default:e.depthFunc(e.LEQUAL)}yt=mt}},setLocked:function(mt){F=mt},setClear:function(mt){dt!==mt&&(dt=mt,et&&(mt=1-mt),e.clearDepth(mt))},reset:function(){F=!1,j=null,yt=null,dt=null,et=!1}}}function r(){let F=!1,et=null,j=null,yt=null,dt=null,mt=null,Lt=null,Kt=null,ht=null;return{setTest:function(Dt){F||(Dt?at(e.STENCIL_TEST):J(e.STENCIL_TEST))},setMask:function(Dt){et!==Dt&&!F&&(e.stencilMask(Dt),et=Dt)},setFunc:function(Dt,Jt,At){(j!==Dt||yt!==Jt||dt!==At)&&(e.stencilFunc(Dt,Jt,At),j=Dt,yt=Jt,dt=At)},setOp:function(Dt,Jt,At){(mt!==Dt||Lt!==Jt||Kt!==At)&&(e.stencilOp(Dt,Jt,At),mt=Dt,Lt=Jt,Kt=At)},setLocked:function(Dt){F=Dt},setClear:function(Dt){ht!==Dt&&(e.clearStencil(Dt),ht=Dt)},reset:function(){F=!1,et=null,j=null,yt=null,dt=null,mt=null,Lt=null,Kt=null,ht=null}}}let s=new n,o=new i,a=new r,c={},l=new WeakMap,u={},h={},f={},d=new WeakMap,p=[],y=null,m=!1,g=null,x=null,S=null,v=null,w=null,b=null,_=null,M=new Wt(0,0,0),C=0,E=!1,I=null,R=null,U=null,P=null,L=null,O=e.getParameter(e.MAX_COMBINED_TEXTURE_IMAGE_UNITS),D=!1,Y=0,B=e.getParameter(e.VERSION);B.indexOf("WebGL")!==-1?(Y=parseFloat(/^WebGL (\d)/.exec(B)[1]),D=Y>=1):B.indexOf("OpenGL ES")!==-1&&(Y=parseFloat(/^OpenGL ES (\d)/.exec(B)[1]),D=Y>=2);let V=null,q={},rt=e.getParameter(e.SCISSOR_BOX),ct=e.getParameter(e.VIEWPORT),$=new pe().fromArray(rt),ot=new pe().fromArray(ct);function ut(F,et,j,yt){let dt=new Uint8Array(4),mt=e.createTexture();e.bindTexture(F,mt),e.texParameteri(F,e.TEXTURE_MIN_FILTER,e.NEAREST),e.texParameteri(F,e.TEXTURE_MAG_FILTER,e.NEAREST);for(let Lt=0;Lt<j;Lt++)F===e.TEXTURE_3D||F===e.TEXTURE_2D_ARRAY?e.texImage3D(et,0,e.RGBA,1,1,yt,0,e.RGBA,e.UNSIGNED_BYTE,dt):e.texImage2D(et+Lt,0,e.RGBA,1,1,0,e.RGBA,e.UNSIGNED_BYTE,dt);return mt}let st={};st[e.TEXTURE_2D]=ut(e.TEXTURE_2D,e.TEXTURE_2D,1),st[e.TEXTURE_CUBE_MAP]=ut(e.TEXTURE_CUBE_MAP,e.TEXTURE_CUBE_MAP_POSITIVE_X,6),st[e.TEXTURE_2D_ARRAY]=ut(e.TEXTURE_2D_ARRAY,e.TEXTURE_2D_ARRAY,1,1),st[e.TEXTURE_3D]=ut(e.TEXTURE_3D,e.TEXTURE_3D,1,1),s.setClear(0,0,0,1),o.setClear(1),a.setClear(0),at(e.DEPTH_TEST),o.setFunc(Ya),ye(!1),fe(B_),at(e.CULL_FACE),$t(Co);function at(F){u[F]!==!0&&(e.enable(F),u[F]=!0)}function J(F){u[F]!==!1&&(e.disable(F),u[F]=!1)}function _t(F,et){return f[F]!==et?(e.bindFramebuffer(F,et),f[F]=et,F===e.DRAW_FRAMEBUFFER&&(f[e.FRAMEBUFFER]=et),F===e.FRAMEBUFFER&&(f[e.DRAW_FRAMEBUFFER]=et),!0):!1}function lt(F,et){let j=p,yt=!1;if(F){j=d.get(et),j===void 0&&(j=[],d.set(et,j));let dt=F.textures;if(j.length!==dt.length||j[0]!==e.COLOR_ATTACHMENT0){for(let mt=0,Lt=dt.length;mt<Lt;mt++)j[mt]=e.COLOR_ATTACHMENT0+mt;j.length=dt.length,yt=!0}}else j[0]!==e.BACK&&(j[0]=e.BACK,yt=!0);yt&&e.drawBuffers(j)}function K(F){return y!==F?(e.useProgram(F),y=F,!0):!1}let Nt={[Ro]:e.FUNC_ADD,[TE]:e.FUNC_SUBTRACT,[AE]:e.FUNC_REVERSE_SUBTRACT};Nt[EE]=e.MIN,Nt[CE]=e.MAX;let Mt={[RE]:e.ZERO,[PE]:e.ONE,[IE]:e.SRC_COLOR,[V_]:e.SRC_ALPHA,[OE]:e.SRC_ALPHA_SATURATE,[UE]:e.DST_COLOR,[NE]:e.DST_ALPHA,[LE]:e.ONE_MINUS_SRC_COLOR,[H_]:e.ONE_MINUS_SRC_ALPHA,[FE]:e.ONE_MINUS_DST_COLOR,[DE]:e.ONE_MINUS_DST_ALPHA,[BE]:e.CONSTANT_COLOR,[kE]:e.ONE_MINUS_CONSTANT_COLOR,[zE]:e.CONSTANT_ALPHA,[GE]:e.ONE_MINUS_CONSTANT_ALPHA};function $t(F,et,j,yt,dt,mt,Lt,Kt,ht,Dt){if(F===Co){m===!0&&(J(e.BLEND),m=!1);return}if(m===!1&&(at(e.BLEND),m=!0),F!==wE){if(F!==g||Dt!==E){if((x!==Ro||w!==Ro)&&(e.blendEquation(e.FUNC_ADD),x=Ro,w=Ro),Dt)switch(F){case oc:e.blendFuncSeparate(e.ONE,e.ONE_MINUS_SRC_ALPHA,e.ONE,e.ONE_MINUS_SRC_ALPHA);break;case k_:e.blendFunc(e.ONE,e.ONE);break;case z_:e.blendFuncSeparate(e.ZERO,e.ONE_MINUS_SRC_COLOR,e.ZERO,e.ONE);break;case G_:e.blendFuncSeparate(e.DST_COLOR,e.ONE_MINUS_SRC_ALPHA,e.ZERO,e.ONE);break;default:kt("WebGLState: Invalid blending: ",F);break}else switch(F){case oc:e.blendFuncSeparate(e.SRC_ALPHA,e.ONE_MINUS_SRC_ALPHA,e.ONE,e.ONE_MINUS_SRC_ALPHA);break;case k_:e.blendFuncSeparate(e.SRC_ALPHA,e.ONE,e.ONE,e.ONE);break;case z_:kt("WebGLState: SubtractiveBlending requires material.premultipliedAlpha = true");break;case G_:kt("WebGLState: MultiplyBlending requires material.premultipliedAlpha = true");break;default:kt("WebGLState: Invalid blending: ",F);break}S=null,v=null,b=null,_=null,M.set(0,0,0),C=0,g=F,E=Dt}return}dt=dt||et,mt=mt||j,Lt=Lt||yt,(et!==x||dt!==w)&&(e.blendEquationSeparate(Nt[et],Nt[dt]),x=et,w=dt),(j!==S||yt!==v||mt!==b||Lt!==_)&&(e.blendFuncSeparate(Mt[j],Mt[yt],Mt[mt],Mt[Lt]),S=j,v=yt,b=mt,_=Lt),(Kt.equals(M)===!1||ht!==C)&&(e.blendColor(Kt.r,Kt.g,Kt.b,ht),M.copy(Kt),C=ht),g=F,E=!1}function Zt(F,et){F.side===Ri?J(e.CULL_FACE):at(e.CULL_FACE);let j=F.side===Un;et&&(j=!j),ye(j),F.blending===oc&&F.transparent===!1?$t(Co):$t(F.blending,F.blendEquation,F.blendSrc,F.blendDst,F.blendEquationAlpha,F.blendSrcAlpha,F.blendDstAlpha,F.blendColor,F.blendAlpha,F.premultipliedAlpha),o.setFunc(F.depthFunc),o.setTest(F.depthTest),o.setMask(F.depthWrite),s.setMask(F.colorWrite);let yt=F.stencilWrite;a.setTest(yt),yt&&(a.setMask(F.stencilWriteMask),a.setFunc(F.stencilFunc,F.stencilRef,F.stencilFuncMask),a.setOp(F.stencilFail,F.stencilZFail,F.stencilZPass)),Ze(F.polygonOffset,F.polygonOffsetFactor,F.polygonOffsetUnits),F.alphaToCoverage===!0?at(e.SAMPLE_ALPHA_TO_COVERAGE):J(e.SAMPLE_ALPHA_TO_COVERAGE)}function ye(F){I!==F&&(F?e.frontFace(e.CW):e.frontFace(e.CCW),I=F)}function fe(F){F!==bE?(at(e.CULL_FACE),F!==R&&(F===B_?e.cullFace(e.BACK):F===ME?e.cullFace(e.FRONT):e.cullFace(e.FRONT_AND_BACK))):J(e.CULL_FACE),R=F}function yn(F){F!==U&&(D&&e.lineWidth(F),U=F)}function Ze(F,et,j){F?(at(e.POLYGON_OFFSET_FILL),(P!==et||L!==j)&&(P=et,L=j,o.getReversed()&&(et=-et,j=-j),e.polygonOffset(et,j))):J(e.POLYGON_OFFSET_FILL)}function ii(F){F?at(e.SCISSOR_TEST):J(e.SCISSOR_TEST)}function ri(F){F===void 0&&(F=e.TEXTURE0+O-1),V!==F&&(e.activeTexture(F),V=F)}function si(F,et,j){j===void 0&&(V===null?j=e.TEXTURE0+O-1:j=V);let yt=q[j];yt===void 0&&(yt={type:void 0,texture:void 0},q[j]=yt),(yt.type!==F||yt.texture!==et)&&(V!==j&&(e.activeTexture(j),V=j),e.bindTexture(F,et||st[F]),yt.type=F,yt.texture=et)}function G(){let F=q[V];F!==void 0&&F.type!==void 0&&(e.bindTexture(F.type,null),F.type=void 0,F.texture=void 0)}function oi(){try{e.compressedTexImage2D(...arguments)}catch(F){kt("WebGLState:",F)}}function Ae(){try{e.compressedTexImage3D(...arguments)}catch(F){kt("WebGLState:",F)}}function Ee(){try{e.texSubImage2D(...arguments)}catch(F){kt("WebGLState:",F)}}function Tt(){try{e.texSubImage3D(...arguments)}catch(F){kt("WebGLState:",F)}}function Ge(){try{e.compressedTexSubImage2D(...arguments)}catch(F){kt("WebGLState:",F)}}function Ot(){try{e.compressedTexSubImage3D(...arguments)}catch(F){kt("WebGLState:",F)}}function Gt(){try{e.texStorage2D(...arguments)}catch(F){kt("WebGLState:",F)}}function N(){try{e.texStorage3D(...arguments)}catch(F){kt("WebGLState:",F)}}function T(){try{e.texImage2D(...arguments)}catch(F){kt("WebGLState:",F)}}function W(){try{e.texImage3D(...arguments)}catch(F){kt("WebGLState:",F)}}function ft(F){return h[F]!==void 0?h[F]:e.getParameter(F)}function nt(F,et){h[F]!==et&&(e.pixelStorei(F,et),h[F]=et)}function pt(F){$.equals(F)===!1&&(e.scissor(F.x,F.y,F.z,F.w),$.copy(F))}function vt(F){ot.equals(F)===!1&&(e.viewport(F.x,F.y,F.z,F.w),ot.copy(F))}function Q(F,et){let j=l.get(et);j===void 0&&(j=new WeakMap,l.set(et,j));let yt=j.get(F);yt===void 0&&(yt=e.getUniformBlockIndex(et,F.name),e.uniformBlockBinding(et,yt,yt),j.set(F,yt))}function tt(F,et,j){let dt=l.get(et).get(F);c[dt]!==j&&(e.bindBufferBase(e.UNIFORM_BUFFER,dt,j),c[dt]=j)}function gt(){e.disable(e.BLEND),e.disable(e.CULL_FACE),e.disable(e.DEPTH_TEST),e.disable(e.POLYGON_OFFSET_FILL),e.disable(e.SCISSOR_TEST),e.disable(e.STENCIL_TEST),e.disable(e.SAMPLE_ALPHA_TO_COVERAGE),e.blendEquation(e.FUNC_ADD),e.blendFunc(e.ONE,e.ZERO),e.blendFuncSeparate(e.ONE,e.ZERO,e.ONE,e.ZERO),e.blendColor(0,0,0,0),e.colorMask(!0,!0,!0,!0),e.clearColor(0,0,0,0),e.depthMask(!0),e.depthFunc(e.LESS),o.setReversed(!1),e.clearDepth(1),e.stencilMask(4294967295),e.stencilFunc(e.ALWAYS,0,4294967295),e.stencilOp(e.KEEP,e.KEEP,e.KEEP),e.clearStencil(0),e.cullFace(e.BACK),e.frontFace(e.CCW),e.polygonOffset(0,0),e.activeTexture(e.TEXTURE0),e.bindFramebuffer(e.FRAMEBUFFER,null),e.bindFramebuffer(e.DRAW_FRAMEBUFFER,null),e.bindFramebuffer(e.READ_FRAMEBUFFER,null),e.useProgram(null),e.lineWidth(1),e.scissor(0,0,e.canvas.width,e.canvas.height),e.viewport(0,0,e.canvas.width,e.canvas.height),e.pixelStorei(e.PACK_ALIGNMENT,4),e.pixelStorei(e.UNPACK_ALIGNMENT,4),e.pixelStorei(e.UNPACK_FLIP_Y_WEBGL,!1),e.pixelStorei(e.UNPACK_PREMULTIPLY_ALPHA_WEBGL,!1),e.pixelStorei(e.UNPACK_COLORSPACE_CONVERSION_WEBGL,e.BROWSER_DEFAULT_WEBGL),e.pixelStorei(e.PACK_ROW_LENGTH,0),e.pixelStorei(e.PACK_SKIP_PIXELS,0),e.pixelStorei(e.PACK_SKIP_ROWS,0),e.pixelStorei(e.UNPACK_ROW_LENGTH,0),e.pixelStorei(e.UNPACK_IMAGE_HEIGHT,0),e.pixelStorei(e.UNPACK_SKIP_PIXELS,0),e.pixelStorei(e.UNPACK_SKIP_ROWS,0),e.pixelStorei(e.UNPACK_SKIP_IMAGES,0),u={},h={},V=null,q={},f={},c={},d=new WeakMap,p=[],y=null,m=!1,g=null,x=null,S=null,v=null,w=null,b=null,_=null,M=new Wt(0,0,0),C=0,E=!1,I=null,R=null,U=null,P=null,L=null,$.set(0,0,e.canvas.width,e.canvas.height),ot.set(0,0,e.canvas.width,e.canvas.height),s.reset(),o.reset(),a.reset()}return{buffers:{color:s,depth:o,stencil:a},enable:at,disable:J,bindFramebuffer:_t,drawBuffers:lt,useProgram:K,setBlending:$t,setMaterial:Zt,setFlipSided:ye,setCullFace:fe,setLineWidth:yn,setPolygonOffset:Ze,setScissorTest:ii,activeTexture:ri,bindTexture:si,unbindTexture:G,compressedTexImage2D:oi,compressedTexImage3D:Ae,texImage2D:T,texImage3D:W,pixelStorei:nt,getParameter:ft,updateUBOMapping:Q,uniformBlockBinding:tt,texStorage2D:Gt,texStorage3D:N,texSubImage2D:Ee,texSubImage3D:Tt,compressedTexSubImage2D:Ge,compressedTexSubImage3D:Ot,scissor:pt,viewport:vt,reset:gt}}function HB(e,t,n,i,r,s,o){let a=t.has("WEBGL_multisampled_render_to_texture")?t.get("WEBGL_multisampled_render_to_texture"):null,c=typeof navigator>"u"?!1:/OculusBrowser/g.test(navigator.userAgent),l=new Ft,u=new WeakMap,h=new Set,f,d=new WeakMap,p=new Set,y=new FinalizationRegistry(N=>p.delete(N)),m=!1;try{m=typeof OffscreenCanvas<"u"&&new OffscreenCanvas(1,1).getContext("2d")!==null}catch{}function g(N,T){return m?new OffscreenCanvas(N,T):Cl("canvas")}function x(N,T,W){let ft=1,nt=Gt(N);if((nt.width>W||nt.height>W)&&(ft=W/Math.max(nt.width,nt.height)),ft<1)if(typeof HTMLImageElement<"u"&&N instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&N instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&N instanceof ImageBitmap||typeof VideoFrame<"u"&&N instanceof VideoFrame){let pt=Math.floor(ft*nt.width),vt=Math.floor(ft*nt.height);f===void 0&&(f=g(pt,vt));let Q=T?g(pt,vt):f;return Q.width=pt,Q.height=vt,Q.getContext("2d").drawImage(N,0,0,pt,vt),Ut("WebGLRenderer: Texture has been resized from ("+nt.width+"x"+nt.height+") to ("+pt+"x"+vt+")."),Q}else return"data"in N&&Ut("WebGLRenderer: Image in DataTexture is too big ("+nt.width+"x"+nt.height+")."),N;return N}function S(N){return N.generateMipmaps}function v(N){e.generateMipmap(N)}function w(N){return N.isWebGLCubeRenderTarget?e.TEXTURE_CUBE_MAP:N.isWebGL3DRenderTarget?e.TEXTURE_3D:N.isWebGLArrayRenderTarget||N.isCompressedArrayTexture?e.TEXTURE_2D_ARRAY:e.TEXTURE_2D}function b(N,T,W,ft,nt,pt=!1){if(N!==null){if(e[N]!==void 0)return e[N];Ut("WebGLRenderer: Attempt to use non-existing WebGL internal format '"+N+"'")}let vt;ft&&(vt=t.get("EXT_texture_norm16"),vt||Ut("WebGLRenderer: Unable to use normalized textures without EXT_texture_norm16 extension"));let Q=T;if(T===e.RED&&(W===e.FLOAT&&(Q=e.R32F),W===e.HALF_FLOAT&&(Q=e.R16F),W===e.UNSIGNED_BYTE&&(Q=e.R8),W===e.UNSIGNED_SHORT&&vt&&(Q=vt.R16_EXT),W===e.SHORT&&vt&&(Q=vt.R16_SNORM_EXT)),T===e.RED_INTEGER&&(W===e.UNSIGNED_BYTE&&(Q=e.R8UI),W===e.UNSIGNED_SHORT&&(Q=e.R16UI),W===e.UNSIGNED_INT&&(Q=e.R32UI),W===e.BYTE&&(Q=e.R8I),W===e.SHORT&&(Q=e.R16I),W===e.INT&&(Q=e.R32I)),T===e.RG&&(W===e.FLOAT&&(Q=e.RG32F),W===e.HALF_FLOAT&&(Q=e.RG16F),W===e.UNSIGNED_BYTE&&(Q=e.RG8),W===e.UNSIGNED_SHORT&&vt&&(Q=vt.RG16_EXT),W===e.SHORT&&vt&&(Q=vt.RG16_SNORM_EXT)),T===e.RG_INTEGER&&(W===e.UNSIGNED_BYTE&&(Q=e.RG8UI),W===e.UNSIGNED_SHORT&&(Q=e.RG16UI),W===e.UNSIGNED_INT&&(Q=e.RG32UI),W===e.BYTE&&(Q=e.RG8I),W===e.SHORT&&(Q=e.RG16I),W===e.INT&&(Q=e.RG32I)),T===e.RGB_INTEGER&&(W===e.UNSIGNED_BYTE&&(Q=e.RGB8UI),W===e.UNSIGNED_SHORT&&(Q=e.RGB16UI),W===e.UNSIGNED_INT&&(Q=e.RGB32UI),W===e.BYTE&&(Q=e.RGB8I),W===e.SHORT&&(Q=e.RGB16I),W===e.INT&&(Q=e.RGB32I)),T===e.RGBA_INTEGER&&(W===e.UNSIGNED_BYTE&&(Q=e.RGBA8UI),W===e.UNSIGNED_SHORT&&(Q=e.RGBA16UI),W===e.UNSIGNED_INT&&(Q=e.RGBA32UI),W===e.BYTE&&(Q=e.RGBA8I),W===e.SHORT&&(Q=e.RGBA16I),W===e.INT&&(Q=e.RGBA32I)),T===e.RGB&&(W===e.UNSIGNED_SHORT&&vt&&(Q=vt.RGB16_EXT),W===e.SHORT&&vt&&(Q=vt.RGB16_SNORM_EXT),W===e.UNSIGNED_INT_5_9_9_9_REV&&(Q=e.RGB9_E5),W===e.UNSIGNED_INT_10F_11F_11F_REV&&(Q=e.R11F_G11F_B10F)),T===e.RGBA){let tt=pt?El:re.getTransfer(nt);W===e.FLOAT&&(Q=e.RGBA32F),W===e.HALF_FLOAT&&(Q=e.RGBA16F),W===e.UNSIGNED_BYTE&&(Q=tt===de?e.SRGB8_ALPHA8:e.RGBA8),W===e.UNSIGNED_SHORT&&vt&&(Q=vt.RGBA16_EXT),W===e.SHORT&&vt&&(Q=vt.RGBA16_SNORM_EXT),W===e.UNSIGNED_SHORT_4_4_4_4&&(Q=e.RGBA4),W===e.UNSIGNED_SHORT_5_5_5_1&&(Q=e.RGB5_A1)}return(Q===e.R16F||Q===e.R32F||Q===e.RG16F||Q===e.RG32F||Q===e.RGBA16F||Q===e.RGBA32F)&&t.get("EXT_color_buffer_float"),Q}function _(N,T){let W;return N?T===null||T===Hi||T===Io?W=e.DEPTH24_STENCIL8:T===Wi?W=e.DEPTH32F_STENCIL8:T===cc&&(W=e.DEPTH24_STENCIL8,Ut("DepthTexture: 16 bit depth attachment is not supported with stencil. Using 24-bit attachment.")):T===null||T===Hi||T===Io?W=e.DEPTH_COMPONENT24:T===Wi?W=e.DEPTH_COMPONENT32F:T===cc&&(W=e.DEPTH_COMPONENT16),W}function M(N,T){return S(N)===!0||N.isFramebufferTexture&&N.minFilter!==an&&N.minFilter!==Nn?Math.log2(Math.max(T.width,T.height))+1:N.mipmaps.length>0?N.mipmaps.length:N.isCompressedTexture&&Array.isArray(N.image)?T.mipmaps.length:1}function C(N){let T=new WeakRef(N);i.get(N).__ref=T,p.add(T),y.register(N,T,T)}function E(N){let T=i.get(N).__ref;T!==void 0&&(p.delete(T),y.unregister(T))}function I(N){U(N.target)}function R(N){P(N.target)}function U(N){N.removeEventListener("dispose",I),E(N),O(N),N.isVideoTexture&&u.delete(N),N.isHTMLTexture&&h.delete(N)}function P(N){N.removeEventListener("dispose",R),E(N),Y(N)}function L(){for(let N of p){let T=N.deref();T!==void 0&&(T.isRenderTarget===!0?P(T):U(T))}p.clear(),h.clear()}function O(N){let T=i.get(N);if(T.__webglInit===void 0)return;let W=N.source,ft=d.get(W);if(ft){let nt=ft[T.__cacheKey];nt.usedTimes--,nt.usedTimes===0&&D(N),Object.keys(ft).length===0&&d.delete(W)}i.remove(N)}function D(N){let T=i.get(N);e.deleteTexture(T.__webglTexture);let W=N.source,ft=d.get(W);delete ft[T.__cacheKey],o.memory.textures--}function Y(N){let T=i.get(N);T.__depthDisposeCallback&&T.__depthDisposeCallback();let W=N.depthTexture;if(W&&W.renderTarget===N&&U(W),N.isWebGLCubeRenderTarget)for(let nt=0;nt<6;nt++){if(Array.isArray(T.__webglFramebuffer[nt]))for(let pt=0;pt<T.__webglFramebuffer[nt].length;pt++)e.deleteFramebuffer(T.__webglFramebuffer[nt][pt]);else e.deleteFramebuffer(T.__webglFramebuffer[nt]);T.__webglDepthbuffer&&e.deleteRenderbuffer(T.__webglDepthbuffer[nt])}else{if(Array.isArray(T.__webglFramebuffer))for(let nt=0;nt<T.__webglFramebuffer.length;nt++)e.deleteFramebuffer(T.__webglFramebuffer[nt]);else e.deleteFramebuffer(T.__webglFramebuffer);if(T.__webglDepthbuffer&&e.deleteRenderbuffer(T.__webglDepthbuffer),T.__webglMultisampledFramebuffer&&e.deleteFramebuffer(T.__webglMultisampledFramebuffer),T.__webglColorRenderbuffer)for(let nt=0;nt<T.__webglColorRenderbuffer.length;nt++)T.__webglColorRenderbuffer[nt]&&e.deleteRenderbuffer(T.__webglColorRenderbuffer[nt]);T.__webglDepthRenderbuffer&&e.deleteRenderbuffer(T.__webglDepthRenderbuffer)}let ft=N.textures;for(let nt=0,pt=ft.length;nt<pt;nt++){let vt=i.get(ft[nt]);vt.__webglTexture&&(e.deleteTexture(vt.__webglTexture),o.memory.textures--),i.remove(ft[nt])}i.remove(N)}let B=0;function V(){B=0}function q(){return B}function rt(N){B=N}function ct(){let N=B;return N>=r.maxTextures&&Ut("WebGLTextures: Trying to use "+(N+1)+" texture units while this GPU supports only "+r.maxTextures),B+=1,N}function $(N){let T=[];return T.push(N.wrapS),T.push(N.wrapT),T.push(N.wrapR||0),T.push(N.magFilter),T.push(N.minFilter),T.push(N.anisotropy),T.push(N.internalFormat),T.push(N.format),T.push(N.type),T.push(N.generateMipmaps),T.push(N.mipmapsAutoUpdate),T.push(N.premultiplyAlpha),T.push(N.flipY),T.push(N.unpackAlignment),T.push(N.colorSpace),T.join()}function ot(N,T){let W=i.get(N);if(N.isVideoTexture&&Ge(N),N.isRenderTargetTexture===!1&&N.isExternalTexture!==!0&&N.version>0&&W.__version!==N.version){let ft=N.image;if(ft===null)Ut("WebGLRenderer: Texture marked for update but no image data found.");else if(ft.complete===!1)Ut("WebGLRenderer: Texture marked for update but image is incomplete");else{Zt(W,N,T);return}}else N.isExternalTexture&&(W.__webglTexture=N.sourceTexture?N.sourceTexture:null);n.bindTexture(e.TEXTURE_2D,W.__webglTexture,e.TEXTURE0+T)}function ut(N,T){let W=i.get(N);if(N.isRenderTargetTexture===!1&&N.version>0&&W.__version!==N.version){Zt(W,N,T);return}else N.isExternalTexture&&(W.__webglTexture=N.sourceTexture?N.sourceTexture:null);n.bindTexture(e.TEXTURE_2D_ARRAY,W.__webglTexture,e.TEXTURE0+T)}function st(N,T){let W=i.get(N);if(N.isRenderTargetTexture===!1&&N.version>0&&W.__version!==N.version){Zt(W,N,T);return}n.bindTexture(e.TEXTURE_3D,W.__webglTexture,e.TEXTURE0+T)}function at(N,T){let W=i.get(N);if(N.version>0&&W.__version!==N.version){ye(W,N,T);return}n.bindTexture(e.TEXTURE_CUBE_MAP,W.__webglTexture,e.TEXTURE0+T)}let J={[Qh]:e.REPEAT,[pr]:e.CLAMP_TO_EDGE,[td]:e.MIRRORED_REPEAT},_t={[an]:e.NEAREST,[WE]:e.NEAREST_MIPMAP_NEAREST,[Ql]:e.NEAREST_MIPMAP_LINEAR,[Nn]:e.LINEAR,[Rd]:e.LINEAR_MIPMAP_NEAREST,[Jr]:e.LINEAR_MIPMAP_LINEAR},lt={[YE]:e.NEVER,[ax]:e.ALWAYS,[ZE]:e.LESS,[sx]:e.LEQUAL,[JE]:e.EQUAL,[ox]:e.GEQUAL,[KE]:e.GREATER,[jE]:e.NOTEQUAL};function K(N,T){if(T.type===Wi&&t.has("OES_texture_float_linear")===!1&&(T.magFilter===Nn||T.magFilter===Rd||T.magFilter===Ql||T.magFilter===Jr||T.minFilter===Nn||T.minFilter===Rd||T.minFilter===Ql||T.minFilter===Jr)&&Ut("WebGLRenderer: Unable to use linear filtering with floating point textures. OES_texture_float_linear not supported on this device."),e.texParameteri(N,e.TEXTURE_WRAP_S,J[T.wrapS]),e.texParameteri(N,e.TEXTURE_WRAP_T,J[T.wrapT]),(N===e.TEXTURE_3D||N===e.TEXTURE_2D_ARRAY)&&e.texParameteri(N,e.TEXTURE_WRAP_R,J[T.wrapR]),e.texParameteri(N,e.TEXTURE_MAG_FILTER,_t[T.magFilter]),e.texParameteri(N,e.TEXTURE_MIN_FILTER,_t[T.minFilter]),T.compareFunction&&(e.texParameteri(N,e.TEXTURE_COMPARE_MODE,e.COMPARE_REF_TO_TEXTURE),e.texParameteri(N,e.TEXTURE_COMPARE_FUNC,lt[T.compareFunction])),t.has("EXT_texture_filter_anisotropic")===!0){if(T.magFilter===an||T.minFilter!==Ql&&T.minFilter!==Jr||T.type===Wi&&t.has("OES_texture_float_linear")===!1)return;if(T.anisotropy>1||i.get(T).__currentAnisotropy){let W=t.get("EXT_texture_filter_anisotropic");e.texParameterf(N,W.TEXTURE_MAX_ANISOTROPY_EXT,Math.min(T.anisotropy,r.getMaxAnisotropy())),i.get(T).__currentAnisotropy=T.anisotropy}}}function Nt(N,T){let W=!1;N.__webglInit===void 0&&(N.__webglInit=!0,T.addEventListener("dispose",I),C(T));let ft=T.source,nt=d.get(ft);nt===void 0&&(nt={},d.set(ft,nt));let pt=$(T);if(pt!==N.__cacheKey){nt[pt]===void 0&&(nt[pt]={texture:e.createTexture(),usedTimes:0},o.memory.textures++,W=!0),nt[pt].usedTimes++;let vt=nt[N.__cacheKey];vt!==void 0&&(nt[N.__cacheKey].usedTimes--,vt.usedTimes===0&&D(T)),N.__cacheKey=pt,N.__webglTexture=nt[pt].texture}return W}function Mt(N,T,W){return Math.floor(Math.floor(N/W)/T)}function $t(N,T,W,ft){let pt=N.updateRanges;if(pt.length===0)n.texSubImage2D(e.TEXTURE_2D,0,0,0,T.width,T.height,W,ft,T.data);else{pt.sort((F,et)=>F.start-et.start);let vt=0;for(let F=1;F<pt.length;F++){let et=pt[vt],j=pt[F],yt=et.start+et.count,dt=Mt(j.start,T.width,4),mt=Mt(et.start,T.width,4);j.start<=yt+1&&dt===mt&&Mt(j.start+j.count-1,T.width,4)===dt?et.count=Math.max(et.count,j.start+j.count-et.start):(++vt,pt[vt]=j)}pt.length=vt+1;let Q=n.getParameter(e.UNPACK_ROW_LENGTH),tt=n.getParameter(e.UNPACK_SKIP_PIXELS),gt=n.getParameter(e.UNPACK_SKIP_ROWS);n.pixelStorei(e.UNPACK_ROW_LENGTH,T.width);for(let F=0,et=pt.length;F<et;F++){let j=pt[F],yt=Math.floor(j.start/4),dt=Math.ceil(j.count/4),mt=yt%T.width,Lt=Math.floor(yt/T.width),Kt=dt,ht=1;n.pixelStorei(e.UNPACK_SKIP_PIXELS,mt),n.pixelStorei(e.UNPACK_SKIP_ROWS,Lt),n.texSubImage2D(e.TEXTURE_2D,0,mt,Lt,Kt,ht,W,ft,T.data)}N.clearUpdateRanges(),n.pixelStorei(e.UNPACK_ROW_LENGTH,Q),n.pixelStorei(e.UNPACK_SKIP_PIXELS,tt),n.pixelStorei(e.UNPACK_SKIP_ROWS,gt)}}function Zt(N,T,W){let ft=e.TEXTURE_2D;(T.isDataArrayTexture||T.isCompressedArrayTexture)&&(ft=e.TEXTURE_2D_ARRAY),T.isData3DTexture&&(ft=e.TEXTURE_3D);let nt=Nt(N,T),pt=T.source;n.bindTexture(ft,N.__webglTexture,e.TEXTURE0+W);let vt=i.get(pt);if(pt.version!==vt.__version||nt===!0){if(n.activeTexture(e.TEXTURE0+W),(typeof ImageBitmap<"u"&&T.image instanceof ImageBitmap)===!1){let ht=re.getPrimaries(re.workingColorSpace),Dt=T.colorSpace===jr?null:re.getPrimaries(T.colorSpace),Jt=T.colorSpace===jr||ht===Dt?e.NONE:e.BROWSER_DEFAULT_WEBGL;n.pixelStorei(e.UNPACK_FLIP_Y_WEBGL,T.flipY),n.pixelStorei(e.UNPACK_PREMULTIPLY_ALPHA_WEBGL,T.premultiplyAlpha),n.pixelStorei(e.UNPACK_COLORSPACE_CONVERSION_WEBGL,Jt)}n.pixelStorei(e.UNPACK_ALIGNMENT,T.unpackAlignment);let tt=x(T.image,!1,r.maxTextureSize);tt=Ot(T,tt);let gt=s.convert(T.format,T.colorSpace),F=s.convert(T.type),et=b(T.internalFormat,gt,F,T.normalized,T.colorSpace,T.isVideoTexture);K(ft,T);let j,yt=T.mipmaps,dt=T.isVideoTexture!==!0,mt=vt.__version===void 0||nt===!0,Lt=pt.dataReady,Kt=M(T,tt);if(T.isDepthTexture)et=_(T.format===Kr,T.type),mt&&(dt?n.texStorage2D(e.TEXTURE_2D,1,et,tt.width,tt.height):n.texImage2D(e.TEXTURE_2D,0,et,tt.width,tt.height,0,gt,F,null));else if(T.isDataTexture)if(yt.length>0){dt&&mt&&n.texStorage2D(e.TEXTURE_2D,Kt,et,yt[0].width,yt[0].height);for(let ht=0,Dt=yt.length;ht<Dt;ht++)j=yt[ht],dt?Lt&&n.texSubImage2D(e.TEXTURE_2D,ht,0,0,j.width,j.height,gt,F,j.data):n.texImage2D(e.TEXTURE_2D,ht,et,j.width,j.height,0,gt,F,j.data);T.generateMipmaps=!1}else dt?(mt&&n.texStorage2D(e.TEXTURE_2D,Kt,et,tt.width,tt.height),Lt&&$t(T,tt,gt,F)):n.texImage2D(e.TEXTURE_2D,0,et,tt.width,tt.height,0,gt,F,tt.data);else if(T.isCompressedTexture)if(T.isCompressedArrayTexture){dt&&mt&&n.texStorage3D(e.TEXTURE_2D_ARRAY,Kt,et,yt[0].width,yt[0].height,tt.depth);for(let ht=0,Dt=yt.length;ht<Dt;ht++)if(j=yt[ht],T.format!==Xi)if(gt!==null)if(dt){if(Lt)if(T.layerUpdates.size>0){let Jt=yx(j.width,j.height,T.format,T.type);for(let At of T.layerUpdates){let me=j.data.subarray(At*Jt/j.data.BYTES_PER_ELEMENT,(At+1)*Jt/j.data.BYTES_PER_ELEMENT);n.compressedTexSubImage3D(e.TEXTURE_2D_ARRAY,ht,0,0,At,j.width,j.height,1,gt,me)}}else n.compressedTexSubImage3D(e.TEXTURE_2D_ARRAY,ht,0,0,0,j.width,j.height,tt.depth,gt,j.data)}else n.compressedTexImage3D(e.TEXTURE_2D_ARRAY,ht,et,j.width,j.height,tt.depth,0,j.data,0,0);else Ut("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()");else dt?Lt&&n.texSubImage3D(e.TEXTURE_2D_ARRAY,ht,0,0,0,j.width,j.height,tt.depth,gt,F,j.data):n.texImage3D(e.TEXTURE_2D_ARRAY,ht,et,j.width,j.height,tt.depth,0,gt,F,j.data);T.layerUpdates.size>0&&T.clearLayerUpdates()}else{dt&&mt&&n.texStorage2D(e.TEXTURE_2D,Kt,et,yt[0].width,yt[0].height);for(let ht=0,Dt=yt.length;ht<Dt;ht++)j=yt[ht],T.format!==Xi?gt!==null?dt?Lt&&n.compressedTexSubImage2D(e.TEXTURE_2D,ht,0,0,j.width,j.height,gt,j.data):n.compressedTexImage2D(e.TEXTURE_2D,ht,et,j.width,j.height,0,j.data):Ut("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()"):dt?Lt&&n.texSubImage2D(e.TEXTURE_2D,ht,0,0,j.width,j.height,gt,F,j.data):n.texImage2D(e.TEXTURE_2D,ht,et,j.width,j.height,0,gt,F,j.data)}else if(T.isDataArrayTexture)if(dt){if(mt&&n.texStorage3D(e.TEXTURE_2D_ARRAY,Kt,et,tt.width,tt.height,tt.depth),Lt)if(T.layerUpdates.size>0){let ht=yx(tt.width,tt.height,T.format,T.type);for(let Dt of T.layerUpdates){let Jt=tt.data.subarray(Dt*ht/tt.data.BYTES_PER_ELEMENT,(Dt+1)*ht/tt.data.BYTES_PER_ELEMENT);n.texSubImage3D(e.TEXTURE_2D_ARRAY,0,0,0,Dt,tt.width,tt.height,1,gt,F,Jt)}T.clearLayerUpdates()}else n.texSubImage3D(e.TEXTURE_2D_ARRAY,0,0,0,0,tt.width,tt.height,tt.depth,gt,F,tt.data)}else n.texImage3D(e.TEXTURE_2D_ARRAY,0,et,tt.width,tt.height,tt.depth,0,gt,F,tt.data);else if(T.isData3DTexture)dt?(mt&&n.texStorage3D(e.TEXTURE_3D,Kt,et,tt.width,tt.height,tt.depth),Lt&&n.texSubImage3D(e.TEXTURE_3D,0,0,0,0,tt.width,tt.height,tt.depth,gt,F,tt.data)):n.texImage3D(e.TEXTURE_3D,0,et,tt.width,tt.height,tt.depth,0,gt,F,tt.data);else if(T.isFramebufferTexture){if(mt)if(dt)n.texStorage2D(e.TEXTURE_2D,Kt,et,tt.width,tt.height);else{let ht=tt.width,Dt=tt.height;for(let Jt=0;Jt<Kt;Jt++)n.texImage2D(e.TEXTURE_2D,Jt,et,ht,Dt,0,gt,F,null),ht>>=1,Dt>>=1}}else if(T.isHTMLTexture){if("texElementImage2D"in e){let ht=e.canvas;if(ht.hasAttribute("layoutsubtree")||ht.setAttribute("layoutsubtree","true"),tt.parentNode!==ht){ht.appendChild(tt),h.add(T),ht.onpaint=Dt=>{let Jt=Dt.changedElements;for(let At of h)Jt.includes(At.image)&&(At.needsUpdate=!0)},ht.requestPaint();return}if(e.texElementImage2D.length===3)e.texElementImage2D(e.TEXTURE_2D,e.RGBA8,tt);else{let Jt=e.RGBA,At=e.RGBA,me=e.UNSIGNED_BYTE;e.texElementImage2D(e.TEXTURE_2D,0,Jt,At,me,tt)}e.texParameteri(e.TEXTURE_2D,e.TEXTURE_MIN_FILTER,e.LINEAR),e.texParameteri(e.TEXTURE_2D,e.TEXTURE_WRAP_S,e.CLAMP_TO_EDGE),e.texParameteri(e.TEXTURE_2D,e.TEXTURE_WRAP_T,e.CLAMP_TO_EDGE)}}else if(yt.length>0){if(dt&&mt){let ht=Gt(yt[0]);n.texStorage2D(e.TEXTURE_2D,Kt,et,ht.width,ht.height)}for(let ht=0,Dt=yt.length;ht<Dt;ht++)j=yt[ht],dt?Lt&&n.texSubImage2D(e.TEXTURE_2D,ht,0,0,gt,F,j):n.texImage2D(e.TEXTURE_2D,ht,et,gt,F,j);T.generateMipmaps=!1}else if(dt){if(mt){let ht=Gt(tt);n.texStorage2D(e.TEXTURE_2D,Kt,et,ht.width,ht.height)}Lt&&n.texSubImage2D(e.TEXTURE_2D,0,0,0,gt,F,tt)}else n.texImage2D(e.TEXTURE_2D,0,et,gt,F,tt);S(T)&&T.mipmapsAutoUpdate===!0&&v(ft),vt.__version=pt.version,T.onUpdate&&T.onUpdate(T)}N.__version=T.version}function ye(N,T,W){if(T.image.length!==6)return;let ft=Nt(N,T),nt=T.source;n.bindTexture(e.TEXTURE_CUBE_MAP,N.__webglTexture,e.TEXTURE0+W);let pt=i.get(nt);if(nt.version!==pt.__version||ft===!0){n.activeTexture(e.TEXTURE0+W);let vt=re.getPrimaries(re.workingColorSpace),Q=T.colorSpace===jr?null:re.getPrimaries(T.colorSpace),tt=T.colorSpace===jr||vt===Q?e.NONE:e.BROWSER_DEFAULT_WEBGL;n.pixelStorei(e.UNPACK_FLIP_Y_WEBGL,T.flipY),n.pixelStorei(e.UNPACK_PREMULTIPLY_ALPHA_WEBGL,T.premultiplyAlpha),n.pixelStorei(e.UNPACK_ALIGNMENT,T.unpackAlignment),n.pixelStorei(e.UNPACK_COLORSPACE_CONVERSION_WEBGL,tt);let gt=T.isCompressedTexture||T.image[0].isCompressedTexture,F=T.image[0]&&T.image[0].isDataTexture,et=[];for(let At=0;At<6;At++)!gt&&!F?et[At]=x(T.image[At],!0,r.maxCubemapSize):et[At]=F?T.image[At].image:T.image[At],et[At]=Ot(T,et[At]);let j=et[0],yt=s.convert(T.format,T.colorSpace),dt=s.convert(T.type),mt=b(T.internalFormat,yt,dt,T.normalized,T.colorSpace),Lt=T.isVideoTexture!==!0,Kt=pt.__version===void 0||ft===!0,ht=nt.dataReady,Dt=M(T,j);K(e.TEXTURE_CUBE_MAP,T);let Jt;if(T.isDepthTexture){if(mt=_(T.format===Kr,T.type),Kt)if(Lt)n.texStorage2D(e.TEXTURE_CUBE_MAP,1,mt,j.width,j.height);else for(let At=0;At<6;At++)n.texImage2D(e.TEXTURE_CUBE_MAP_POSITIVE_X+At,0,mt,j.width,j.height,0,yt,dt,null)}else if(gt){Lt&&Kt&&n.texStorage2D(e.TEXTURE_CUBE_MAP,Dt,mt,j.width,j.height);for(let At=0;At<6;At++){Jt=et[At].mipmaps;for(let me=0;me<Jt.length;me++){let Je=Jt[me];T.format!==Xi?yt!==null?Lt?ht&&n.compressedTexSubImage2D(e.TEXTURE_CUBE_MAP_POSITIVE_X+At,me,0,0,Je.width,Je.height,yt,Je.data):n.compressedTexImage2D(e.TEXTURE_CUBE_MAP_POSITIVE_X+At,me,mt,Je.width,Je.height,0,Je.data):Ut("WebGLRenderer: Attempt to load unsupported compressed texture format in .setTextureCube()"):Lt?ht&&n.texSubImage2D(e.TEXTURE_CUBE_MAP_POSITIVE_X+At,me,0,0,Je.width,Je.height,yt,dt,Je.data):n.texImage2D(e.TEXTURE_CUBE_MAP_POSITIVE_X+At,me,mt,Je.width,Je.height,0,yt,dt,Je.data)}}}else{if(Jt=T.mipmaps,Lt&&Kt){Jt.length>0&&Dt++;let At=Gt(et[0]);n.texStorage2D(e.TEXTURE_CUBE_MAP,Dt,mt,At.width,At.height)}for(let At=0;At<6;At++)if(F){Lt?ht&&n.texSubImage2D(e.TEXTURE_CUBE_MAP_POSITIVE_X+At,0,0,0,et[At].width,et[At].height,yt,dt,et[At].data):n.texImage2D(e.TEXTURE_CUBE_MAP_POSITIVE_X+At,0,mt,et[At].width,et[At].height,0,yt,dt,et[At].data);for(let me=0;me<Jt.length;me++){let Qr=Jt[me].image[At].image;Lt?ht&&n.texSubImage2D(e.TEXTURE_CUBE_MAP_POSITIVE_X+At,me+1,0,0,Qr.width,Qr.height,yt,dt,Qr.data):n.texImage2D(e.TEXTURE_CUBE_MAP_POSITIVE_X+At,me+1,mt,Qr.width,Qr.height,0,yt,dt,Qr.data)}}else{Lt?ht&&n.texSubImage2D(e.TEXTURE_CUBE_MAP_POSITIVE_X+At,0,0,0,yt,dt,et[At]):n.texImage2D(e.TEXTURE_CUBE_MAP_POSITIVE_X+At,0,mt,yt,dt,et[At]);for(let me=0;me<Jt.length;me++){let Je=Jt[me];Lt?ht&&n.texSubImage2D(e.TEXTURE_CUBE_MAP_POSITIVE_X+At,me+1,0,0,yt,dt,Je.image[At]):n.texImage2D(e.TEXTURE_CUBE_MAP_POSITIVE_X+At,me+1,mt,yt,dt,Je.image[At])}}}S(T)&&T.mipmapsAutoUpdate===!0&&v(e.TEXTURE_CUBE_MAP),pt.__version=nt.version,T.onUpdate&&T.onUpdate(T)}N.__version=T.version}function fe(N,T,W,ft,nt,pt){let vt=s.convert(W.format,W.colorSpace),Q=s.convert(W.type),tt=b(W.internalFormat,vt,Q,W.normalized,W.colorSpace),gt=i.get(T),F=i.get(W);if(F.__renderTarget=T,!gt.__hasExternalTextures){let et=Math.max(1,T.width>>pt),j=Math.max(1,T.height>>pt);nt===e.TEXTURE_3D||nt===e.TEXTURE_2D_ARRAY?n.texImage3D(nt,pt,tt,et,j,T.depth,0,vt,Q,null):n.texImage2D(nt,pt,tt,et,j,0,vt,Q,null)}n.bindFramebuffer(e.FRAMEBUFFER,N),Tt(T)?a.framebufferTexture2DMultisampleEXT(e.FRAMEBUFFER,ft,nt,F.__webglTexture,0,Ee(T)):(nt===e.TEXTURE_2D||nt>=e.TEXTURE_CUBE_MAP_POSITIVE_X&&nt<=e.TEXTURE_CUBE_MAP_NEGATIVE_Z)&&e.framebufferTexture2D(e.FRAMEBUFFER,ft,nt,F.__webglTexture,pt),n.bindFramebuffer(e.FRAMEBUFFER,null)}function yn(N,T,W){if(e.bindRenderbuffer(e.RENDERBUFFER,N),T.depthBuffer){let ft=T.depthTexture,nt=ft&&ft.isDepthTexture?ft.type:null,pt=_(T.stencilBuffer,nt),vt=T.stencilBuffer?e.DEPTH_STENCIL_ATTACHMENT:e.DEPTH_ATTACHMENT;Tt(T)?a.renderbufferStorageMultisampleEXT(e.RENDERBUFFER,Ee(T),pt,T.width,T.height):W?e.renderbufferStorageMultisample(e.RENDERBUFFER,Ee(T),pt,T.width,T.height):e.renderbufferStorage(e.RENDERBUFFER,pt,T.width,T.height),e.framebufferRenderbuffer(e.FRAMEBUFFER,vt,e.RENDERBUFFER,N)}else{let ft=T.textures;for(let nt=0;nt<ft.length;nt++){let pt=ft[nt],vt=s.convert(pt.format,pt.colorSpace),Q=s.convert(pt.type),tt=b(pt.internalFormat,vt,Q,pt.normalized,pt.colorSpace);Tt(T)?a.renderbufferStorageMultisampleEXT(e.RENDERBUFFER,Ee(T),tt,T.width,T.height):W?e.renderbufferStorageMultisample(e.RENDERBUFFER,Ee(T),tt,T.width,T.height):e.renderbufferStorage(e.RENDERBUFFER,tt,T.width,T.height)}}e.bindRenderbuffer(e.RENDERBUFFER,null)}function Ze(N,T,W){let ft=T.isWebGLCubeRenderTarget===!0;if(n.bindFramebuffer(e.FRAMEBUFFER,N),!(T.depthTexture&&T.depthTexture.isDepthTexture))throw new Error("THREE.WebGLTextures: renderTarget.depthTexture must be an instance of THREE.DepthTexture.");let nt=i.get(T.depthTexture);nt.__renderTarget=T;let pt=ft?T.depthTexture.image[0]:T.depthTexture.image;(!nt.__webglTexture||pt.width!==T.width||pt.height!==T.height)&&(pt.width=T.width,pt.height=T.height,T.depthTexture.needsUpdate=!0),ft?at(T.depthTexture,0):ot(T.depthTexture,0);let vt=nt.__webglTexture,Q=Ee(T),tt=ft?e.TEXTURE_CUBE_MAP_POSITIVE_X+W:e.TEXTURE_2D,gt=T.depthTexture.format===Kr?e.DEPTH_STENCIL_ATTACHMENT:e.DEPTH_ATTACHMENT;if(T.depthTexture.format===Xr)Tt(T)?a.framebufferTexture2DMultisampleEXT(e.FRAMEBUFFER,gt,tt,vt,0,Q):e.framebufferTexture2D(e.FRAMEBUFFER,gt,tt,vt,0);else if(T.depthTexture.format===Kr)Tt(T)?a.framebufferTexture2DMultisampleEXT(e.FRAMEBUFFER,gt,tt,vt,0,Q):e.framebufferTexture2D(e.FRAMEBUFFER,gt,tt,vt,0);else throw new Error("THREE.WebGLTextures: Unknown depthTexture format.")}function ii(N){let T=i.get(N),W=N.isWebGLCubeRenderTarget===!0;if(T.__boundDepthTexture!==N.depthTexture){let ft=N.depthTexture;if(T.__depthDisposeCallback&&T.__depthDisposeCallback(),ft){let nt=()=>{delete T.__boundDepthTexture,delete T.__depthDisposeCallback,ft.removeEventListener("dispose",nt)};ft.addEventListener("dispose",nt),T.__depthDisposeCallback=nt}T.__boundDepthTexture=ft}if(N.depthTexture&&!T.__autoAllocateDepthBuffer)if(W)for(let ft=0;ft<6;ft++)Ze(T.__webglFramebuffer[ft],N,ft);else N.texture.mipmaps.length>0?Ze(T.__webglFramebuffer[0],N,0):Ze(T.__webglFramebuffer,N,0);else if(W){T.__webglDepthbuffer=[];for(let ft=0;ft<6;ft++)if(n.bindFramebuffer(e.FRAMEBUFFER,T.__webglFramebuffer[ft]),T.__webglDepthbuffer[ft]===void 0)T.__webglDepthbuffer[ft]=e.createRenderbuffer(),yn(T.__webglDepthbuffer[ft],N,!1);else{let nt=N.stencilBuffer?e.DEPTH_STENCIL_ATTACHMENT:e.DEPTH_ATTACHMENT,pt=T.__webglDepthbuffer[ft];e.bindRenderbuffer(e.RENDERBUFFER,pt),e.framebufferRenderbuffer(e.FRAMEBUFFER,nt,e.RENDERBUFFER,pt)}}else if(N.texture.mipmaps.length>0?n.bindFramebuffer(e.FRAMEBUFFER,T.__webglFramebuffer[0]):n.bindFramebuffer(e.FRAMEBUFFER,T.__webglFramebuffer),T.__webglDepthbuffer===void 0)T.__webglDepthbuffer=e.createRenderbuffer(),yn(T.__webglDepthbuffer,N,!1);else{let nt=N.stencilBuffer?e.DEPTH_STENCIL_ATTACHMENT:e.DEPTH_ATTACHMENT,pt=T.__webglDepthbuffer;e.bindRenderbuffer(e.RENDERBUFFER,pt),e.framebufferRenderbuffer(e.FRAMEBUFFER,nt,e.RENDERBUFFER,pt)}n.bindFramebuffer(e.FRAMEBUFFER,null)}function ri(N,T,W){let ft=i.get(N);T!==void 0&&fe(ft.__webglFramebuffer,N,N.texture,e.COLOR_ATTACHMENT0,e.TEXTURE_2D,0),W!==void 0&&ii(N)}function si(N){let T=N.texture,W=i.get(N),ft=i.get(T);N.addEventListener("dispose",R),C(N);let nt=N.textures,pt=N.isWebGLCubeRenderTarget===!0,vt=nt.length>1;if(vt||(ft.__webglTexture===void 0&&(ft.__webglTexture=e.createTexture()),ft.__version=T.version,o.memory.textures++),pt){W.__webglFramebuffer=[];for(let Q=0;Q<6;Q++)if(T.mipmaps.length>0){W.__webglFramebuffer[Q]=[];for(let tt=0;tt<T.mipmaps.length;tt++)W.__webglFramebuffer[Q][tt]=e.createFramebuffer()}else W.__webglFramebuffer[Q]=e.createFramebuffer()}else{if(T.mipmaps.length>0){W.__webglFramebuffer=[];for(let Q=0;Q<T.mipmaps.length;Q++)W.__webglFramebuffer[Q]=e.createFramebuffer()}else W.__webglFramebuffer=e.createFramebuffer();if(vt)for(let Q=0,tt=nt.length;Q<tt;Q++){let gt=i.get(nt[Q]);gt.__webglTexture===void 0&&(gt.__webglTexture=e.createTexture(),o.memory.textures++)}if(N.samples>0&&Tt(N)===!1){W.__webglMultisampledFramebuffer=e.createFramebuffer(),W.__webglColorRenderbuffer=[],n.bindFramebuffer(e.FRAMEBUFFER,W.__webglMultisampledFramebuffer);for(let Q=0;Q<nt.length;Q++){let tt=nt[Q];W.__webglColorRenderbuffer[Q]=e.createRenderbuffer(),e.bindRenderbuffer(e.RENDERBUFFER,W.__webglColorRenderbuffer[Q]);let gt=s.convert(tt.format,tt.colorSpace),F=s.convert(tt.type),et=b(tt.internalFormat,gt,F,tt.normalized,tt.colorSpace,N.isXRRenderTarget===!0),j=Ee(N);e.renderbufferStorageMultisample(e.RENDERBUFFER,j,et,N.width,N.height),e.framebufferRenderbuffer(e.FRAMEBUFFER,e.COLOR_ATTACHMENT0+Q,e.RENDERBUFFER,W.__webglColorRenderbuffer[Q])}e.bindRenderbuffer(e.RENDERBUFFER,null),N.depthBuffer&&(W.__webglDepthRenderbuffer=e.createRenderbuffer(),yn(W.__webglDepthRenderbuffer,N,!0)),n.bindFramebuffer(e.FRAMEBUFFER,null)}}if(pt){n.bindTexture(e.TEXTURE_CUBE_MAP,ft.__webglTexture),K(e.TEXTURE_CUBE_MAP,T);for(let Q=0;Q<6;Q++)if(T.mipmaps.length>0)for(let tt=0;tt<T.mipmaps.length;tt++)fe(W.__webglFramebuffer[Q][tt],N,T,e.COLOR_ATTACHMENT0,e.TEXTURE_CUBE_MAP_POSITIVE_X+Q,tt);else fe(W.__webglFramebuffer[Q],N,T,e.COLOR_ATTACHMENT0,e.TEXTURE_CUBE_MAP_POSITIVE_X+Q,0);S(T)?v(e.TEXTURE_CUBE_MAP):T.mipmaps.length>0&&e.texParameteri(e.TEXTURE_CUBE_MAP,e.TEXTURE_MAX_LEVEL,T.mipmaps.length-1),n.unbindTexture()}else if(vt){for(let Q=0,tt=nt.length;Q<tt;Q++){let gt=nt[Q],F=i.get(gt),et=e.TEXTURE_2D;(N.isWebGL3DRenderTarget||N.isWebGLArrayRenderTarget)&&(et=N.isWebGL3DRenderTarget?e.TEXTURE_3D:e.TEXTURE_2D_ARRAY),n.bindTexture(et,F.__webglTexture),K(et,gt),fe(W.__webglFramebuffer,N,gt,e.COLOR_ATTACHMENT0+Q,et,0),S(gt)&&v(et)}n.unbindTexture()}else{let Q=e.TEXTURE_2D;if((N.isWebGL3DRenderTarget||N.isWebGLArrayRenderTarget)&&(Q=N.isWebGL3DRenderTarget?e.TEXTURE_3D:e.TEXTURE_2D_ARRAY),n.bindTexture(Q,ft.__webglTexture),K(Q,T),T.mipmaps.length>0)for(let tt=0;tt<T.mipmaps.length;tt++)fe(W.__webglFramebuffer[tt],N,T,e.COLOR_ATTACHMENT0,Q,tt);else fe(W.__webglFramebuffer,N,T,e.COLOR_ATTACHMENT0,Q,0);S(T)?v(Q):T.mipmaps.length>0&&e.texParameteri(Q,e.TEXTURE_MAX_LEVEL,T.mipmaps.length-1),n.unbindTexture()}N.depthBuffer&&ii(N)}function G(N){let T=N.textures;for(let W=0,ft=T.length;W<ft;W++){let nt=T[W];if(S(nt)&&nt.mipmapsAutoUpdate===!0){let pt=w(N),vt=i.get(nt).__webglTexture;n.bindTexture(pt,vt),v(pt),n.unbindTexture()}}}let oi=[];function Ae(N){if(N.samples>0){if(Tt(N)===!1){let T=N.textures,W=N.width,ft=N.height,nt=e.COLOR_BUFFER_BIT,pt=N.stencilBuffer?e.DEPTH_STENCIL_ATTACHMENT:e.DEPTH_ATTACHMENT,vt=i.get(N),Q=T.length>1;if(Q)for(let gt=0;gt<T.length;gt++)n.bindFramebuffer(e.FRAMEBUFFER,vt.__webglMultisampledFramebuffer),e.framebufferRenderbuffer(e.FRAMEBUFFER,e.COLOR_ATTACHMENT0+gt,e.RENDERBUFFER,null),n.bindFramebuffer(e.FRAMEBUFFER,vt.__webglFramebuffer),e.framebufferTexture2D(e.DRAW_FRAMEBUFFER,e.COLOR_ATTACHMENT0+gt,e.TEXTURE_2D,null,0);n.bindFramebuffer(e.READ_FRAMEBUFFER,vt.__webglMultisampledFramebuffer),N.texture.mipmaps.length>0?n.bindFramebuffer(e.DRAW_FRAMEBUFFER,vt.__webglFramebuffer[0]):n.bindFramebuffer(e.DRAW_FRAMEBUFFER,vt.__webglFramebuffer);for(let gt=0;gt<T.length;gt++){if(N.resolveDepthBuffer&&(N.depthBuffer&&(nt|=e.DEPTH_BUFFER_BIT),N.stencilBuffer&&N.resolveStencilBuffer&&(nt|=e.STENCIL_BUFFER_BIT)),Q){e.framebufferRenderbuffer(e.READ_FRAMEBUFFER,e.COLOR_ATTACHMENT0,e.RENDERBUFFER,vt.__webglColorRenderbuffer[gt]);let F=i.get(T[gt]).__webglTexture;e.framebufferTexture2D(e.DRAW_FRAMEBUFFER,e.COLOR_ATTACHMENT0,e.TEXTURE_2D,F,0)}e.blitFramebuffer(0,0,W,ft,0,0,W,ft,nt,e.NEAREST),c===!0&&(oi.length=0,oi.push(e.COLOR_ATTACHMENT0+gt),N.depthBuffer&&N.storeMultisampledDepthBuffer===!1&&oi.push(pt),e.invalidateFramebuffer(e.READ_FRAMEBUFFER,oi))}if(n.bindFramebuffer(e.READ_FRAMEBUFFER,null),n.bindFramebuffer(e.DRAW_FRAMEBUFFER,null),Q)for(let gt=0;gt<T.length;gt++){n.bindFramebuffer(e.FRAMEBUFFER,vt.__webglMultisampledFramebuffer),e.framebufferRenderbuffer(e.FRAMEBUFFER,e.COLOR_ATTACHMENT0+gt,e.RENDERBUFFER,vt.__webglColorRenderbuffer[gt]);let F=i.get(T[gt]).__webglTexture;n.bindFramebuffer(e.FRAMEBUFFER,vt.__webglFramebuffer),e.framebufferTexture2D(e.DRAW_FRAMEBUFFER,e.COLOR_ATTACHMENT0+gt,e.TEXTURE_2D,F,0)}n.bindFramebuffer(e.DRAW_FRAMEBUFFER,vt.__webglMultisampledFramebuffer)}else if(N.depthBuffer&&N.storeMultisampledDepthBuffer===!1&&c){let T=N.stencilBuffer?e.DEPTH_STENCIL_ATTACHMENT:e.DEPTH_ATTACHMENT;e.invalidateFramebuffer(e.DRAW_FRAMEBUFFER,[T])}}}function Ee(N){return Math.min(r.maxSamples,N.samples)}function Tt(N){let T=i.get(N);return N.samples>0&&t.has("WEBGL_multisampled_render_to_texture")===!0&&T.__useRenderToTexture!==!1}function Ge(N){let T=o.render.frame;u.get(N)!==T&&(u.set(N,T),N.update())}function Ot(N,T){let W=N.colorSpace,ft=N.format,nt=N.type;return N.isCompressedTexture===!0||N.isVideoTexture===!0||W!==Al&&W!==jr&&(re.getTransfer(W)===de?(ft!==Xi||nt!==Hn)&&Ut("WebGLTextures: sRGB encoded textures have to use RGBAFormat and UnsignedByteType."):kt("WebGLTextures: Unsupported texture color space:",W)),T}function Gt(N){return typeof HTMLImageElement<"u"&&N instanceof HTMLImageElement?(l.width=N.naturalWidth||N.width,l.height=N.naturalHeight||N.height):typeof VideoFrame<"u"&&N instanceof VideoFrame?(l.width=N.displayWidth,l.height=N.displayHeight):(l.width=N.width,l.height=N.height),l}this.allocateTextureUnit=ct,this.resetTextureUnits=V,this.getTextureUnits=q,this.setTextureUnits=rt,this.setTexture2D=ot,this.setTexture2DArray=ut,this.setTexture3D=st,this.setTextureCube=at,this.rebindTextures=ri,this.setupRenderTarget=si,this.updateRenderTargetMipmap=G,this.updateMultisampleRenderTarget=Ae,this.setupDepthRenderbuffer=ii,this.setupFrameBufferTexture=fe,this.useMultisampledRTT=Tt,this.dispose=L}function WB(e,t){function n(i,r=jr){let s,o=re.getTransfer(r);if(i===Hn)return e.UNSIGNED_BYTE;if(i===Id)return e.UNSIGNED_SHORT_4_4_4_4;if(i===Ld)return e.UNSIGNED_SHORT_5_5_5_1;if(i===tx)return e.UNSIGNED_INT_5_9_9_9_REV;if(i===ex)return e.UNSIGNED_INT_10F_11F_11F_REV;if(i===j_)return e.BYTE;if(i===Q_)return e.SHORT;if(i===cc)return e.UNSIGNED_SHORT;if(i===Pd)return e.INT;if(i===Hi)return e.UNSIGNED_INT;if(i===Wi)return e.FLOAT;if(i===$i)return e.HALF_FLOAT;if(i===nx)return e.ALPHA;if(i===ix)return e.RGB;if(i===Xi)return e.RGBA;if(i===Xr)return e.DEPTH_COMPONENT;if(i===Kr)return e.DEPTH_STENCIL;if(i===rx)return e.RED;if(i===Nd)return e.RED_INTEGER;if(i===ks)return e.RG;if(i===Dd)return e.RG_INTEGER;if(i===Ud)return e.RGBA_INTEGER;if(i===tu||i===eu||i===nu||i===iu)if(o===de)if(s=t.get("WEBGL_compressed_texture_s3tc_srgb"),s!==null){if(i===tu)return s.COMPRESSED_SRGB_S3TC_DXT1_EXT;if(i===eu)return s.COMPRESSED_SRGB_ALPHA_S3TC_DXT1_EXT;if(i===nu)return s.COMPRESSED_SRGB_ALPHA_S3TC_DXT3_EXT;if(i===iu)return s.COMPRESSED_SRGB_ALPHA_S3TC_DXT5_EXT}else return null;else if(s=t.get("WEBGL_compressed_texture_s3tc"),s!==null){if(i===tu)return s.COMPRESSED_RGB_S3TC_DXT1_EXT;if(i===eu)return s.COMPRESSED_RGBA_S3TC_DXT1_EXT;if(i===nu)return s.COMPRESSED_RGBA_S3TC_DXT3_EXT;if(i===iu)return s.COMPRESSED_RGBA_S3TC_DXT5_EXT}else return null;if(i===Fd||i===Od||i===Bd||i===kd)if(s=t.get("WEBGL_compressed_texture_pvrtc"),s!==null){if(i===Fd)return s.COMPRESSED_RGB_PVRTC_4BPPV1_IMG;if(i===Od)return s.COMPRESSED_RGB_PVRTC_2BPPV1_IMG;if(i===Bd)return s.COMPRESSED_RGBA_PVRTC_4BPPV1_IMG;if(i===kd)return s.COMPRESSED_RGBA_PVRTC_2BPPV1_IMG}else return null;if(i===zd||i===Gd||i===Vd||i===Hd||i===Wd||i===ru||i===$d)if(s=t.get("WEBGL_compressed_texture_etc"),s!==null){if(i===zd||i===Gd)return o===de?s.COMPRESSED_SRGB8_ETC2:s.COMPRESSED_RGB8_ETC2;if(i===Vd)return o===de?s.COMPRESSED_SRGB8_ALPHA8_ETC2_EAC:s.COMPRESSED_RGBA8_ETC2_EAC;if(i===Hd)return s.COMPRESSED_R11_EAC;if(i===Wd)return s.COMPRESSED_SIGNED_R11_EAC;if(i===ru)return s.COMPRESSED_RG11_EAC;if(i===$d)return s.COMPRESSED_SIGNED_RG11_EAC}else return null;if(i===Xd||i===qd||i===Yd||i===Zd||i===Jd||i===Kd||i===jd||i===Qd||i===tp||i===ep||i===np||i===ip||i===rp||i===sp)if(s=t.get("WEBGL_compressed_texture_astc"),s!==null){if(i===Xd)return o===de?s.COMPRESSED_SRGB8_ALPHA8_ASTC_4x4_KHR:s.COMPRESSED_RGBA_ASTC_4x4_KHR;if(i===qd)return o===de?s.COMPRESSED_SRGB8_ALPHA8_ASTC_5x4_KHR:s.COMPRESSED_RGBA_ASTC_5x4_KHR;if(i===Yd)return o===de?s.COMPRESSED_SRGB8_ALPHA8_ASTC_5x5_KHR:s.COMPRESSED_RGBA_ASTC_5x5_KHR;if(i===Zd)return o===de?s.COMPRESSED_SRGB8_ALPHA8_ASTC_6x5_KHR:s.COMPRESSED_RGBA_ASTC_6x5_KHR;if(i===Jd)return o===de?s.COMPRESSED_SRGB8_ALPHA8_ASTC_6x6_KHR:s.COMPRESSED_RGBA_ASTC_6x6_KHR;if(i===Kd)return o===de?s.COMPRESSED_SRGB8_ALPHA8_ASTC_8x5_KHR:s.COMPRESSED_RGBA_ASTC_8x5_KHR;if(i===jd)return o===de?s.COMPRESSED_SRGB8_ALPHA8_ASTC_8x6_KHR:s.COMPRESSED_RGBA_ASTC_8x6_KHR;if(i===Qd)return o===de?s.COMPRESSED_SRGB8_ALPHA8_ASTC_8x8_KHR:s.COMPRESSED_RGBA_ASTC_8x8_KHR;if(i===tp)return o===de?s.COMPRESSED_SRGB8_ALPHA8_ASTC_10x5_KHR:s.COMPRESSED_RGBA_ASTC_10x5_KHR;if(i===ep)return o===de?s.COMPRESSED_SRGB8_ALPHA8_ASTC_10x6_KHR:s.COMPRESSED_RGBA_ASTC_10x6_KHR;if(i===np)return o===de?s.COMPRESSED_SRGB8_ALPHA8_ASTC_10x8_KHR:s.COMPRESSED_RGBA_ASTC_10x8_KHR;if(i===ip)return o===de?s.COMPRESSED_SRGB8_ALPHA8_ASTC_10x10_KHR:s.COMPRESSED_RGBA_ASTC_10x10_KHR;if(i===rp)return o===de?s.COMPRESSED_SRGB8_ALPHA8_ASTC_12x10_KHR:s.COMPRESSED_RGBA_ASTC_12x10_KHR;if(i===sp)return o===de?s.COMPRESSED_SRGB8_ALPHA8_ASTC_12x12_KHR:s.COMPRESSED_RGBA_ASTC_12x12_KHR}else return null;if(i===op||i===ap||i===cp)if(s=t.get("EXT_texture_compression_bptc"),s!==null){if(i===op)return o===de?s.COMPRESSED_SRGB_ALPHA_BPTC_UNORM_EXT:s.COMPRESSED_RGBA_BPTC_UNORM_EXT;if(i===ap)return s.COMPRESSED_RGB_BPTC_SIGNED_FLOAT_EXT;if(i===cp)return s.COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT_EXT}else return null;if(i===lp||i===up||i===su||i===fp)if(s=t.get("EXT_texture_compression_rgtc"),s!==null){if(i===lp)return s.COMPRESSED_RED_RGTC1_EXT;if(i===up)return s.COMPRESSED_SIGNED_RED_RGTC1_EXT;if(i===su)return s.COMPRESSED_RED_GREEN_RGTC2_EXT;if(i===fp)return s.COMPRESSED_SIGNED_RED_GREEN_RGTC2_EXT}else return null;return i===Io?e.UNSIGNED_INT_24_8:e[i]!==void 0?e[i]:null}return{convert:n}}var $B=`
void main() {

	gl_Position = vec4( position, 1.0 );

}`,XB=`
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

}`,Ax=class{constructor(){this.texture=null,this.mesh=null,this.depthNear=0,this.depthFar=0}init(t,n){if(this.texture===null){let i=new kl(t.texture);(t.depthNear!==n.depthNear||t.depthFar!==n.depthFar)&&(this.depthNear=t.depthNear,this.depthFar=t.depthFar),this.texture=i}}getMesh(t){if(this.texture!==null&&this.mesh===null){let n=t.cameras[0].viewport,i=new Ci({vertexShader:$B,fragmentShader:XB,uniforms:{depthColor:{value:this.texture},depthWidth:{value:n.z},depthHeight:{value:n.w}}});this.mesh=new ln(new Eo(20,20),i)}return this.mesh}reset(){this.texture=null,this.mesh=null}getDepthTexture(){return this.texture}},Ex=class extends Gi{constructor(t,n){super();let i=this,r=null,s=1,o=null,a="local-floor",c=1,l=null,u=null,h=null,f=null,d=null,p=null,y=typeof XRWebGLBinding<"u",m=new Ax,g={},x=n.getContextAttributes(),S=null,v=null,w=[],b=[],_=new Ft,M=null,C=null,E=new Ln;E.viewport=new pe;let I=new Ln;I.viewport=new pe;let R=[E,I],U=new Td,P=null,L=null;this.cameraAutoUpdate=!0,this.enabled=!1,this.isPresenting=!1,this.getController=function($){let ot=w[$];return ot===void 0&&(ot=new Qa,w[$]=ot),ot.getTargetRaySpace()},this.getControllerGrip=function($){let ot=w[$];return ot===void 0&&(ot=new Qa,w[$]=ot),ot.getGripSpace()},this.getHand=function($){let ot=w[$];return ot===void 0&&(ot=new Qa,w[$]=ot),ot.getHandSpace()};function O($){let ot=b.indexOf($.inputSource);if(ot===-1)return;let ut=w[ot];ut!==void 0&&(ut.update($.inputSource,$.frame,l||o),ut.dispatchEvent({type:$.type,data:$.inputSource}))}function D(){r.removeEventListener("select",O),r.removeEventListener("selectstart",O),r.removeEventListener("selectend",O),r.removeEventListener("squeeze",O),r.removeEventListener("squeezestart",O),r.removeEventListener("squeezeend",O),r.removeEventListener("end",D),r.removeEventListener("inputsourceschange",Y);for(let $=0;$<w.length;$++){let ot=b[$];ot!==null&&(b[$]=null,w[$].disconnect(ot))}P=null,L=null,m.reset();for(let $ in g)delete g[$];if(t.setRenderTarget(S),d=null,f=null,h=null,r=null,v=null,ct.stop(),i.isPresenting=!1,t.setPixelRatio(M),t.setSize(_.width,_.height,!1),C!==null){let $=C.camera;$.fov=C.fov,$.zoom=C.zoom,$.updateProjectionMatrix(),C=null}i.dispatchEvent({type:"sessionend"})}this.setFramebufferScaleFactor=function($){s=$,i.isPresenting===!0&&Ut("WebXRManager: Cannot change framebuffer scale while presenting.")},this.setReferenceSpaceType=function($){a=$,i.isPresenting===!0&&Ut("WebXRManager: Cannot change reference space type while presenting.")},this.getReferenceSpace=function(){return l||o},this.setReferenceSpace=function($){l=$},this.getBaseLayer=function(){return f!==null?f:d},this.getBinding=function(){return h===null&&y&&(h=new XRWebGLBinding(r,n)),h},this.getFrame=function(){return p},this.getSession=function(){return r},this.setSession=async function($){if(r=$,r!==null){if(S=t.getRenderTarget(),r.addEventListener("select",O),r.addEventListener("selectstart",O),r.addEventListener("selectend",O),r.addEventListener("squeeze",O),r.addEventListener("squeezestart",O),r.addEventListener("squeezeend",O),r.addEventListener("end",D),r.addEventListener("inputsourceschange",Y),x.xrCompatible!==!0&&await n.makeXRCompatible(),M=t.getPixelRatio(),t.getSize(_),y&&"createProjectionLayer"in XRWebGLBinding.prototype){let ut=null,st=null,at=null;x.depth&&(at=x.stencil?n.DEPTH24_STENCIL8:n.DEPTH_COMPONENT24,ut=x.stencil?Kr:Xr,st=x.stencil?Io:Hi);let J={colorFormat:n.RGBA8,depthFormat:at,scaleFactor:s};h=this.getBinding(),f=h.createProjectionLayer(J),r.updateRenderState({layers:[f]}),t.setPixelRatio(1),t.setSize(f.textureWidth,f.textureHeight,!1),v=new ei(f.textureWidth,f.textureHeight,{format:Xi,type:Hn,depthTexture:new Zr(f.textureWidth,f.textureHeight,st,void 0,void 0,void 0,void 0,void 0,void 0,ut),stencilBuffer:x.stencil,colorSpace:t.outputColorSpace,samples:x.antialias?4:0,resolveDepthBuffer:f.ignoreDepthValues===!1,resolveStencilBuffer:f.ignoreDepthValues===!1,storeMultisampledDepthBuffer:f.ignoreDepthValues===!1,storeMultisampledStencilBuffer:f.ignoreDepthValues===!1})}else{let ut={antialias:x.antialias,alpha:!0,depth:x.depth,stencil:x.stencil,framebufferScaleFactor:s};d=new XRWebGLLayer(r,n,ut),r.updateRenderState({baseLayer:d}),t.setPixelRatio(1),t.setSize(d.framebufferWidth,d.framebufferHeight,!1),v=new ei(d.framebufferWidth,d.framebufferHeight,{format:Xi,type:Hn,colorSpace:t.outputColorSpace,stencilBuffer:x.stencil,resolveDepthBuffer:d.ignoreDepthValues===!1,resolveStencilBuffer:d.ignoreDepthValues===!1,storeMultisampledDepthBuffer:d.ignoreDepthValues===!1,storeMultisampledStencilBuffer:d.ignoreDepthValues===!1})}v.isXRRenderTarget=!0,this.setFoveation(c),l=null,o=await r.requestReferenceSpace(a),ct.setContext(r),ct.start(),i.isPresenting=!0,i.dispatchEvent({type:"sessionstart"})}},this.getEnvironmentBlendMode=function(){if(r!==null)return r.environmentBlendMode},this.getDepthTexture=function(){return m.getDepthTexture()};function Y($){for(let ot=0;ot<$.removed.length;ot++){let ut=$.removed[ot],st=b.indexOf(ut);st>=0&&(b[st]=null,w[st].disconnect(ut))}for(let ot=0;ot<$.added.length;ot++){let ut=$.added[ot],st=b.indexOf(ut);if(st===-1){for(let J=0;J<w.length;J++)if(J>=b.length){b.push(ut),st=J;break}else if(b[J]===null){b[J]=ut,st=J;break}if(st===-1)break}let at=w[st];at&&at.connect(ut)}}function B($,ot){ot===null?$.matrixWorld.copy($.matrix):$.matrixWorld.multiplyMatrices(ot.matrixWorld,$.matrix),$.matrixWorldInverse.copy($.matrixWorld).invert()}this.updateCamera=function($){if(r===null)return;let ot=$.near,ut=$.far;m.texture!==null&&(m.depthNear>0&&(ot=m.depthNear),m.depthFar>0&&(ut=m.depthFar)),U.near=I.near=E.near=ot,U.far=I.far=E.far=ut,(P!==U.near||L!==U.far)&&(r.updateRenderState({depthNear:U.near,depthFar:U.far}),P=U.near,L=U.far),U.layers.mask=$.layers.mask|6,E.layers.mask=U.layers.mask&-5,I.layers.mask=U.layers.mask&-3;let st=$.parent,at=U.cameras;B(U,st);for(let J=0;J<at.length;J++)B(at[J],st);U.projectionMatrix.copy(E.projectionMatrix),U.projectionMatrixInverse.copy(E.projectionMatrixInverse),C===null&&$.isPerspectiveCamera&&(C={camera:$,fov:$.fov,zoom:$.zoom}),V($,U,st)};function V($,ot,ut){ut===null?$.matrix.copy(ot.matrixWorld):($.matrix.copy(ut.matrixWorld),$.matrix.invert(),$.matrix.multiply(ot.matrixWorld)),$.matrix.decompose($.position,$.quaternion,$.scale),$.updateMatrixWorld(!0),$.projectionMatrix.copy(ot.projectionMatrix),$.projectionMatrixInverse.copy(ot.projectionMatrixInverse),$.isPerspectiveCamera&&($.fov=Ka*2*Math.atan(1/$.projectionMatrix.elements[5]),$.zoom=1)}this.getCamera=function(){return U},this.getFoveation=function(){if(!(f===null&&d===null))return c},this.setFoveation=function($){c=$,f!==null&&(f.fixedFoveation=$),d!==null&&d.fixedFoveation!==void 0&&(d.fixedFoveation=$)},this.hasDepthSensing=function(){return m.texture!==null},this.getDepthSensingMesh=function(){return m.getMesh(U)},this.getCameraTexture=function($){return g[$]};let q=null;function rt($,ot){if(u=ot.getViewerPose(l||o),p=ot,u!==null){let ut=u.views;d!==null&&(t.setRenderTargetFramebuffer(v,d.framebuffer),t.setRenderTarget(v));let st=!1;ut.length!==U.cameras.length&&(U.cameras.length=0,st=!0);for(let lt=0;lt<ut.length;lt++){let K=ut[lt],Nt=null;if(d!==null)Nt=d.getViewport(K);else{let $t=h.getViewSubImage(f,K);Nt=$t.viewport,lt===0&&(t.setRenderTargetTextures(v,$t.colorTexture,$t.depthStencilTexture),t.setRenderTarget(v))}let Mt=R[lt];Mt===void 0&&(Mt=new Ln,Mt.layers.enable(lt),Mt.viewport=new pe,R[lt]=Mt),Mt.matrix.fromArray(K.transform.matrix),Mt.matrix.decompose(Mt.position,Mt.quaternion,Mt.scale),Mt.projectionMatrix.fromArray(K.projectionMatrix),Mt.projectionMatrixInverse.copy(Mt.projectionMatrix).invert(),Mt.viewport.set(Nt.x,Nt.y,Nt.width,Nt.height),lt===0&&(U.matrix.copy(Mt.matrix),U.matrix.decompose(U.position,U.quaternion,U.scale)),st===!0&&U.cameras.push(Mt)}let at=r.enabledFeatures;if(at&&at.includes("depth-sensing")&&r.depthUsage=="gpu-optimized"&&y){h=i.getBinding();let lt=h.getDepthInformation(ut[0]);lt&&lt.isValid&&lt.texture&&m.init(lt,r.renderState)}if(at&&at.includes("camera-access")&&y){t.state.unbindTexture(),h=i.getBinding();for(let lt=0;lt<ut.length;lt++){let K=ut[lt].camera;if(K){let Nt=g[K];Nt||(Nt=new kl,g[K]=Nt);let Mt=h.getCameraImage(K);Nt.sourceTexture=Mt}}}}for(let ut=0;ut<w.length;ut++){let st=b[ut],at=w[ut];st!==null&&at!==void 0&&at.update(st,ot,l||o)}q&&q($,ot),ot.detectedPlanes&&i.dispatchEvent({type:"planesdetected",data:ot}),p=null}let ct=new E2;ct.setAnimationLoop(rt),this.setAnimationLoop=function($){q=$},this.dispose=function(){}}},qB=new ee,O2=new zt;O2.set(-1,0,0,0,1,0,0,0,1);function YB(e,t){function n(m,g){m.matrixAutoUpdate===!0&&m.updateMatrix(),g.value.copy(m.matrix)}function i(m,g){g.color.getRGB(m.fogColor.value,px(e)),g.isFog?(m.fogNear.value=g.near,m.fogFar.value=g.far):g.isFogExp2&&(m.fogDensity.value=g.density)}function r(m,g,x,S,v){g.isNodeMaterial?g.uniformsNeedUpdate=!1:g.isMeshBasicMaterial?s(m,g):g.isMeshLambertMaterial?(s(m,g),g.envMap&&(m.envMapIntensity.value=g.envMapIntensity)):g.isMeshToonMaterial?(s(m,g),h(m,g)):g.isMeshPhongMaterial?(s(m,g),u(m,g),g.envMap&&(m.envMapIntensity.value=g.envMapIntensity)):g.isMeshStandardMaterial?(s(m,g),f(m,g),g.isMeshPhysicalMaterial&&d(m,g,v)):g.isMeshMatcapMaterial?(s(m,g),p(m,g)):g.isMeshDepthMaterial?s(m,g):g.isMeshDistanceMaterial?(s(m,g),y(m,g)):g.isMeshNormalMaterial?s(m,g):g.isLineBasicMaterial?(o(m,g),g.isLineDashedMaterial&&a(m,g)):g.isPointsMaterial?c(m,g,x,S):g.isSpriteMaterial?l(m,g):g.isShadowMaterial?(m.color.value.copy(g.color),m.opacity.value=g.opacity):g.isShaderMaterial&&(g.uniformsNeedUpdate=!1)}function s(m,g){m.opacity.value=g.opacity,g.color&&m.diffuse.value.copy(g.color),g.emissive&&m.emissive.value.copy(g.emissive).multiplyScalar(g.emissiveIntensity),g.map&&(m.map.value=g.map,n(g.map,m.mapTransform)),g.alphaMap&&(m.alphaMap.value=g.alphaMap,n(g.alphaMap,m.alphaMapTransform)),g.bumpMap&&(m.bumpMap.value=g.bumpMap,n(g.bumpMap,m.bumpMapTransform),m.bumpScale.value=g.bumpScale,g.side===Un&&(m.bumpScale.value*=-1)),g.normalMap&&(m.normalMap.value=g.normalMap,n(g.normalMap,m.normalMapTransform),m.normalScale.value.copy(g.normalScale),g.side===Un&&m.normalScale.value.negate()),g.displacementMap&&(m.displacementMap.value=g.displacementMap,n(g.displacementMap,m.displacementMapTransform),m.displacementScale.value=g.displacementScale,m.displacementBias.value=g.displacementBias),g.emissiveMap&&(m.emissiveMap.value=g.emissiveMap,n(g.emissiveMap,m.emissiveMapTransform)),g.specularMap&&(m.specularMap.value=g.specularMap,n(g.specularMap,m.specularMapTransform)),g.alphaTest>0&&(m.alphaTest.value=g.alphaTest);let x=t.get(g),S=x.envMap,v=x.envMapRotation;S&&(m.envMap.value=S,m.envMapRotation.value.setFromMatrix4(qB.makeRotationFromEuler(v)).transpose(),S.isCubeTexture&&S.isRenderTargetTexture===!1&&m.envMapRotation.value.premultiply(O2),m.reflectivity.value=g.reflectivity,m.ior.value=g.ior,m.refractionRatio.value=g.refractionRatio),g.lightMap&&(m.lightMap.value=g.lightMap,m.lightMapIntensity.value=g.lightMapIntensity,n(g.lightMap,m.lightMapTransform)),g.aoMap&&(m.aoMap.value=g.aoMap,m.aoMapIntensity.value=g.aoMapIntensity,n(g.aoMap,m.aoMapTransform))}function o(m,g){m.diffuse.value.copy(g.color),m.opacity.value=g.opacity,g.map&&(m.map.value=g.map,n(g.map,m.mapTransform))}function a(m,g){m.dashSize.value=g.dashSize,m.totalSize.value=g.dashSize+g.gapSize,m.scale.value=g.scale}function c(m,g,x,S){m.diffuse.value.copy(g.color),m.opacity.value=g.opacity,m.size.value=g.size*x,m.scale.value=S*.5,g.map&&(m.map.value=g.map,n(g.map,m.uvTransform)),g.alphaMap&&(m.alphaMap.value=g.alphaMap,n(g.alphaMap,m.alphaMapTransform)),g.alphaTest>0&&(m.alphaTest.value=g.alphaTest)}function l(m,g){m.diffuse.value.copy(g.color),m.opacity.value=g.opacity,m.rotation.value=g.rotation,g.map&&(m.map.value=g.map,n(g.map,m.mapTransform)),g.alphaMap&&(m.alphaMap.value=g.alphaMap,n(g.alphaMap,m.alphaMapTransform)),g.alphaTest>0&&(m.alphaTest.value=g.alphaTest)}function u(m,g){m.specular.value.copy(g.specular),m.shininess.value=Math.max(g.shininess,1e-4)}function h(m,g){g.gradientMap&&(m.gradientMap.value=g.gradientMap)}function f(m,g){m.metalness.value=g.metalness,g.metalnessMap&&(m.metalnessMap.value=g.metalnessMap,n(g.metalnessMap,m.metalnessMapTransform)),m.roughness.value=g.roughness,g.roughnessMap&&(m.roughnessMap.value=g.roughnessMap,n(g.roughnessMap,m.roughnessMapTransform)),g.envMap&&(m.envMapIntensity.value=g.envMapIntensity)}function d(m,g,x){m.ior.value=g.ior,g.diffuseRoughness>0&&(m.diffuseRoughness.value=g.diffuseRoughness,g.diffuseRoughnessMap&&(m.diffuseRoughnessMap.value=g.diffuseRoughnessMap,n(g.diffuseRoughnessMap,m.diffuseRoughnessMapTransform))),g.sheen>0&&(m.sheenColor.value.copy(g.sheenColor).multiplyScalar(g.sheen),m.sheenRoughness.value=g.sheenRoughness,g.sheenColorMap&&(m.sheenColorMap.value=g.sheenColorMap,n(g.sheenColorMap,m.sheenColorMapTransform)),g.sheenRoughnessMap&&(m.sheenRoughnessMap.value=g.sheenRoughnessMap,n(g.sheenRoughnessMap,m.sheenRoughnessMapTransform))),g.clearcoat>0&&(m.clearcoat.value=g.clearcoat,m.clearcoatRoughness.value=g.clearcoatRoughness,g.clearcoatMap&&(m.clearcoatMap.value=g.clearcoatMap,n(g.clearcoatMap,m.clearcoatMapTransform)),g.clearcoatRoughnessMap&&(m.clearcoatRoughnessMap.value=g.clearcoatRoughnessMap,n(g.clearcoatRoughnessMap,m.clearcoatRoughnessMapTransform)),g.clearcoatNormalMap&&(m.clearcoatNormalMap.value=g.clearcoatNormalMap,n(g.clearcoatNormalMap,m.clearcoatNormalMapTransform),m.clearcoatNormalScale.value.copy(g.clearcoatNormalScale),g.side===Un&&m.clearcoatNormalScale.value.negate())),g.dispersion>0&&(m.dispersion.value=g.dispersion),g.retroreflectivity>0&&(m.retroreflectivity.value=g.retroreflectivity),g.iridescence>0&&(m.iridescence.value=g.iridescence,m.iridescenceIOR.value=g.iridescenceIOR,m.iridescenceThicknessMinimum.value=g.iridescenceThicknessMinimum,m.iridescenceThicknessMaximum.value=g.iridescenceThicknessMaximum,g.iridescenceMap&&(m.iridescenceMap.value=g.iridescenceMap,n(g.iridescenceMap,m.iridescenceMapTransform)),g.iridescenceThicknessMap&&(m.iridescenceThicknessMap.value=g.iridescenceThicknessMap,n(g.iridescenceThicknessMap,m.iridescenceThicknessMapTransform))),g.transmission>0&&(m.transmission.value=g.transmission,m.transmissionSamplerMap.value=x.texture,m.transmissionSamplerSize.value.set(x.width,x.height),g.transmissionMap&&(m.transmissionMap.value=g.transmissionMap,n(g.transmissionMap,m.transmissionMapTransform)),m.thickness.value=g.thickness,g.thicknessMap&&(m.thicknessMap.value=g.thicknessMap,n(g.thicknessMap,m.thicknessMapTransform)),m.attenuationDistance.value=g.attenuationDistance,m.attenuationColor.value.copy(g.attenuationColor)),g.anisotropy>0&&(m.anisotropyVector.value.set(g.anisotropy*Math.cos(g.anisotropyRotation),g.anisotropy*Math.sin(g.anisotropyRotation)),g.anisotropyMap&&(m.anisotropyMap.value=g.anisotropyMap,n(g.anisotropyMap,m.anisotropyMapTransform))),m.specularIntensity.value=g.specularIntensity,m.specularColor.value.copy(g.specularColor),g.specularColorMap&&(m.specularColorMap.value=g.specularColorMap,n(g.specularColorMap,m.specularColorMapTransform)),g.specularIntensityMap&&(m.specularIntensityMap.value=g.specularIntensityMap,n(g.specularIntensityMap,m.specularIntensityMapTransform))}function p(m,g){g.matcap&&(m.matcap.value=g.matcap)}function y(m,g){let x=t.get(g).light;m.referencePosition.value.setFromMatrixPosition(x.matrixWorld),m.nearDistance.value=x.shadow.camera.near,m.farDistance.value=x.shadow.camera.far}return{refreshFogUniforms:i,refreshMaterialUniforms:r}}function ZB(e,t,n,i){let r={},s={};function o(x,S){let v=S.program;i.uniformBlockBinding(x,v,r[x.id])}function a(x,S){let v=r[x.id];v===void 0&&(p(x),v=c(x),r[x.id]=v,x.addEventListener("dispose",m));let w=S.program;i.updateUBOMapping(x,w);let b=t.render.frame;s[x.id]!==b&&(l(x),s[x.id]=b)}function c(x){let S=e.createBuffer(),v=x.__size,w=x.usage;return e.bindBuffer(e.UNIFORM_BUFFER,S),e.bufferData(e.UNIFORM_BUFFER,v,w),e.bindBuffer(e.UNIFORM_BUFFER,null),S}function l(x){let S=r[x.id],v=x.uniforms,w=x.__cache;e.bindBuffer(e.UNIFORM_BUFFER,S);for(let b=0,_=v.length;b<_;b++){let M=v[b];if(Array.isArray(M))for(let C=0,E=M.length;C<E;C++)u(M[C],b,C,w);else u(M,b,0,w)}e.bindBuffer(e.UNIFORM_BUFFER,null)}function u(x,S,v,w){if(f(x,S,v,w)===!0){let b=x.__offset,_=x.value;if(Array.isArray(_)){let M=0;for(let C=0;C<_.length;C++){let E=_[C],I=y(E,!0);h(E,x.__data,M),M+=I.storage/Float32Array.BYTES_PER_ELEMENT}}else h(_,x.__data,0);e.bufferSubData(e.UNIFORM_BUFFER,b,x.__data)}}function h(x,S,v){typeof x=="number"||typeof x=="boolean"?S[v]=x:x.isMatrix3?(S[v]=x.elements[0],S[v+1]=x.elements[1],S[v+2]=x.elements[2],S[v+3]=0,S[v+4]=x.elements[3],S[v+5]=x.elements[4],S[v+6]=x.elements[5],S[v+7]=0,S[v+8]=x.elements[6],S[v+9]=x.elements[7],S[v+10]=x.elements[8],S[v+11]=0):ArrayBuffer.isView(x)?S.set(x.subarray(0,S.length-v),v):x.toArray(S,v)}function f(x,S,v,w){let b=x.value,_=S+"_"+v;if(Array.isArray(b)){w[_]===void 0&&(w[_]=[]);let M=w[_],C=!1;for(let E=0;E<b.length;E++)d(b[E],M,E)===!0&&(C=!0);return C}return d(b,w,_)}function d(x,S,v){if(S[v]===void 0)return typeof x=="number"||typeof x=="boolean"?S[v]=x:ArrayBuffer.isView(x)?S[v]=x.slice():S[v]=x.clone(),!0;{let w=S[v];if(typeof x=="number"||typeof x=="boolean"){if(w!==x)return S[v]=x,!0}else{if(ArrayBuffer.isView(x))return!0;if(w.equals(x)===!1)return w.copy(x),!0}}return!1}function p(x){let S=x.uniforms,v=0,w=16;for(let _=0,M=S.length;_<M;_++){let C=Array.isArray(S[_])?S[_]:[S[_]];for(let E=0,I=C.length;E<I;E++){let R=C[E],U=Array.isArray(R.value)?R.value:[R.value],P=Array.isArray(S[_])||Array.isArray(R.value),L=v;for(let D=0,Y=U.length;D<Y;D++){let B=U[D],V=y(B,P),q=v%w,rt=q%V.boundary,ct=q+rt;v+=rt,ct!==0&&w-ct<V.storage&&(v+=w-ct),D===0&&(L=v),v+=V.storage}let O=R.type==="int"?Int32Array:R.type==="uint"?Uint32Array:Float32Array;R.__data=new O((v-L)/Float32Array.BYTES_PER_ELEMENT),R.__offset=L}}let b=v%w;return b>0&&(v+=w-b),x.__size=v,x.__cache={},this}function y(x,S){let v={boundary:0,storage:0};return typeof x=="number"||typeof x=="boolean"?(v.boundary=4,v.storage=4):x.isVector2?(v.boundary=8,v.storage=8):x.isVector3||x.isColor?(v.boundary=16,v.storage=12):x.isVector4?(v.boundary=16,v.storage=16):x.isMatrix3?(v.boundary=16,v.storage=48):x.isMatrix4?(v.boundary=16,v.storage=64):x.isTexture?Ut("WebGLRenderer: Texture samplers can not be part of an uniforms group."):ArrayBuffer.isView(x)?(v.boundary=16,v.storage=x.byteLength):Ut("WebGLRenderer: Unsupported uniform value type.",x),S===!0&&(v.boundary=16,v.storage=Math.ceil(v.storage/16)*16),v}function m(x){let S=x.target;S.removeEventListener("dispose",m),e.deleteBuffer(r[S.id]),delete r[S.id],delete s[S.id]}function g(){for(let x in r)e.deleteBuffer(r[x]);r={},s={}}return{bind:o,update:a,dispose:g}}var JB=new Uint16Array([12469,15057,12620,14925,13266,14620,13807,14376,14323,13990,14545,13625,14713,13328,14840,12882,14931,12528,14996,12233,15039,11829,15066,11525,15080,11295,15085,10976,15082,10705,15073,10495,13880,14564,13898,14542,13977,14430,14158,14124,14393,13732,14556,13410,14702,12996,14814,12596,14891,12291,14937,11834,14957,11489,14958,11194,14943,10803,14921,10506,14893,10278,14858,9960,14484,14039,14487,14025,14499,13941,14524,13740,14574,13468,14654,13106,14743,12678,14818,12344,14867,11893,14889,11509,14893,11180,14881,10751,14852,10428,14812,10128,14765,9754,14712,9466,14764,13480,14764,13475,14766,13440,14766,13347,14769,13070,14786,12713,14816,12387,14844,11957,14860,11549,14868,11215,14855,10751,14825,10403,14782,10044,14729,9651,14666,9352,14599,9029,14967,12835,14966,12831,14963,12804,14954,12723,14936,12564,14917,12347,14900,11958,14886,11569,14878,11247,14859,10765,14828,10401,14784,10011,14727,9600,14660,9289,14586,8893,14508,8533,15111,12234,15110,12234,15104,12216,15092,12156,15067,12010,15028,11776,14981,11500,14942,11205,14902,10752,14861,10393,14812,9991,14752,9570,14682,9252,14603,8808,14519,8445,14431,8145,15209,11449,15208,11451,15202,11451,15190,11438,15163,11384,15117,11274,15055,10979,14994,10648,14932,10343,14871,9936,14803,9532,14729,9218,14645,8742,14556,8381,14461,8020,14365,7603,15273,10603,15272,10607,15267,10619,15256,10631,15231,10614,15182,10535,15118,10389,15042,10167,14963,9787,14883,9447,14800,9115,14710,8665,14615,8318,14514,7911,14411,7507,14279,7198,15314,9675,15313,9683,15309,9712,15298,9759,15277,9797,15229,9773,15166,9668,15084,9487,14995,9274,14898,8910,14800,8539,14697,8234,14590,7790,14479,7409,14367,7067,14178,6621,15337,8619,15337,8631,15333,8677,15325,8769,15305,8871,15264,8940,15202,8909,15119,8775,15022,8565,14916,8328,14804,8009,14688,7614,14569,7287,14448,6888,14321,6483,14088,6171,15350,7402,15350,7419,15347,7480,15340,7613,15322,7804,15287,7973,15229,8057,15148,8012,15046,7846,14933,7611,14810,7357,14682,7069,14552,6656,14421,6316,14251,5948,14007,5528,15356,5942,15356,5977,15353,6119,15348,6294,15332,6551,15302,6824,15249,7044,15171,7122,15070,7050,14949,6861,14818,6611,14679,6349,14538,6067,14398,5651,14189,5311,13935,4958,15359,4123,15359,4153,15356,4296,15353,4646,15338,5160,15311,5508,15263,5829,15188,6042,15088,6094,14966,6001,14826,5796,14678,5543,14527,5287,14377,4985,14133,4586,13869,4257,15360,1563,15360,1642,15358,2076,15354,2636,15341,3350,15317,4019,15273,4429,15203,4732,15105,4911,14981,4932,14836,4818,14679,4621,14517,4386,14359,4156,14083,3795,13808,3437,15360,122,15360,137,15358,285,15355,636,15344,1274,15322,2177,15281,2765,15215,3223,15120,3451,14995,3569,14846,3567,14681,3466,14511,3305,14344,3121,14037,2800,13753,2467,15360,0,15360,1,15359,21,15355,89,15346,253,15325,479,15287,796,15225,1148,15133,1492,15008,1749,14856,1882,14685,1886,14506,1783,14324,1608,13996,1398,13702,1183]),yr=null;function KB(){return yr===null&&(yr=new od(JB,16,16,ks,$i),yr.name="DFG_LUT",yr.minFilter=Nn,yr.magFilter=Nn,yr.wrapS=pr,yr.wrapT=pr,yr.generateMipmaps=!1,yr.needsUpdate=!0),yr}var yp=class{constructor(t={}){let{canvas:n=QE(),context:i=null,depth:r=!0,stencil:s=!1,alpha:o=!1,antialias:a=!1,premultipliedAlpha:c=!0,preserveDrawingBuffer:l=!1,powerPreference:u="default",failIfMajorPerformanceCaveat:h=!1,reversedDepthBuffer:f=!1,outputBufferType:d=Hn}=t;this.isWebGLRenderer=!0;let p;if(i!==null){if(typeof WebGLRenderingContext<"u"&&i instanceof WebGLRenderingContext)throw new Error("THREE.WebGLRenderer: WebGL 1 is not supported since r163.");p=i.getContextAttributes().alpha}else p=o;let y=d,m=new Set([Ud,Dd,Nd]),g=new Set([Hn,Hi,cc,Io,Id,Ld]),x=new Uint32Array(4),S=new Int32Array(4),v={textures:[],min:[],max:[],resolution:[]},w=null,b=null,_=[],M=[],C=null;this.domElement=n,this.debug={checkShaderErrors:!0,diagnostics:{keywords:!1},onShaderError:null},this.autoClear=!0,this.autoClearColor=!0,this.autoClearDepth=!0,this.autoClearStencil=!0,this.sortObjects=!0,this.clippingPlanes=[],this.localClippingEnabled=!1,this.toneMapping=gr,this.toneMappingExposure=1,this.transmissionResolutionScale=1;let E=this,I=!1,R=null,U=null,P=null,L=null;this._outputColorSpace=jn;let O=0,D=0,Y=null,B=-1,V=null,q=new pe,rt=new pe,ct=null,$=new Wt(0),ot=0,ut=n.width,st=n.height,at=1,J=null,_t=null,lt=new pe(0,0,ut,st),K=new pe(0,0,ut,st),Nt=!1,Mt=new Es,$t=new ad,Zt=!1,ye=!1,fe=new ee,yn=new k,Ze=new pe,ii={background:null,fog:null,environment:null,overrideMaterial:null,isScene:!0},ri=!1;function si(){return Y===null?at:1}let G=i;function oi(A,z){return n.getContext(A,z)}let Ae,Ee,Tt,Ge,Ot,Gt,N,T,W,ft,nt,pt,vt,Q,tt,gt,F,et,j,yt,dt,mt,Lt;try{let A={alpha:!0,depth:r,stencil:s,antialias:a,premultipliedAlpha:c,preserveDrawingBuffer:l,powerPreference:u,failIfMajorPerformanceCaveat:h};if("setAttribute"in n&&n.setAttribute("data-engine",`three.js r${"187"}`),n.addEventListener("webglcontextlost",Dt,!1),n.addEventListener("webglcontextrestored",Jt,!1),n.addEventListener("webglcontextcreationerror",At,!1),G===null){let z="webgl2";if(G=oi(z,A),G===null)throw oi(z)?new Error("THREE.WebGLRenderer: Error creating WebGL context with your selected attributes."):new Error("THREE.WebGLRenderer: Error creating WebGL context.")}Kt()}catch(A){throw n.removeEventListener("webglcontextlost",Dt,!1),n.removeEventListener("webglcontextrestored",Jt,!1),n.removeEventListener("webglcontextcreationerror",At,!1),kt("WebGLRenderer: "+A.message),A}function Kt(){Ae=new c5(G),Ae.init(),dt=new WB(G,Ae),Ee=new K4(G,Ae,t,dt),Tt=new VB(G,Ae),Ee.reversedDepthBuffer&&f&&Tt.buffers.depth.setReversed(!0),U=G.createFramebuffer(),P=G.createFramebuffer(),L=G.createFramebuffer(),Ge=new f5(G),Ot=new CB,Gt=new HB(G,Ae,Tt,Ot,Ee,dt,Ge),N=new a5(E),T=new dF(G),mt=new Z4(G,T),W=new l5(G,T,Ge,mt),ft=new d5(G,W,T,mt,Ge),et=new h5(G,Ee,Gt),tt=new j4(Ot),nt=new EB(E,N,Ae,Ee,mt,tt),pt=new YB(E,Ot),vt=new PB,Q=new FB(Ae),F=new Y4(E,N,Tt,ft,p,c),gt=new GB(E,ft,Ee),Lt=new ZB(G,Ge,Ee,Tt),j=new J4(G,Ae,Ge),yt=new u5(G,Ae,Ge),Ge.programs=nt.programs,E.capabilities=Ee,E.extensions=Ae,E.properties=Ot,E.renderLists=vt,E.shadowMap=gt,E.state=Tt,E.info=Ge}y!==Hn&&(C=new m5(y,n.width,n.height,a,r,s));let ht=new Ex(E,G);this.xr=ht,this.getContext=function(){return G},this.getContextAttributes=function(){return G.getContextAttributes()},this.forceContextLoss=function(){let A=Ae.get("WEBGL_lose_context");A&&A.loseContext()},this.forceContextRestore=function(){let A=Ae.get("WEBGL_lose_context");A&&A.restoreContext()},this.getPixelRatio=function(){return at},this.setPixelRatio=function(A){A!==void 0&&(at=A,this.setSize(ut,st,!1))},this.getSize=function(A){return A.set(ut,st)},this.setSize=function(A,z,Z=!0){if(ht.isPresenting){Ut("WebGLRenderer: Can't change size while VR device is presenting.");return}ut=A,st=z,n.width=Math.floor(A*at),n.height=Math.floor(z*at),Z===!0&&(n.style.width=A+"px",n.style.height=z+"px"),C!==null&&C.setSize(n.width,n.height),this.setViewport(0,0,A,z)},this.getDrawingBufferSize=function(A){return A.set(ut*at,st*at).floor()},this.setDrawingBufferSize=function(A,z,Z){ut=A,st=z,at=Z,n.width=Math.floor(A*Z),n.height=Math.floor(z*Z),this.setViewport(0,0,A,z)},this.setEffects=function(A){if(y===Hn){kt("WebGLRenderer: setEffects() requires outputBufferType set to HalfFloatType or FloatType.");return}if(A){for(let z=0;z<A.length;z++)if(A[z].isOutputPass===!0){Ut("WebGLRenderer: OutputPass is not needed in setEffects(). Tone mapping and color space conversion are applied automatically.");break}}C.setEffects(A||[])},this.getCurrentViewport=function(A){return A.copy(q)},this.getViewport=function(A){return A.copy(lt)},this.setViewport=function(A,z,Z,H){A.isVector4?lt.set(A.x,A.y,A.z,A.w):lt.set(A,z,Z,H),Tt.viewport(q.copy(lt).multiplyScalar(si()).round())},this.getScissor=function(A){return A.copy(K)},this.setScissor=function(A,z,Z,H){A.isVector4?K.set(A.x,A.y,A.z,A.w):K.set(A,z,Z,H),Tt.scissor(rt.copy(K).multiplyScalar(si()).round())},this.getScissorTest=function(){return Nt},this.setScissorTest=function(A){Tt.setScissorTest(Nt=A)},this.setOpaqueSort=function(A){J=A},this.setTransparentSort=function(A){_t=A},this.getClearColor=function(A){return A.copy(F.getClearColor())},this.setClearColor=function(){F.setClearColor(...arguments)},this.getClearAlpha=function(){return F.getClearAlpha()},this.setClearAlpha=function(){F.setClearAlpha(...arguments)},this.clear=function(A=!0,z=!0,Z=!0){let H=0;if(A){let X=!1;if(Y!==null){let bt=Y.texture.format;X=m.has(bt)}if(X){let bt=Y.texture.type,Ct=g.has(bt),xt=F.getClearColor(),Et=F.getClearAlpha(),It=xt.r,Vt=xt.g,ne=xt.b;Ct?(x[0]=It,x[1]=Vt,x[2]=ne,x[3]=Et,G.clearBufferuiv(G.COLOR,0,x)):(S[0]=It,S[1]=Vt,S[2]=ne,S[3]=Et,G.clearBufferiv(G.COLOR,0,S))}else H|=G.COLOR_BUFFER_BIT}z&&(H|=G.DEPTH_BUFFER_BIT,this.state.buffers.depth.setMask(!0)),Z&&(H|=G.STENCIL_BUFFER_BIT,this.state.buffers.stencil.setMask(4294967295)),H!==0&&G.clear(H)},this.clearColor=function(){this.clear(!0,!1,!1)},this.clearDepth=function(){this.clear(!1,!0,!1)},this.clearStencil=function(){this.clear(!1,!1,!0)},this.setNodesHandler=function(A){A.setRenderer(this),R=A},this.dispose=function(){n.removeEventListener("webglcontextlost",Dt,!1),n.removeEventListener("webglcontextrestored",Jt,!1),n.removeEventListener("webglcontextcreationerror",At,!1),F.dispose(),vt.dispose(),Q.dispose(),Gt.dispose(),Ot.dispose(),N.dispose(),ft.dispose(),W.dispose(),mt.dispose(),Lt.dispose(),nt.dispose(),ht.dispose(),ht.removeEventListener("sessionstart",kx),ht.removeEventListener("sessionend",zx),Gs.stop()};function Dt(A){A.preventDefault(),Rl("WebGLRenderer: Context Lost."),I=!0}function Jt(){Rl("WebGLRenderer: Context Restored."),I=!1;let A=Ge.autoReset,z=gt.enabled,Z=gt.autoUpdate,H=gt.needsUpdate,X=gt.type;Kt(),Ge.autoReset=A,gt.enabled=z,gt.autoUpdate=Z,gt.needsUpdate=H,gt.type=X}function At(A){kt("WebGLRenderer: A WebGL context could not be created. Reason: ",A.statusMessage)}function me(A){let z=A.target;z.removeEventListener("dispose",me),Je(z)}function Je(A){Qr(A),Ot.remove(A)}function Qr(A){let z=Ot.get(A).programs;z!==void 0&&(z.forEach(function(Z){nt.releaseProgram(Z)}),A.isShaderMaterial&&nt.releaseShaderCache(A))}this.renderBufferDirect=function(A,z,Z,H,X,bt){z===null&&(z=ii);let Ct=X.isMesh&&X.matrixWorld.determinantAffine()<0,xt=K2(A,z,Z,H,X);Tt.setMaterial(H,Ct);let Et=Z.index,It=1;if(H.wireframe===!0){if(Et=W.getWireframeAttribute(Z),Et===void 0)return;It=2}let Vt=Z.drawRange,ne=Z.attributes.position,Rt=Vt.start*It,ie=(Vt.start+Vt.count)*It;bt!==null&&(Rt=Math.max(Rt,bt.start*It),ie=Math.min(ie,(bt.start+bt.count)*It)),Et!==null?(Rt=Math.max(Rt,0),ie=Math.min(ie,Et.count)):ne!=null&&(Rt=Math.max(Rt,0),ie=Math.min(ie,ne.count));let Be=ie-Rt;if(Be<0||Be===1/0)return;mt.setup(X,H,xt,Z,Et);let Me,xe=j;if(Et!==null&&(Me=T.get(Et),xe=yt,xe.setIndex(Me)),X.isMesh)H.wireframe===!0?(Tt.setLineWidth(H.wireframeLinewidth*si()),xe.setMode(G.LINES)):xe.setMode(G.TRIANGLES);else if(X.isLine){let _n=H.linewidth;_n===void 0&&(_n=1),Tt.setLineWidth(_n*si()),X.isLineSegments?xe.setMode(G.LINES):X.isLineLoop?xe.setMode(G.LINE_LOOP):xe.setMode(G.LINE_STRIP)}else X.isPoints?xe.setMode(G.POINTS):X.isSprite&&xe.setMode(G.TRIANGLES);if(X.isBatchedMesh)if(Ae.get("WEBGL_multi_draw"))xe.renderMultiDraw(X._multiDrawStarts,X._multiDrawCounts,X._multiDrawCount);else{let _n=X._multiDrawStarts,Pt=X._multiDrawCounts,Tn=X._multiDrawCount,ce=Et?T.get(Et).bytesPerElement:1,Vs=Ot.get(H).currentProgram.getUniforms();for(let xn=0;xn<Tn;xn++)Vs.setValue(G,"_gl_DrawID",xn),xe.render(_n[xn]/ce,Pt[xn])}else if(X.isInstancedMesh)xe.renderInstances(Rt,Be,X.count);else if(Z.isInstancedBufferGeometry){let _n=Z._maxInstanceCount!==void 0?Z._maxInstanceCount:1/0,Pt=Math.min(Z.instanceCount,_n);xe.renderInstances(Rt,Be,Pt)}else xe.render(Rt,Be)};function Bx(A,z,Z,H){R!==null&&A.isNodeMaterial&&R.setObject(H,A),Zt===!0&&tt.setState(A,Z,!1),A.transparent===!0&&A.side===Ri&&A.forceSinglePass===!1?(A.side=Un,A.needsUpdate=!0,dc(A,z,H),A.side=Bs,A.needsUpdate=!0,dc(A,z,H),A.side=Ri):dc(A,z,H)}this.compile=function(A,z,Z=null){Z===null&&(Z=A),R!==null&&R.renderStart(A,z,Z),b=Q.get(Z),b.init(z),M.push(b),Z.traverseVisible(function(X){X.isLight&&X.layers.test(z.layers)&&(b.pushLight(X),X.castShadow&&b.pushShadow(X))}),A!==Z&&A.traverseVisible(function(X){X.isLight&&X.layers.test(z.layers)&&(b.pushLight(X),X.castShadow&&b.pushShadow(X))}),b.setupLights(),R!==null&&R.updateLights(b.state.lightsArray),ye=this.localClippingEnabled,Zt=tt.init(this.clippingPlanes,ye),Zt===!0&&tt.setGlobalState(this.clippingPlanes,z),R!==null&&gt.render(b.state.shadowsArray,Z,z);let H=new Set;return A.traverse(function(X){if(!(X.isMesh||X.isPoints||X.isLine||X.isSprite))return;let bt=X.material;if(bt)if(Array.isArray(bt))for(let Ct=0;Ct<bt.length;Ct++){let xt=bt[Ct];Bx(xt,Z,z,X),H.add(xt)}else Bx(bt,Z,z,X),H.add(bt)}),b=M.pop(),R!==null&&R.renderEnd(),H},this.compileAsync=function(A,z,Z=null){let H=this.compile(A,z,Z);return new Promise(X=>{function bt(){if(H.forEach(function(Ct){let Et=Ot.get(Ct).currentProgram;(Et===void 0||Et.isReady())&&H.delete(Ct)}),H.size===0){X(A);return}setTimeout(bt,10)}Ae.get("KHR_parallel_shader_compile")!==null?bt():setTimeout(bt,10)})};let Rp=null;function Z2(A){Rp&&Rp(A)}function kx(){Gs.stop()}function zx(){Gs.start()}let Gs=new E2;Gs.setAnimationLoop(Z2),typeof self<"u"&&Gs.setContext(self),this.setAnimationLoop=function(A){Rp=A,ht.setAnimationLoop(A),A===null?Gs.stop():Gs.start()},ht.addEventListener("sessionstart",kx),ht.addEventListener("sessionend",zx),this.render=function(A,z){if(z!==void 0&&z.isCamera!==!0){kt("WebGLRenderer.render: camera is not an instance of THREE.Camera.");return}if(I===!0)return;R!==null&&R.renderStart(A,z);let Z=ht.enabled===!0&&ht.isPresenting===!0,H=C!==null&&(Y===null||Z)&&C.begin(E,Y);if(A.matrixWorldAutoUpdate===!0&&A.updateMatrixWorld(),z.parent===null&&z.matrixWorldAutoUpdate===!0&&z.updateMatrixWorld(),ht.enabled===!0&&ht.isPresenting===!0&&(C===null||C.isCompositing()===!1)&&(ht.cameraAutoUpdate===!0&&ht.updateCamera(z),z=ht.getCamera()),A.isScene===!0&&A.onBeforeRender(E,A,z,Y),b=Q.get(A,M.length),b.init(z),b.state.textureUnits=Gt.getTextureUnits(),M.push(b),fe.multiplyMatrices(z.projectionMatrix,z.matrixWorldInverse),z.isArrayCamera?$t.setFromArrayCamera(z):Mt.setFromProjectionMatrix(fe,Ai,z.reversedDepth),ye=this.localClippingEnabled,Zt=tt.init(this.clippingPlanes,ye),w=vt.get(A,_.length),w.init(),_.push(w),this.info.render.frame++,ht.enabled===!0&&ht.isPresenting===!0){let Ct=E.xr.getDepthSensingMesh();Ct!==null&&Pp(Ct,z,-1/0,E.sortObjects)}Pp(A,z,0,E.sortObjects),w.finish(),R!==null&&R.updateLights(b.state.lightsArray),E.sortObjects===!0&&w.sort(J,_t),ri=ht.enabled===!1||ht.isPresenting===!1||ht.hasDepthSensing()===!1,ri&&F.addToRenderList(w,A),this.info.autoReset===!0&&this.info.reset(),Zt===!0&&tt.beginShadows();let X=b.state.shadowsArray;if(gt.render(X,A,z),Zt===!0&&tt.endShadows(),(H&&C.hasRenderPass())===!1){let Ct=w.opaque,xt=w.transmissive;if(b.setupLights(),z.isArrayCamera){let Et=z.cameras;if(xt.length>0)for(let It=0,Vt=Et.length;It<Vt;It++){let ne=Et[It];Vx(Ct,xt,A,ne)}ri&&F.render(A);for(let It=0,Vt=Et.length;It<Vt;It++){let ne=Et[It];Gx(w,A,ne,ne.viewport)}}else xt.length>0&&Vx(Ct,xt,A,z),ri&&F.render(A),Gx(w,A,z)}Y!==null&&D===0&&(Gt.updateMultisampleRenderTarget(Y),Gt.updateRenderTargetMipmap(Y)),H&&C.end(E),A.isScene===!0&&A.onAfterRender(E,A,z),mt.resetDefaultState(),B=-1,V=null,M.pop(),M.length>0?(b=M[M.length-1],Gt.setTextureUnits(b.state.textureUnits),Zt===!0&&tt.setGlobalState(E.clippingPlanes,b.state.camera)):b=null,_.pop(),_.length>0?w=_[_.length-1]:w=null,R!==null&&R.renderEnd()};function Pp(A,z,Z,H){if(A.visible===!1)return;if(A.layers.test(z.layers)){if(A.isGroup)Z=A.renderOrder;else if(A.isLOD)A.autoUpdate===!0&&A.update(z);else if(A.isLight)b.pushLight(A),A.castShadow&&b.pushShadow(A);else if(A.isSprite){let Ct=z.isArrayCamera?$t:Mt;if(!A.frustumCulled||A.intersectsFrustum(Ct)){H&&Ze.setFromMatrixPosition(A.matrixWorld).applyMatrix4(fe);let xt=ft.update(A),Et=A.material;Et.visible&&w.push(A,xt,Et,Z,Ze.z,null,z)}}else if(A.isMesh||A.isLine||A.isPoints){let Ct=z.isArrayCamera?$t:Mt;if(!A.frustumCulled||A.intersectsFrustum(Ct)){let xt=ft.update(A),Et=A.material;if(H&&(A.boundingSphere!==void 0?(A.boundingSphere===null&&A.computeBoundingSphere(),Ze.copy(A.boundingSphere.center)):(xt.boundingSphere===null&&xt.computeBoundingSphere(),Ze.copy(xt.boundingSphere.center)),Ze.applyMatrix4(A.matrixWorld).applyMatrix4(fe)),Array.isArray(Et)){let It=xt.groups;for(let Vt=0,ne=It.length;Vt<ne;Vt++){let Rt=It[Vt],ie=Et[Rt.materialIndex];ie&&ie.visible&&w.push(A,xt,ie,Z,Ze.z,Rt,z)}}else Et.visible&&w.push(A,xt,Et,Z,Ze.z,null,z)}}}let bt=A.children;for(let Ct=0,xt=bt.length;Ct<xt;Ct++)Pp(bt[Ct],z,Z,H)}function Gx(A,z,Z,H){let{opaque:X,transmissive:bt,transparent:Ct}=A;b.setupLightsView(Z),Zt===!0&&tt.setGlobalState(E.clippingPlanes,Z),H&&Tt.viewport(q.copy(H)),X.length>0&&hu(X,z,Z),bt.length>0&&hu(bt,z,Z),Ct.length>0&&hu(Ct,z,Z),Tt.buffers.depth.setTest(!0),Tt.buffers.depth.setMask(!0),Tt.buffers.color.setMask(!0),Tt.setPolygonOffset(!1)}function Vx(A,z,Z,H){if((Z.isScene===!0?Z.overrideMaterial:null)!==null)return;if(b.state.transmissionRenderTarget[H.id]===void 0){let Rt=Ae.has("EXT_color_buffer_half_float")||Ae.has("EXT_color_buffer_float");b.state.transmissionRenderTarget[H.id]=new ei(1,1,{generateMipmaps:!0,type:Rt?$i:Hn,minFilter:Jr,samples:Math.max(4,Ee.samples),stencilBuffer:s,resolveDepthBuffer:!1,resolveStencilBuffer:!1,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,colorSpace:re.workingColorSpace})}let bt=b.state.transmissionRenderTarget[H.id],Ct=H.viewport||q;bt.setSize(Ct.z*E.transmissionResolutionScale,Ct.w*E.transmissionResolutionScale);let xt=E.getRenderTarget(),Et=E.getActiveCubeFace(),It=E.getActiveMipmapLevel();E.setRenderTarget(bt),E.getClearColor($),ot=E.getClearAlpha(),ot<1&&E.setClearColor(16777215,.5),E.clear(),ri&&F.render(Z);let Vt=E.toneMapping;E.toneMapping=gr;let ne=H.viewport;if(H.viewport!==void 0&&(H.viewport=void 0),b.setupLightsView(H),Zt===!0&&tt.setGlobalState(E.clippingPlanes,H),hu(A,Z,H),Gt.updateMultisampleRenderTarget(bt),Gt.updateRenderTargetMipmap(bt),Ae.has("WEBGL_multisampled_render_to_texture")===!1){let Rt=!1;for(let ie=0,Be=z.length;ie<Be;ie++){let Me=z[ie],{object:xe,geometry:_n,material:Pt,group:Tn}=Me;if(Pt.side===Ri&&xe.layers.test(H.layers)){let ce=Pt.side;Pt.side=Un,Pt.needsUpdate=!0,Hx(xe,Z,H,_n,Pt,Tn),Pt.side=ce,Pt.needsUpdate=!0,Rt=!0}}Rt===!0&&(Gt.updateMultisampleRenderTarget(bt),Gt.updateRenderTargetMipmap(bt))}E.setRenderTarget(xt,Et,It),E.setClearColor($,ot),ne!==void 0&&(H.viewport=ne),E.toneMapping=Vt}function hu(A,z,Z){let H=z.isScene===!0?z.overrideMaterial:null;for(let X=0,bt=A.length;X<bt;X++){let Ct=A[X],{object:xt,geometry:Et,group:It}=Ct,Vt=Ct.material;Vt.allowOverride===!0&&H!==null&&(Vt=H),xt.layers.test(Z.layers)&&Hx(xt,z,Z,Et,Vt,It)}}function Hx(A,z,Z,H,X,bt){R!==null&&X.isNodeMaterial&&R.setObject(A,X),A.onBeforeRender(E,z,Z,H,X,bt),A.modelViewMatrix.multiplyMatrices(Z.matrixWorldInverse,A.matrixWorld),A.normalMatrix.getNormalMatrix(A.modelViewMatrix),X.onBeforeRender(E,z,Z,H,A,bt),X.transparent===!0&&X.side===Ri&&X.forceSinglePass===!1?(X.side=Un,X.needsUpdate=!0,E.renderBufferDirect(Z,z,H,X,A,bt),X.side=Bs,X.needsUpdate=!0,E.renderBufferDirect(Z,z,H,X,A,bt),X.side=Ri):E.renderBufferDirect(Z,z,H,X,A,bt),A.onAfterRender(E,z,Z,H,X,bt)}function Wx(A){let z=0;for(let Z of A)Z.texture!==null&&z++;return z}function dc(A,z,Z){z.isScene!==!0&&(z=ii);let H=Ot.get(A),X=b.state.lights,bt=b.state.shadowsArray,Ct=X.state.version,xt=nt.getParameters(A,X.state,bt,z,Z,b.state.lightProbeGridArray),Et=nt.getProgramCacheKey(xt),It=H.programs;H.environment=A.isMeshStandardMaterial||A.isMeshLambertMaterial||A.isMeshPhongMaterial?z.environment:null,H.fog=z.fog;let Vt=A.isMeshStandardMaterial||A.isMeshLambertMaterial&&!A.envMap||A.isMeshPhongMaterial&&!A.envMap;H.envMap=N.get(A.envMap||H.environment,Vt),H.envMapRotation=H.environment!==null&&A.envMap===null?z.environmentRotation:A.envMapRotation,It===void 0&&(A.addEventListener("dispose",me),It=new Map,H.programs=It,H.programVariants=new Map);let ne=It.get(Et);if(ne!==void 0){if(H.currentProgram===ne&&H.lightsStateVersion===Ct)return Xx(A,xt),ne}else xt.uniforms=nt.getUniforms(A),R!==null&&A.isNodeMaterial&&R.build(A,Z,xt),A.onBeforeCompile(xt,E),ne=nt.acquireProgram(xt,Et),It.set(Et,ne),H.uniforms=xt.uniforms;let Rt=H.uniforms;return(!A.isShaderMaterial&&!A.isRawShaderMaterial||A.clipping===!0)&&(Rt.clippingPlanes=tt.uniform),Xx(A,xt),H.needsLights=Q2(A),H.lightsStateVersion=Ct,H.needsLights&&(Rt.ambientLightColor.value=X.state.ambient,Rt.lightProbe.value=X.state.probe,Rt.sunLights.value=X.state.sun,Rt.sunLightShadows.value=X.state.sunShadow,Rt.directionalLights.value=X.state.directional,Rt.directionalLightShadows.value=X.state.directionalShadow,Rt.spotLights.value=X.state.spot,Rt.spotLightShadows.value=X.state.spotShadow,Rt.rectAreaLights.value=X.state.rectArea,Rt.ltc_1.value=X.state.rectAreaLTC1,Rt.ltc_2.value=X.state.rectAreaLTC2,Rt.pointLights.value=X.state.point,Rt.pointLightShadows.value=X.state.pointShadow,Rt.hemisphereLights.value=X.state.hemi,Rt.sunShadowMatrix.value=X.state.sunShadowMatrix,Rt.sunShadowCascade.value=X.state.sunShadowCascade,Rt.directionalShadowMatrix.value=X.state.directionalShadowMatrix,Rt.spotLightMatrix.value=X.state.spotLightMatrix,Rt.spotLightMap.value=X.state.spotLightMap,Rt.pointShadowMatrix.value=X.state.pointShadowMatrix),H.numLightProbeGrids=Wx(b.state.lightProbeGridArray),H.currentProgram=ne,H.uniformsList=null,ne}function J2(A,z,Z,H,X){let bt=Ot.get(A),Ct=bt.currentProgram.id+","+H+","+X,xt=bt.programVariants.get(Ct);return xt===void 0?(xt=dc(A,z,Z),bt.programVariants.set(Ct,xt)):(bt.currentProgram=xt,bt.uniformsList=null,bt.outputColorSpace=H,bt.toneMapping=X),xt}function $x(A){if(A.uniformsList===null){let z=A.currentProgram.getUniforms();A.uniformsList=lc.seqWithValue(z.seq,A.uniforms)}return A.uniformsList}function Xx(A,z){let Z=Ot.get(A);Z.outputColorSpace=z.outputColorSpace,Z.batching=z.batching,Z.batchingColor=z.batchingColor,Z.instancing=z.instancing,Z.instancingColor=z.instancingColor,Z.instancingMorph=z.instancingMorph,Z.skinning=z.skinning,Z.morphTargets=z.morphTargets,Z.morphNormals=z.morphNormals,Z.morphColors=z.morphColors,Z.morphTargetsCount=z.morphTargetsCount,Z.numClippingPlanes=z.numClippingPlanes,Z.numIntersection=z.numClipIntersection,Z.vertexAlphas=z.vertexAlphas,Z.vertexTangents=z.vertexTangents,Z.toneMapping=z.toneMapping}function K2(A,z,Z,H,X){z.isScene!==!0&&(z=ii),Gt.resetTextureUnits();let bt=z.fog,Ct=H.isMeshStandardMaterial||H.isMeshLambertMaterial||H.isMeshPhongMaterial?z.environment:null,xt=Y===null?E.outputColorSpace:Y.isXRRenderTarget===!0?Y.texture.colorSpace:re.workingColorSpace,Et=H.isMeshStandardMaterial||H.isMeshLambertMaterial&&!H.envMap||H.isMeshPhongMaterial&&!H.envMap,It=N.get(H.envMap||Ct,Et),Vt=H.vertexColors===!0&&!!Z.attributes.color&&Z.attributes.color.itemSize===4,ne=!!Z.attributes.tangent&&(!!H.normalMap||H.anisotropy>0),Rt=!!Z.morphAttributes.position,ie=!!Z.morphAttributes.normal,Be=!!Z.morphAttributes.color,Me=gr;H.toneMapped&&(Y===null||Y.isXRRenderTarget===!0)&&(Me=E.toneMapping);let xe=Z.morphAttributes.position||Z.morphAttributes.normal||Z.morphAttributes.color,_n=xe!==void 0?xe.length:0,Pt=Ot.get(H),Tn=b.state.lights;if(Zt===!0&&(ye===!0||A!==V)){let Ce=A===V&&H.id===B;tt.setState(H,A,Ce)}let ce=!1,Vs=!1;H.version===Pt.__version?Pt.needsLights&&Pt.lightsStateVersion!==Tn.state.version||X.isBatchedMesh&&Pt.batching===!1||!X.isBatchedMesh&&Pt.batching===!0||X.isBatchedMesh&&Pt.batchingColor===!0&&X._colorsTexture===null||X.isBatchedMesh&&Pt.batchingColor===!1&&X._colorsTexture!==null||X.isInstancedMesh&&Pt.instancing===!1||!X.isInstancedMesh&&Pt.instancing===!0||X.isSkinnedMesh&&Pt.skinning===!1||!X.isSkinnedMesh&&Pt.skinning===!0||X.isInstancedMesh&&Pt.instancingColor===!0&&X.instanceColor===null||X.isInstancedMesh&&Pt.instancingColor===!1&&X.instanceColor!==null||X.isInstancedMesh&&Pt.instancingMorph===!0&&X.morphTexture===null||X.isInstancedMesh&&Pt.instancingMorph===!1&&X.morphTexture!==null||Pt.envMap!==It||H.fog===!0&&Pt.fog!==bt||Pt.numClippingPlanes!==void 0&&(Pt.numClippingPlanes!==tt.numPlanes||Pt.numIntersection!==tt.numIntersection)||Pt.vertexAlphas!==Vt||Pt.vertexTangents!==ne||Pt.morphTargets!==Rt||Pt.morphNormals!==ie||Pt.morphColors!==Be||Pt.morphTargetsCount!==_n||Pt.numLightProbeGrids!==Wx(b.state.lightProbeGridArray)?ce=!0:(Pt.outputColorSpace!==xt||Pt.toneMapping!==Me)&&(Vs=!0):(ce=!0,Pt.__version=H.version);let xn=Pt.currentProgram;(ce===!0||Vs===!0)&&(xn=Vs===!0?J2(H,z,X,xt,Me):dc(H,z,X),R&&H.isNodeMaterial&&R.onUpdateProgram(H,xn,Pt));let du=!1,ts=!1,Hs=!1,se=xn.getUniforms(),un=Pt.uniforms;if(Tt.useProgram(xn.program)&&(du=!0,ts=!0,Hs=!0),H.id!==B&&(B=H.id,ts=!0),du||V!==A){Tt.buffers.depth.getReversed()&&A.reversedDepth!==!0&&(A._reversedDepth=!0,A.updateProjectionMatrix()),se.setValue(G,"projectionMatrix",A.projectionMatrix),se.setValue(G,"viewMatrix",A.matrixWorldInverse);let Ke=se.map.cameraPosition;Ke!==void 0&&Ke.setValue(G,yn.setFromMatrixPosition(A.matrixWorld)),Ee.logarithmicDepthBuffer&&se.setValue(G,"logDepthBufFC",2/(Math.log(A.far+1)/Math.LN2)),(H.isMeshPhongMaterial||H.isMeshToonMaterial||H.isMeshLambertMaterial||H.isMeshBasicMaterial||H.isMeshStandardMaterial||H.isShaderMaterial)&&se.setValue(G,"isOrthographic",A.isOrthographicCamera===!0),V!==A&&(V=A,ts=!0,Hs=!0)}if(Pt.needsLights&&(Tn.state.sunShadowMap.length>0&&se.setValue(G,"sunShadowMap",Tn.state.sunShadowMap,Gt),Tn.state.directionalShadowMap.length>0&&se.setValue(G,"directionalShadowMap",Tn.state.directionalShadowMap,Gt),Tn.state.spotShadowMap.length>0&&se.setValue(G,"spotShadowMap",Tn.state.spotShadowMap,Gt),Tn.state.pointShadowMap.length>0&&se.setValue(G,"pointShadowMap",Tn.state.pointShadowMap,Gt)),X.isSkinnedMesh){se.setOptional(G,X,"bindMatrix"),se.setOptional(G,X,"bindMatrixInverse");let Ce=X.skeleton;Ce&&(Ce.boneTexture===null&&Ce.computeBoneTexture(),se.setValue(G,"boneTexture",Ce.boneTexture,Gt))}X.isBatchedMesh&&(se.setOptional(G,X,"batchingTexture"),se.setValue(G,"batchingTexture",X._matricesTexture,Gt),se.setOptional(G,X,"batchingIdTexture"),se.setValue(G,"batchingIdTexture",X._indirectTexture,Gt),se.setOptional(G,X,"batchingColorTexture"),X._colorsTexture!==null&&se.setValue(G,"batchingColorTexture",X._colorsTexture,Gt));let Pi=Z.morphAttributes;if((Pi.position!==void 0||Pi.normal!==void 0||Pi.color!==void 0)&&et.update(X,Z,xn),(ts||Pt.receiveShadow!==X.receiveShadow)&&(Pt.receiveShadow=X.receiveShadow,se.setValue(G,"receiveShadow",X.receiveShadow)),(H.isMeshStandardMaterial||H.isMeshLambertMaterial||H.isMeshPhongMaterial)&&H.envMap===null&&z.environment!==null&&(un.envMapIntensity.value=z.environmentIntensity),un.dfgLUT!==void 0&&(un.dfgLUT.value=KB()),ts){if(se.setValue(G,"toneMappingExposure",E.toneMappingExposure),Pt.needsLights&&j2(un,Hs),bt&&H.fog===!0&&pt.refreshFogUniforms(un,bt),pt.refreshMaterialUniforms(un,H,at,st,b.state.transmissionRenderTarget[A.id]),Pt.needsLights&&Pt.numLightProbeGrids>0){let Ce=v,Ke=0;for(let br of b.state.lightProbeGridArray)br.texture!==null&&(Ce.textures[Ke]=br.texture,Ce.min[Ke]=br.boundingBox.min,Ce.max[Ke]=br.boundingBox.max,Ce.resolution[Ke]=br.resolution,Ke++);for(let br in Ce)Ce[br].length=Ke;un.probesSH.value=Ce.textures,un.probesMin.value=Ce.min,un.probesMax.value=Ce.max,un.probesResolution.value=Ce.resolution}lc.upload(G,$x(Pt),un,Gt)}if(H.isShaderMaterial&&H.uniformsNeedUpdate===!0&&(lc.upload(G,$x(Pt),un,Gt),H.uniformsNeedUpdate=!1),H.isSpriteMaterial&&se.setValue(G,"center",X.center),se.setValue(G,"modelViewMatrix",X.modelViewMatrix),se.setValue(G,"normalMatrix",X.normalMatrix),se.setValue(G,"modelMatrix",X.matrixWorld),H.uniformsGroups!==void 0){let Ce=H.uniformsGroups;for(let Ke=0,br=Ce.length;Ke<br;Ke++){let Yx=Ce[Ke];Lt.update(Yx,xn),Lt.bind(Yx,xn)}}return xn}function j2(A,z){A.ambientLightColor.needsUpdate=z,A.lightProbe.needsUpdate=z,A.sunLights.needsUpdate=z,A.sunLightShadows.needsUpdate=z,A.directionalLights.needsUpdate=z,A.directionalLightShadows.needsUpdate=z,A.pointLights.needsUpdate=z,A.pointLightShadows.needsUpdate=z,A.spotLights.needsUpdate=z,A.spotLightShadows.needsUpdate=z,A.rectAreaLights.needsUpdate=z,A.hemisphereLights.needsUpdate=z}function Q2(A){return A.isMeshLambertMaterial||A.isMeshToonMaterial||A.isMeshPhongMaterial||A.isMeshStandardMaterial||A.isShadowMaterial||A.isShaderMaterial&&A.lights===!0}this.getActiveCubeFace=function(){return O},this.getActiveMipmapLevel=function(){return D},this.getRenderTarget=function(){return Y},this.setRenderTargetTextures=function(A,z,Z){let H=Ot.get(A);H.__autoAllocateDepthBuffer=A.resolveDepthBuffer===!1,H.__autoAllocateDepthBuffer===!1&&(H.__useRenderToTexture=!1),Ot.get(A.texture).__webglTexture=z,Ot.get(A.depthTexture).__webglTexture=H.__autoAllocateDepthBuffer?void 0:Z,H.__hasExternalTextures=!0},this.setRenderTargetFramebuffer=function(A,z){let Z=Ot.get(A);Z.__webglFramebuffer=z,Z.__useDefaultFramebuffer=z===void 0},this.setRenderTarget=function(A,z=0,Z=0){Y=A,O=z,D=Z;let H=null,X=!1,bt=!1;if(A){let xt=Ot.get(A);if(xt.__useDefaultFramebuffer!==void 0){Tt.bindFramebuffer(G.FRAMEBUFFER,xt.__webglFramebuffer),q.copy(A.viewport),rt.copy(A.scissor),ct=A.scissorTest,Tt.viewport(q),Tt.scissor(rt),Tt.setScissorTest(ct),B=-1;return}else if(xt.__webglFramebuffer===void 0)Gt.setupRenderTarget(A);else if(xt.__hasExternalTextures)Gt.rebindTextures(A,Ot.get(A.texture).__webglTexture,Ot.get(A.depthTexture).__webglTexture);else if(A.depthBuffer){let Vt=A.depthTexture;if(xt.__boundDepthTexture!==Vt){if(Vt!==null&&Ot.has(Vt)&&(A.width!==Vt.image.width||A.height!==Vt.image.height))throw new Error("THREE.WebGLRenderer: Attached DepthTexture is initialized to the incorrect size.");Gt.setupDepthRenderbuffer(A)}}let Et=A.texture;(Et.isData3DTexture||Et.isDataArrayTexture||Et.isCompressedArrayTexture)&&(bt=!0);let It=Ot.get(A).__webglFramebuffer;A.isWebGLCubeRenderTarget?(Array.isArray(It[z])?H=It[z][Z]:H=It[z],X=!0):A.samples>0&&Gt.useMultisampledRTT(A)===!1?H=Ot.get(A).__webglMultisampledFramebuffer:Array.isArray(It)?H=It[Z]:H=It,q.copy(A.viewport),rt.copy(A.scissor),ct=A.scissorTest}else q.copy(lt).multiplyScalar(at).floor(),rt.copy(K).multiplyScalar(at).floor(),ct=Nt;if(Z!==0&&(H=U),Tt.bindFramebuffer(G.FRAMEBUFFER,H)&&Tt.drawBuffers(A,H),Tt.viewport(q),Tt.scissor(rt),Tt.setScissorTest(ct),X){let xt=Ot.get(A.texture);G.framebufferTexture2D(G.FRAMEBUFFER,G.COLOR_ATTACHMENT0,G.TEXTURE_CUBE_MAP_POSITIVE_X+z,xt.__webglTexture,Z)}else if(bt){let xt=z;for(let Et=0;Et<A.textures.length;Et++){let It=Ot.get(A.textures[Et]);G.framebufferTextureLayer(G.FRAMEBUFFER,G.COLOR_ATTACHMENT0+Et,It.__webglTexture,Z,xt)}}else if(A!==null&&Z!==0){let xt=Ot.get(A.texture);G.framebufferTexture2D(G.FRAMEBUFFER,G.COLOR_ATTACHMENT0,G.TEXTURE_2D,xt.__webglTexture,Z)}B=-1};function qx(A){let z=Ot.get(A);return(z.__readFormat!==A.format||z.__readType!==A.type)&&(z.__readFormat=A.format,z.__readType=A.type,z.__formatReadable=Ee.textureFormatReadable(A.format),z.__typeReadable=Ee.textureTypeReadable(A.type)),z}this.readRenderTargetPixels=function(A,z,Z,H,X,bt,Ct,xt=0){if(!(A&&A.isWebGLRenderTarget)){kt("WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");return}let Et=Ot.get(A).__webglFramebuffer;if(A.isWebGLCubeRenderTarget&&Ct!==void 0&&(Et=Et[Ct],Array.isArray(Et)&&(Et=Et[0])),Et){Tt.bindFramebuffer(G.FRAMEBUFFER,Et);try{let It=A.textures[xt],Vt=It.format,ne=It.type;A.textures.length>1&&G.readBuffer(G.COLOR_ATTACHMENT0+xt);let Rt=qx(It);if(Rt.__formatReadable===!1){kt("WebGLRenderer.readRenderTargetPixels: renderTarget is not in RGBA or implementation defined format.");return}if(Rt.__typeReadable===!1){kt("WebGLRenderer.readRenderTargetPixels: renderTarget is not in UnsignedByteType or implementation defined type.");return}z>=0&&z<=A.width-H&&Z>=0&&Z<=A.height-X&&G.readPixels(z,Z,H,X,dt.convert(Vt),dt.convert(ne),bt)}finally{let It=Y!==null?Ot.get(Y).__webglFramebuffer:null;Tt.bindFramebuffer(G.FRAMEBUFFER,It)}}},this.readRenderTargetPixelsAsync=async function(A,z,Z,H,X,bt,Ct,xt=0){if(!(A&&A.isWebGLRenderTarget))throw new Error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");let Et=Ot.get(A).__webglFramebuffer;if(A.isWebGLCubeRenderTarget&&Ct!==void 0&&(Et=Et[Ct],Array.isArray(Et)&&(Et=Et[0])),Et)if(z>=0&&z<=A.width-H&&Z>=0&&Z<=A.height-X){Tt.bindFramebuffer(G.FRAMEBUFFER,Et);let It=A.textures[xt],Vt=It.format,ne=It.type;A.textures.length>1&&G.readBuffer(G.COLOR_ATTACHMENT0+xt);let Rt=qx(It);if(Rt.__formatReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in RGBA or implementation defined format.");if(Rt.__typeReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in UnsignedByteType or implementation defined type.");let ie=G.createBuffer();G.bindBuffer(G.PIXEL_PACK_BUFFER,ie),G.bufferData(G.PIXEL_PACK_BUFFER,bt.byteLength,G.STREAM_READ),G.readPixels(z,Z,H,X,dt.convert(Vt),dt.convert(ne),0),G.bindBuffer(G.PIXEL_PACK_BUFFER,null);let Be=Y!==null?Ot.get(Y).__webglFramebuffer:null;Tt.bindFramebuffer(G.FRAMEBUFFER,Be);let Me=G.fenceSync(G.SYNC_GPU_COMMANDS_COMPLETE,0);return G.flush(),await e2(G,Me,4),G.bindBuffer(G.PIXEL_PACK_BUFFER,ie),G.getBufferSubData(G.PIXEL_PACK_BUFFER,0,bt),G.bindBuffer(G.PIXEL_PACK_BUFFER,null),G.deleteBuffer(ie),G.deleteSync(Me),bt}else throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: requested read bounds are out of range.")},this.copyFramebufferToTexture=function(A,z=null,Z=0){let H=Math.pow(2,-Z),X=Math.floor(A.image.width*H),bt=Math.floor(A.image.height*H),Ct=z!==null?z.x:0,xt=z!==null?z.y:0;Gt.setTexture2D(A,0),G.copyTexSubImage2D(G.TEXTURE_2D,Z,0,0,Ct,xt,X,bt),Tt.unbindTexture()},this.copyTextureToTexture=function(A,z,Z=null,H=null,X=0,bt=0){let Ct,xt,Et,It,Vt,ne,Rt,ie,Be,Me=A.isCompressedTexture?A.mipmaps[bt]:A.image;if(Z!==null)Ct=Z.max.x-Z.min.x,xt=Z.max.y-Z.min.y,Et=Z.isBox3?Z.max.z-Z.min.z:1,It=Z.min.x,Vt=Z.min.y,ne=Z.isBox3?Z.min.z:0;else{let se=Math.pow(2,-X);Ct=Math.floor(Me.width*se),xt=Math.floor(Me.height*se),A.isDataArrayTexture?Et=Me.depth:A.isData3DTexture?Et=Math.floor(Me.depth*se):Et=1,It=0,Vt=0,ne=0}H!==null?(Rt=H.x,ie=H.y,Be=H.z):(Rt=0,ie=0,Be=0);let xe=dt.convert(z.format),_n=dt.convert(z.type),Pt;z.isData3DTexture?(Gt.setTexture3D(z,0),Pt=G.TEXTURE_3D):z.isDataArrayTexture||z.isCompressedArrayTexture?(Gt.setTexture2DArray(z,0),Pt=G.TEXTURE_2D_ARRAY):(Gt.setTexture2D(z,0),Pt=G.TEXTURE_2D),Tt.activeTexture(G.TEXTURE0),Tt.pixelStorei(G.UNPACK_FLIP_Y_WEBGL,z.flipY),Tt.pixelStorei(G.UNPACK_PREMULTIPLY_ALPHA_WEBGL,z.premultiplyAlpha),Tt.pixelStorei(G.UNPACK_ALIGNMENT,z.unpackAlignment);let Tn=Tt.getParameter(G.UNPACK_ROW_LENGTH),ce=Tt.getParameter(G.UNPACK_IMAGE_HEIGHT),Vs=Tt.getParameter(G.UNPACK_SKIP_PIXELS),xn=Tt.getParameter(G.UNPACK_SKIP_ROWS),du=Tt.getParameter(G.UNPACK_SKIP_IMAGES);Tt.pixelStorei(G.UNPACK_ROW_LENGTH,Me.width),Tt.pixelStorei(G.UNPACK_IMAGE_HEIGHT,Me.height),Tt.pixelStorei(G.UNPACK_SKIP_PIXELS,It),Tt.pixelStorei(G.UNPACK_SKIP_ROWS,Vt),Tt.pixelStorei(G.UNPACK_SKIP_IMAGES,ne);let ts=A.isDataArrayTexture||A.isData3DTexture,Hs=z.isDataArrayTexture||z.isData3DTexture;if(A.isDepthTexture){let se=Ot.get(A),un=Ot.get(z),Pi=Ot.get(se.__renderTarget),Ce=Ot.get(un.__renderTarget);Tt.bindFramebuffer(G.READ_FRAMEBUFFER,Pi.__webglFramebuffer),Tt.bindFramebuffer(G.DRAW_FRAMEBUFFER,Ce.__webglFramebuffer);for(let Ke=0;Ke<Et;Ke++)ts&&(G.framebufferTextureLayer(G.READ_FRAMEBUFFER,G.COLOR_ATTACHMENT0,Ot.get(A).__webglTexture,X,ne+Ke),G.framebufferTextureLayer(G.DRAW_FRAMEBUFFER,G.COLOR_ATTACHMENT0,Ot.get(z).__webglTexture,bt,Be+Ke)),G.blitFramebuffer(It,Vt,It+Ct,Vt+xt,Rt,ie,Rt+Ct,ie+xt,G.DEPTH_BUFFER_BIT,G.NEAREST);Tt.bindFramebuffer(G.READ_FRAMEBUFFER,null),Tt.bindFramebuffer(G.DRAW_FRAMEBUFFER,null)}else if(X!==0||A.isRenderTargetTexture||Ot.has(A)){let se=Ot.get(A),un=Ot.get(z);Tt.bindFramebuffer(G.READ_FRAMEBUFFER,P),Tt.bindFramebuffer(G.DRAW_FRAMEBUFFER,L);for(let Pi=0;Pi<Et;Pi++)ts?G.framebufferTextureLayer(G.READ_FRAMEBUFFER,G.COLOR_ATTACHMENT0,se.__webglTexture,X,ne+Pi):G.framebufferTexture2D(G.READ_FRAMEBUFFER,G.COLOR_ATTACHMENT0,G.TEXTURE_2D,se.__webglTexture,X),Hs?G.framebufferTextureLayer(G.DRAW_FRAMEBUFFER,G.COLOR_ATTACHMENT0,un.__webglTexture,bt,Be+Pi):G.framebufferTexture2D(G.DRAW_FRAMEBUFFER,G.COLOR_ATTACHMENT0,G.TEXTURE_2D,un.__webglTexture,bt),X!==0?G.blitFramebuffer(It,Vt,It+Ct,Vt+xt,Rt,ie,Rt+Ct,ie+xt,G.COLOR_BUFFER_BIT,G.NEAREST):Hs?G.copyTexSubImage3D(Pt,bt,Rt,ie,Be+Pi,It,Vt,Ct,xt):G.copyTexSubImage2D(Pt,bt,Rt,ie,It,Vt,Ct,xt);Tt.bindFramebuffer(G.READ_FRAMEBUFFER,null),Tt.bindFramebuffer(G.DRAW_FRAMEBUFFER,null)}else Hs?A.isDataTexture||A.isData3DTexture?G.texSubImage3D(Pt,bt,Rt,ie,Be,Ct,xt,Et,xe,_n,Me.data):z.isCompressedArrayTexture?G.compressedTexSubImage3D(Pt,bt,Rt,ie,Be,Ct,xt,Et,xe,Me.data):G.texSubImage3D(Pt,bt,Rt,ie,Be,Ct,xt,Et,xe,_n,Me):A.isDataTexture?G.texSubImage2D(G.TEXTURE_2D,bt,Rt,ie,Ct,xt,xe,_n,Me.data):A.isCompressedTexture?G.compressedTexSubImage2D(G.TEXTURE_2D,bt,Rt,ie,Me.width,Me.height,xe,Me.data):G.texSubImage2D(G.TEXTURE_2D,bt,Rt,ie,Ct,xt,xe,_n,Me);Tt.pixelStorei(G.UNPACK_ROW_LENGTH,Tn),Tt.pixelStorei(G.UNPACK_IMAGE_HEIGHT,ce),Tt.pixelStorei(G.UNPACK_SKIP_PIXELS,Vs),Tt.pixelStorei(G.UNPACK_SKIP_ROWS,xn),Tt.pixelStorei(G.UNPACK_SKIP_IMAGES,du),bt===0&&z.generateMipmaps===!0&&z.mipmapsAutoUpdate===!0&&G.generateMipmap(Pt),Tt.unbindTexture()},this.initRenderTarget=function(A){Ot.get(A).__webglFramebuffer===void 0&&Gt.setupRenderTarget(A)},this.initTexture=function(A){A.isCubeTexture?Gt.setTextureCube(A,0):A.isData3DTexture?Gt.setTexture3D(A,0):A.isDataArrayTexture||A.isCompressedArrayTexture?Gt.setTexture2DArray(A,0):Gt.setTexture2D(A,0),Tt.unbindTexture()},this.resetState=function(){O=0,D=0,Y=null,Tt.reset(),mt.reset()},typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}get coordinateSystem(){return Ai}get outputColorSpace(){return this._outputColorSpace}set outputColorSpace(t){this._outputColorSpace=t;let n=this.getContext();n.drawingBufferColorSpace=re._getDrawingBufferColorSpace(t),n.unpackColorSpace=re._getUnpackColorSpace()}};var B2={type:"change"},Rx={type:"start"},z2={type:"end"},vp=new As,k2=new Qn,jB=Math.cos(70*ou.DEG2RAD),Ye=new k,Wn=2*Math.PI,ue={NONE:-1,ROTATE:0,DOLLY:1,PAN:2,TOUCH_ROTATE:3,TOUCH_PAN:4,TOUCH_DOLLY_PAN:5,TOUCH_DOLLY_ROTATE:6},Cx=1e-6,bp=class extends Kl{constructor(t,n=null){super(t,n),this.state=ue.NONE,this.target=new k,this.cursor=new k,this.minDistance=0,this.maxDistance=1/0,this.minZoom=0,this.maxZoom=1/0,this.minTargetRadius=0,this.maxTargetRadius=1/0,this.minPolarAngle=0,this.maxPolarAngle=Math.PI,this.minAzimuthAngle=-1/0,this.maxAzimuthAngle=1/0,this.enableDamping=!1,this.dampingFactor=.05,this.enableZoom=!0,this.zoomSpeed=1,this.enableRotate=!0,this.rotateSpeed=1,this.keyRotateSpeed=1,this.enablePan=!0,this.panSpeed=1,this.screenSpacePanning=!0,this.keyPanSpeed=7,this.zoomToCursor=!1,this.autoRotate=!1,this.autoRotateSpeed=2,this.keys={LEFT:"ArrowLeft",UP:"ArrowUp",RIGHT:"ArrowRight",BOTTOM:"ArrowDown"},this.mouseButtons={LEFT:Fs.ROTATE,MIDDLE:Fs.DOLLY,RIGHT:Fs.PAN},this.touches={ONE:Os.ROTATE,TWO:Os.DOLLY_PAN},this.target0=this.target.clone(),this.position0=this.object.position.clone(),this.zoom0=this.object.zoom,this._cursorStyle="auto",this._domElementKeyEvents=null,this._lastPosition=new k,this._lastQuaternion=new Sn,this._lastTargetPosition=new k,this._quat=new Sn().setFromUnitVectors(t.up,new k(0,1,0)),this._quatInverse=this._quat.clone().invert(),this._spherical=new rc,this._sphericalDelta=new rc,this._scale=1,this._panOffset=new k,this._rotateStart=new Ft,this._rotateEnd=new Ft,this._rotateDelta=new Ft,this._panStart=new Ft,this._panEnd=new Ft,this._panDelta=new Ft,this._dollyStart=new Ft,this._dollyEnd=new Ft,this._dollyDelta=new Ft,this._dollyDirection=new k,this._mouse=new Ft,this._performCursorZoom=!1,this._pointers=[],this._pointerPositions={},this._controlActive=!1,this._onPointerMove=t6.bind(this),this._onPointerDown=QB.bind(this),this._onPointerUp=e6.bind(this),this._onContextMenu=c6.bind(this),this._onMouseWheel=r6.bind(this),this._onKeyDown=s6.bind(this),this._onTouchStart=o6.bind(this),this._onTouchMove=a6.bind(this),this._onMouseDown=n6.bind(this),this._onMouseMove=i6.bind(this),this._interceptControlDown=l6.bind(this),this._interceptControlUp=u6.bind(this),this.domElement!==null&&this.connect(this.domElement),this.update()}set cursorStyle(t){this._cursorStyle=t,t==="grab"?this.domElement.style.cursor="grab":this.domElement.style.cursor="auto"}get cursorStyle(){return this._cursorStyle}connect(t){super.connect(t),this.domElement.addEventListener("pointerdown",this._onPointerDown),this.domElement.addEventListener("pointercancel",this._onPointerUp),this.domElement.addEventListener("contextmenu",this._onContextMenu),this.domElement.addEventListener("wheel",this._onMouseWheel,{passive:!1}),this.domElement.ownerDocument.addEventListener("keydown",this._interceptControlDown,{passive:!0,capture:!0}),this.domElement.style.touchAction="none"}disconnect(){this.state=ue.NONE,this.domElement.removeEventListener("pointerdown",this._onPointerDown),this.domElement.ownerDocument.removeEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.removeEventListener("pointerup",this._onPointerUp),this.domElement.removeEventListener("pointercancel",this._onPointerUp),this.domElement.removeEventListener("wheel",this._onMouseWheel),this.domElement.removeEventListener("contextmenu",this._onContextMenu),this.stopListenToKeyEvents(),this.domElement.ownerDocument.removeEventListener("keydown",this._interceptControlDown,{capture:!0}),this.domElement.ownerDocument.removeEventListener("keyup",this._interceptControlUp,{capture:!0}),this._controlActive=!1,this._pointers.length=0,this._pointerPositions={},this.domElement.style.touchAction="",this.domElement.style.cursor="auto"}dispose(){this.disconnect()}getPolarAngle(){return this._spherical.phi}getAzimuthalAngle(){return this._spherical.theta}getDistance(){return this.object.position.distanceTo(this.target)}listenToKeyEvents(t){t.addEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=t}stopListenToKeyEvents(){this._domElementKeyEvents!==null&&(this._domElementKeyEvents.removeEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=null)}saveState(){this.target0.copy(this.target),this.position0.copy(this.object.position),this.zoom0=this.object.zoom}reset(){this.target.copy(this.target0),this.object.position.copy(this.position0),this.object.zoom=this.zoom0,this.object.updateProjectionMatrix(),this.dispatchEvent(B2),this.update(),this.state=ue.NONE}pan(t,n){this._pan(t,n),this.update()}dollyIn(t){this._dollyIn(t),this.update()}dollyOut(t){this._dollyOut(t),this.update()}rotateLeft(t){this._rotateLeft(t),this.update()}rotateUp(t){this._rotateUp(t),this.update()}update(t=null){let n=this.object.position;Ye.copy(n).sub(this.target),Ye.applyQuaternion(this._quat),this._spherical.setFromVector3(Ye),this.autoRotate&&this.state===ue.NONE&&this._rotateLeft(this._getAutoRotationAngle(t)),this.enableDamping?(this._spherical.theta+=this._sphericalDelta.theta*this.dampingFactor,this._spherical.phi+=this._sphericalDelta.phi*this.dampingFactor):(this._spherical.theta+=this._sphericalDelta.theta,this._spherical.phi+=this._sphericalDelta.phi);let i=this.minAzimuthAngle,r=this.maxAzimuthAngle;isFinite(i)&&isFinite(r)&&(i<-Math.PI?i+=Wn:i>Math.PI&&(i-=Wn),r<-Math.PI?r+=Wn:r>Math.PI&&(r-=Wn),i<=r?this._spherical.theta=Math.max(i,Math.min(r,this._spherical.theta)):this._spherical.theta=this._spherical.theta>(i+r)/2?Math.max(i,this._spherical.theta):Math.min(r,this._spherical.theta)),this._spherical.phi=Math.max(this.minPolarAngle,Math.min(this.maxPolarAngle,this._spherical.phi)),this._spherical.makeSafe(),this.enableDamping===!0?this.target.addScaledVector(this._panOffset,this.dampingFactor):this.target.add(this._panOffset),this.target.sub(this.cursor),this.target.clampLength(this.minTargetRadius,this.maxTargetRadius),this.target.add(this.cursor);let s=!1;if(this.zoomToCursor&&this._performCursorZoom||this.object.isOrthographicCamera)this._spherical.radius=this._clampDistance(this._spherical.radius);else{let o=this._spherical.radius;this._spherical.radius=this._clampDistance(this._spherical.radius*this._scale),s=o!=this._spherical.radius}if(Ye.setFromSpherical(this._spherical),Ye.applyQuaternion(this._quatInverse),n.copy(this.target).add(Ye),this.object.lookAt(this.target),this.enableDamping===!0?(this._sphericalDelta.theta*=1-this.dampingFactor,this._sphericalDelta.phi*=1-this.dampingFactor,this._panOffset.multiplyScalar(1-this.dampingFactor)):(this._sphericalDelta.set(0,0,0),this._panOffset.set(0,0,0)),this.zoomToCursor&&this._performCursorZoom){let o=null;if(this.object.isPerspectiveCamera){let a=Ye.length();o=this._clampDistance(a*this._scale);let c=a-o;this.object.position.addScaledVector(this._dollyDirection,c),this.object.updateMatrixWorld(),s=!!c}else if(this.object.isOrthographicCamera){let a=new k(this._mouse.x,this._mouse.y,0);a.unproject(this.object);let c=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),this.object.updateProjectionMatrix(),s=c!==this.object.zoom;let l=new k(this._mouse.x,this._mouse.y,0);l.unproject(this.object),this.object.position.sub(l).add(a),this.object.updateMatrixWorld(),o=Ye.length()}else console.warn("WARNING: OrbitControls.js encountered an unknown camera type - zoom to cursor disabled."),this.zoomToCursor=!1;o!==null&&(this.screenSpacePanning?this.target.set(0,0,-1).transformDirection(this.object.matrix).multiplyScalar(o).add(this.object.position):(vp.origin.copy(this.object.position),vp.direction.set(0,0,-1).transformDirection(this.object.matrix),Math.abs(this.object.up.dot(vp.direction))<jB?this.object.lookAt(this.target):(k2.setFromNormalAndCoplanarPoint(this.object.up,this.target),vp.intersectPlane(k2,this.target))))}else if(this.object.isOrthographicCamera){let o=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),o!==this.object.zoom&&(this.object.updateProjectionMatrix(),s=!0)}return this._scale=1,this._performCursorZoom=!1,s||this._lastPosition.distanceToSquared(this.object.position)>Cx||8*(1-this._lastQuaternion.dot(this.object.quaternion))>Cx||this._lastTargetPosition.distanceToSquared(this.target)>Cx?(this.dispatchEvent(B2),this._lastPosition.copy(this.object.position),this._lastQuaternion.copy(this.object.quaternion),this._lastTargetPosition.copy(this.target),!0):!1}_getAutoRotationAngle(t){return t!==null?Wn/60*this.autoRotateSpeed*t:Wn/60/60*this.autoRotateSpeed}_getZoomScale(t){let n=Math.abs(t*.01);return Math.pow(.95,this.zoomSpeed*n)}_rotateLeft(t){this._sphericalDelta.theta-=t}_rotateUp(t){this._sphericalDelta.phi-=t}_panLeft(t,n){Ye.setFromMatrixColumn(n,0),Ye.multiplyScalar(-t),this._panOffset.add(Ye)}_panUp(t,n){this.screenSpacePanning===!0?Ye.setFromMatrixColumn(n,1):(Ye.setFromMatrixColumn(n,0),Ye.crossVectors(this.object.up,Ye)),Ye.multiplyScalar(t),this._panOffset.add(Ye)}_pan(t,n){let i=this.domElement;if(this.object.isPerspectiveCamera){let r=this.object.position;Ye.copy(r).sub(this.target);let s=Ye.length();s*=Math.tan(this.object.fov/2*Math.PI/180),this._panLeft(2*t*s/i.clientHeight,this.object.matrix),this._panUp(2*n*s/i.clientHeight,this.object.matrix)}else this.object.isOrthographicCamera?(this._panLeft(t*(this.object.right-this.object.left)/this.object.zoom/i.clientWidth,this.object.matrix),this._panUp(n*(this.object.top-this.object.bottom)/this.object.zoom/i.clientHeight,this.object.matrix)):(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - pan disabled."),this.enablePan=!1)}_dollyOut(t){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale/=t:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_dollyIn(t){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale*=t:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_updateZoomParameters(t,n){if(!this.zoomToCursor)return;this._performCursorZoom=!0;let i=this.domElement.getBoundingClientRect(),r=t-i.left,s=n-i.top,o=i.width,a=i.height;this._mouse.x=r/o*2-1,this._mouse.y=-(s/a)*2+1,this._dollyDirection.set(this._mouse.x,this._mouse.y,1).unproject(this.object).sub(this.object.position).normalize()}_clampDistance(t){return Math.max(this.minDistance,Math.min(this.maxDistance,t))}_handleMouseDownRotate(t){this._rotateStart.set(t.clientX,t.clientY)}_handleMouseDownDolly(t){this._updateZoomParameters(t.clientX,t.clientY),this._dollyStart.set(t.clientX,t.clientY)}_handleMouseDownPan(t){this._panStart.set(t.clientX,t.clientY)}_handleMouseMoveRotate(t){this._rotateEnd.set(t.clientX,t.clientY),this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);let n=this.domElement;this._rotateLeft(Wn*this._rotateDelta.x/n.clientHeight),this._rotateUp(Wn*this._rotateDelta.y/n.clientHeight),this._rotateStart.copy(this._rotateEnd),this.update()}_handleMouseMoveDolly(t){this._dollyEnd.set(t.clientX,t.clientY),this._dollyDelta.subVectors(this._dollyEnd,this._dollyStart),this._dollyDelta.y>0?this._dollyOut(this._getZoomScale(this._dollyDelta.y)):this._dollyDelta.y<0&&this._dollyIn(this._getZoomScale(this._dollyDelta.y)),this._dollyStart.copy(this._dollyEnd),this.zoomToCursor&&(this._performCursorZoom=!0,this._dollyDirection.set(this._mouse.x,this._mouse.y,1).unproject(this.object).sub(this.object.position).normalize()),this.update()}_handleMouseMovePan(t){this._panEnd.set(t.clientX,t.clientY),this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd),this.update()}_handleMouseWheel(t){this._updateZoomParameters(t.clientX,t.clientY),t.deltaY<0?this._dollyIn(this._getZoomScale(t.deltaY)):t.deltaY>0&&this._dollyOut(this._getZoomScale(t.deltaY)),this.update()}_handleKeyDown(t){let n=!1;switch(t.code){case this.keys.UP:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateUp(Wn*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(0,this.keyPanSpeed),n=!0;break;case this.keys.BOTTOM:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateUp(-Wn*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(0,-this.keyPanSpeed),n=!0;break;case this.keys.LEFT:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateLeft(Wn*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(this.keyPanSpeed,0),n=!0;break;case this.keys.RIGHT:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateLeft(-Wn*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(-this.keyPanSpeed,0),n=!0;break}n&&(t.preventDefault(),this.update())}_handleTouchStartRotate(t){if(this._pointers.length===1)this._rotateStart.set(t.pageX,t.pageY);else{let n=this._getSecondPointerPosition(t),i=.5*(t.pageX+n.x),r=.5*(t.pageY+n.y);this._rotateStart.set(i,r)}}_handleTouchStartPan(t){if(this._pointers.length===1)this._panStart.set(t.pageX,t.pageY);else{let n=this._getSecondPointerPosition(t),i=.5*(t.pageX+n.x),r=.5*(t.pageY+n.y);this._panStart.set(i,r)}}_handleTouchStartDolly(t){let n=this._getSecondPointerPosition(t),i=t.pageX-n.x,r=t.pageY-n.y,s=Math.sqrt(i*i+r*r);this._dollyStart.set(0,s)}_handleTouchStartDollyPan(t){this.enableZoom&&this._handleTouchStartDolly(t),this.enablePan&&this._handleTouchStartPan(t)}_handleTouchStartDollyRotate(t){this.enableZoom&&this._handleTouchStartDolly(t),this.enableRotate&&this._handleTouchStartRotate(t)}_handleTouchMoveRotate(t){if(this._pointers.length==1)this._rotateEnd.set(t.pageX,t.pageY);else{let i=this._getSecondPointerPosition(t),r=.5*(t.pageX+i.x),s=.5*(t.pageY+i.y);this._rotateEnd.set(r,s)}this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);let n=this.domElement;this._rotateLeft(Wn*this._rotateDelta.x/n.clientHeight),this._rotateUp(Wn*this._rotateDelta.y/n.clientHeight),this._rotateStart.copy(this._rotateEnd)}_handleTouchMovePan(t){if(this._pointers.length===1)this._panEnd.set(t.pageX,t.pageY);else{let n=this._getSecondPointerPosition(t),i=.5*(t.pageX+n.x),r=.5*(t.pageY+n.y);this._panEnd.set(i,r)}this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd)}_handleTouchMoveDolly(t){let n=this._getSecondPointerPosition(t),i=t.pageX-n.x,r=t.pageY-n.y,s=Math.sqrt(i*i+r*r);this._dollyEnd.set(0,s),this._dollyDelta.set(0,Math.pow(this._dollyEnd.y/this._dollyStart.y,this.zoomSpeed)),this._dollyOut(this._dollyDelta.y),this._dollyStart.copy(this._dollyEnd);let o=(t.pageX+n.x)*.5,a=(t.pageY+n.y)*.5;this._updateZoomParameters(o,a)}_handleTouchMoveDollyPan(t){this.enableZoom&&this._handleTouchMoveDolly(t),this.enablePan&&this._handleTouchMovePan(t)}_handleTouchMoveDollyRotate(t){this.enableZoom&&this._handleTouchMoveDolly(t),this.enableRotate&&this._handleTouchMoveRotate(t)}_addPointer(t){this._pointers.push(t.pointerId)}_removePointer(t){delete this._pointerPositions[t.pointerId];for(let n=0;n<this._pointers.length;n++)if(this._pointers[n]==t.pointerId){this._pointers.splice(n,1);return}}_isTrackingPointer(t){for(let n=0;n<this._pointers.length;n++)if(this._pointers[n]==t.pointerId)return!0;return!1}_trackPointer(t){let n=this._pointerPositions[t.pointerId];n===void 0&&(n=new Ft,this._pointerPositions[t.pointerId]=n),n.set(t.pageX,t.pageY)}_getSecondPointerPosition(t){let n=t.pointerId===this._pointers[0]?this._pointers[1]:this._pointers[0];return this._pointerPositions[n]}_customWheelEvent(t){let n=t.deltaMode,i={clientX:t.clientX,clientY:t.clientY,deltaY:t.deltaY};switch(n){case 1:i.deltaY*=16;break;case 2:i.deltaY*=100;break}return t.ctrlKey&&!this._controlActive&&(i.deltaY*=10),i}};function QB(e){this.enabled!==!1&&(this._pointers.length===0&&(this.domElement.setPointerCapture(e.pointerId),this.domElement.ownerDocument.addEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.addEventListener("pointerup",this._onPointerUp)),!this._isTrackingPointer(e)&&(this._addPointer(e),e.pointerType==="touch"?this._onTouchStart(e):this._onMouseDown(e),this._cursorStyle==="grab"&&(this.domElement.style.cursor="grabbing")))}function t6(e){this.enabled!==!1&&(e.pointerType==="touch"?this._onTouchMove(e):this._onMouseMove(e))}function e6(e){switch(this._removePointer(e),this._pointers.length){case 0:this.domElement.releasePointerCapture(e.pointerId),this.domElement.ownerDocument.removeEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.removeEventListener("pointerup",this._onPointerUp),this.dispatchEvent(z2),this.state=ue.NONE,this._cursorStyle==="grab"&&(this.domElement.style.cursor="grab");break;case 1:let t=this._pointers[0],n=this._pointerPositions[t];this._onTouchStart({pointerId:t,pageX:n.x,pageY:n.y});break}}function n6(e){let t;switch(e.button){case 0:t=this.mouseButtons.LEFT;break;case 1:t=this.mouseButtons.MIDDLE;break;case 2:t=this.mouseButtons.RIGHT;break;default:t=-1}switch(t){case Fs.DOLLY:if(this.enableZoom===!1)return;this._handleMouseDownDolly(e),this.state=ue.DOLLY;break;case Fs.ROTATE:if(e.ctrlKey||e.metaKey||e.shiftKey){if(this.enablePan===!1)return;this._handleMouseDownPan(e),this.state=ue.PAN}else{if(this.enableRotate===!1)return;this._handleMouseDownRotate(e),this.state=ue.ROTATE}break;case Fs.PAN:if(e.ctrlKey||e.metaKey||e.shiftKey){if(this.enableRotate===!1)return;this._handleMouseDownRotate(e),this.state=ue.ROTATE}else{if(this.enablePan===!1)return;this._handleMouseDownPan(e),this.state=ue.PAN}break;default:this.state=ue.NONE}this.state!==ue.NONE&&this.dispatchEvent(Rx)}function i6(e){switch(this.state){case ue.ROTATE:if(this.enableRotate===!1)return;this._handleMouseMoveRotate(e);break;case ue.DOLLY:if(this.enableZoom===!1)return;this._handleMouseMoveDolly(e);break;case ue.PAN:if(this.enablePan===!1)return;this._handleMouseMovePan(e);break}}function r6(e){this.enabled===!1||this.enableZoom===!1||this.state!==ue.NONE||(e.preventDefault(),this.dispatchEvent(Rx),this._handleMouseWheel(this._customWheelEvent(e)),this.dispatchEvent(z2))}function s6(e){this.enabled!==!1&&this._handleKeyDown(e)}function o6(e){switch(this._trackPointer(e),this._pointers.length){case 1:switch(this.touches.ONE){case Os.ROTATE:if(this.enableRotate===!1){this.state=ue.NONE;break}this._handleTouchStartRotate(e),this.state=ue.TOUCH_ROTATE;break;case Os.PAN:if(this.enablePan===!1){this.state=ue.NONE;break}this._handleTouchStartPan(e),this.state=ue.TOUCH_PAN;break;default:this.state=ue.NONE}break;case 2:switch(this.touches.TWO){case Os.DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchStartDollyPan(e),this.state=ue.TOUCH_DOLLY_PAN;break;case Os.DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchStartDollyRotate(e),this.state=ue.TOUCH_DOLLY_ROTATE;break;default:this.state=ue.NONE}break;default:this.state=ue.NONE}this.state!==ue.NONE&&this.dispatchEvent(Rx)}function a6(e){switch(this._trackPointer(e),this.state){case ue.TOUCH_ROTATE:if(this.enableRotate===!1)return;this._handleTouchMoveRotate(e),this.update();break;case ue.TOUCH_PAN:if(this.enablePan===!1)return;this._handleTouchMovePan(e),this.update();break;case ue.TOUCH_DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchMoveDollyPan(e),this.update();break;case ue.TOUCH_DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchMoveDollyRotate(e),this.update();break;default:this.state=ue.NONE}}function c6(e){this.enabled!==!1&&e.preventDefault()}function l6(e){e.key==="Control"&&(this._controlActive=!0,this.domElement.ownerDocument.addEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}function u6(e){e.key==="Control"&&(this._controlActive=!1,this.domElement.ownerDocument.removeEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}wt.line={worldUnits:{value:1},linewidth:{value:1},resolution:{value:new Ft},dashOffset:{value:0},dashScale:{value:1},dashSize:{value:1},gapSize:{value:1}};Fn.line={uniforms:au.merge([wt.common,wt.fog,wt.line]),vertexShader:`
		#include <common>
		#include <color_pars_vertex>
		#include <fog_pars_vertex>
		#include <logdepthbuf_pars_vertex>
		#include <clipping_planes_pars_vertex>

		uniform float linewidth;
		uniform vec2 resolution;

		attribute vec3 instanceStart;
		attribute vec3 instanceEnd;

		attribute vec3 instanceColorStart;
		attribute vec3 instanceColorEnd;

		#ifdef WORLD_UNITS

			varying vec4 worldPos;
			varying vec3 worldStart;
			varying vec3 worldEnd;

			#ifdef USE_DASH

				varying vec2 vUv;

			#endif

		#else

			varying vec2 vUv;

		#endif

		#ifdef USE_DASH

			uniform float dashScale;
			attribute float instanceDistanceStart;
			attribute float instanceDistanceEnd;
			varying float vLineDistance;

		#endif

		float trimSegmentAlpha( const in vec4 start, const in vec4 end ) {

			// compute the interpolation factor needed to trim the segment so it terminates
			// between the camera plane and the near plane

			// conservative estimate of the near plane
			float a = projectionMatrix[ 2 ][ 2 ]; // 3nd entry in 3th column
			float b = projectionMatrix[ 3 ][ 2 ]; // 3nd entry in 4th column

			// we need different nearEstimate formula for reversed and default depth buffer
			// a is positive with a reversed depth buffer so it can be used for controlling the code flow
			float nearEstimate = ( a > 0.0 ) ? ( - b / ( a + 1.0 ) ) : ( - 0.5 * b / a );

			return ( nearEstimate - start.z ) / ( end.z - start.z );

		}

		void main() {

			#ifdef USE_COLOR

				vColor.xyz = ( position.y < 0.5 ) ? instanceColorStart : instanceColorEnd;

			#endif

			float aspect = resolution.x / resolution.y;

			// camera space
			vec4 start = modelViewMatrix * vec4( instanceStart, 1.0 );
			vec4 end = modelViewMatrix * vec4( instanceEnd, 1.0 );

			#ifdef USE_DASH

				float lineDistanceStart = dashScale * instanceDistanceStart;
				float lineDistanceEnd = dashScale * instanceDistanceEnd;

			#endif

			#ifdef WORLD_UNITS

				worldStart = start.xyz;
				worldEnd = end.xyz;

			#else

				vUv = uv;

			#endif

			// special case for perspective projection, and segments that terminate either in, or behind, the camera plane
			// clearly the gpu firmware has a way of addressing this issue when projecting into ndc space
			// but we need to perform ndc-space calculations in the shader, so we must address this issue directly
			// perhaps there is a more elegant solution -- WestLangley

			bool perspective = ( projectionMatrix[ 2 ][ 3 ] == - 1.0 ); // 4th entry in the 3rd column

			if ( perspective ) {

				if ( start.z < 0.0 && end.z >= 0.0 ) {

					float alpha = trimSegmentAlpha( start, end );
					end.xyz = mix( start.xyz, end.xyz, alpha );

					#ifdef USE_DASH

						lineDistanceEnd = mix( lineDistanceStart, lineDistanceEnd, alpha );

					#endif

				} else if ( end.z < 0.0 && start.z >= 0.0 ) {

					float alpha = trimSegmentAlpha( end, start );
					start.xyz = mix( end.xyz, start.xyz, alpha );

					#ifdef USE_DASH

						lineDistanceStart = mix( lineDistanceEnd, lineDistanceStart, alpha );

					#endif

				}

			}

			#ifdef USE_DASH

				vLineDistance = ( position.y < 0.5 ) ? lineDistanceStart : lineDistanceEnd;
				vUv = uv;

			#endif

			// clip space
			vec4 clipStart = projectionMatrix * start;
			vec4 clipEnd = projectionMatrix * end;

			// ndc space
			vec3 ndcStart = clipStart.xyz / clipStart.w;
			vec3 ndcEnd = clipEnd.xyz / clipEnd.w;

			// direction
			vec2 dir = ndcEnd.xy - ndcStart.xy;

			// account for clip-space aspect ratio
			dir.x *= aspect;
			dir = normalize( dir );

			#ifdef WORLD_UNITS

				vec3 worldDir = normalize( end.xyz - start.xyz );
				vec3 tmpFwd = perspective ? normalize( mix( start.xyz, end.xyz, 0.5 ) ) : vec3( 0.0, 0.0, - 1.0 );
				vec3 worldUp = normalize( cross( worldDir, tmpFwd ) );
				vec3 worldFwd = cross( worldDir, worldUp );
				worldPos = position.y < 0.5 ? start: end;

				// height offset
				float hw = linewidth * 0.5;
				worldPos.xyz += position.x < 0.0 ? hw * worldUp : - hw * worldUp;

				// don't extend the line if we're rendering dashes because we
				// won't be rendering the endcaps
				#ifndef USE_DASH

					// cap extension
					worldPos.xyz += position.y < 0.5 ? - hw * worldDir : hw * worldDir;

					// add width to the box
					worldPos.xyz += worldFwd * hw;

					// endcaps
					if ( position.y > 1.0 || position.y < 0.0 ) {

						worldPos.xyz -= worldFwd * 2.0 * hw;

					}

				#endif

				// project the worldpos
				vec4 clip = projectionMatrix * worldPos;

				// shift the depth of the projected points so the line
				// segments overlap neatly
				vec3 clipPose = ( position.y < 0.5 ) ? ndcStart : ndcEnd;

				// only shift the depth of vertices in front of the camera (#35137)
				if ( clip.w > 0.0 ) clip.z = clipPose.z * clip.w;

			#else

				vec2 offset = vec2( dir.y, - dir.x );
				// undo aspect ratio adjustment
				dir.x /= aspect;
				offset.x /= aspect;

				// sign flip
				if ( position.x < 0.0 ) offset *= - 1.0;

				// endcaps
				if ( position.y < 0.0 ) {

					offset += - dir;

				} else if ( position.y > 1.0 ) {

					offset += dir;

				}

				// adjust for linewidth
				offset *= linewidth;

				// adjust for clip-space to screen-space conversion // maybe resolution should be based on viewport ...
				offset /= resolution.y;

				// select end
				vec4 clip = ( position.y < 0.5 ) ? clipStart : clipEnd;

				// back to clip space
				offset *= clip.w;

				clip.xy += offset;

			#endif

			gl_Position = clip;

			vec4 mvPosition = ( position.y < 0.5 ) ? start : end; // this is an approximation

			#include <logdepthbuf_vertex>
			#include <clipping_planes_vertex>
			#include <fog_vertex>

		}
		`,fragmentShader:`
		uniform vec3 diffuse;
		uniform float opacity;
		uniform float linewidth;

		#ifdef USE_DASH

			uniform float dashOffset;
			uniform float dashSize;
			uniform float gapSize;

		#endif

		varying float vLineDistance;

		#ifdef WORLD_UNITS

			varying vec4 worldPos;
			varying vec3 worldStart;
			varying vec3 worldEnd;

			#ifdef USE_DASH

				varying vec2 vUv;

			#endif

		#else

			varying vec2 vUv;

		#endif

		#include <common>
		#include <color_pars_fragment>
		#include <fog_pars_fragment>
		#include <logdepthbuf_pars_fragment>
		#include <clipping_planes_pars_fragment>

		vec2 closestLineToLine(vec3 p1, vec3 p2, vec3 p3, vec3 p4) {

			float mua;
			float mub;

			vec3 p13 = p1 - p3;
			vec3 p43 = p4 - p3;

			vec3 p21 = p2 - p1;

			float d1343 = dot( p13, p43 );
			float d4321 = dot( p43, p21 );
			float d1321 = dot( p13, p21 );
			float d4343 = dot( p43, p43 );
			float d2121 = dot( p21, p21 );

			float denom = d2121 * d4343 - d4321 * d4321;

			float numer = d1343 * d4321 - d1321 * d4343;

			mua = numer / denom;
			mua = clamp( mua, 0.0, 1.0 );
			mub = ( d1343 + d4321 * ( mua ) ) / d4343;
			mub = clamp( mub, 0.0, 1.0 );

			return vec2( mua, mub );

		}

		void main() {

			float alpha = opacity;
			vec4 diffuseColor = vec4( diffuse, alpha );

			#include <clipping_planes_fragment>

			#ifdef USE_DASH

				if ( vUv.y < - 1.0 || vUv.y > 1.0 ) discard; // discard endcaps

				if ( mod( vLineDistance + dashOffset, dashSize + gapSize ) > dashSize ) discard; // todo - FIX

			#endif

			#ifdef WORLD_UNITS

				float len;

				if ( isOrthographic ) {

					// View rays are parallel to the z axis so the distance reduces to camera-space XY
					vec2 lineDir = worldEnd.xy - worldStart.xy;
					float t = clamp( dot( worldPos.xy - worldStart.xy, lineDir ) / dot( lineDir, lineDir ), 0.0, 1.0 );
					len = length( worldStart.xy + lineDir * t - worldPos.xy );

				} else {

					// Find the closest points on the view ray and the line segment
					vec3 rayEnd = normalize( worldPos.xyz ) * 1e5;
					vec3 lineDir = worldEnd - worldStart;
					vec2 params = closestLineToLine( worldStart, worldEnd, vec3( 0.0, 0.0, 0.0 ), rayEnd );

					vec3 p1 = worldStart + lineDir * params.x;
					vec3 p2 = rayEnd * params.y;
					vec3 delta = p1 - p2;
					len = length( delta );

				}

				float norm = len / linewidth;

				#ifndef USE_DASH

					#ifdef USE_ALPHA_TO_COVERAGE

						float dnorm = fwidth( norm );
						alpha = 1.0 - smoothstep( 0.5 - dnorm, 0.5 + dnorm, norm );

					#else

						if ( norm > 0.5 ) {

							discard;

						}

					#endif

				#endif

			#else

				#ifdef USE_ALPHA_TO_COVERAGE

					// artifacts appear on some hardware if a derivative is taken within a conditional
					float a = vUv.x;
					float b = ( vUv.y > 0.0 ) ? vUv.y - 1.0 : vUv.y + 1.0;
					float len2 = a * a + b * b;
					float dlen = fwidth( len2 );

					if ( abs( vUv.y ) > 1.0 ) {

						alpha = 1.0 - smoothstep( 1.0 - dlen, 1.0 + dlen, len2 );

					}

				#else

					if ( abs( vUv.y ) > 1.0 ) {

						float a = vUv.x;
						float b = ( vUv.y > 0.0 ) ? vUv.y - 1.0 : vUv.y + 1.0;
						float len2 = a * a + b * b;

						if ( len2 > 1.0 ) discard;

					}

				#endif

			#endif

			#include <logdepthbuf_fragment>
			#include <color_fragment>

			gl_FragColor = vec4( diffuseColor.rgb, alpha );

			#include <tonemapping_fragment>
			#include <colorspace_fragment>
			#include <fog_fragment>
			#include <premultiplied_alpha_fragment>

		}
		`};var fc=class extends Ci{constructor(t){super({type:"LineMaterial",uniforms:au.clone(Fn.line.uniforms),vertexShader:Fn.line.vertexShader,fragmentShader:Fn.line.fragmentShader,clipping:!0}),this.isLineMaterial=!0,this.setValues(t)}get color(){return this.uniforms.diffuse.value}set color(t){this.uniforms.diffuse.value=t}get worldUnits(){return"WORLD_UNITS"in this.defines}set worldUnits(t){t===!0!==this.worldUnits&&(this.needsUpdate=!0),t===!0?this.defines.WORLD_UNITS="":delete this.defines.WORLD_UNITS}get linewidth(){return this.uniforms.linewidth.value}set linewidth(t){this.uniforms.linewidth&&(this.uniforms.linewidth.value=t)}get dashed(){return"USE_DASH"in this.defines}set dashed(t){t===!0!==this.dashed&&(this.needsUpdate=!0),t===!0?this.defines.USE_DASH="":delete this.defines.USE_DASH}get dashScale(){return this.uniforms.dashScale.value}set dashScale(t){this.uniforms.dashScale.value=t}get dashSize(){return this.uniforms.dashSize.value}set dashSize(t){this.uniforms.dashSize.value=t}get dashOffset(){return this.uniforms.dashOffset.value}set dashOffset(t){this.uniforms.dashOffset.value=t}get gapSize(){return this.uniforms.gapSize.value}set gapSize(t){this.uniforms.gapSize.value=t}get opacity(){return this.uniforms.opacity.value}set opacity(t){this.uniforms&&(this.uniforms.opacity.value=t)}get resolution(){return this.uniforms.resolution.value}set resolution(t){this.uniforms.resolution.value.copy(t)}get alphaToCoverage(){return"USE_ALPHA_TO_COVERAGE"in this.defines}set alphaToCoverage(t){this.defines&&(t===!0!==this.alphaToCoverage&&(this.needsUpdate=!0),t===!0?this.defines.USE_ALPHA_TO_COVERAGE="":delete this.defines.USE_ALPHA_TO_COVERAGE)}};var G2=new cn,Mp=new k,hc=class extends Yl{constructor(){super(),this.isLineSegmentsGeometry=!0,this.type="LineSegmentsGeometry";let t=[-1,2,0,1,2,0,-1,1,0,1,1,0,-1,0,0,1,0,0,-1,-1,0,1,-1,0],n=[-1,2,1,2,-1,1,1,1,-1,-1,1,-1,-1,-2,1,-2],i=[0,2,1,2,3,1,2,4,3,4,5,3,4,6,5,6,7,5];this.setIndex(i),this.setAttribute("position",new ge(t,3)),this.setAttribute("uv",new ge(n,2))}applyMatrix4(t){let n=this.attributes.instanceStart,i=this.attributes.instanceEnd;return n!==void 0&&(n.applyMatrix4(t),i.applyMatrix4(t),n.needsUpdate=!0),this.boundingBox!==null&&this.computeBoundingBox(),this.boundingSphere!==null&&this.computeBoundingSphere(),this}setPositions(t){let n;t instanceof Float32Array?n=t:Array.isArray(t)&&(n=new Float32Array(t));let i=new Us(n,6,1);return this.setAttribute("instanceStart",new Vi(i,3,0)),this.setAttribute("instanceEnd",new Vi(i,3,3)),this.instanceCount=this.attributes.instanceStart.count,this.computeBoundingBox(),this.computeBoundingSphere(),this}setColors(t){let n;t instanceof Float32Array?n=t:Array.isArray(t)&&(n=new Float32Array(t));let i=new Us(n,6,1);return this.setAttribute("instanceColorStart",new Vi(i,3,0)),this.setAttribute("instanceColorEnd",new Vi(i,3,3)),this}fromWireframeGeometry(t){return this.setPositions(t.attributes.position.array),this}fromEdgesGeometry(t){return this.setPositions(t.attributes.position.array),this}fromMesh(t){return this.fromWireframeGeometry(new Gl(t.geometry)),this}fromLineSegments(t){let n=t.geometry;return this.setPositions(n.attributes.position.array),this}computeBoundingBox(){this.boundingBox===null&&(this.boundingBox=new cn);let t=this.attributes.instanceStart,n=this.attributes.instanceEnd;t!==void 0&&n!==void 0&&(this.boundingBox.setFromBufferAttribute(t),G2.setFromBufferAttribute(n),this.boundingBox.union(G2))}computeBoundingSphere(){this.boundingSphere===null&&(this.boundingSphere=new Ei),this.boundingBox===null&&this.computeBoundingBox();let t=this.attributes.instanceStart,n=this.attributes.instanceEnd;if(t!==void 0&&n!==void 0){let i=this.boundingSphere.center;this.boundingBox.getCenter(i);let r=0;for(let s=0,o=t.count;s<o;s++)Mp.fromBufferAttribute(t,s),r=Math.max(r,i.distanceToSquared(Mp)),Mp.fromBufferAttribute(n,s),r=Math.max(r,i.distanceToSquared(Mp));this.boundingSphere.radius=Math.sqrt(r),isNaN(this.boundingSphere.radius)&&console.error("THREE.LineSegmentsGeometry.computeBoundingSphere(): Computed radius is NaN. The instanced position data is likely to have NaN values.",this)}}toJSON(){}};var Px=new pe,V2=new k,H2=new k,pn=new pe,mn=new pe,_r=new pe,Ix=new k,Lx=new ee,gn=new Zl,W2=new k,Sp=new cn,wp=new Ei,xr=new pe,vr,No;function $2(e,t,n){return xr.set(0,0,-t,1).applyMatrix4(e.projectionMatrix),xr.multiplyScalar(1/xr.w),xr.x=No/n.width,xr.y=No/n.height,xr.applyMatrix4(e.projectionMatrixInverse),xr.multiplyScalar(1/xr.w),Math.abs(Math.max(xr.x,xr.y))}function f6(e,t){let n=e.matrixWorld,i=e.geometry,r=i.attributes.instanceStart,s=i.attributes.instanceEnd,o=Math.min(i.instanceCount,r.count);for(let a=0,c=o;a<c;a++){gn.start.fromBufferAttribute(r,a),gn.end.fromBufferAttribute(s,a),gn.applyMatrix4(n);let l=new k,u=new k;vr.distanceSqToSegment(gn.start,gn.end,u,l),u.distanceTo(l)<No*.5&&t.push({point:u,pointOnLine:l,distance:vr.origin.distanceTo(u),object:e,face:null,faceIndex:a,uv:null,uv1:null})}}function h6(e,t,n){let i=t.projectionMatrix,s=e.material.resolution,o=e.matrixWorld,a=e.geometry,c=a.attributes.instanceStart,l=a.attributes.instanceEnd,u=Math.min(a.instanceCount,c.count),h=-t.near;vr.at(1,_r),_r.w=1,_r.applyMatrix4(t.matrixWorldInverse),_r.applyMatrix4(i),_r.multiplyScalar(1/_r.w),_r.x*=s.x/2,_r.y*=s.y/2,_r.z=0,Ix.copy(_r),Lx.multiplyMatrices(t.matrixWorldInverse,o);for(let f=0,d=u;f<d;f++){if(pn.fromBufferAttribute(c,f),mn.fromBufferAttribute(l,f),pn.w=1,mn.w=1,pn.applyMatrix4(Lx),mn.applyMatrix4(Lx),pn.z>h&&mn.z>h)continue;if(pn.z>h){let S=pn.z-mn.z,v=(pn.z-h)/S;pn.lerp(mn,v)}else if(mn.z>h){let S=mn.z-pn.z,v=(mn.z-h)/S;mn.lerp(pn,v)}pn.applyMatrix4(i),mn.applyMatrix4(i),pn.multiplyScalar(1/pn.w),mn.multiplyScalar(1/mn.w),pn.x*=s.x/2,pn.y*=s.y/2,mn.x*=s.x/2,mn.y*=s.y/2,gn.start.copy(pn),gn.start.z=0,gn.end.copy(mn),gn.end.z=0;let y=gn.closestPointToPointParameter(Ix,!0);gn.at(y,W2);let m=ou.lerp(pn.z,mn.z,y),g=m>=-1&&m<=1,x=Ix.distanceTo(W2)<No*.5;if(g&&x){gn.start.fromBufferAttribute(c,f),gn.end.fromBufferAttribute(l,f),gn.start.applyMatrix4(o),gn.end.applyMatrix4(o);let S=new k,v=new k;vr.distanceSqToSegment(gn.start,gn.end,v,S),n.push({point:v,pointOnLine:S,distance:vr.origin.distanceTo(v),object:e,face:null,faceIndex:f,uv:null,uv1:null})}}}var Tp=class extends ln{constructor(t=new hc,n=new fc({color:Math.random()*16777215})){super(t,n),this.isLineSegments2=!0,this.type="LineSegments2"}computeLineDistances(){let t=this.geometry,n=t.attributes.instanceStart,i=t.attributes.instanceEnd,r=new Float32Array(2*n.count);for(let o=0,a=0,c=n.count;o<c;o++,a+=2)V2.fromBufferAttribute(n,o),H2.fromBufferAttribute(i,o),r[a]=a===0?0:r[a-1],r[a+1]=r[a]+V2.distanceTo(H2);let s=new Us(r,2,1);return t.setAttribute("instanceDistanceStart",new Vi(s,1,0)),t.setAttribute("instanceDistanceEnd",new Vi(s,1,1)),this}raycast(t,n){let i=this.material.worldUnits,r=t.camera;if(r===null&&!i&&console.error('LineSegments2: "Raycaster.camera" needs to be set in order to raycast against LineSegments2 while worldUnits is set to false.'),i===!1&&(this.material.resolution.x===0||this.material.resolution.y===0))return;let s=t.params.Line2!==void 0&&t.params.Line2.threshold||0;vr=t.ray;let o=this.matrixWorld,a=this.geometry,c=this.material;No=c.linewidth+s,a.boundingSphere===null&&a.computeBoundingSphere(),wp.copy(a.boundingSphere).applyMatrix4(o);let l;if(i)l=No*.5;else{let h=Math.max(r.near,wp.distanceToPoint(vr.origin));l=$2(r,h,c.resolution)}if(wp.radius+=l,vr.intersectsSphere(wp)===!1)return;a.boundingBox===null&&a.computeBoundingBox(),Sp.copy(a.boundingBox).applyMatrix4(o);let u;if(i)u=No*.5;else{let h=Math.max(r.near,Sp.distanceToPoint(vr.origin));u=$2(r,h,c.resolution)}Sp.expandByScalar(u),vr.intersectsBox(Sp)!==!1&&(i?f6(this,n):h6(this,r,n))}onBeforeRender(t){let n=this.material.uniforms;n&&n.resolution&&(t.getViewport(Px),this.material.uniforms.resolution.value.set(Px.z,Px.w))}};var Nx=Math.PI/180,d6=new k(0,1,0),p6=new k(0,0,1),Ap=e=>new ee().fromArray(e);function X2(e,t,n,i){let[r,s]=[new k(...e),new k(...t)],o=s.clone().sub(r),a=i(n,o.length()),c=new Sn;return o.length()>1e-9&&c.setFromUnitVectors(d6,o.clone().normalize()),a.applyQuaternion(c),a.translate(...r.add(s).multiplyScalar(.5).toArray()),a}function m6(e){switch(e.form){case"capsule":return X2(e.from,e.to,e.radius,(t,n)=>new nc(t,n,8,24));case"box":return new Rs(...e.size);case"sphere":return new Ps(e.radius,32,20);case"cylinder":return new zl(e.radius,e.radius,e.height,32).rotateX(Math.PI/2);case"plane":{let t=new k(...e.normal),n=new Eo(4e3,4e3);return n.applyQuaternion(new Sn().setFromUnitVectors(p6,t)),n.translate(...t.multiplyScalar(e.offset).toArray())}default:{let t=new De;return t.setAttribute("position",new ze(new Float32Array(e.corners),3)),t.computeVertexNormals(),t}}}function Dx(e,t,n=1){let i=new Is({color:t,transparent:n<1,opacity:n,side:2,depthWrite:n>.5}),r=new ln(m6(e),i);return r.applyMatrix4(Ap(e.at)),r}function g6(e){let t=new Float32Array([0,0,0,e,0,0,0,0,0,0,e,0,0,0,0,0,0,e]),n=new Float32Array([.84,.2,.2,.84,.2,.2,.1,.6,.25,.1,.6,.25,.15,.4,.9,.15,.4,.9]),i=new De;i.setAttribute("position",new ze(t,3)),i.setAttribute("color",new ze(n,3));let r=new Cs(i,new Yr({vertexColors:!0,depthTest:!1}));return r.renderOrder=3,r}function y6(e,t){let n=[Ap(e.base)];for(let i=0;i<6;i+=1){let r=t[i];for(let{joint:f,on:d,ratio:p}of e.coupling)f===i&&(r+=p*t[d]);let[s,o,a,c,l]=e.rows[i],u=(c+e.sign[i]*r+e.offset[i])*Nx,h=new ee().makeRotationX(s*Nx).multiply(new ee().makeTranslation(o,0,0)).multiply(new ee().makeRotationY(a*Nx)).multiply(new ee().makeRotationZ(u)).multiply(new ee().makeTranslation(0,0,l));n.push(n[i].clone().multiply(h))}return n}function q2(e){let t=new ti,n=Array.from({length:7},()=>new ti);for(let l of n)l.matrixAutoUpdate=!1,t.add(l);let i=new ti,r=new Is({color:9082019});t.add(i);let s=e.shapes.length>0;for(let l of e.shapes){let u=Dx(l,l.attached?10124111:l.link%2?14256701:13225686,.42);u.renderOrder=2,n[l.link].add(u)}let o=e.rows.reduce((l,u)=>l+Math.abs(u[1])+Math.abs(u[4]),1),a=g6(Math.max(20,o*.06));a.matrixAutoUpdate=!1,t.add(a);function c(l,u){let h=y6(e,l),f=h[6].clone().multiply(Ap(e.flange)),d=f.clone().multiply(Ap(e.tools[u]??e.tools[0]));h.forEach((m,g)=>{n[g].matrix.copy(m),n[g].matrixWorldNeedsUpdate=!0}),a.matrix.copy(d),a.matrixWorldNeedsUpdate=!0;for(let m of i.children)m.geometry.dispose();i.clear();let p=[...h,f,d].map(m=>new k().setFromMatrixPosition(m).toArray()),y=o*(s?.006:.016);for(let m=0;m+1<p.length;m+=1)if(Math.hypot(...p[m].map((x,S)=>x-p[m+1][S]))>.5){let x=m>=6?y*.6:y;i.add(new ln(X2(p[m],p[m+1],x,(S,v)=>new nc(S,v,4,12)),r))}}return{group:t,pose:c}}var Ep=e=>Zc(.1+.8*Math.max(0,Math.min(1,e))),Ux=e=>new Wt(getComputedStyle(document.documentElement).getPropertyValue(`--${e}`).trim()||"#888"),_6=6e3,Fx=class{constructor(t,n,i){this.path=t;let{at:r,by:s,starts:o}=t,a=r.length/3,c=new Set(o);this.pairs=[];for(let h=1;h<a;h+=1)c.has(h)||this.pairs.push(h);this.ends=new Float32Array(this.pairs.length*6);let l=new Float32Array(this.pairs.length*6),u=new Wt;this.pairs.forEach((h,f)=>{for(let[d,p]of[[0,h-1],[3,h]])u.set(n(p)),u.toArray(l,f*6+d)}),this.wide=this.pairs.length<=_6,this.wide?(this.geometry=new hc,this.geometry.setPositions(this.ends),this.geometry.setColors(l),this.lines=new Tp(this.geometry,new fc({linewidth:i,vertexColors:!0}))):(this.geometry=new De,this.geometry.setAttribute("position",new ze(this.ends,3)),this.geometry.setAttribute("color",new ze(l,3)),this.lines=new Cs(this.geometry,new Yr({vertexColors:!0}))),this.shift(s?1:0),this.lines.frustumCulled=!1}shift(t){let{at:n,by:i}=this.path;if(this.pairs.forEach((r,s)=>{for(let[o,a]of[[0,r-1],[3,r]])for(let c=0;c<3;c+=1){let l=a*3+c;this.ends[s*6+o+c]=n[l]+(i?t*i[l]:0)}}),this.wide){let{data:r}=this.geometry.attributes.instanceStart;r.array.set(this.ends),r.needsUpdate=!0}else this.geometry.attributes.position.needsUpdate=!0}};function x6(){let e=document.createElement("canvas");[e.width,e.height]=[32,32];let t=e.getContext("2d");return t.fillStyle="#fff",t.beginPath(),t.arc(16,16,15,0,2*Math.PI),t.fill(),new Ol(e)}var Cp=class{constructor(t,n,i){this.cell=n,this.renderer=new yp({antialias:!0,alpha:!0,preserveDrawingBuffer:!0}),this.canvas=this.renderer.domElement,this.canvas.tabIndex=0,this.canvas.setAttribute("role","img"),this.canvas.setAttribute("aria-label",`${n.title}: arrow keys turn, plus and minus come nearer and go away`),t.append(this.canvas),this.renderer.setPixelRatio(Math.min(devicePixelRatio,2)),this.scene=new Ll,this.camera=new Ln(38,1,1,1e5),this.camera.up.set(0,0,1);let r=new Xl(16777215,2.2);r.position.set(1,-1.4,2.4),this.camera.add(r),this.scene.add(new ql(16777215,1.6),this.camera),this.controls=new bp(this.camera,this.canvas),this.controls.addEventListener("change",()=>this.draw()),this.layers={paths:[]},this.magnification=1,this.build(),this.view([1,-1.2,.75]),this.listen(i),new ResizeObserver(()=>this.resize(t)).observe(t),this.resize(t)}build(){let{cell:t}=this;this.bounds=new cn;let n=i=>{let r=new k;for(let s=0;s+2<i.length;s+=3)this.bounds.expandByPoint(r.fromArray(i,s))};for(let i of t.paths)n(i.at);n(t.points.at.filter(i=>i!=null));for(let{at:i}of t.ellipsoids??[])n(i);if(this.extent=this.bounds.isEmpty()?500:Math.max(50,this.bounds.getSize(new k).length()),this.solids=new ti,this.scene.add(this.solids),t.robot){this.robot=q2(t.robot),this.scene.add(this.robot.group);let i=new k().setFromMatrixPosition(new ee().fromArray(t.robot.base));this.bounds.expandByPoint(i)}this.ground();for(let i of t.bodies)this.solids.add(Dx(i,8228776,i.form==="plane"?.15:.35));this.worst=Math.max(1e-12,...t.paths.map(i=>i.worst??0));for(let i of t.paths){let r=Ux(i.tone),s=c=>Math.hypot(i.by[3*c],i.by[3*c+1],i.by[3*c+2]),o=i.by&&i.graded?c=>Ep(s(c)/this.worst):()=>r,a=new Fx(i,o,i.by?2.6:1.6);this.layers.paths.push(a),this.scene.add(a.lines)}this.placeItems(),this.placeEllipsoids()}ground(){let t=(this.cell.robot?.rows??[]).reduce((r,s)=>r+Math.abs(s[1])+Math.abs(s[4]),0),n=200*2**Math.ceil(Math.log2(Math.max(1,this.extent,t)/100)),i=new Jl(n,16,8947848,8947848);if(i.material.transparent=!0,i.material.opacity=.18,i.rotateX(Math.PI/2),!this.cell.robot&&!this.bounds.isEmpty()){let r=this.bounds.getCenter(new k);i.position.set(r.x,r.y,this.bounds.min.z-.05*this.extent)}this.scene.add(i)}placeItems(){let{at:t}=this.cell.points,n=t.length/3;this.rows=[];for(let h=0;h<n;h+=1)t[3*h]!=null&&this.rows.push(h);let i=new De,[r,s]=[new Float32Array(3*this.rows.length),new Float32Array(3*this.rows.length)],o=new Wt,{error:a}=this.cell.points,c=(a??[]).reduce((h,f)=>Math.max(h,f??0),1e-12);this.rows.forEach((h,f)=>{r.set(t.slice(3*h,3*h+3),3*f),a?.[h]==null?o.copy(Ux("wanted")):o.set(Ep(a[h]/c)),o.toArray(s,3*f)}),i.setAttribute("position",new ze(r,3)),i.setAttribute("color",new ze(s,3));let l=(n>2e3?3:5.5)*this.renderer.getPixelRatio();this.items=new Ul(i,new ec({size:l,sizeAttenuation:!1,vertexColors:!0,map:x6(),alphaTest:.5})),this.items.frustumCulled=!1,this.scene.add(this.items);let u=new tc({color:15073406,transparent:!0,opacity:.9,depthTest:!1});this.mark=new ln(new Ps(1,20,14),u),this.mark.renderOrder=4,this.mark.visible=!1,this.scene.add(this.mark)}placeEllipsoids(){this.ellipsoids=[];let t=new Is({color:Ux("after"),transparent:!0,opacity:.4,side:Ri,depthWrite:!1});for(let{at:n,axes:i}of this.cell.ellipsoids??[]){let r=new ln(new Ps(1,24,16),t);r.matrixAutoUpdate=!1,this.scene.add(r),this.ellipsoids.push({mesh:r,at:n,axes:i})}}magnify(t){this.magnification=t;for(let n of this.layers.paths)n.path.by&&n.shift(t);for(let{mesh:n,at:i,axes:r}of this.ellipsoids){let[s,o,a]=[0,3,6].map(c=>r.slice(c,c+3).map(l=>l*t));n.matrix.set(s[0],o[0],a[0],i[0],s[1],o[1],a[1],i[1],s[2],o[2],a[2],i[2],0,0,0,1),n.matrixWorldNeedsUpdate=!0}this.draw()}select(t){let{at:n,joints:i,tool:r}=this.cell.points;if(this.mark.visible=n[3*t]!=null,this.mark.visible){let s=this.extent*.009;this.mark.position.fromArray(n,3*t),this.mark.scale.setScalar(s)}this.robot&&i&&i[6*t]!=null&&this.robot.pose(i.slice(6*t,6*t+6),r?.[t]??0),this.draw()}view(t){let n=this.bounds.isEmpty()?new cn(new k(-250,-250,0),new k(250,250,500)):this.bounds.clone();if(this.robot){let s=new cn().setFromObject(this.robot.group);s.isEmpty()||n.union(s)}let i=n.getCenter(new k),r=Math.max(60,n.getSize(new k).length())*1.35;this.controls.target.copy(i),this.camera.position.copy(i).add(new k(...t).normalize().multiplyScalar(r)),this.camera.near=r/500,this.camera.far=r*30,this.camera.updateProjectionMatrix(),this.controls.update(),this.draw()}near(){let t=new cn,n=new k;for(let o of this.cell.paths)for(let a=0;a+2<o.at.length;a+=3)t.expandByPoint(n.fromArray(o.at,a));if(t.isEmpty())return;let i=t.getCenter(new k),r=Math.max(20,t.getSize(new k).length())*1.25,s=this.camera.position.clone().sub(this.controls.target).normalize();this.controls.target.copy(i),this.camera.position.copy(i).addScaledVector(s,r),this.controls.update(),this.draw()}listen(t){let n=null;this.canvas.addEventListener("pointerdown",r=>{n=[r.clientX,r.clientY]}),this.canvas.addEventListener("pointerup",r=>{if(!n||Math.hypot(r.clientX-n[0],r.clientY-n[1])>4)return;let s=this.itemAt(r);s!=null&&t(s)});let i={ArrowLeft:[-.12,0],ArrowRight:[.12,0],ArrowUp:[0,.12],ArrowDown:[0,-.12]};this.canvas.addEventListener("keydown",r=>{let s=this.camera.position.clone().sub(this.controls.target);if(r.key in i){let[o,a]=i[r.key],c=Math.hypot(s.x,s.y),l=Math.max(-1.5,Math.min(1.5,Math.atan2(s.z,c)+a)),u=Math.atan2(s.y,s.x)+o,h=s.length();s.set(Math.cos(u)*Math.cos(l),Math.sin(u)*Math.cos(l),Math.sin(l)).multiplyScalar(h)}else if(r.key==="+"||r.key==="=")s.multiplyScalar(.85);else if(r.key==="-")s.multiplyScalar(1/.85);else return;r.preventDefault(),this.camera.position.copy(this.controls.target).add(s),this.controls.update()})}itemAt(t){let n=this.canvas.getBoundingClientRect(),i=new Ft(t.clientX-n.left,t.clientY-n.top),{at:r}=this.cell.points,s=new k,o=null,a=12;for(let c of this.rows){if(s.fromArray(r,3*c).project(this.camera),s.z>1)continue;let l=Math.hypot((s.x+1)/2*n.width-i.x,(1-s.y)/2*n.height-i.y);l<a&&([o,a]=[c,l])}return o}resize(t){let[n,i]=[t.clientWidth,t.clientHeight];!n||!i||(this.renderer.setSize(n,i),this.camera.aspect=n/i,this.camera.updateProjectionMatrix(),this.draw())}draw(){this.waiting||(this.waiting=!0,requestAnimationFrame(()=>{this.waiting=!1,this.renderer.render(this.scene,this.camera)}))}};var Ox=[1,2,5,10,20,50,100,200,500,1e3,2e3,5e3,1e4];function v6(e){let[t,n]=[[1/0,1/0,1/0],[-1/0,-1/0,-1/0]],i=0;for(let a of e.paths){for(let c=0;c+2<a.at.length;c+=3)for(let l=0;l<3;l+=1)t[l]=Math.min(t[l],a.at[c+l]),n[l]=Math.max(n[l],a.at[c+l]);i=Math.max(i,a.worst??0)}e.paths.length||e.points.at.forEach((a,c)=>{a!=null&&(t[c%3]=Math.min(t[c%3],a),n[c%3]=Math.max(n[c%3],a))});for(let{axes:a}of e.ellipsoids??[])i=Math.max(i,...a.map(Math.abs));let r=Math.hypot(...n.map((a,c)=>a-t[c]));if(!(i>0)||!Number.isFinite(r))return 0;let s=.1*r/i,o=0;return Ox.forEach((a,c)=>{a<=s&&(o=c)}),o}function b6(e){for(let t of e.paths){if(!t.at){let n=e.paths[t.like];t.at=n.at,t.starts=n.starts,t.items=n.items}if(t.by){t.worst=0,t.error=new Array(t.at.length/3);for(let n=0;n<t.error.length;n+=1)t.error[n]=Math.hypot(t.by[3*n],t.by[3*n+1],t.by[3*n+2]),t.worst=Math.max(t.worst,t.error[n])}}return e}function M6(e,t){let n=St("div",{className:"controls"}),i=t.paths.some(s=>s.by)||(t.ellipsoids??[]).length>0,r=()=>{};if(i){let s=St("output",{}),o=St("input",{type:"range",min:"0",max:String(Ox.length-1),step:"1",className:"magnify","aria-label":"Magnify deviations"});o.value=String(v6(t)),r=()=>{let a=Ox[Number(o.value)];s.textContent=`\xD7${a}`,o.setAttribute("aria-valuetext",`times ${a}`),e?.magnify(a)},o.addEventListener("input",r),n.append(St("label",{},"Deviations ",o,s))}if(e){for(let c of e.layers.paths){let l=St("input",{type:"checkbox",checked:!0,onchange:()=>{c.lines.visible=l.checked,e.draw()}});n.append(St("label",{},l,` ${c.path.name}`))}let s=[["robot",e.robot?.group],["cell",t.bodies.length?e.solids:null],[t.points.name,e.items]];for(let[c,l]of s){if(!l)continue;let u=St("input",{type:"checkbox",checked:!0,onchange:()=>{l.visible=u.checked,e.draw()}});n.append(St("label",{},u,` ${c}`))}let o={Corner:[1,-1.2,.75],Front:[1,0,.02],Side:[0,-1,.02],Top:[0,-.001,1]},a=St("span",{className:"views"});for(let[c,l]of Object.entries(o))a.append(St("button",{type:"button",onclick:()=>e.view(l)},c));t.paths.length&&a.append(St("button",{type:"button",onclick:()=>e.near()},"Closer")),n.append(a)}return{bar:n,apply:r}}function S6(e,t){let n=Array.from({length:11},(s,o)=>Ep(o/10)).join(", "),i=e.worst,r=i>=1?2:Math.min(6,1-Math.floor(Math.log10(i)));return St("div",{className:"scale"},St("span",{},"0"),St("i",{style:`background: linear-gradient(to right, ${n})`}),St("span",{},`${i.toFixed(r)} ${t}`))}function w6(e,t,n,i){return r=>{let s=St("dl",{});for(let f of n.columns){if(f.code||f.hidden)continue;let d=oe(f,r);d==null||d===""||s.append(St("dt",{},Ws(f)),St("dd",{},pc(d)))}let o=n.columns.find(f=>f.code),a=n.columns.find(f=>f.label==="line"),c=[];if(o&&oe(o,r)!=null){let f=a?St("span",{className:"lineno"},`${oe(a,r)}  `):null;c.push(St("pre",{className:"code"},f,oe(o,r)))}let{joints:l}=t.points;l&&l[6*r]!=null&&s.append(St("dt",{},"joints, deg"),St("dd",{},l.slice(6*r,6*r+6).map(f=>pc(f)).join("  ")));let h=i(r).map(f=>St("li",{className:"severity "+f.severity},`${f.severity} ${f.id}: ${f.message}`));e.replaceChildren(...c,s,h.length?St("ul",{className:"found"},...h):"")}}function T6(e,t){let n=e.paths.filter(l=>l.by&&l.items);if(!n.length||e.along===!1)return null;let i=[],r=[],s=Math.max(...n.map(l=>l.error.length)),o=l=>[...l,...Array(s-l.length).fill(null)];for(let l of n){let u=new Array(l.error.length),h=0;for(let y=0;y<u.length;y+=1)y>0&&(h+=Math.hypot(l.at[3*y]-l.at[3*y-3],l.at[3*y+1]-l.at[3*y-2],l.at[3*y+2]-l.at[3*y-1])),u[y]=Number(h.toFixed(2));let d=l.like!=null&&i.length?0:i.push({label:n.length>1&&i.length?`way (${l.name})`:"way of the tool",unit:"mm",values:o(u)})-1,p=i.push({label:l.name,unit:"mm",values:o(l.error.map(y=>Number(y.toPrecision(4))))})-1;r.push({kind:"line",x:d,y:p,name:l.name,tone:l.tone})}let a=n[0].items,c={title:"Error along the path",note:e.along,wide:!0,x:{label:"way of the tool",unit:"mm"},y:{label:"error",unit:"mm"},series:r};return _h(c,{columns:i},l=>t(a[l]))}function Y2(e,t,n){b6(e);let i=St("div",{className:"stage"}),r=St("div",{className:"detail","aria-live":"polite"}),s=w6(r,e,t,n),o=null,a=null,c=(g,x=!1)=>{g==null||g<0||g>=ai(t)||(s(g),o?.select(g),x||a?.select(g))};try{o=new Cp(i,e,g=>c(g))}catch{i.append(St("p",{className:"missing"},"This browser shows no WebGL: the view in space is left out. Charts and tables are complete."))}a=gl(t,{title:e.points.title,onselect:g=>c(g,!0),page:15});let{bar:l,apply:u}=M6(o,e),h=[St("h2",{},e.title)];e.note&&h.push(St("p",{},e.note));let f=o&&e.paths.some(g=>g.by&&g.graded)?S6(o,"mm"):null;h.push(l,St("div",{className:"cell"},St("div",{className:"space"},i,f),r),St("h3",{},e.points.title),a.node);let d=St("section",{},...h),p=T6(e,g=>c(g));p&&d.append(p);let y=e.points.first??0;return{node:d,select:c,start:()=>{u(),ai(t)&&c(y),o?.view([1,-1.2,.75])}}}function A6(e){if(!e)return()=>[];let t=c=>e.columns.find(l=>l.label===c),[n,i,r,s,o]=["severity","id","file","line","message"].map(t),a=new Map;for(let c=0;c<ai(e);c+=1){let l=`${oe(s,c)} ${oe(r,c)}`;a.has(l)||a.set(l,[]),a.get(l).push({severity:oe(n,c),id:oe(i,c),message:oe(o,c)})}return(c,l)=>a.get(`${l} ${c}`)??[]}function E6(){let e=JSON.parse(document.getElementById("data").textContent),t=document.getElementById("page"),n=e.tables??{},i=A6(n.findings),r=[],s=null,o=null;for(let a of e.sections)switch(a.type!=="chart"&&(o=null),a.type){case"cell":{let c=n[a.table],[l,u]=["file","line"].map(f=>c.columns.find(d=>d.label===f)),h=Y2(a,c,f=>u?i(l?oe(l,f):"",oe(u,f)):[]);s=h.select,r.push(h.start),t.append(h.node);break}case"chart":{o||(o=St("section",{className:"charts"}),t.append(o));let c=n[a.table],l=a.picks?u=>s?.(u):null;o.append(_h(a,c,l));break}case"heat":t.append(St("section",{},GA(a)));break;case"table":{let c=gl(n[a.table],{title:a.title}),l=a.note?St("p",{},a.note):null;t.append(St("section",{},St("h2",{},a.title),l,c.node));break}default:t.append(St("section",{},St("h2",{},a.title),...a.lines.map(c=>St("p",{},c))))}for(let a of r)a();requestAnimationFrame(()=>requestAnimationFrame(()=>{document.documentElement.dataset.ready="yes"}))}E6();})();
