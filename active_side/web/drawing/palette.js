// SPDX-License-Identifier: Apache-2.0
// Paper and eight colours, each at least 3:1 from the paper (WCAG 1.4.11); strokes know their colour by its place here.
// Dark paper is for fingers: on a dark screen the camera sees a finger's mirror image, too, and so the moment it lands and lifts.
export const palettes = {
  light: {paper: "#ffffff",
          colours: ["#1a2230", "#c92a2a", "#c2410c", "#8a6100", "#2b7a3b", "#0b6e80", "#1864ab", "#8a2fa3"]},
  dark: {paper: "#12161d",
         colours: ["#eef2f7", "#ff8787", "#ffa94d", "#ffd43b", "#69db7c", "#66d9e8", "#74c0fc", "#e599f7"]},
};
