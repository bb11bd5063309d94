// Play, speed, loop, and the current frame.

import { button, choice, element, grouped, toggle } from './dom';
import type { Player } from './player';
import type { Take } from './take';

export function addTransport(holder: HTMLElement, take: Take, player: Player): void {
  const play = button('Play', 'play or pause (space)', () => (player.playing ? player.pause() : player.play()));
  play.className = 'play';
  const slider = element('input', { type: 'range', min: '0', max: String(Math.max(0, take.told - 1)), step: '1', value: '0', 'aria-label': 'frame' });
  slider.addEventListener('input', () => {
    // Pausing moves the slider to the current time.
    const wanted = Number(slider.value);
    player.pause();
    player.seek(wanted);
  });
  const number = element('input', { type: 'number', class: 'number', 'aria-label': 'frame number', min: String(take.number(0)), max: String(take.number(Math.max(0, take.told - 1))), step: String(take.data.step) });
  number.addEventListener('change', () => player.jump(take.frameOf(Number(number.value))));
  const time = element('span', { class: 'time' });
  const speeds: [string, string][] = ['0.1', '0.25', '0.5', '1', '2', '4'].map((speed) => [speed, `${speed}\u00d7`]);
  const controls = element('div', { class: 'controls' }, play,
    button('\u2039', 'previous frame (left arrow)', () => player.step(-1)),
    button('\u203a', 'next frame (right arrow)', () => player.step(1)),
    choice('speed', speeds, '1', (speed) => { player.speed = Number(speed); }),
    toggle('Loop', 'start again at the end (L)', true, (on) => { player.loop = on; }),
    element('label', {}, 'frame ', number), time);
  holder.append(controls, slider);
  const total = take.rate > 0 ? (take.told / take.rate).toFixed(2) : '0';
  const show = (): void => {
    play.textContent = player.playing ? 'Pause' : 'Play';
    slider.value = String(player.shown);
    if (document.activeElement !== number) number.value = String(take.told > 0 ? take.number(player.shown) : take.data.first_frame);
    const seconds = take.rate > 0 ? player.shown / take.rate : 0;
    time.textContent = `${seconds.toFixed(2)} of ${total} s`;
    slider.setAttribute('aria-valuetext', `frame ${grouped(take.number(player.shown))}`);
  };
  player.onMove(show);
  show();
  const none = take.told < 2;
  for (const control of controls.querySelectorAll('button, select, input')) (control as HTMLButtonElement).disabled = none;
  slider.disabled = none;
}
