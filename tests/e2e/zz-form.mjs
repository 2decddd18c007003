import { chromium } from '@playwright/test';
import { serve } from '/work/main/tests/e2e/server.mjs';
const s=await serve();
const b=await chromium.launch({executablePath:'/usr/bin/chromium',args:['--no-sandbox','--disable-gpu']});
for (const [w,h,dark,l,o] of [[1440,900,0,'en','/tmp/f1.png'],[390,844,1,'pt-BR','/tmp/f2.png'],[1024,768,0,'es','/tmp/f3.png']]) { const p=await (await b.newContext({viewport:{width:w,height:h},colorScheme:dark?'dark':'light'})).newPage(); p.setDefaultTimeout(3000); p.on('console',m=>console.log('C',m.text()));
await p.goto(s.origin+`/?bench=relay-tuning&lang=${l}&view=full`); await p.waitForSelector('#bench:not(.outline)'); await p.waitForTimeout(600);
await p.getByTestId('plant').selectOption('wood-berry'); await p.waitForTimeout(500);
await p.getByTestId('own-plant').click(); await p.waitForTimeout(300);
await p.getByTestId('g11').fill('12.8 exp(-s)/(tau s + 1)');
await p.getByTestId('script').fill("G = [1/(s+1), 2;\n  oops 3]");
await p.getByTestId('take-script').click(); await p.waitForTimeout(300);
await p.getByTestId('side-by-side').click(); await p.waitForTimeout(1500);
await p.screenshot({path:o,fullPage:true}); console.log(await p.evaluate(()=>document.documentElement.scrollWidth+'x'+document.documentElement.scrollHeight)); }
await b.close(); process.exit(0);
